# SPDX-License-Identifier: GPL-3.0-or-later
"""The buttons, one operator a file."""

from __future__ import annotations

from . import control_rig, edit_recordings, recordings
from .add_sample import FRAGMOTION_OT_add_sample
from .background import FRAGMOTION_OT_cancel
from .bake import FRAGMOTION_OT_bake
from .bones import FRAGMOTION_OT_find_bones, FRAGMOTION_OT_load_bones, FRAGMOTION_OT_save_bones
from .build import FRAGMOTION_OT_build
from .draw_path import FRAGMOTION_OT_draw_path
from .drive import (
    FRAGMOTION_OT_drive,
    FRAGMOTION_OT_find_pads,
    FRAGMOTION_OT_listen,
    FRAGMOTION_OT_play_trace,
    FRAGMOTION_OT_record,
)
from .follow_path import FRAGMOTION_OT_follow_path
from .force_class import FRAGMOTION_OT_force_class
from .import_mocap import DROP_HANDLERS, FRAGMOTION_OT_import_mocap
from .leave_out import FRAGMOTION_OT_leave_out, FRAGMOTION_OT_take_in
from .load_policy import FRAGMOTION_OT_load_policy
from .mend_finding import FRAGMOTION_OT_mend_finding
from .moves import FRAGMOTION_OT_add_move, FRAGMOTION_OT_remove_move
from .play_take import FRAGMOTION_OT_play_take
from .populate import FRAGMOTION_OT_populate
from .retarget_actions import FRAGMOTION_OT_retarget_actions
from .save_policy import FRAGMOTION_OT_save_policy
from .show_fragment import FRAGMOTION_OT_show_fragment
from .solo_class import FRAGMOTION_OT_solo_class
from .suggest import FRAGMOTION_OT_suggest_classes
from .tick_actions import FRAGMOTION_OT_tick_actions

__all__ = ["CLASSES", "DROP_HANDLERS"]

CLASSES = (
    *control_rig.CLASSES,
    FRAGMOTION_OT_import_mocap,
    FRAGMOTION_OT_add_sample,
    FRAGMOTION_OT_retarget_actions,
    FRAGMOTION_OT_find_bones,
    FRAGMOTION_OT_load_bones,
    FRAGMOTION_OT_save_bones,
    FRAGMOTION_OT_play_take,
    FRAGMOTION_OT_tick_actions,
    FRAGMOTION_OT_mend_finding,
    FRAGMOTION_OT_add_move,
    FRAGMOTION_OT_remove_move,
    FRAGMOTION_OT_leave_out,
    FRAGMOTION_OT_take_in,
    FRAGMOTION_OT_suggest_classes,
    FRAGMOTION_OT_build,
    FRAGMOTION_OT_cancel,
    FRAGMOTION_OT_save_policy,
    FRAGMOTION_OT_load_policy,
    *recordings.CLASSES,
    *edit_recordings.CLASSES,
    FRAGMOTION_OT_follow_path,
    FRAGMOTION_OT_draw_path,
    FRAGMOTION_OT_solo_class,
    FRAGMOTION_OT_force_class,
    FRAGMOTION_OT_show_fragment,
    FRAGMOTION_OT_drive,
    FRAGMOTION_OT_listen,
    FRAGMOTION_OT_record,
    FRAGMOTION_OT_play_trace,
    FRAGMOTION_OT_find_pads,
    FRAGMOTION_OT_bake,
    FRAGMOTION_OT_populate,
)
