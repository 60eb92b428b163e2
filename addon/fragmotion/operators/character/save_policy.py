# SPDX-License-Identifier: GPL-3.0-or-later
"""Save the active armature's character as a policy file."""

from __future__ import annotations

import bpy

from ...character.building import save_policy
from ...character.moves import bring_up_to_date
from ...errors import reported
from ..base.context import active_armature
from ..base.saving import SavingCharacter


class FRAGMOTION_OT_save_policy(SavingCharacter, bpy.types.Operator):
    """Save the character as a policy file, for another .blend or a program of yours"""

    bl_idname = "fragmotion.save_policy"
    bl_label = "Save Policy"

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        path = self._path()
        obj = active_armature(context)
        bring_up_to_date(context, obj)
        save_policy(obj, path)
        self.report({"INFO"}, f"Saved '{path}' ({path.stat().st_size / 1e6:.1f} MB)")
        return {"FINISHED"}
