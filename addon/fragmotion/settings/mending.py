# SPDX-License-Identifier: GPL-3.0-or-later
"""What a file of an earlier version says of our properties gets its name of today when it is opened, and what a damaged
or forged one says is put back within their bounds.

Blender checks a value against its property's bounds when it is set, but not when it is read from a file.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import bpy
import numpy as np
from bpy.app.handlers import persistent

from .former_names import rename

_LONGEST = 1 << 12  # characters of a text that is drawn: Blender's own names have 63 and its paths 1023
_EVENTS = ("load_post", "blend_import_post")  # the latter, of Append and Link, from 4.3


def mend(group: Any) -> int:
    """Set what is out of its bounds in a property group, and in the groups in it, to its default; how much that was."""
    return sum(_mend_property(group, prop) for prop in group.bl_rna.properties[1:])  # the first is the type


def register() -> None:
    """Begin to mend what is opened."""
    for handlers in _handlers():
        handlers.append(_mend_file)


def unregister() -> None:
    """Stop it."""
    for handlers in _handlers():
        handlers.remove(_mend_file)


def _handlers() -> Iterator[Any]:
    return (getattr(bpy.app.handlers, name) for name in _EVENTS if hasattr(bpy.app.handlers, name))


@persistent  # type: ignore[untyped-decorator]
def _mend_file(*_: object) -> None:
    for obj in bpy.data.objects:
        rename(obj)
    for kind in (bpy.data.objects, bpy.data.actions, bpy.data.window_managers):
        for data in kind:
            count = mend(data.fragmotion) if data.library is None and data.is_property_set("fragmotion") else 0
            if count:
                print(f"Fragmotion: {count} settings of '{data.name}' were damaged; they have their default values now")


def _mend_property(group: Any, prop: Any) -> int:
    if prop.type == "POINTER" and not _is_to_data(prop):
        return mend(getattr(group, prop.identifier))
    if prop.type == "COLLECTION":
        return _mend_entries(getattr(group, prop.identifier))
    if _is_computed(prop) or _is_sound(group, prop):
        return 0
    group.property_unset(prop.identifier)
    return 1


def _mend_entries(entries: Any) -> int:
    """The same of a collection: a property of all entries is looked at at once, each only where one is unsound."""
    properties = entries[0].bl_rna.properties[1:] if len(entries) else ()
    unsound = [prop for prop in properties if not _are_sound(entries, prop)]
    return sum(_mend_property(each, prop) for prop in unsound for each in entries)


def _are_sound(entries: Any, prop: Any) -> bool:
    if prop.type == "POINTER":
        return _is_to_data(prop) and all(_is_sound(each, prop) for each in entries)
    if prop.type == "COLLECTION":
        return not any(len(getattr(each, prop.identifier)) for each in entries)
    if _is_computed(prop) or prop.type == "BOOLEAN" or _are_bytes(prop):
        return True
    if prop.type in {"INT", "FLOAT"}:
        return _are_within(entries, prop)
    try:
        values = {getattr(each, prop.identifier) for each in entries}
    except UnicodeDecodeError:
        return False
    return all(_is_within(prop, value) for value in values)


def _are_within(entries: Any, prop: Any) -> bool:
    """Whether the numbers of all entries are within their property's bounds; one that is no number is not."""
    numbers = np.empty(len(entries) * max(prop.array_length, 1), np.int32 if prop.type == "INT" else np.float32)
    entries.foreach_get(prop.identifier, numbers)
    return bool(prop.hard_min <= numbers.min() and numbers.max() <= prop.hard_max)


def _is_computed(prop: Any) -> bool:
    """Whether nothing of a property is stored: what can't be set, or is chosen among items listed by a function."""
    return prop.is_readonly or (prop.type == "ENUM" and not prop.enum_items)


def _are_bytes(prop: Any) -> bool:
    """Blender warns on the console where the subtype of a number with a unit is asked for."""
    return bool(prop.type == "STRING" and prop.subtype == "BYTE_STRING")


def _is_to_data(prop: Any) -> bool:
    """Whether a pointer is to a data-block, and no group of its own."""
    return issubclass(getattr(bpy.types, prop.fixed_type.identifier, object), bpy.types.ID)


def _is_sound(group: Any, prop: Any) -> bool:
    try:
        return _is_within(prop, getattr(group, prop.identifier))
    except UnicodeDecodeError:
        return False


def _is_within(prop: Any, value: Any) -> bool:
    if prop.type == "STRING":
        return prop.is_hidden or len(value) <= _LONGEST  # what is never drawn is bounded by what reads it
    if prop.type == "ENUM":
        return value in prop.enum_items
    if prop.type == "POINTER":
        return value is None or isinstance(value, getattr(bpy.types, prop.fixed_type.identifier))
    if prop.type in {"INT", "FLOAT"}:
        return all(prop.hard_min <= each <= prop.hard_max for each in (value if prop.is_array else (value,)))
    return True
