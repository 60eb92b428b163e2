# SPDX-License-Identifier: MIT
"""What cannot be bound is said in one message, and nothing changes; what follows in part is named."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import bpy
import layouts
import making
import pytest


def refuses(operator: Callable[..., set[str]], rig: bpy.types.Object, message: str, **fields: object) -> None:
    """One message that matches, and nothing changes."""
    before = layouts.everything(rig)
    with pytest.raises(RuntimeError, match=message) as failure:
        operator(**fields)
    assert str(failure.value).count("Error:") <= 1
    after = layouts.everything(rig)
    assert {key: (before[key], after[key]) for key in before if before[key] != after[key]} == {}


def cut_legs(rig: bpy.types.Object) -> None:
    with making.editing(rig) as bones:
        for bone in list(bones):
            if any(part in bone.name for part in ("thigh", "leg", "foot", "toes")):
                bones.remove(bone)


def tie_circle(rig: bpy.types.Object) -> None:
    layouts._copy(rig, "c_spine_01.x", "c_neck.x", "COPY_ROTATION")


def stretch(rig: bpy.types.Object) -> None:
    rig.scale = (1, 1, 1.5)


def mirror(rig: bpy.types.Object) -> None:
    rig.scale = (-1, 1, 1)


def free_hips(rig: bpy.types.Object) -> None:
    for bone in rig.pose.bones:
        if bone.name in {"c_pos", "c_root_master.x"}:
            bone.custom_shape = None


def tweak(rig: bpy.types.Object) -> None:
    data = rig.animation_data_create()
    data.nla_tracks.new().strips.new("strip", 1, making.add_action(making.add_armature()))
    making.activate(rig)
    data.nla_tracks[0].select = data.nla_tracks[0].strips[0].select = True
    data.use_tweak_mode = True


@pytest.mark.parametrize(
    ("harm", "message"),
    [
        (cut_legs, "'Hero': .*left_thigh"),
        (tie_circle, "'Hero': bones 'c_spine_01.x'.* wait for each other"),
        (stretch, "'Hero'.*scale"),
        (mirror, "'Hero'.*(scale|mirror)"),
        (free_hips, "'Hero': no control moves the whole body; its hips are bone 'root.x'"),
        (tweak, "NLA's tweak mode"),
    ],
)
def test_what_cannot_follow_changes_nothing(harm: Callable[[bpy.types.Object], None], message: str) -> None:
    rig = layouts.add_layout()
    harm(rig)
    refuses(bpy.ops.fragmotion.bind_rig, rig, message)


def test_what_does_not_follow_is_named(addon: ModuleType, capfd: pytest.CaptureFixture[str]) -> None:
    rig = layouts.add_layout()
    rig.pose.bones["c_hand.l"].custom_shape = None
    for index in range(4):
        rig.driver_add('pose.bones["c_hand.r"].rotation_quaternion', index).driver.expression = "0.5"
    rig.pose.bones["c_head.x"].lock_rotation = (True, True, True)
    assert bpy.ops.fragmotion.bind_rig() == {"FINISHED"}
    told = capfd.readouterr().out
    assert "No control was found for head, left hand, right hand: they do not follow" in told


def test_a_plain_armature_needs_no_motion_skeleton() -> None:
    rig = making.add_armature()
    rig.pose.bones["head"].constraints.new("LIMIT_ROTATION")
    rig.pose.bones["foot.L"].constraints.new("COPY_ROTATION").target = rig
    refuses(bpy.ops.fragmotion.bind_rig, rig, "'Rig' is no control rig")
    refuses(bpy.ops.fragmotion.unbind_rig, rig, "'Rig' has no motion skeleton")


def test_nothing_is_keyed_on_bones_that_controls_move(tmp_path: Path) -> None:
    making.write_bvh(tmp_path / "take.bvh")
    source = making.add_armature()
    making.add_action(source).fragmotion.use = True
    rig = layouts.add_layout()
    fields = {"directory": str(tmp_path), "onto": "ACTIVE"}
    refuses(bpy.ops.fragmotion.import_mocap, rig, "'Hero' is a control rig.*Make Motion Skeleton", **fields)
    rig.fragmotion.source = source
    refuses(bpy.ops.fragmotion.retarget_actions, rig, "'Hero' is a control rig.*Make Motion Skeleton")


def test_there_must_be_something_to_bake() -> None:
    rig = layouts.add_layout()
    assert bpy.ops.fragmotion.bind_rig() == {"FINISHED"}
    refuses(bpy.ops.fragmotion.bake_to_controls, rig, "'Hero Motion' plays no Action")


def test_a_control_rig_makes_no_crowd() -> None:
    rig = layouts.add_layout()
    assert bpy.ops.fragmotion.bind_rig() == {"FINISHED"}
    refuses(
        bpy.ops.fragmotion.populate,
        rig,
        "'Hero' is a control rig, and only plain armatures can be copied: press Bake to Controls",
    )


def test_a_rig_whose_motion_skeleton_was_deleted_can_be_unbound(addon: ModuleType) -> None:
    rig = layouts.add_layout()
    before = layouts.everything(rig)
    assert bpy.ops.fragmotion.bind_rig() == {"FINISHED"}
    bpy.data.objects.remove(addon.control_rig.binding.motion_of(rig))
    refuses(bpy.ops.fragmotion.bake_to_controls, rig, "'Hero' has no motion skeleton any more")
    assert bpy.ops.fragmotion.unbind_rig() == {"FINISHED"}
    bpy.data.orphans_purge()
    assert layouts.everything(rig) == before


@pytest.mark.parametrize("overridden", [False, True])
def test_a_rig_of_another_file_is_refused(tmp_path: Path, overridden: bool) -> None:
    layouts.add_layout()
    library = str(tmp_path / "library.blend")
    bpy.ops.wm.save_as_mainfile(filepath=library)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    with bpy.data.libraries.load(library, link=True) as (_, wanted):
        wanted.objects = ["Hero"]
    rig = bpy.data.objects["Hero"]
    if overridden:
        rig = rig.override_create(remap_local_usages=True)
    bpy.context.scene.collection.objects.link(rig)
    making.activate(rig)
    refuses(bpy.ops.fragmotion.bind_rig, rig, "'Hero' is (linked|a library override).*Make Local")
