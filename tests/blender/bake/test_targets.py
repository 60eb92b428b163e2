# SPDX-License-Identifier: MIT
"""A bake goes where it is told, and what was there before is seen around it."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import bpy
import numpy as np
import pytest
from baked import FIRST, SEED, assert_seen, bake, bake_recording, play, seen_at


def test_a_bake_into_the_current_action_replaces_its_keys_from_the_playhead_on(
    addon: ModuleType, obj: bpy.types.Object, trace: np.ndarray, recording: Any
) -> None:
    bake(trace_source="PLAYER", player="runner", seconds=8)
    action = obj.animation_data.action
    names = play(addon, obj, trace).names
    before = seen_at(obj, range(FIRST, FIRST + 240, 10), names)[0]
    bpy.context.scene.frame_set(60)
    assert bpy.ops.fragmotion.bake(trace_source="RECORDING", target="CURRENT", fit_end=False) == {"FINISHED"}
    assert obj.animation_data.action == action and tuple(action.frame_range) == (FIRST, FIRST + 240)
    assert_seen(obj, play(addon, obj, trace), first=60)
    after = seen_at(obj, range(FIRST, FIRST + 240, 10), names)[0]
    kept = np.array([not 60 <= frame <= 180 for frame in range(FIRST, FIRST + 240, 10)])
    np.testing.assert_allclose(after[kept], before[kept], atol=1e-6)
    for curve in addon.compat.versions.curves_of(action, obj):
        frames = [key.co.x for key in curve.keyframe_points]
        assert frames == list(range(FIRST, FIRST + 241))


def test_a_bake_goes_on_where_the_character_stands(
    addon: ModuleType, obj: bpy.types.Object, trace: np.ndarray, recording: Any
) -> None:
    bake_recording()
    played = play(addon, obj, trace).performance
    bpy.context.scene.frame_set(FIRST + 100)
    bake(trace_source="RECORDING", as_recorded=False, place="CHARACTER", seed=SEED, target="CURRENT")
    x, y, heading = played.path[100]
    heads = seen_at(obj, [FIRST + 100], play(addon, obj, trace).names)[0]
    np.testing.assert_allclose(heads[0, 0, :2], (x, y), atol=0.01)
    far = play(addon, obj, trace, start=(x, y, heading))
    bpy.context.scene.frame_set(FIRST + 200)
    np.testing.assert_allclose(
        seen_at(obj, [FIRST + 200], far.names)[0][0, 0, :2], far.heads[100, 0, :2], atol=0.6
    )  # the hips' own heading is not the smoothed one


def test_an_nla_strip_covers_what_played_only_while_it_lasts(
    addon: ModuleType, obj: bpy.types.Object, trace: np.ndarray, recording: Any
) -> None:
    bake(trace_source="PLAYER", player="runner", seconds=8, action="Run")
    names = play(addon, obj, trace).names
    outside = [*range(FIRST, 50, 6), *range(200, 240, 6)]
    before = seen_at(obj, outside, names)[0]
    assert bpy.ops.fragmotion.bake(trace_source="RECORDING", target="NLA", frame_start=60) == {"FINISHED"}
    data = obj.animation_data
    assert data.action is None
    assert [(track.name, len(track.strips)) for track in data.nla_tracks] == [("Run", 1), ("Stroll Bake", 1)]
    assert_seen(obj, play(addon, obj, trace), first=60)
    np.testing.assert_allclose(seen_at(obj, outside, names)[0], before, atol=1e-5)


@pytest.mark.parametrize("below", ["NEW", "NLA"])
@pytest.mark.parametrize("frame", [1, 80])
def test_a_strip_over_keys_that_move_the_object_shows_its_own_path(
    addon: ModuleType, obj: bpy.types.Object, trace: np.ndarray, recording: Any, below: str, frame: int
) -> None:
    """Wherever the playhead is, and so the object, when it is baked."""
    bake_recording(root="OBJECT", target=below, action="Below")
    bpy.context.scene.frame_set(frame)
    bake_recording(target="NLA", root="BONE")
    assert_seen(obj, play(addon, obj, trace))
    assert [track.name for track in obj.animation_data.nla_tracks][-2:] == ["Below", "Stroll Bake"]
