# SPDX-License-Identifier: GPL-3.0-or-later
"""The armature's own pose and animation, put aside while it shows something and given back exactly.

They are noted on the object itself: what undo or autosave keep of the middle of a drive or a preview can be healed.
"""

from __future__ import annotations

from typing import Any

import bpy

from ..compat import versions
from ..rig.posing import CHANNELS, get_channel, reset_pose
from ..rig.rigs import PUT_ASIDE

# By a note that no drive wrote.
_DAMAGES = (ArithmeticError, AttributeError, LookupError, ReferenceError, RuntimeError, TypeError, ValueError)


def put_aside(obj: bpy.types.Object) -> None:
    """Free the armature for poses written as quaternions; nothing else moves it but drivers and constraints."""
    obj[PUT_ASIDE] = _note(obj)
    if obj.animation_data is not None:
        obj.animation_data.use_nla = False
        obj.animation_data.action = None
    obj.data.pose_position = "POSE"
    for bone in obj.pose.bones:
        bone.rotation_mode = "QUATERNION"
    reset_pose(obj)


def give_back(obj: bpy.types.Object, layer: bpy.types.ViewLayer | None = None) -> None:
    """Undo `put_aside`: Action, slot, NLA, pose, rotation modes and the object's place are as they were.

    The object is in the view layer, by default the one that is shown.
    """
    note, layer = obj[PUT_ASIDE], layer or bpy.context.view_layer
    data = obj.animation_data
    if data is not None:
        action = note.get("action")
        versions.restore(obj, (action, versions.find_slot(action, note["slot"])))
        data.use_nla = bool(note["use_nla"])
    armature = note.get("armature", obj.data)  # files of the first version do not tell
    if armature is not None:
        armature.pose_position = note["pose_position"]
    bones = _bones(obj, note)
    for bone, mode in zip(bones, note["modes"].values()):
        if bone is not None:
            bone.rotation_mode = mode
    layer.update()  # the Action's own pose, over which the user's stands
    for channel in CHANNELS:
        setattr(obj, channel, list(note["place"][channel]))
        _pose(bones, channel, note["pose"][channel])
    del obj[PUT_ASIDE]
    obj.update_tag()
    layer.update()


def heal() -> None:
    """Give back what was put aside in a file or an undo step that was made in the middle of a drive."""
    for obj in bpy.data.objects:
        if PUT_ASIDE in obj and obj.library is None:
            try:
                give_back(obj)
            except _DAMAGES as error:
                del obj[PUT_ASIDE]
                print(f"Fragmotion: how '{obj.name}' was before it was driven is not known any more ({error})")


def _note(obj: bpy.types.Object) -> dict[str, Any]:
    data = obj.animation_data
    note = {
        "use_nla": data is not None and data.use_nla,
        "slot": versions.slot_handle(obj),
        "armature": obj.data,
        "pose_position": obj.data.pose_position,
        "modes": {bone.name: bone.rotation_mode for bone in obj.pose.bones},
        "pose": {channel: get_channel(obj, channel).tolist() for channel in CHANNELS},
        "place": {channel: list(getattr(obj, channel)) for channel in CHANNELS},
    }
    if data is not None and data.action is not None:
        note["action"] = data.action
    return note


def _bones(obj: bpy.types.Object, note: Any) -> list[bpy.types.PoseBone | None]:
    """The noted bones that are still there, in the note's order; as many as were renamed are told by their order."""
    names, bones = list(note["modes"].keys()), obj.pose.bones
    unknown = [bone for bone in bones if bone.name not in note["modes"]]
    renamed = iter(unknown if len(bones) == len(names) and note.get("armature") == obj.data else ())
    return [bones[name] if name in bones else next(renamed, None) for name in names]


def _pose(bones: list[bpy.types.PoseBone | None], channel: str, values: Any) -> None:
    """Give one channel back to the bones."""
    size = len(values) // len(bones)
    for index, bone in enumerate(bones):
        if bone is not None:
            setattr(bone, channel, list(values[size * index : size * (index + 1)]))
