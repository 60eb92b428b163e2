# SPDX-License-Identifier: GPL-3.0-or-later
"""How many classes to build: the core's trial of several numbers."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import bpy
from bpy.props import FloatProperty, IntProperty

from ..compat.core import core
from ..jobs import Report
from . import building

if TYPE_CHECKING:
    from fragmotion_core import ClassesTried

Suggestion = tuple[int, "list[ClassesTried]"]


class NumberTried(bpy.types.PropertyGroup):
    """What a number of classes was good for."""

    classes: IntProperty()  # type: ignore[valid-type]
    velocity_error: FloatProperty()  # type: ignore[valid-type]
    quality: FloatProperty()  # type: ignore[valid-type]


def prepare(context: bpy.types.Context, obj: bpy.types.Object, settings: Any) -> Callable[[Report], Suggestion]:
    """Sample the ticked Actions for a trial; UserError on what cannot be built from."""
    material = building.gather(context, obj, settings)

    def task(report: Report) -> Suggestion:
        suggestion: Suggestion = core.suggest_classes(
            material.rig.skeleton, material.clips, material.traces, material.options, report
        )
        return suggestion

    return task


def keep(obj: bpy.types.Object, suggestion: Suggestion, before: int) -> str:
    """Set the number, keep the figures with the armature, and say what was found."""
    classes, tried = suggestion
    obj.fragmotion.build.classes = classes
    rows = obj.fragmotion.tried
    rows.clear()
    for each in tried:
        row = rows.add()
        row.classes, row.velocity_error, row.quality = each.classes, each.velocity_error, each.quality
    return _tell(classes, {each.classes: each.velocity_error for each in tried}, before)


def _tell(classes: int, errors: dict[int, float], before: int) -> str:
    if classes == before:
        return f"{classes} classes are right: the velocity is off by {100 * errors[classes]:.0f} % of the command"
    told = f"Classes {before} -> {classes}: "
    if before not in errors:
        return f"{told}the velocity is off by {100 * errors[classes]:.0f} % of the command"
    change = 100 * (errors[classes] / errors[before] - 1)
    return f"{told}{abs(change):.0f} % {'less' if change < 0 else 'more'} velocity error"
