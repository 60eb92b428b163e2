# SPDX-License-Identifier: GPL-3.0-or-later
"""An armature that is posed for a while, and given back."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy
import numpy as np

from ..compat.data_blocks import is_alive
from ..errors import core_errors
from ..rig.rigs import PUT_ASIDE
from . import suspended_state

if TYPE_CHECKING:
    from fragmotion_core import Doubles, Rig


class PosedArmature:
    """The armature from construction until `give_back`. What a file or an undo step keeps meanwhile can be healed."""

    def __init__(self, obj: bpy.types.Object, rig: Rig) -> None:
        self._obj, self._rig, self._name = obj, rig, str(obj.name)
        self._data, self._bones, self._position = obj.data, len(obj.pose.bones), str(obj.data.pose_position)
        self._order = [obj.data.bones.find(bone.name) for bone in obj.pose.bones]
        self._put_aside()

    @property
    def name(self) -> str:
        """The object's; where it was deleted, the last one."""
        if is_alive(self._obj):
            self._name = str(self._obj.name)
        return self._name

    def pose(self, root: Doubles, rotations: Doubles) -> None:
        """Show a pose of the character: root position [3] and rotations [B,4]. UserError where it cannot be."""
        with core_errors(f"Armature '{self.name}'"):
            locations, turns = self._rig.channels(root[None], rotations[None])
        self._put_aside()
        bones = self._obj.pose.bones
        bones.foreach_set("location", locations[0, self._order].astype(np.float32).ravel())
        bones.foreach_set("rotation_quaternion", turns[0, self._order].astype(np.float32).ravel())
        self._obj.update_tag()

    def trouble(self) -> str:
        """Why it cannot be posed any more, empty where it can."""
        if not is_alive(self._obj):
            return f"Armature '{self.name}' was deleted"
        if self._obj.data != self._data:
            return f"Armature '{self.name}' was given other armature data"
        if self._obj.mode not in {"OBJECT", "POSE"}:
            return f"Armature '{self.name}' is being edited"
        if len(self._obj.pose.bones) != self._bones:
            return f"Bones of armature '{self.name}' were added or deleted"
        return ""

    def give_back(self, layer: bpy.types.ViewLayer | None = None) -> None:
        """All is as it was, until the next pose; one that was deleted stays deleted, though another object may show its
        bones. It is in the view layer, by default the one that is shown."""
        if not is_alive(self._obj):
            if is_alive(self._data):
                self._data.pose_position = self._position
        elif PUT_ASIDE in self._obj:
            suspended_state.give_back(self._obj, layer)

    def _put_aside(self) -> None:
        """Put its own pose and animation aside, unless they are."""
        if PUT_ASIDE in self._obj:
            return
        try:
            suspended_state.put_aside(self._obj)
        except BaseException:
            self.give_back()
            raise
