# SPDX-License-Identifier: GPL-3.0-or-later
"""A control rig bound to a motion skeleton of its own, and let go again as it was."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any

import bpy
from bpy.props import BoolProperty, CollectionProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

from ..compat import versions
from ..errors import UserError
from ..made import mark, remove_collection, remove_object
from ..rig.bodies import set_roles
from ..rig.posing import check_free, playing
from .armatures import out_of_modes
from .controls import Controls, Trying, find_controls
from .following import (
    bone_name,
    constrain,
    constraints_of,
    deviations,
    make_anchors,
    make_motion_skeleton,
)
from .joints import Joint, find_joints, height_of, without
from .planes import carry
from .wiring import Switch, find_circle, heeded_switches, read_switch, set_switch

_OPTIONAL = re.compile(r"(spine|neck|.+_(thumb|index|middle|ring|pinky))_\d+|.+_(shoulder|toe)")
_FURTHER = re.compile(r"(spine|neck|.+_(thumb|index|middle|ring|pinky))_[2-9]")
_FOLLOWS = 0.01  # of the body's height: how far a joint may be off
_TRUNK = re.compile(r"hips|spine_\d+")


class FormerSwitch(bpy.types.PropertyGroup):
    """How a switch stood before the rig was bound: custom property `name` of a bone, or of the object."""

    bone: StringProperty()  # type: ignore[valid-type]
    value: FloatProperty()  # type: ignore[valid-type]


class ControlRigSettings(bpy.types.PropertyGroup):
    """Of a rig that is bound: what it follows, and how it was. Of what was made for it: `rig`."""

    rig: PointerProperty(type=bpy.types.Object)  # type: ignore[valid-type]
    motion: PointerProperty(type=bpy.types.Object)  # type: ignore[valid-type]
    anchors: PointerProperty(type=bpy.types.Object)  # type: ignore[valid-type]
    action: PointerProperty(type=bpy.types.Action)  # type: ignore[valid-type]
    slot: IntProperty()  # type: ignore[valid-type]
    use_nla: BoolProperty()  # type: ignore[valid-type]
    switches: CollectionProperty(type=FormerSwitch)  # type: ignore[valid-type]


def motion_of(obj: bpy.types.Object) -> bpy.types.Object | None:
    """The rig's motion skeleton, None where it has none."""
    motion = obj.fragmotion.control_rig.motion
    is_armature = motion is not None and motion.type == "ARMATURE" and motion != obj
    return motion if is_armature and motion.users_collection else None


def rig_of(obj: bpy.types.Object) -> bpy.types.Object:
    """The rig that an armature was made for; itself where it was made for none."""
    rig = obj.fragmotion.control_rig.rig
    return rig if rig is not None and obj in {motion_of(rig), rig.fragmotion.control_rig.anchors} else obj


def own_armatures(obj: bpy.types.Object) -> set[bpy.types.Armature]:
    """The armatures of a rig and of what was made for it, by any one of them."""
    rig = rig_of(obj)
    settings = rig.fragmotion.control_rig
    return {other.data for other in (rig, settings.motion, settings.anchors) if other is not None}


def is_source(other: bpy.types.Object, obj: bpy.types.Object) -> bool:
    """Whether an object is an armature whose Actions another one may be to perform."""
    if other.type != "ARMATURE" or other in {obj, rig_of(obj)}:
        return False
    return bool(rig_of(other) == other or motion_of(rig_of(other)) == other)


def is_bound(obj: bpy.types.Object) -> bool:
    """Whether there is anything to be unbound, as what it followed may be deleted."""
    return obj.fragmotion.is_property_set("control_rig") and (
        motion_of(obj) is not None or any(True for _ in constraints_of(obj))
    )


def follows(obj: bpy.types.Object) -> bool:
    """Whether the rig follows its motion skeleton now."""
    return any(not constraint.mute for _, constraint in constraints_of(obj))


def set_following(obj: bpy.types.Object, does: bool) -> None:
    """Let the rig follow its motion skeleton, or move by itself."""
    for _, constraint in constraints_of(obj):
        constraint.mute = not does


def bind(context: bpy.types.Context, obj: bpy.types.Object) -> Trying[list[str]]:
    """Make the rig's motion skeleton and let its controls follow it, telling what share is done; the roles that do not.
    UserError where it cannot be; then, and where it is closed, nothing has changed."""
    check_free(obj)
    circle = find_circle(obj)
    if circle:
        raise UserError(
            f"Armature '{obj.name}': bones {_listed(circle)} wait for each other, by their constraints and parents: "
            "mute one of these constraints"
        )
    joints = find_joints(obj)
    switches = {switch for each in heeded_switches(obj).values() for switch in each}
    former = {switch: value for switch in switches if (value := read_switch(obj, switch)) is not None}
    try:
        with playing(context, obj, None):
            controls = yield from find_controls(context, obj, joints)
        missing = [role for role in joints if role not in controls.followed]
        joints = without(joints, [role for role in missing if _OPTIONAL.fullmatch(role)])
        _note(obj, {switch: former[switch] for switch in controls.switches})
        with out_of_modes(context):
            missing += _build(context, obj, controls, joints)
    except BaseException:
        for switch, value in former.items():
            set_switch(obj, switch, value)
        unbind(context, obj)
        raise
    return [role for role in missing if not _FURTHER.fullmatch(role)]


def unbind(context: bpy.types.Context, obj: bpy.types.Object) -> None:
    """Take the motion skeleton and all that follows it away; the rig is as it was before, but for an Action that it
    was given since."""
    settings = obj.fragmotion.control_rig
    for bone, constraint in constraints_of(obj):
        bone.constraints.remove(constraint)
    for former in settings.switches:
        switch = Switch(former.bone, former.name)
        if read_switch(obj, switch) is not None:
            set_switch(obj, switch, former.value)
    _give_back_animation(obj, settings)
    made = [other for other in dict.fromkeys((motion_of(obj), settings.anchors)) if _is_made_for(other, obj)]
    collections = {collection for other in made for collection in other.users_collection}
    for other in made:
        remove_object(other)
    for collection in collections:
        remove_collection(collection)
    obj.fragmotion.property_unset("control_rig")
    context.view_layer.update()


def _is_made_for(other: Any, obj: bpy.types.Object) -> bool:
    """Whether an armature was made for this rig, and not for one that it is a copy of."""
    if other is None or other == obj or other.library is not None:
        return False
    return bool(other.type == "ARMATURE" and other.fragmotion.control_rig.rig == obj)


def _note(obj: bpy.types.Object, switches: Mapping[Switch, float]) -> None:
    """Remember how the rig is, and free it from its Action and the NLA, which would move the controls."""
    settings = obj.fragmotion.control_rig
    for switch, value in switches.items():
        former = settings.switches.add()
        former.bone, former.name, former.value = switch.bone, switch.name, value
    data = obj.animation_data
    if data is not None:
        settings.action, settings.slot, settings.use_nla = data.action, versions.slot_handle(obj), data.use_nla
        data.action, data.use_nla = None, False


def _give_back_animation(obj: bpy.types.Object, settings: ControlRigSettings) -> None:
    data, action = obj.animation_data, settings.action
    if data is None:
        return
    if data.action is None and action is not None:
        versions.restore(obj, (action, versions.find_slot(action, settings.slot)))
    elif action is not None and action.library is None:
        action.use_fake_user = True  # nothing may use it now
    data.use_nla = data.use_nla or settings.use_nla


def _build(
    context: bpy.types.Context, obj: bpy.types.Object, controls: Controls, joints: Mapping[str, Joint]
) -> list[str]:
    """Make what the rig follows, and let it; the parts of the trunk that do not all the same."""
    settings = obj.fragmotion.control_rig
    collection = bpy.data.collections.new(f"{obj.name} Motion")
    mark(collection)
    context.scene.collection.children.link(collection)
    motion = settings.motion = make_motion_skeleton(context, obj, collection, controls, joints)
    motion.fragmotion.control_rig.rig = obj
    anchors = settings.anchors = make_anchors(context, obj, collection, motion, controls, joints)
    anchors.fragmotion.control_rig.rig = obj
    constrain(obj, anchors, controls)
    set_roles(motion, {role: bone_name(role) for role in joints})
    off = _choose_carrier(context, obj, controls, joints)
    for made in (motion, anchors):
        made.hide_set(True)
    return [role for role, distance in off.items() if distance > _FOLLOWS * height_of(joints)]


def _choose_carrier(
    context: bpy.types.Context, obj: bpy.types.Object, controls: Controls, joints: Mapping[str, Joint]
) -> dict[str, float]:
    """Let that part of the trunk carry the body's control by which the trunk's joints are off the least: how far."""
    settings = obj.fragmotion.control_rig
    trunk = {role: joint for role, joint in joints.items() if _TRUNK.fullmatch(role)}
    off = {}
    for role in trunk:
        carry(settings.anchors, controls.body, settings.motion, bone_name(role))
        off[role] = deviations(context, obj, settings.motion, trunk)
    best = min(off, key=lambda role: max(off[role].values()))
    carry(settings.anchors, controls.body, settings.motion, bone_name(best))
    return off[best]


def _listed(names: Iterable[str]) -> str:
    return ", ".join(f"'{name}'" for name in names)
