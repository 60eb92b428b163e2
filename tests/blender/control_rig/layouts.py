# SPDX-License-Identifier: MIT
"""Control rigs: Rigify's generated human, and one of another make; and all that a rig is, to compare."""

from __future__ import annotations

from typing import Any

import bpy
import making
import pytest
from mathutils import Vector

Bone = tuple[str, str, tuple[float, float, float], tuple[float, float, float]]
_SIDES = (("l", 1), ("r", -1))

_DEFORMING: tuple[Bone, ...] = (
    ("root.x", "", (0, 0, 1), (0, 0, 1.12)),
    ("spine_01.x", "root.x", (0, 0, 1.12), (0, 0.02, 1.3)),
    ("spine_02.x", "spine_01.x", (0, 0.02, 1.3), (0, 0.02, 1.5)),
    ("neck.x", "spine_02.x", (0, 0.02, 1.5), (0, 0, 1.6)),
    ("head.x", "neck.x", (0, 0, 1.6), (0, 0, 1.8)),
)
_DEFORMING_SIDE: tuple[Bone, ...] = (
    ("shoulder", "spine_02.x", (0.03, 0.02, 1.45), (0.18, 0.02, 1.47)),
    ("arm", "shoulder", (0.18, 0.02, 1.47), (0.45, 0.03, 1.45)),
    ("forearm", "arm", (0.45, 0.03, 1.45), (0.7, 0, 1.44)),
    ("hand", "forearm", (0.7, 0, 1.44), (0.8, 0, 1.44)),
    ("thigh", "root.x", (0.1, 0, 0.98), (0.1, -0.03, 0.52)),
    ("leg", "thigh", (0.1, -0.03, 0.52), (0.1, 0, 0.1)),
    ("foot", "leg", (0.1, 0, 0.1), (0.1, -0.13, 0.02)),
    ("toes", "foot", (0.1, -0.13, 0.02), (0.1, -0.2, 0.02)),
)
_CONTROLS: tuple[Bone, ...] = (  # none of the trunk's points where its bone does
    ("c_pos", "", (0, 0, 0), (0, 0.3, 0)),
    ("c_root_master.x", "c_pos", (0, 0.1, 1.05), (0, 0.4, 1.05)),
    ("c_root.x", "c_root_master.x", (0, 0, 1), (0, 0.2, 1)),
    ("c_spine_01.x", "c_root_master.x", (0, 0, 1.12), (0, 0.2, 1.12)),
    ("c_spine_02.x", "c_spine_01.x", (0, 0.02, 1.3), (0, 0.2, 1.3)),
    ("c_neck.x", "c_spine_02.x", (0, 0.02, 1.5), (0, 0.2, 1.5)),
    ("c_head.x", "c_neck.x", (0, 0, 1.6), (0, 0.2, 1.6)),
)
SWITCH = "ik_fk_switch"


def rigify_human() -> bpy.types.Object:
    """The rig that Rigify generates from its human meta-rig, alone in the file; skips where there is no Rigify."""
    handlers = list(bpy.app.handlers.load_post)
    try:
        bpy.ops.preferences.addon_enable(module="rigify")
    except RuntimeError as error:
        pytest.skip(f"this Blender has no Rigify: {error}")
    bpy.ops.object.armature_human_metarig_add()
    metarig = bpy.context.object
    assert bpy.ops.pose.rigify_generate() == {"FINISHED"}
    rig = next(obj for obj in bpy.data.objects if obj.type == "ARMATURE" and obj != metarig)
    bpy.data.objects.remove(metarig)
    bpy.ops.preferences.addon_disable(module="rigify")
    bpy.app.handlers.load_post[:] = handlers  # Blender 5.2's Rigify leaves its own behind, which then fails
    return rig


def add_layout(fk_legs: bool = True) -> bpy.types.Object:
    """A rig named "Hero" whose legs are moved by IK, or with `fk_legs` by FK where a switch says so, which is at IK;
    active.

    Its bones deform in a chain of their own, as in Auto-Rig Pro's rigs, and have such names. Each follows a helper in
    its place that hangs on a control; no control of the trunk points where its bone does.
    """
    bones, wires = [*_DEFORMING, *_CONTROLS], []
    for name in (bone[0] for bone in _DEFORMING):
        _wire(bones, wires, name, "fk", f"c_{name}")
    for side, sign in _SIDES:
        bones += [_sided(bone, side, sign) for bone in _DEFORMING_SIDE]
        for name in ("shoulder", "arm", "forearm", "hand", *(("thigh", "leg", "foot", "toes") if fk_legs else ())):
            bones.append(_fk_control(bones, f"{name}.{side}"))
            _wire(bones, wires, f"{name}.{side}", "fk", f"c_{name}.{side}")
        _add_ik_leg(bones, wires, side, sign)
    obj = making.add_armature(bones, "Hero")
    _dress(obj, wires)
    for side, _ in _SIDES:
        _solve(obj, side)
        if fk_legs:
            obj.pose.bones[f"c_foot_ik.{side}"][SWITCH] = 0.0
            for name in ("thigh", "leg", "foot", "toes"):
                _drive(obj, obj.pose.bones[f"{name}.{side}"].constraints[1], f"c_foot_ik.{side}")
    bpy.context.view_layer.update()
    return obj


def _sided(bone: Bone, side: str, sign: int) -> Bone:
    name, parent, head, tail = bone
    above = parent if parent.endswith(".x") else f"{parent}.{side}"
    return f"{name}.{side}", above, (sign * head[0], *head[1:]), (sign * tail[0], *tail[1:])


def _fk_control(bones: list[Bone], name: str) -> Bone:
    """A control in the place of a bone that deforms, in a chain of such."""
    bone = next(bone for bone in bones if bone[0] == name)
    return f"c_{name}", f"c_{bone[1]}", *bone[2:]


def _wire(bones: list[Bone], wires: list[tuple[str, str]], name: str, kind: str, control: str) -> None:
    """Let a bone follow a helper in its place that hangs on a control."""
    bone = next(bone for bone in bones if bone[0] == name)
    helper = f"{kind}_{name}"
    bones.append((helper, control, *bone[2:]))
    wires.append((name, helper))


def _add_ik_leg(bones: list[Bone], wires: list[tuple[str, str]], side: str, sign: int) -> None:
    ball = (0.1 * sign, -0.13, 0.02)
    bones += [
        (f"c_foot_ik.{side}", "c_pos", (0.1 * sign, 0, 0.1), (0.1 * sign, -0.2, 0.1)),
        (f"c_toes_ik.{side}", f"c_foot_ik.{side}", ball, (0.1 * sign, -0.2, 0.02)),
        (f"c_leg_pole.{side}", "c_pos", (0.1 * sign, -0.6, 0.52), (0.1 * sign, -0.7, 0.52)),
    ]
    _wire(bones, wires, f"thigh.{side}", "ik", "c_root.x")
    _wire(bones, wires, f"leg.{side}", "ik", f"ik_thigh.{side}")
    _wire(bones, wires, f"foot.{side}", "ik", f"ik_leg.{side}")
    _wire(bones, wires, f"toes.{side}", "ik", f"c_toes_ik.{side}")
    _wire(bones, [], f"foot.{side}", "goal", f"c_foot_ik.{side}")


def _dress(obj: bpy.types.Object, wires: list[tuple[str, str]]) -> None:
    """Shapes for the controls, and for each wire a constraint by which the bone follows its helper."""
    with making.editing(obj) as bones:
        for bone in bones:
            deforming = bone.name.partition("_")[2]
            if bone.name.startswith(("fk_", "ik_", "goal_")):
                bone.roll = bones[deforming].roll
    shape = bpy.data.objects.new("Shape", bpy.data.meshes.new("Shape"))
    deforming = {name for name, _ in wires}
    for bone in obj.pose.bones:
        bone.bone.use_deform = bone.name in deforming
        bone.custom_shape = shape if bone.name.startswith("c_") else None
    for name, helper in wires:
        _copy(obj, name, helper, "COPY_TRANSFORMS")


def _solve(obj: bpy.types.Object, side: str) -> None:
    """Let a leg reach for its foot's control, its knee where it rests."""
    _copy(obj, f"ik_foot.{side}", f"goal_foot.{side}", "COPY_ROTATION")
    solver = _copy(obj, f"ik_leg.{side}", f"c_foot_ik.{side}", "IK")
    solver.pole_target, solver.pole_subtarget, solver.chain_count = obj, f"c_leg_pole.{side}", 2
    knee = obj.pose.bones[f"ik_leg.{side}"]

    def error(angle: float) -> float:
        solver.pole_angle = angle
        bpy.context.view_layer.update()
        return float((knee.head - Vector(knee.bone.head_local)).length)

    best = 0.0
    for step in (0.1, 0.01, 0.001, 0.0001):
        best = min([best + step * count for count in range(-32, 33)], key=error)
    solver.pole_angle = best


def _copy(obj: bpy.types.Object, bone: str, source: str, kind: str) -> Any:
    constraint: Any = obj.pose.bones[bone].constraints.new(kind)
    constraint.target, constraint.subtarget = obj, source
    return constraint


def _drive(obj: bpy.types.Object, constraint: bpy.types.Constraint, owner: str) -> None:
    """Let a constraint act while the switch is at 0."""
    driver = constraint.driver_add("influence").driver
    driver.expression = "1 - fk"
    variable = driver.variables.new()
    variable.name = "fk"
    variable.targets[0].id, variable.targets[0].data_path = obj, f'pose.bones["{owner}"]["{SWITCH}"]'


def everything(obj: bpy.types.Object) -> dict[str, Any]:
    """All that binding might change of a rig and the file."""
    bpy.context.view_layer.update()
    data = obj.animation_data
    return {
        **making.contents(),
        "properties": {owner.name: _custom(owner) for owner in (obj, obj.data, *obj.pose.bones)},
        "constraints": {b.name: [_values(c) for c in b.constraints] for b in obj.pose.bones if b.constraints},
        "modes": {
            b.name: (b.rotation_mode, b.bone.select if hasattr(b.bone, "select") else b.select) for b in obj.pose.bones
        },
        "drivers": data and [(d.data_path, d.array_index, d.driver.expression) for d in data.drivers],
        "nla": data and (data.use_nla, [track.name for track in data.nla_tracks]),
        "slot": getattr(data, "action_slot", None) and data.action_slot.handle,
        "collections": sorted(collection.name for collection in bpy.data.collections),
        "hidden": sorted(other.name for other in bpy.context.view_layer.objects if other.hide_get()),
        "matrix": [tuple(row) for row in obj.matrix_world],
    }


def _custom(owner: Any) -> dict[str, tuple[str, str]]:
    """Custom properties with their types, but those that registered ones are kept in."""
    return {key: (type(value).__name__, repr(value)) for key, value in owner.items() if key != "fragmotion"}


def _values(constraint: bpy.types.Constraint) -> dict[str, str]:
    return {p.identifier: repr(getattr(constraint, p.identifier)) for p in constraint.bl_rna.properties}
