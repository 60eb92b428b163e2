# SPDX-License-Identifier: GPL-3.0-or-later
"""Buttons that make a character of takes and show what is in it."""

from __future__ import annotations

from .build import FRAGMOTION_OT_build
from .force_class import FRAGMOTION_OT_force_class
from .leave_out import FRAGMOTION_OT_leave_out, FRAGMOTION_OT_take_in
from .load_policy import FRAGMOTION_OT_load_policy
from .moves import FRAGMOTION_OT_add_move, FRAGMOTION_OT_remove_move
from .save_policy import FRAGMOTION_OT_save_policy
from .show_fragment import FRAGMOTION_OT_show_fragment
from .solo_class import FRAGMOTION_OT_solo_class
from .suggest import FRAGMOTION_OT_suggest_classes

__all__ = ["CLASSES"]

CLASSES = (
    FRAGMOTION_OT_build,
    FRAGMOTION_OT_force_class,
    FRAGMOTION_OT_leave_out,
    FRAGMOTION_OT_take_in,
    FRAGMOTION_OT_load_policy,
    FRAGMOTION_OT_add_move,
    FRAGMOTION_OT_remove_move,
    FRAGMOTION_OT_save_policy,
    FRAGMOTION_OT_show_fragment,
    FRAGMOTION_OT_solo_class,
    FRAGMOTION_OT_suggest_classes,
)
