# SPDX-License-Identifier: GPL-3.0-or-later
"""What is told where the compiled core cannot be loaded: why, and what to do, in a panel of its own."""

from __future__ import annotations

import sys
import textwrap
from pathlib import Path

import bpy

_CHARACTERS = 44  # in a line of a sidebar of the usual width
_SYSTEMS = {"linux": "Linux", "win32": "Windows", "darwin": "a Mac"}
_LOCKED = ("code signature", "not valid for use", "system policy", "quarantine")  # what macOS says in such an error


class CoreMissing(ImportError):
    """Why there is no compiled core, and what to do."""


def explain(error: ImportError, addon: Path) -> str:
    """Why the core of the add-on in that folder cannot be loaded, and what to do, in a few sentences."""
    python = f"{sys.version_info.major}.{sys.version_info.minor}"
    here = _SYSTEMS.get(sys.platform, sys.platform)
    others = [path.name for path in addon.glob("fragmotion_core.*") if path.suffix in {".so", ".pyd"}]
    strangers = {_system_of(name) for name in others} - {sys.platform}
    if strangers and not any(_system_of(name) == sys.platform for name in others):
        return (
            f"This is Fragmotion for {_SYSTEMS[strangers.pop()]}, and this is {here}. Remove it, and install the zip "
            f"made for {here}."
        )
    if sys.platform == "darwin" and any(word in str(error).lower() for word in _LOCKED):
        return (
            "macOS has locked Fragmotion's compiled core, as it came from the internet. Run this in Terminal, then "
            f"restart Blender: xattr -dr com.apple.quarantine '{getattr(error, 'path', None) or addon}'"
        )
    if isinstance(error, ModuleNotFoundError):
        return (
            f"Fragmotion's compiled core for Python {python} on {here} is missing. Remove Fragmotion, restart Blender, "
            "and install the zip made for this Blender and this system. (Zips hold Python 3.11 and 3.13 for Blender "
            "4.2 and later, Python 3.10 and 3.11 for Blender 3.4 to 4.1.)"
        )
    return (
        f"Fragmotion's compiled core cannot be loaded on this system ({here}, Python {python}): {error}. Remove "
        "Fragmotion, restart Blender, and install the zip made for this Blender and this system."
    )


def _system_of(name: str) -> str:
    """The sys.platform that a module's file name is made for."""
    if name.endswith(".pyd"):
        return "win32"
    return "darwin" if "darwin" in name else "linux"


class FRAGMOTION_PT_missing(bpy.types.Panel):
    """All that there is of the add-on without its core."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Fragmotion"
    bl_label = "Fragmotion Cannot Start"

    cause = ""

    def draw(self, _context: bpy.types.Context) -> None:
        column = self.layout.column(align=True)
        for number, line in enumerate(textwrap.wrap(self.cause, _CHARACTERS)):
            column.label(text=line, icon="NONE" if number else "ERROR")


def register(cause: CoreMissing) -> None:
    """Show the panel."""
    FRAGMOTION_PT_missing.cause = str(cause)
    bpy.utils.register_class(FRAGMOTION_PT_missing)
    print(cause, file=sys.stderr)


def unregister() -> None:
    """Remove the panel."""
    bpy.utils.unregister_class(FRAGMOTION_PT_missing)
