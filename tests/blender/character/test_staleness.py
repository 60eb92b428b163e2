# SPDX-License-Identifier: MIT
"""A character is marked where Build would learn from something else now, and only then."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import bpy
import making
import pytest


@pytest.fixture
def takes(obj: bpy.types.Object) -> list[bpy.types.Action]:
    """The Actions that the armature was built from."""
    return [action for action in bpy.data.actions if action.fragmotion.use]


def looked_at(addon: ModuleType, obj: bpy.types.Object) -> bool:
    """Whether the mark is there after as many looks as it may take."""
    return any(addon.character.staleness.is_stale(obj) for _ in range(len(bpy.data.actions) + 1))


def first_key(addon: ModuleType, action: bpy.types.Action) -> bpy.types.Keyframe:
    return addon.compat.versions.all_curves(action)[0].keyframe_points[0]


def add_key(addon: ModuleType, action: bpy.types.Action) -> None:
    addon.compat.versions.all_curves(action)[0].keyframe_points.insert(5.5, 0.9)


def nudge(addon: ModuleType, action: bpy.types.Action) -> None:
    first_key(addon, action).co.y += 0.01


def mute(addon: ModuleType, action: bpy.types.Action) -> None:
    addon.compat.versions.all_curves(action)[3].mute = True


def untick(addon: ModuleType, action: bpy.types.Action) -> None:
    action.fragmotion.use = False


@pytest.mark.thorough
@pytest.mark.parametrize("change", [nudge, add_key, mute, untick])
def test_what_changes_the_actions_marks_the_character(
    addon: ModuleType,
    obj: bpy.types.Object,
    takes: list[bpy.types.Action],
    change: Callable[[ModuleType, bpy.types.Action], None],
) -> None:
    assert not looked_at(addon, obj)
    addon.compat.versions.assign(obj, takes[1])  # as one must to edit it
    bpy.context.view_layer.update()
    assert not looked_at(addon, obj)
    change(addon, takes[1])
    bpy.context.view_layer.update()
    assert looked_at(addon, obj)
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=20, seconds=5) == {"FINISHED"}
    assert not looked_at(addon, obj)


def test_undo_takes_the_mark_away(addon: ModuleType, obj: bpy.types.Object, takes: list[bpy.types.Action]) -> None:
    addon.compat.versions.assign(obj, takes[0])
    bpy.context.view_layer.update()
    bpy.ops.ed.undo_push(message="before")
    nudge(addon, takes[0])
    bpy.context.view_layer.update()
    bpy.ops.ed.undo_push(message="after")
    assert looked_at(addon, obj)
    bpy.ops.ed.undo()
    assert not looked_at(addon, bpy.data.objects[making.ARMATURE])
    bpy.ops.ed.redo()
    assert looked_at(addon, bpy.data.objects[making.ARMATURE])


def test_the_mark_survives_saving(
    addon: ModuleType, obj: bpy.types.Object, takes: list[bpy.types.Action], tmp_path: Path
) -> None:
    nudge(addon, takes[0])
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "stale.blend"))
    assert looked_at(addon, making.open_armature(tmp_path / "stale.blend"))


def test_what_build_does_not_read_marks_nothing(
    addon: ModuleType, obj: bpy.types.Object, takes: list[bpy.types.Action]
) -> None:
    takes[0].name = "renamed"
    obj.name = "Hero"
    bpy.context.scene.frame_set(7)
    assert bpy.ops.fragmotion.bake(seconds=1) == {"FINISHED"}
    assert not looked_at(addon, obj)
    other = making.add_armature()
    assert not looked_at(addon, other), "it has no character"


def test_a_policy_from_a_file_is_never_marked(addon: ModuleType, obj: bpy.types.Object, tmp_path: Path) -> None:
    path = str(tmp_path / "mine.policy")
    assert bpy.ops.fragmotion.save_policy(filepath=path) == {"FINISHED"}
    assert bpy.ops.fragmotion.load_policy(filepath=path) == {"FINISHED"}
    bpy.ops.fragmotion.tick_actions(use=False)
    assert not looked_at(addon, obj)


def test_a_look_without_changes_reads_no_keys(addon: ModuleType, obj: bpy.types.Object) -> None:
    looked_at(addon, obj)
    read = []
    keys = addon.character.staleness._keys
    addon.character.staleness._keys = lambda curve: read.append(curve) or keys(curve)
    try:
        assert not addon.character.staleness.is_stale(obj)
    finally:
        addon.character.staleness._keys = keys
    assert not read


@pytest.mark.thorough
def test_reading_all_actions_takes_less_than_sampling_them(addon: ModuleType, obj: bpy.types.Object) -> None:
    rig, takes = addon.rig.rigs.make_rig(obj), addon.mocap.actions.ticked(obj)

    def read() -> None:
        addon.character.staleness._digests.clear()
        addon.character.staleness.sources_of(obj)

    def sample() -> None:
        for action in takes:
            addon.mocap.sampling.sample(bpy.context, obj, action, rig)

    spent = {task.__name__: min(_time(task) for _ in range(3)) for task in (read, sample)}
    print(f"\n{len(takes)} Actions: {1000 * spent['read']:.0f} ms to read, {1000 * spent['sample']:.0f} ms to sample")
    assert spent["read"] < 2 * spent["sample"]


def _time(task: Callable[[], None]) -> float:
    start = time.perf_counter()
    task()
    return time.perf_counter() - start


def test_bones_that_are_chosen_are_what_build_learns_from(addon: ModuleType, obj: bpy.types.Object) -> None:
    roles = addon.rig.rigs.make_rig(obj).skeleton.roles
    other = next(name for name in [bone.name for bone in obj.data.bones] if name not in roles.values())
    addon.rig.bodies.set_roles(obj, {**roles, "left_hand": other, "spine_1": other})
    assert addon.rig.rigs.make_rig(obj).skeleton.roles == {**roles, "left_hand": other}
    assert looked_at(addon, obj), "Build would find another body"
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    assert addon.character.building.load(obj).skeleton.roles["left_hand"] == other
    assert not looked_at(addon, obj)
