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


def test_an_empty_that_holds_one_armature_stands_for_it() -> None:
    """As the importers of files from stores leave them, with the Empty active."""
    obj, empty = making.add_armature(), bpy.data.objects.new("Sketchfab_model", None)
    mesh = bpy.data.objects.new("Hair", bpy.data.meshes.new("Hair"))
    add_takes(obj)
    for each in (empty, mesh):
        bpy.context.scene.collection.objects.link(each)
    obj.parent = mesh.parent = empty
    for each in (empty, mesh):
        making.activate(each)
        assert bpy.ops.fragmotion.build.poll()
    other = making.add_armature(name="Other")
    other.parent = empty
    making.activate(empty)
    refuses(bpy.ops.fragmotion.build, "No armature is active")


def test_one_bone() -> None:
    obj = making.add_armature(making.BODY[:1])
    add_takes(obj)
    refuses(bpy.ops.fragmotion.build, "'Rig' has only one bone, 'root'")


def test_a_scale_that_is_not_uniform_along_the_ground() -> None:
    obj = making.add_armature()
    add_takes(obj)
    obj.scale = (1, 1.5, 1)
    refuses(bpy.ops.fragmotion.build, r"'Rig'.*scale")


def test_an_action_of_another_rig(addon: ModuleType) -> None:
    other = making.add_armature([("tail", "", (0, 0, 0), (0, 0, 1)), ("fin", "tail", (0, 0, 1), (0, 0, 2))], "Fish")
    add_takes(other, 1)
    obj = making.add_armature()
    refuses(bpy.ops.fragmotion.build, "'take 0' is of another rig: it animates 'fin', 'tail'.*'Rig'")
    rig = addon.rig.rigs.make_rig(obj)
    with pytest.raises(addon.errors.UserError, match="'take 0' animates no bone of armature 'Rig'"):
        addon.mocap.sampling.sample(bpy.context, obj, bpy.data.actions["take 0"], rig)


def test_actions_of_other_rigs_are_not_listed(addon: ModuleType) -> None:
    worm = [(f"x{i}", f"x{i - 1}" if i else "", (0, 0, i), (0, 0, i + 1)) for i in range(9)]
    other = making.add_armature(worm, "Worm")
    add_takes(other, 1)
    obj = making.add_armature()
    mine = making.add_action(obj, name="mine")
    assert addon.mocap.actions.fitting(obj) == [mine]
    assert [action.name for action in addon.mocap.actions.fitting(other)] == ["take 0"]


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
    assert not any("foot" in role for role in addon.rig.rigs.make_rig(obj).skeleton.roles)
    fields = {"classes": 8, "seconds": 10, "mirror": False}
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", **fields) == {"FINISHED"}
    durations = addon.character.building.load(obj).fragment_durations
    assert len(durations) >= 8 and durations.max() < 0.5 + 1e-6
    assert bpy.ops.fragmotion.bake(seconds=2) == {"FINISHED"}


@pytest.mark.parametrize("root", [False, True])
def test_a_rig_without_knees_builds_and_bakes(root: bool) -> None:
    bones = [("root", "", (0, 0, 0), (0, 0.3, 0))] if root else []
    bones += [("hips", "root" if root else "", (0, 0, 1), (0, 0, 1.15))]
    bones += [bone for bone in making.BODY if bone[0] in ("spine", "head")]
    for side, x in (("L", 0.1), ("R", -0.1)):
        bones.append((f"leg.{side}", "hips", (x, 0, 1), (x, 0, 0.1)))
        bones.append((f"foot.{side}", f"leg.{side}", (x, 0, 0.1), (x, -0.15, 0.02)))
    obj = making.add_armature(bones)
    add_takes(obj, 3, 90)
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=8, seconds=10) == {"FINISHED"}
    assert bpy.ops.fragmotion.bake(seconds=2) == {"FINISHED"}


def build_small(obj: bpy.types.Object) -> None:
    """A character of few classes."""
    if not bpy.data.actions:
        add_takes(obj, 3, 90)
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=8, seconds=10) == {"FINISHED"}


def rename(obj: bpy.types.Object) -> None:
    obj.data.bones["foot.L"].name = "paw.L"


def add_bone(obj: bpy.types.Object) -> None:
    with making.editing(obj) as bones:
        bones.new("tail").tail = (0, 1, 0)
        bones["tail"].parent = bones["hips"]


def hang_elsewhere(obj: bpy.types.Object) -> None:
    with making.editing(obj) as bones:
        bones["foot.R"].parent = bones["thigh.R"]


def raise_shoulder(obj: bpy.types.Object) -> None:
    with making.editing(obj) as bones:
        bones["upper_arm.L"].head.z += 0.05
        bones["upper_arm.L"].tail.z += 0.05


def roll_shin(obj: bpy.types.Object) -> None:
    with making.editing(obj) as bones:
        bones["shin.L"].roll += np.radians(10)


def stretch_head(obj: bpy.types.Object) -> None:
    with making.editing(obj) as bones:
        bones["head"].length *= 1.5


def scale_object(obj: bpy.types.Object) -> None:
    obj.scale = (1.5, 1.5, 1.5)


def scale_bones(obj: bpy.types.Object) -> None:
    with making.editing(obj) as bones:
        ends = {bone.name: (0.5 * bone.head, 0.5 * bone.tail) for bone in bones}
        for name, (head, tail) in ends.items():
            bones[name].head, bones[name].tail = head, tail


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (rename, "bone 'foot.L' is missing"),
        (add_bone, "bone 'tail' is new"),
        (hang_elsewhere, "bone 'foot.R' hangs on 'thigh.R', not on 'shin.R'"),
        (raise_shoulder, "bone 'upper_arm.L' begins 0.050 m from where it did on 'spine'"),
        (roll_shin, "bone 'shin.L' is turned by 10.0 degrees at rest"),
        (stretch_head, "bone 'head' is 0.451 m long, not 0.301 m"),
        (scale_object, "it is 1.5 times as large"),
        (scale_bones, "it is 0.5 times as large"),
    ],
)
def test_an_armature_that_changed_after_build(change: Callable[[bpy.types.Object], None], told: str) -> None:
    obj = making.add_armature()
    build_small(obj)
    change(obj)
    refuses(bpy.ops.fragmotion.bake, f"'Rig' has changed since Build: {told}.*press Build again")


def test_an_armature_that_only_stands_elsewhere_is_the_same() -> None:
    obj = making.add_armature()
    build_small(obj)
    obj.location, obj.rotation_euler = (300, -200, 7), (0.4, 0.2, 2)
    assert bpy.ops.fragmotion.bake(seconds=1) == {"FINISHED"}
    obj.scale = (2, 2, 2)
    scale_bones(obj)  # twice half the size
    assert bpy.ops.fragmotion.bake(seconds=1) == {"FINISHED"}


def constrain_bone(obj: bpy.types.Object) -> None:
    obj.pose.bones["head"].constraints.new("LIMIT_ROTATION")
    obj.pose.bones["spine"].constraints.new("LIMIT_ROTATION").mute = True
    obj.pose.bones["hips"].constraints.new("LIMIT_ROTATION").influence = 0


def constrain_object(obj: bpy.types.Object) -> None:
    obj.constraints.new("LIMIT_LOCATION")


def drive(obj: bpy.types.Object) -> None:
    obj["mood"] = 1.0
    obj.driver_add('["mood"]').driver.expression = "frame"  # moves nothing
    for bone in ("head", "spine"):
        obj.driver_add(f'pose.bones["{bone}"].scale', 0).driver.expression = "1"


def carry(obj: bpy.types.Object) -> None:
    obj.parent = making.add_mesh(making.add_mesh())
    obj.parent.parent.name = "Cart"
    obj.parent.parent.keyframe_insert("location", frame=1)


@pytest.mark.parametrize(
    ("hinder", "named"),
    [
        (constrain_bone, "constraint 'Limit Rotation' of bone 'head'"),
        (constrain_object, "object constraint 'Limit Location'"),
        (drive, 'driver of pose.bones["head"].scale and 1 more'),
        (carry, "moving parent 'Cart'"),
    ],
)
def test_what_else_moves_the_armature_is_named(
    addon: ModuleType,
    capfd: pytest.CaptureFixture[str],
    hinder: Callable[[bpy.types.Object], None],
    named: str,
) -> None:
    obj = making.add_armature()
    add_takes(obj, 3, 90)
    obj.parent = making.add_mesh()  # one that stands still
    assert addon.bake.baking.hindrances(obj) == []
    hinder(obj)
    assert addon.bake.baking.hindrances(obj) == [named]
    build_small(obj)
    assert f"learned as Blender shows them, moved also by {named}" in capfd.readouterr().out
    assert bpy.ops.fragmotion.bake(seconds=1) == {"FINISHED"}
    assert f"will differ from the bake because of {named}" in capfd.readouterr().out


def test_the_nla_and_the_rest_position_hide_a_bake(addon: ModuleType) -> None:
    obj = making.add_armature()
    add_takes(obj, 1)
    obj.animation_data.nla_tracks.new().name = "Dance"
    obj.data.pose_position = "REST"
    assert addon.bake.baking.hindrances(obj) == ["NLA track 'Dance'", "the armature's Rest Position"]


def test_an_action_of_a_single_pose_is_named(capfd: pytest.CaptureFixture[str]) -> None:
    obj = making.add_armature()
    making.add_action(obj, 1, name="T-pose").fragmotion.use = True
    refuses(bpy.ops.fragmotion.build, r"'T-pose' holds a single pose \(frame 1\).*untick it")
    add_takes(obj, 3, 90)
    build_small(obj)
    assert "Left out, as they hold a single pose: T-pose" in capfd.readouterr().out


def link_armature(folder: Path, kind: str) -> bpy.types.Object:
    """An armature with a ticked Action, of another file: linked, or overridden, by itself or in a collection."""
    collection = bpy.data.collections.new("Cast")
    bpy.context.scene.collection.children.link(collection)
    obj = making.add_armature()
    collection.objects.link(obj)
    bpy.context.scene.collection.objects.unlink(obj)
    add_takes(obj, 1)
    library = str(folder / "library.blend")
    bpy.ops.wm.save_as_mainfile(filepath=library)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    scene, with_collection = bpy.context.scene, "collection" in kind
    with bpy.data.libraries.load(library, link=True) as (_, wanted):
        setattr(wanted, "collections" if with_collection else "objects", ["Cast" if with_collection else "Rig"])
    obj = bpy.data.objects["Rig"]
    if kind == "collection":
        scene.collection.children.link(bpy.data.collections["Cast"])
    elif kind == "overridden collection":
        bpy.data.collections["Cast"].override_hierarchy_create(scene, bpy.context.view_layer)
        obj = next(o for o in scene.objects if o.override_library)
    elif kind == "data":
        obj = bpy.data.objects.new("Rig", obj.data)
    elif kind == "overridden object":
        obj = obj.override_create(remap_local_usages=True)
    if not with_collection:
        scene.collection.objects.link(obj)
    bpy.context.view_layer.update()
    making.activate(obj)
    return obj


MAKE_LOCAL = {"Selected Objects and Data": "SELECT_OBDATA", "All": "ALL"}


@pytest.mark.parametrize("kind", ["object", "data", "collection", "overridden object", "overridden collection"])
def test_an_armature_of_another_file_can_be_made_local_as_advised(tmp_path: Path, kind: str) -> None:
    obj = link_armature(tmp_path, kind)
    state = "is a library override" if kind.startswith("overridden") else "is linked from another file"
    with pytest.raises(RuntimeError, match=f"'Rig' {state}") as failure:
        bpy.ops.fragmotion.build()
    choice = str(failure.value).strip().rpartition("Make Local > ")[2]
    assert bpy.ops.object.make_local(type=MAKE_LOCAL[choice]) == {"FINISHED"}
    obj = next(o for o in bpy.context.scene.objects if o.library is None)
    making.activate(obj)
    add_takes(obj, 1)
    assert bpy.ops.fragmotion.build.poll()


def test_an_armature_in_the_nlas_tweak_mode() -> None:
    obj = making.add_armature()
    build_small(obj)
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
    curve = next(c for c in addon.compat.versions.curves_of(action, obj) if "spine" in c.data_path)
    curve.keyframe_points[4].co.y = np.nan
    refuses(bpy.ops.fragmotion.build, "'take'.*frame 4.*'spine'")
