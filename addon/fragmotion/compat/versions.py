# SPDX-License-Identifier: GPL-3.0-or-later
"""The one place for what differs between Blender 3.4 and 5.2.

Up to 4.3 an Action holds its F-curves. From 4.4 it holds slots, each with its own channelbag of F-curves, and an object
plays one slot.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import blf
import bpy
import numpy as np

SLOTTED = bpy.app.version >= (4, 4, 0)


def curves_of(action: bpy.types.Action, obj: bpy.types.Object) -> list[bpy.types.FCurve]:
    """The Action's F-curves that move `obj`, were the Action assigned to it."""
    if not SLOTTED:
        return list(action.fcurves)
    slot = _slot_for(action, obj)
    return [curve for bag in _bags(action) if slot and bag.slot_handle == slot.handle for curve in bag.fcurves]


def has_slot_of(action: bpy.types.Action, obj: bpy.types.Object) -> bool:
    """Whether the Action has a slot that is named after the object."""
    return SLOTTED and any(slot.name_display == obj.name for slot in action.slots)


def all_curves(action: bpy.types.Action) -> list[bpy.types.FCurve]:
    """All the Action's F-curves, whatever they move."""
    return [curve for bag in _bags(action) for curve in bag.fcurves] if SLOTTED else list(action.fcurves)


def count_curves(action: bpy.types.Action) -> int:
    """Number of all the Action's F-curves."""
    return sum(len(bag.fcurves) for bag in _bags(action)) if SLOTTED else len(action.fcurves)


def is_muted(curve: bpy.types.FCurve) -> bool:
    """Whether Blender leaves the F-curve out: by itself, or up to 4.3 by its group (from 4.4 a muted group plays)."""
    return curve.mute or (not SLOTTED and curve.group is not None and curve.group.mute)


def assign(obj: bpy.types.Object, action: bpy.types.Action | None) -> None:
    """Let the object play the Action (its slot for this object)."""
    data = obj.animation_data or obj.animation_data_create()
    data.action = action
    if SLOTTED and action is not None:
        slot = _slot_for(action, obj)
        if slot is not None:
            data.action_slot = slot


def assign_strip(strip: bpy.types.NlaStrip, action: bpy.types.Action, obj: bpy.types.Object) -> None:
    """Let an NLA strip of the Action play its slot for the object."""
    if SLOTTED:
        strip.action_slot = _slot_for(action, obj)


def assignment(obj: bpy.types.Object) -> tuple[bpy.types.Action | None, Any]:
    """What the object plays: the Action, and its slot where there are slots."""
    data = obj.animation_data
    if data is None:
        return None, None
    return data.action, data.action_slot if SLOTTED else None


def restore(obj: bpy.types.Object, played: tuple[bpy.types.Action | None, Any]) -> None:
    """Let the object play again what `assignment` told."""
    action, slot = played
    data = obj.animation_data
    if data is None:
        return
    data.action = action
    if SLOTTED and action is not None:
        data.action_slot = slot


def slot_handle(obj: bpy.types.Object) -> int:
    """The number of the slot that the object plays, 0 for none; it stays the same in saved files."""
    _, slot = assignment(obj)
    return 0 if slot is None else int(slot.handle)


def find_slot(action: bpy.types.Action | None, handle: int) -> Any:
    """The Action's slot of that number, or None."""
    slots = action.slots if SLOTTED and action is not None else ()
    return next((slot for slot in slots if slot.handle == handle), None)


def holder_for(action: bpy.types.Action, obj: bpy.types.Object) -> Any:
    """What holds the object's F-curves as `.fcurves` and `.groups`; slot, layer and strip are made where missing."""
    if not SLOTTED:
        return action
    slot = _slot_for(action, obj) or action.slots.new(id_type="OBJECT", name=obj.name)
    layer = action.layers[0] if action.layers else action.layers.new("Layer")
    strip = layer.strips[0] if layer.strips else layer.strips.new(type="KEYFRAME")
    return strip.channelbag(slot, ensure=True)


def new_curve(holder: Any, path: str, index: int, group: str) -> bpy.types.FCurve:
    """Add an F-curve to what `holder_for` gave, in the group of that name."""
    if bpy.app.version >= (5, 0, 0):
        return holder.fcurves.new(path, index=index, group_name=group)
    if not SLOTTED:
        return holder.fcurves.new(path, index=index, action_group=group)
    curve = holder.fcurves.new(path, index=index)
    curve.group = holder.groups.get(group) or holder.groups.new(group)
    return curve


def get_bone_selection(obj: bpy.types.Object) -> dict[str, tuple[bool, bool, bool]]:
    """Which bones are selected: from 5.0 the pose bones are, before the armature's (with their ends)."""
    if bpy.app.version >= (5, 0, 0):
        return {bone.name: (bone.select, False, False) for bone in obj.pose.bones}
    return {bone.name: (bone.select, bone.select_head, bone.select_tail) for bone in obj.data.bones}


def set_bone_selection(obj: bpy.types.Object, selection: dict[str, tuple[bool, bool, bool]]) -> None:
    """Select the bones as `get_bone_selection` told."""
    bones = obj.pose.bones if bpy.app.version >= (5, 0, 0) else obj.data.bones
    for name, (select, head, tail) in selection.items():
        if name not in bones:
            continue
        bones[name].select = select
        if bpy.app.version < (5, 0, 0):
            bones[name].select_head, bones[name].select_tail = head, tail


def own_by_shown_scene() -> None:
    """Let the scene that is shown own what Blender's context gives. Up to 4.3 its owner is the one that was shown when
    anybody last asked the context for its layer collection, as Rigify does, even where that is gone: to show another
    scene in the context's window, as Blender's glTF does, then writes there, and Blender crashes in the end."""
    _ = bpy.context.layer_collection


@contextmanager
def old_numpy() -> Iterator[None]:
    """Inside, NumPy has the alias that 3.4's importer of glTF uses for meshes, and that NumPy dropped in 1.24."""
    if bpy.app.version >= (4, 0, 0) or "bool" in vars(np):
        yield
        return
    vars(np)["bool"] = bool
    try:
        yield
    finally:
        del vars(np)["bool"]


def draw_named(layout: bpy.types.UILayout, data: Any, name: str, placeholder: str) -> None:
    """A text field that says what it means while it is empty (from 4.1)."""
    if bpy.app.version >= (4, 1, 0):
        layout.prop(data, name, placeholder=placeholder)
    else:
        layout.prop(data, name)


def draw_progress(layout: bpy.types.UILayout, fraction: float, text: str) -> None:
    """A progress bar; its text with a percentage before 4.0, which had no bar."""
    if hasattr(layout, "progress"):
        layout.progress(factor=fraction, text=text)
    else:
        layout.label(text=f"{text}: {100 * fraction:.0f} %", icon="SORTTIME")


def draw_deflection(layout: bpy.types.UILayout, value: float) -> None:
    """A value from -1 to 1 as a bar; as a number before 4.0."""
    if hasattr(layout, "progress"):
        layout.progress(factor=(value + 1) / 2, text=f"{value:+.2f}")
    else:
        layout.label(text=f"{value:+.2f}")


def shader(name: str) -> str:
    """What gpu.shader.from_builtin calls a shader for points in space: before 4.0 their names began with "3D_"."""
    return name if bpy.app.version >= (4, 0, 0) else f"3D_{name}"


def set_font_size(font: int, size: float) -> None:
    """The height of blf's letters in pixels; up to 3.6 it asked for the dots in an inch as well."""
    if bpy.app.version >= (4, 0, 0):
        blf.size(font, size)
    else:
        blf.size(font, size, 72)


def _bags(action: bpy.types.Action) -> Iterator[Any]:
    for layer in action.layers:
        for strip in layer.strips:
            yield from strip.channelbags


def _slot_for(action: bpy.types.Action, obj: bpy.types.Object) -> Any:
    """The slot that the object plays, else the one named after it, else the one with the most F-curves, else None."""
    data = obj.animation_data
    if data is not None and data.action == action and data.action_slot is not None:
        return data.action_slot
    slots = [slot for slot in action.slots if slot.target_id_type in {"OBJECT", "UNSPECIFIED"}]
    sizes = {bag.slot_handle: len(bag.fcurves) for bag in _bags(action)}
    return max(slots, key=lambda slot: (slot.name_display == obj.name, sizes.get(slot.handle, 0)), default=None)


def kept_properties(data: bpy.types.ID) -> Any:
    """What Blender keeps of the properties that add-ons register, by their names."""
    return data.bl_system_properties_get() if hasattr(data, "bl_system_properties_get") else data
