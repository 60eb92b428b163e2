# SPDX-License-Identifier: MIT
"""Whatever cannot be done is said in one message with its cause and place, and changes nothing in the file."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import bpy
import making
import numpy as np
import pytest


def refuses(operator: Callable[..., set[str]], message: str, **fields: object) -> None:
    """The operator is grey or fails with one message that matches, and nothing changes."""
    before = making.contents()
    with pytest.raises(RuntimeError, match=message) as failure:
        operator(**fields)
    assert str(failure.value).count("Error:") <= 1
    assert making.contents() == before


def add_takes(obj: bpy.types.Object, count: int = 2, frames: int = 60) -> None:
    """Ticked Actions of the armature."""
    for index in range(count):
        making.add_action(obj, frames, seed=index, name=f"take {index}").fragmotion.use = True


def test_buttons_say_why_they_are_grey() -> None:
    assert not bpy.ops.fragmotion.build.poll() and not bpy.ops.fragmotion.bake.poll()
    refuses(bpy.ops.fragmotion.build, "No armature is active")
    obj = making.add_armature()
    refuses(bpy.ops.fragmotion.build, "'Rig' has no Actions to learn from: import mocap")
    refuses(bpy.ops.fragmotion.bake, "'Rig' has no character yet: press Build")
    add_takes(obj)
    bpy.ops.fragmotion.tick_actions(use=False)
    refuses(bpy.ops.fragmotion.build, "No Action is ticked")
    bpy.ops.fragmotion.tick_actions(use=True)
    assert bpy.ops.fragmotion.build.poll()
    bpy.ops.object.mode_set(mode="EDIT")
    refuses(bpy.ops.fragmotion.build, "Leave this mode")


def test_one_bone() -> None:
    obj = making.add_armature(making.BODY[:1])
    add_takes(obj)
    refuses(bpy.ops.fragmotion.build, "'Rig' has only one bone, 'root'")


def test_a_non_uniform_scale() -> None:
    obj = making.add_armature()
    add_takes(obj)
    obj.scale = (1, 1, 1.5)
    refuses(bpy.ops.fragmotion.build, r"'Rig'.*scale")


def test_an_action_of_another_rig(addon: ModuleType) -> None:
    other = making.add_armature([("tail", "", (0, 0, 0), (0, 0, 1)), ("fin", "tail", (0, 0, 1), (0, 0, 2))], "Fish")
    add_takes(other, 1)
    obj = making.add_armature()
    refuses(bpy.ops.fragmotion.build, "'take 0' is of another rig: it animates 'fin', 'tail'.*'Rig'")
    rig = addon.rigs.make_rig(obj)
    with pytest.raises(addon.errors.UserError, match="'take 0' animates no bone of armature 'Rig'"):
        addon.sampling.sample(bpy.context, obj, bpy.data.actions["take 0"], rig)


def test_actions_of_other_rigs_are_not_listed(addon: ModuleType) -> None:
    worm = [(f"x{i}", f"x{i - 1}" if i else "", (0, 0, i), (0, 0, i + 1)) for i in range(9)]
    other = making.add_armature(worm, "Worm")
    add_takes(other, 1)
    obj = making.add_armature()
    mine = making.add_action(obj, name="mine")
    assert addon.actions.fitting(obj) == [mine]
    assert [action.name for action in addon.actions.fitting(other)] == ["take 0"]


def test_more_classes_than_fragments() -> None:
    obj = making.add_armature()
    add_takes(obj)
    refuses(bpy.ops.fragmotion.build, "Build: .*classes", classes=5000, mirror=False, synthesize=False)


@pytest.mark.parametrize(
    ("row", "cause"), [("1,2,3", "trace.csv:3"), ("0,fast,0,0", "trace.csv:3"), ("0,nan,0,0", "trace.csv:3")]
)
def test_a_trace_with_a_bad_row(tmp_path: Path, row: str, cause: str) -> None:
    obj = making.add_armature()
    add_takes(obj)
    trace = tmp_path / "trace.csv"
    trace.write_text(f"velocity_x,velocity_y,turn,jump\n0,1,0,0\n{row}\n0,1,0,0\n")
    refuses(bpy.ops.fragmotion.build, cause, trace_source="FILE", trace_file=str(trace))
    refuses(bpy.ops.fragmotion.build, "No trace file is chosen", trace_source="FILE", trace_file="")
    missing = str(tmp_path / "missing.csv")
    refuses(bpy.ops.fragmotion.build, "missing.csv", trace_source="FILE", trace_file=missing)


def test_a_carrier_that_cannot_move() -> None:
    bones = [list(bone) for bone in making.BODY]
    bones[0][3] = (0, 0, 1)  # the root ends where the hips begin
    obj = making.add_armature(bones, connected=("hips",))
    add_takes(obj)
    refuses(bpy.ops.fragmotion.build, "bone 'hips' carries the body, but is connected")


def test_without_feet_takes_are_cut_by_windows(addon: ModuleType, tmp_path: Path) -> None:
    bones = [("base", "", (0, 0, 0), (0, 0, 0.3))]
    bones += [(f"part{i}", f"part{i - 1}" if i else "base", (0, 0, i + 0.3), (0, 0, i + 1.3)) for i in range(4)]
    obj = making.add_armature(bones)
    add_takes(obj, 3, 90)
    assert not any("foot" in role for role in addon.rigs.make_rig(obj).skeleton.roles)
    fields = {"classes": 8, "seconds": 10, "mirror": False}
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", **fields) == {"FINISHED"}
    durations = addon.building.load(obj).fragment_durations
    assert len(durations) >= 8 and durations.max() < 0.5 + 1e-6
    assert bpy.ops.fragmotion.bake(seconds=2) == {"FINISHED"}


def test_an_armature_that_changed_after_build_and_one_that_constraints_move(addon: ModuleType) -> None:
    obj = making.add_armature()
    add_takes(obj, 3, 90)
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=8, seconds=10) == {"FINISHED"}
    obj.pose.bones["head"].constraints.new("LIMIT_ROTATION")
    assert addon.baking.hindrances(obj, ["spine", "head"]) == ["bone 'head' has constraints"]
    obj.data.bones["foot.L"].name = "paw.L"
    refuses(bpy.ops.fragmotion.bake, "has changed since Build.*press Build again")


def test_an_armature_in_the_nlas_tweak_mode() -> None:
    obj = making.add_armature()
    add_takes(obj, 3, 90)
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=8, seconds=10) == {"FINISHED"}
    data = obj.animation_data
    data.nla_tracks.new().strips.new("strip", 1, bpy.data.actions["take 0"])
    data.nla_tracks[0].select = data.nla_tracks[0].strips[0].select = True
    data.use_tweak_mode = True
    assert data.use_tweak_mode
    refuses(bpy.ops.fragmotion.bake, "NLA's tweak mode")


def test_a_take_with_a_value_that_is_no_number(addon: ModuleType) -> None:
    obj = making.add_armature()
    action = making.add_action(obj, 60)
    action.fragmotion.use = True
    curve = next(c for c in addon.versions.curves_of(action, obj) if "spine" in c.data_path)
    curve.keyframe_points[4].co.y = np.nan
    refuses(bpy.ops.fragmotion.build, "'take'.*frame 4.*'spine'")
