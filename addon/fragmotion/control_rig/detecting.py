# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether an armature's bones are moved by controls, so that keys on them would do nothing."""

from __future__ import annotations

import re

import bpy

_PASSIVE = ("LIMIT_", "MAINTAIN_VOLUME")  # constraints that only restrain what moves a bone
_SHARE = 1 / 4  # of the deforming bones: fewer are helpers, such as twist bones
_DRIVEN = re.compile(r'pose\.bones\["(.+?)"\]\.(?:location|rotation_|scale)')


def is_control_rig(obj: bpy.types.Object) -> bool:
    """Whether constraints or drivers move a good part of the bones that deform the body."""
    driven = _driven_bones(obj)
    deforming = [bone for bone in obj.pose.bones if bone.bone.use_deform]
    moved = sum(bone.name in driven or is_moved(bone) for bone in deforming)
    return moved > 0 and moved >= _SHARE * len(deforming)


def is_moved(bone: bpy.types.PoseBone) -> bool:
    """Whether a constraint moves the bone."""
    return any(
        not constraint.mute and constraint.influence > 0 and not constraint.type.startswith(_PASSIVE)
        for constraint in bone.constraints
    )


def _driven_bones(obj: bpy.types.Object) -> set[str]:
    drivers = obj.animation_data.drivers if obj.animation_data else ()
    return {match[1] for driver in drivers if (match := _DRIVEN.match(driver.data_path))}
