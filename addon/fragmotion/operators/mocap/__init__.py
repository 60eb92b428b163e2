# SPDX-License-Identifier: GPL-3.0-or-later
"""Buttons of takes and of the skeletons that they are for."""

from __future__ import annotations

from . import bones, control_rig
from .add_sample import FRAGMOTION_OT_add_sample
from .import_mocap import DROP_HANDLERS, FRAGMOTION_OT_import_mocap
from .mend_finding import FRAGMOTION_OT_mend_finding
from .play_take import FRAGMOTION_OT_play_take
from .retarget_actions import FRAGMOTION_OT_retarget_actions
from .set_style import FRAGMOTION_OT_set_style
from .take_strips import FRAGMOTION_OT_take_strips
from .tick_actions import FRAGMOTION_OT_tick_actions

__all__ = ["CLASSES", "DROP_HANDLERS"]

CLASSES = (
    FRAGMOTION_OT_add_sample,
    *bones.CLASSES,
    *control_rig.CLASSES,
    FRAGMOTION_OT_import_mocap,
    FRAGMOTION_OT_mend_finding,
    FRAGMOTION_OT_play_take,
    FRAGMOTION_OT_retarget_actions,
    FRAGMOTION_OT_take_strips,
    FRAGMOTION_OT_tick_actions,
    FRAGMOTION_OT_set_style,
)
