# SPDX-License-Identifier: GPL-3.0-or-later
"""The sub-panel of what was wrong with the chosen take."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import bpy

from ..compat.core import command
from ..mocap.actions import chosen
from ..mocap.comparing import source_of
from ..mocap.doctor import DUPLICATE, IN_PLACE, UNTOLD, TakeFinding
from ..operators.base.context import active_armature
from ..settings.drawing import draw_wrapped
from .sidebar import SubPanel

if TYPE_CHECKING:
    from fragmotion_command.takes import with_more
else:
    with_more = command("takes").with_more

LIGHTS = {"error": "CANCEL", "warning": "ERROR", "info": "INFO"}


class FRAGMOTION_PT_doctor(SubPanel, bpy.types.Panel):
    """What was found in the chosen take when it was imported."""

    bl_idname = "FRAGMOTION_PT_doctor"
    bl_label = "Doctor"
    bl_parent_id = "FRAGMOTION_PT_mocap"
    folds = "mocap"

    def draw(self, context: bpy.types.Context) -> None:
        action = chosen(context, active_armature(context))
        if action is None:
            self.layout.label(text="No take is chosen", icon="INFO")
            return
        findings = action.fragmotion.findings
        if not len(findings):
            self.layout.label(text="Nothing is wrong", icon="CHECKMARK")
        for index, alike in _grouped(findings):
            row = findings[index]
            text = with_more([each.text for each in alike]) + (" (mended)" if row.mended else "")
            column = self.layout.column(align=True)
            draw_wrapped(column, context, text, "CHECKMARK" if row.mended else LIGHTS[row.severity])
            if row.code in (IN_PLACE, UNTOLD) and not row.mended:
                column.prop(action.fragmotion, "speed")
            if row.mendable and not row.mended:
                label = "Untick" if row.code == DUPLICATE else "Mend"
                column.operator("fragmotion.mend_finding", text=label, icon="MODIFIER").index = index
        if source_of(action) is not None:
            self.layout.operator("fragmotion.compare_take", icon="IMAGE_DATA")


def _grouped(findings: Sequence[TakeFinding]) -> Iterator[tuple[int, list[TakeFinding]]]:
    """Findings that differ by their frames alone, together, by the number of the first."""
    groups: dict[tuple[str, str, bool], tuple[int, list[TakeFinding]]] = {}
    for index, row in enumerate(findings):
        groups.setdefault((row.code, row.severity, row.mended), (index, []))[1].append(row)
    yield from groups.values()


CLASSES = (FRAGMOTION_PT_doctor,)
