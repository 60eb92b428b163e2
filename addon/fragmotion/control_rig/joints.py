# SPDX-License-Identifier: GPL-3.0-or-later
"""The joints of a control rig's body: of its bones those that deform, by what they are to the body."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

import bpy
import numpy as np
from mathutils import Vector

from ..compat.core import core
from ..errors import UserError, core_errors

_PREFIX = "DEF-"
_FEWEST_BONES = 2
_LOWEST = 1e-6
_CHAINS = (
    ("hips", "spine", "neck", "head"),
    *((f"{side}_upper_arm", f"{side}_lower_arm", f"{side}_hand") for side in ("left", "right")),
    *((f"{side}_thigh", f"{side}_shin", f"{side}_foot", f"{side}_toe") for side in ("left", "right")),
)
_CLOSE = 4  # decimals of the armature's unit to which two bones are in one place


class Joint(NamedTuple):
    """Where a part of the body begins and ends at rest, in the armature's space; `bone` deforms it, `parent` is the
    role that it hangs on, empty for the hips."""

    bone: str
    parent: str
    head: Vector
    tail: Vector


def find_joints(obj: bpy.types.Object) -> dict[str, Joint]:
    """Role -> joint, parents first; UserError where the bones that deform are no body with legs, or the object is
    scaled as no character can be."""
    bones = [bone for bone in obj.data.bones if bone.use_deform]
    if len(bones) < _FEWEST_BONES:
        raise UserError(f"Armature '{obj.name}' has {len(bones)} bones that deform: a body has several")
    parents = _parents(bones)
    ordered = list(_ordered(bones, parents))
    with core_errors(f"Armature '{obj.name}'"):
        rig = core.Rig(
            names=[bone.name.removeprefix(_PREFIX) for bone in ordered],
            parents=[ordered.index(parents[bone]) if parents[bone] else -1 for bone in ordered],
            rest=np.array([bone.matrix_local for bone in ordered]),
            lengths=[bone.length for bone in ordered],
            world=np.array(obj.matrix_world),
        )
        found = core.Body(rig.skeleton).roles
    if rig.rise != 1:
        raise UserError(f"Armature '{obj.name}' is scaled unevenly, which no constraints allow: apply the scale")
    by_name = {bone.name.removeprefix(_PREFIX): bone for bone in ordered}
    return _joints({role: by_name[name] for role, name in found.items()}, ordered, parents)


def height_of(joints: Mapping[str, Joint]) -> float:
    """How high the joints reach over the lowest, in the armature's units."""
    heights = [float(joint.head.z) for joint in joints.values()]
    return max(max(heights) - min(heights), _LOWEST)


def without(joints: Mapping[str, Joint], dropped: Collection[str]) -> dict[str, Joint]:
    """The joints but some, in whose place the parts before them in the chain reach on."""
    kept = {}
    for role, joint in joints.items():
        if role not in dropped:
            kept[role] = joint._replace(parent=_kept_parent(role, joints, dropped), tail=_end(role, joints, dropped))
    return kept


def _kept_parent(role: str, joints: Mapping[str, Joint], dropped: Collection[str]) -> str:
    parent = joints[role].parent
    while parent in dropped:
        parent = joints[parent].parent
    return parent


def _end(role: str, joints: Mapping[str, Joint], dropped: Collection[str] = ()) -> Vector:
    """Where the part ends: where the next one of its chain that is kept begins."""
    end = joints[role].tail
    for after in _after(role, joints):
        if after not in dropped:
            return joints[after].head
        end = joints[after].tail
    return end


def _after(role: str, roles: Iterable[str]) -> list[str]:
    """The roles that follow in the chain of limb, finger or trunk, in order."""
    part, number = _split(role)
    for chain in _CHAINS:
        if part in chain:
            chained = [other for other in roles if _split(other)[0] in chain]
            chained.sort(key=lambda other: (chain.index(_split(other)[0]), _split(other)[1]))
            return chained[chained.index(role) + 1 :]
    return [other for other in sorted(roles) if _split(other)[0] == part and _split(other)[1] > number]


def _split(role: str) -> tuple[str, int]:
    """ "spine_2" as "spine" and 2, "left_hand" as itself and 0."""
    part, _, number = role.rpartition("_")
    return (part, int(number)) if number.isdigit() else (role, 0)


def _parents(bones: Sequence[bpy.types.Bone]) -> dict[bpy.types.Bone, bpy.types.Bone | None]:
    """The bone of these that each hangs on: the nearest above it, or one in the place of what is above it, as helpers
    of a rig often lie where a bone that deforms lies. What then still hangs on nothing hangs on the nearest."""
    by_place = {_place(bone): bone for bone in reversed(bones)}
    parents = {bone: _above(bone, by_place) for bone in bones}
    first = next((bone for bone in bones if parents[bone] is None), bones[0])
    for bone in bones:
        if parents[bone] is None and bone is not first:
            parents[bone] = _nearest(bone, [other for other in bones if not _hangs(other, bone, parents)])
    return parents


def _above(bone: bpy.types.Bone, by_place: Mapping[tuple[float, ...], bpy.types.Bone]) -> bpy.types.Bone | None:
    found = (by_place.get(_place(parent)) for parent in bone.parent_recursive)
    return next((other for other in found if other not in (None, bone)), None)


def _place(bone: bpy.types.Bone) -> tuple[float, ...]:
    return tuple(round(value, _CLOSE) for value in (*bone.head_local, *bone.tail_local))


def _hangs(
    bone: bpy.types.Bone | None, other: bpy.types.Bone, parents: Mapping[bpy.types.Bone, bpy.types.Bone | None]
) -> bool:
    """Whether a bone is the other one, or hangs on it however far."""
    while bone is not None and bone != other:
        bone = parents[bone]
    return bone is not None


def _nearest(bone: bpy.types.Bone, others: Sequence[bpy.types.Bone]) -> bpy.types.Bone | None:
    def distance(other: bpy.types.Bone) -> float:
        return float(min((end - bone.head_local).length for end in (other.head_local, other.tail_local)))

    return min(others, key=distance, default=None)


def _ordered(
    bones: Sequence[bpy.types.Bone], parents: Mapping[bpy.types.Bone, bpy.types.Bone | None]
) -> Iterator[bpy.types.Bone]:
    """Parents before their children."""
    below: dict[bpy.types.Bone | None, list[bpy.types.Bone]] = {}
    for bone in bones:
        below.setdefault(parents[bone], []).append(bone)
    stack = below.get(None, [])[::-1]
    while stack:
        bone = stack.pop()
        yield bone
        stack += below.get(bone, [])[::-1]


def _joints(
    found: Mapping[str, bpy.types.Bone],
    ordered: Sequence[bpy.types.Bone],
    parents: Mapping[bpy.types.Bone, bpy.types.Bone | None],
) -> dict[str, Joint]:
    roles = {bone: role for role, bone in found.items()}
    joints = {}
    for bone in ordered:
        if bone in roles:
            above = parents[bone]
            while above is not None and above not in roles:
                above = parents[above]
            parent = roles[above] if above is not None else ""
            joints[roles[bone]] = Joint(bone.name, parent, bone.head_local.copy(), bone.tail_local.copy())
    return {role: joint._replace(tail=_end(role, joints).copy()) for role, joint in joints.items()}
