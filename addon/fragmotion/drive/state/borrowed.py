# SPDX-License-Identifier: GPL-3.0-or-later
"""An armature on which something is shown for a while, beside a drive: posed as it plays, and given back."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy
import numpy as np

from ...compat.data_blocks import is_alive
from . import suspended_state

if TYPE_CHECKING:
    from fragmotion_core import Doubles


class Borrowed:
    """The armature from construction until `give_back`. What a file or an undo step keeps meanwhile can be healed."""

    def __init__(self, obj: bpy.types.Object) -> None:
        self.name = str(obj.name)
        self._obj, self._data, self._bones = obj, obj.data, len(obj.pose.bones)
        self._order = [obj.data.bones.find(bone.name) for bone in obj.pose.bones]
        self._position = str(obj.data.pose_position)
        suspended_state.put_aside(obj)

    def pose(self, locations: Doubles, rotations: Doubles) -> None:
        """Show locations [B,3] and quaternions [B,4], in the order of the armature's bones."""
        bones = self._obj.pose.bones
        bones.foreach_set("location", locations[self._order].astype(np.float32).ravel())
        bones.foreach_set("rotation_quaternion", rotations[self._order].astype(np.float32).ravel())
        self._obj.update_tag()

    def trouble(self) -> str:
        """Why it cannot be posed any more, empty where it can."""
        if not is_alive(self._obj):
            return f"Armature '{self.name}' was deleted"
        if self._obj.data != self._data or len(self._obj.pose.bones) != self._bones:
            return f"The bones of armature '{self._obj.name}' were changed"
        return "" if suspended_state.NOTE in self._obj else "Undo has given the armature back"

    def give_back(self) -> None:
        """All is as it was; one that was deleted stays deleted, though another object may show its bones."""
        if not is_alive(self._obj):
            if is_alive(self._data):
                self._data.pose_position = self._position
        elif suspended_state.NOTE in self._obj:
            suspended_state.give_back(self._obj)
