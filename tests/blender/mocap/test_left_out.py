# SPDX-License-Identifier: MIT
"""Frames of an Action that Build leaves out: no fragment has one of them or spans them."""

from __future__ import annotations

from types import ModuleType

import bpy
import making
import numpy as np
import pytest

FRAMES = 90


def add_take(name: str = "take", seed: int = 1) -> tuple[bpy.types.Object, bpy.types.Action]:
    """An armature with a ticked Action of FRAMES frames that is chosen in the list."""
    obj = bpy.data.objects.get("Rig") or making.add_armature()
    action = making.add_action(obj, FRAMES, seed=seed, name=name)
    action.fragmotion.use = True
    bpy.context.window_manager.fragmotion.active_action = bpy.data.actions.find(name)
    return obj, action


def leave_out(action: bpy.types.Action, *spans: tuple[int, int]) -> None:
    for first, last in spans:
        span = action.fragmotion.left_out.add()
        span.first, span.last = first, last


@pytest.mark.parametrize(
    ("spans", "parts"),
    [
        ([], [(1, 90)]),
        ([(1, 10)], [(11, 90)]),
        ([(80, 200)], [(1, 79)]),
        ([(-5, 0)], [(1, 90)]),
        ([(30, 40)], [(1, 29), (41, 90)]),
        ([(30, 30)], [(1, 29), (31, 90)]),
        ([(30, 40), (35, 50)], [(1, 29), (51, 90)]),
        ([(30, 40), (42, 50)], [(1, 29), (51, 90)]),  # a single pose is no part
        ([(1, 90)], []),
    ],
)
def test_a_take_falls_into_the_parts_around_its_spans(
    addon: ModuleType, spans: list[tuple[int, int]], parts: list[tuple[int, int]]
) -> None:
    times = np.arange(1.0, FRAMES + 1)
    found = [times[part] for part in addon.mocap.left_out.parts_of(times, spans)]
    assert [(part[0], part[-1]) for part in found] == parts


def test_the_parts_are_the_takes_own_poses(addon: ModuleType) -> None:
    obj, action = add_take()
    leave_out(action, (20, 24), (60, 90))
    rig = addon.rig.rigs.make_rig(obj)
    whole = addon.mocap.sampling.sample(bpy.context, obj, action, rig)
    first, second = addon.mocap.sampling.sample_parts(bpy.context, obj, action, rig)
    np.testing.assert_allclose(first.root_positions, whole.root_positions[:19], atol=1e-9)
    np.testing.assert_allclose(second.root_positions, whole.root_positions[24:59], atol=1e-9)
    np.testing.assert_allclose(second.rotations, whole.rotations[24:59], atol=1e-9)
    assert (first.name, second.name) == ("take from 1", "take from 25")
    assert addon.mocap.left_out.source_of("take from 25 mirrored") == ("take", 25)
    assert addon.mocap.left_out.source_of("take mirrored") == ("take", None)


def test_an_imported_take_keeps_its_rate_and_its_spans_are_scene_frames(addon: ModuleType) -> None:
    obj, action = add_take()
    scene = bpy.context.scene
    scene.render.fps = 30
    action[addon.mocap.actions.RATE], action[addon.mocap.actions.SCENE_RATE] = 60.0, 30.0  # a sample each half frame
    leave_out(action, (20, 24))
    rig = addon.rig.rigs.make_rig(obj)
    first, second = addon.mocap.sampling.sample_parts(bpy.context, obj, action, rig)
    assert len(first.root_positions) == 38  # 1, 1.5 ... 19.5
    assert second.name == "take from 24.5"


def test_no_fragment_has_a_frame_that_is_left_out(addon: ModuleType) -> None:
    for seed in (1, 2, 3):
        obj, action = add_take(f"take {seed}", seed)
        leave_out(action, (20, 24), (50, 61))
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=8, seconds=10) == {"FINISHED"}
    character = addon.character.building.load(obj)
    rate, checked = addon.mocap.sampling.scene_rate(bpy.context.scene), 0
    places = zip(character.fragment_origins, character.fragment_clips, character.fragment_ranges)
    for origin, clip, (begin, end) in places:
        if origin not in {"captured", "mirrored"}:
            continue
        name, part = addon.mocap.left_out.source_of(character.clip_names[clip])
        first, last = part + begin * rate, part + end * rate
        assert name.startswith("take ") and 1 <= first < last <= FRAMES
        assert not any(first <= left_last and last >= left_first for left_first, left_last in ((20, 24), (50, 61)))
        checked += 1
    assert checked > 10


def test_a_take_that_is_left_out_whole_is_named() -> None:
    _, action = add_take()
    leave_out(action, (1, FRAMES))
    with pytest.raises(RuntimeError, match="'take': all of its frames are left out"):
        bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=4)


def test_the_button_leaves_out_what_the_timeline_shows_as_chosen(addon: ModuleType) -> None:
    obj, action = add_take()
    scene = bpy.context.scene
    scene.frame_set(7)
    curves = addon.compat.versions.curves_of(action, obj)
    for selected, expected in ((range(0), (7, 7)), (range(10, 15), (11, 15)), (range(FRAMES), (7, 7))):
        for curve in curves:
            for index, key in enumerate(curve.keyframe_points):
                key.select_control_point = index in selected
        assert bpy.ops.fragmotion.leave_out() == {"FINISHED"}
        span = action.fragmotion.left_out[-1]
        assert (span.first, span.last) == expected
    scene.use_preview_range, scene.frame_preview_start, scene.frame_preview_end = True, 3, 33
    bpy.ops.ed.undo_push(message="before")
    assert bpy.ops.fragmotion.leave_out("EXEC_DEFAULT", True) == {"FINISHED"}
    action = bpy.data.actions["take"]
    assert addon.mocap.left_out.spans_of(action)[-1] == (3, 33) and len(action.fragmotion.left_out) == 4
    bpy.ops.ed.undo()
    assert len(bpy.data.actions["take"].fragmotion.left_out) == 3, "it is not one undo step"
    assert bpy.ops.fragmotion.take_in(index=1) == {"FINISHED"}
    assert addon.mocap.left_out.spans_of(bpy.data.actions["take"]) == [(7, 7), (7, 7)]


def test_a_span_never_ends_before_it_begins() -> None:
    _, action = add_take()
    span = action.fragmotion.left_out.add()
    span.last, span.first = 5, 9
    assert (span.first, span.last) == (9, 9)


def test_the_buttons_are_grey_where_no_take_is_chosen() -> None:
    add_take()
    assert bpy.ops.fragmotion.leave_out.poll()
    bpy.context.window_manager.fragmotion.active_action = 99
    with pytest.raises(RuntimeError, match="No take is chosen"):
        bpy.ops.fragmotion.leave_out()
