# SPDX-License-Identifier: GPL-3.0-or-later
"""Show the active armature's character on the live page."""

from __future__ import annotations

import tempfile
import webbrowser
from pathlib import Path
from typing import ClassVar

import bpy

from ...character.building import save_policy
from ...character.moves import bring_up_to_date
from ...errors import UserError, reported
from ...games import serving
from ...games.exporting import export_mesh, meshes_of
from ...settings import preferences
from ..base.context import active_armature
from ..base.saving import poll_learned

_POLICY, _MESH = "own.policy", "own.glb"


class FRAGMOTION_OT_open_in_browser(bpy.types.Operator):
    """Play the character with its mesh on the live page, in this machine's browser, until Blender is closed"""

    bl_idname = "fragmotion.open_in_browser"
    bl_label = "Open in Browser"

    bl_options: ClassVar[set[str]] = {"REGISTER"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return poll_learned(cls, context)

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        page, obj = _page(context), active_armature(context)
        bring_up_to_date(context, obj)
        own = _own_files(context, obj)
        query = f"?policy={_POLICY}" + (f"&glb={_MESH}" if _MESH in own else "")
        address = serving.start(page, own) + query
        webbrowser.open(address)
        self.report({"INFO"}, f"'{obj.name}' plays at {address}")
        return {"FINISHED"}


def _page(context: bpy.types.Context) -> Path:
    name = preferences.get(context).live_page
    page = Path(bpy.path.abspath(name)) if name else None
    if page is None or not (page / "fragmotion" / "fragmotion.js").is_file():
        where = f"'{page}' is not the live page" if page else "The live page is not on this machine"
        raise UserError(f"{where}: make it by `dev.py web FOLDER`, and name FOLDER in this add-on's preferences")
    return page


def _own_files(context: bpy.types.Context, obj: bpy.types.Object) -> dict[str, bytes]:
    """The character, and its meshes if any is in sight."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        save_policy(obj, folder / _POLICY)
        if meshes_of(context, obj):
            export_mesh(context, obj, folder / _MESH)
        return {path.name: path.read_bytes() for path in folder.iterdir()}
