# SPDX-License-Identifier: MIT
"""A take is played on its armature before it is ticked, and everything is as it was afterwards."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import making
import numpy as np
import pytest
from driving import everything, hips

STEP = 1 / 4  # s


@pytest.fixture
def previews(addon: ModuleType) -> Iterator[ModuleType]:
    """The add-on's module of previews; there is none afterwards."""
    yield addon.preview.previews
    addon.preview.previews.stop()


@pytest.fixture
def sample(addon: ModuleType) -> bpy.types.Object:
    """The sample's armature between two frames, its pose changed by hand; the scene plays at the takes' rate."""
    obj = making.open_sample()
    bpy.context.scene.frame_set(17, subframe=0.5)
    obj.pose.bones["hips"].location.x += 0.3
    obj.pose.bones["hips"].rotation_mode = "XYZ"
    return obj


def another_take(obj: bpy.types.Object) -> bpy.types.Action:
    """One that the armature does not play."""
    playing = obj.animation_data.action
    return next(a for a in bpy.data.actions if a != playing and not a.fragmotion.style and "run" in a.name)


def show(addon: ModuleType, obj: bpy.types.Object, action: bpy.types.Action) -> None:
    """Play the take, in place of what plays."""
    addon.preview.previews.stop()
    addon.preview.previews.show(addon.preview.take_preview.TakePreview(bpy.context, obj, action))


def told(obj: bpy.types.Object) -> str:
    """Everything in words, to be compared across an undo or a load."""
    return repr(everything(obj))


def test_a_take_is_shown_as_blender_plays_it_on_loop_and_leaves_nothing(
    addon: ModuleType, previews: ModuleType, sample: Any
) -> None:
    before, action = everything(sample), another_take(sample)
    show(addon, sample, action)
    length, seen = previews.current.seconds, [hips(sample)]
    rate = bpy.context.scene.render.fps / bpy.context.scene.render.fps_base
    for _ in range(round(length / STEP) + 4):
        previews.current.step(STEP)
        bpy.context.view_layer.update()
        seen.append(hips(sample))
    times = (STEP * np.arange(len(seen))) % length
    assert bpy.context.scene.frame_current_final == 17.5, "the playhead is the user's"
    previews.stop()
    assert everything(sample) == before
    frames = action.frame_range[0] + np.floor(times * rate + 1e-6)
    poses = making.blender_poses(sample, action, frames, ["hips"])[:, 0, :3, 3]
    np.testing.assert_allclose(seen, poses, atol=2e-3)
    assert np.ptp(np.array(seen), axis=0).max() > 1, "it runs"


def test_another_take_takes_its_place(addon: ModuleType, previews: ModuleType, sample: Any) -> None:
    before = everything(sample)
    for action in (another_take(sample), bpy.data.actions["jump up"]):
        show(addon, sample, action)
        assert previews.current.name == f"Take '{action.name}'" and previews.current.trouble() == ""
    previews.stop()
    assert previews.current is None and everything(sample) == before


def test_a_take_that_cannot_be_shown_is_refused_and_nothing_changes(
    addon: ModuleType, previews: ModuleType, sample: Any
) -> None:
    before, stranger = everything(sample), bpy.data.actions.new("of nobody")
    with pytest.raises(addon.errors.UserError, match="'of nobody' animates no bone"):
        show(addon, sample, stranger)
    bpy.data.actions.remove(stranger)
    assert previews.current is None and everything(sample) == before


def test_what_is_taken_away_ends_it(addon: ModuleType, previews: ModuleType, sample: Any) -> None:
    name = sample.name
    show(addon, sample, another_take(sample))
    bpy.data.objects.remove(sample)
    assert previews.current.trouble() == f"Armature '{name}' was deleted"
    previews.stop()


def test_an_undo_step_from_its_middle_is_healed(addon: ModuleType, previews: ModuleType, sample: Any) -> None:
    for action in bpy.data.actions:
        action.fragmotion.use = False
    name, before = sample.name, told(sample)
    bpy.ops.ed.undo_push(message="before")
    show(addon, sample, another_take(sample))
    for take in ("jump up", "run back"):  # each tick is a step of the user's
        bpy.data.actions[take].fragmotion.use = True
        bpy.ops.ed.undo_push(message="tick")
    previews.stop()
    bpy.ops.ed.undo()
    obj = bpy.data.objects[name]
    assert bpy.data.actions["jump up"].fragmotion.use and not bpy.data.actions["run back"].fragmotion.use
    assert told(obj) == before


def test_nothing_else_may_change_the_armature_meanwhile(
    addon: ModuleType, previews: ModuleType, obj: bpy.types.Object
) -> None:
    others = (bpy.ops.fragmotion.build, bpy.ops.fragmotion.bake, bpy.ops.fragmotion.tick_actions)
    assert all(operator.poll() for operator in others)
    show(addon, obj, another_take(obj))
    assert not any(operator.poll() for operator in others) and bpy.ops.fragmotion.play_take.poll()


def test_a_file_that_is_saved_meanwhile_has_the_armature_as_it_was(
    addon: ModuleType, previews: ModuleType, tmp_path: Path
) -> None:
    obj = making.open_sample()
    before = told(obj)
    show(addon, obj, another_take(obj))
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "saved.blend"))
    assert previews.current is None and told(obj) == before
    assert told(making.open_armature(tmp_path / "saved.blend")) == before
