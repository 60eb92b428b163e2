# SPDX-License-Identifier: MIT
"""Motion capture of an animal whose rest pose shows nothing: its motion tells that it goes on four legs, and the
armature keeps that."""

from __future__ import annotations

from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

import bpy
import making
import numpy as np


def made_dog() -> ModuleType:
    """Shared with the tests outside Blender."""
    spec = spec_from_file_location("made_dog", Path(__file__).parents[2] / "python" / "made_dog.py")
    assert spec and spec.loader
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_a_dog_is_imported_learned_and_kept(addon: ModuleType, tmp_path: Path) -> None:
    for name, speed, stride in (("stand", 0.0, 1.0), ("walk", 0.6, 0.6), ("trot", 1.2, 0.4)):
        made_dog().write_dog(tmp_path / f"{name}.bvh", speed, stride=stride)
    assert bpy.ops.fragmotion.import_mocap("EXEC_DEFAULT", directory=str(tmp_path)) == {"FINISHED"}
    obj = bpy.context.view_layer.objects.active
    for name in ("walk", "trot"):
        assert [(row.code, row.mended) for row in bpy.data.actions[name].fragmotion.findings] == [("unit", True)]
    assert addon.rig.bodies.chosen_roles(obj)["left_fore_foot"] == "LeftHand"
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    path = tmp_path / "dog.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    bpy.ops.wm.open_mainfile(filepath=str(path))
    obj = bpy.context.view_layer.objects.active
    skeleton = addon.rig.rigs.make_rig(obj).skeleton
    assert skeleton.roles["right_fore_foot"] == "RightHand" and skeleton.roles["right_foot"] == "RightFoot"
    assert "left_hand" not in skeleton.roles and skeleton.stature < 1
    assert addon.character.building.load(obj).skeleton.roles == skeleton.roles


def test_more_takes_come_onto_it_where_it_stands_and_are_mended(addon: ModuleType, tmp_path: Path) -> None:
    for folder, name, speed in (("first", "walk", 0.6), ("more", "amble", 0.5)):
        (tmp_path / folder).mkdir()
        made_dog().write_dog(tmp_path / folder / f"{name}.bvh", speed)
    assert bpy.ops.fragmotion.import_mocap("EXEC_DEFAULT", directory=str(tmp_path / "first"), onto="NEW") == {
        "FINISHED"
    }
    obj = bpy.context.view_layer.objects.active
    obj.location = place = (3, -2, 0)
    bpy.context.view_layer.update()
    more = str(tmp_path / "more")
    assert bpy.ops.fragmotion.import_mocap("EXEC_DEFAULT", directory=more, onto="ACTIVE") == {"FINISHED"}
    rig = addon.rig.rigs.make_rig(obj)
    clip = addon.mocap.sampling.sample(bpy.context, obj, bpy.data.actions["amble"], rig)
    take = addon.compat.core.core.read_bvh(tmp_path / "more" / "amble.bvh", 1.0)
    np.testing.assert_allclose(clip.world_transforms(rig.skeleton)[0], take.world_transforms()[0] + place, atol=1e-4)


def test_a_person_keeps_no_roles_unasked(addon: ModuleType, tmp_path: Path) -> None:
    making.write_bvh(tmp_path / "walk.bvh", seed=1)
    assert bpy.ops.fragmotion.import_mocap("EXEC_DEFAULT", directory=str(tmp_path)) == {"FINISHED"}
    assert addon.rig.bodies.chosen_roles(bpy.context.view_layer.objects.active) is None
