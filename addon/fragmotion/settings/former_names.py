# SPDX-License-Identifier: GPL-3.0-or-later
"""Properties that had other names in earlier versions: what a file has under those is found under today's."""

from __future__ import annotations

from typing import Any

import bpy

from ..compat import versions

_RENAMED = (
    ((), "takes", "recordings"),
    ((), "active_take", "active_recording"),
    (("feel",), "promptness", "responsiveness"),
    (("feel",), "pull", "root_adjustment"),
)
"""The groups in an object's `fragmotion` that lead to a property, its name in files up to 0.1.0, and today's."""


def rename(obj: bpy.types.Object) -> None:
    """Give what an earlier version kept with an object its name of today."""
    for path, former, name in _RENAMED:
        group = _group(obj, path)
        if group is None or former not in group:
            continue
        kept, present = group[former], group.get(name)
        if present is None:
            group[name] = kept
        elif isinstance(kept, list) and isinstance(present, list):
            group[name] = [*kept, *present]
        del group[former]


def _group(obj: bpy.types.Object, path: tuple[str, ...]) -> Any:
    """What Blender keeps of a property group, if it keeps anything."""
    group = versions.kept_properties(obj)
    for name in ("fragmotion", *path):
        group = group.get(name) if hasattr(group, "get") else None
    return group if hasattr(group, "get") else None
