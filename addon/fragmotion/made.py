# SPDX-License-Identifier: GPL-3.0-or-later
"""Data-blocks that the add-on made and that a pointer in the file names: a pointer may come to name anything, so only
what carries the mark is written over or removed."""

from __future__ import annotations

from typing import Any

import bpy

from .compat import versions
from .compat.data_blocks import is_alive

_MARK = "fragmotion_made"
"""Custom property of what was made: the number of what it was made for."""


def mark(made: Any, number: int = 1) -> None:
    """Note that the add-on made a data-block, for what has this number, from 1 on."""
    made[_MARK] = number


def is_made(data: Any, number: int = 1) -> bool:
    """Whether a data-block is there, is this file's own, and was made for what has this number."""
    if data is None or not is_alive(data) or data.library is not None:
        return False
    found = data.get(_MARK)
    return type(found) is int and found == number > 0


def remove_object(obj: bpy.types.Object) -> None:
    """Take an object away, and its data and its Action where they were made and nothing else uses them."""
    action, _ = versions.assignment(obj)
    data = obj.data
    bpy.data.objects.remove(obj)
    for left in (data, action):
        if left is not None and left.users == 0 and _MARK in left and left.library is None:
            bpy.data.batch_remove([left])


def remove_collection(collection: bpy.types.Collection) -> None:
    """Take a collection away where it was made and is empty."""
    if is_made(collection) and not collection.all_objects and not collection.children:
        bpy.data.collections.remove(collection)
