# SPDX-License-Identifier: GPL-3.0-or-later
"""What a damaged or forged file says of our properties is put back within their bounds when it is opened.

Blender checks a value against its property's bounds when it is set, but not when it is read from a file.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import bpy
from bpy.app.handlers import persistent

_LONGEST = 1 << 12  # bytes of a text: Blender's own names have 63 and its paths 1023
_EVENTS = ("load_post", "blend_import_post")  # the latter, of Append and Link, from 4.3


def mend(group: Any) -> int:
    """Set what is out of its bounds in a property group, and in the groups in it, to its default; how much that was."""
    count = 0
    for prop in group.bl_rna.properties[1:]:  # the first is the type
        if prop.type == "POINTER":
            value = getattr(group, prop.identifier)
            count += mend(value) if isinstance(value, bpy.types.PropertyGroup) else 0
        elif prop.type == "COLLECTION":
            count += sum(mend(each) for each in getattr(group, prop.identifier))
        elif not _is_computed(prop) and not _is_sound(group, prop):
            group.property_unset(prop.identifier)
            count += 1
    return count


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
    for kind in (bpy.data.objects, bpy.data.actions, bpy.data.window_managers):
        for data in kind:
            count = mend(data.fragmotion) if data.library is None and data.is_property_set("fragmotion") else 0
            if count:
                print(f"Fragmotion: {count} settings of '{data.name}' were damaged; they have their default values now")


def _is_computed(prop: Any) -> bool:
    """Whether nothing of a property is stored: what can't be set, or is chosen among items listed by a function."""
    return prop.is_readonly or (prop.type == "ENUM" and not prop.enum_items)


def _is_sound(group: Any, prop: Any) -> bool:
    try:
        return _is_within(prop, getattr(group, prop.identifier))
    except UnicodeDecodeError:
        return False


def _is_within(prop: Any, value: Any) -> bool:
    if prop.type == "STRING":
        return prop.subtype == "BYTE_STRING" or len(value) <= _LONGEST
    if prop.type == "ENUM":
        return value in prop.enum_items
    if prop.type in {"INT", "FLOAT"}:
        return all(prop.hard_min <= each <= prop.hard_max for each in (value if prop.is_array else (value,)))
    return True
