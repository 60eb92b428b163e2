# SPDX-License-Identifier: GPL-3.0-or-later
"""Buttons that direct a character: drives, paths, recordings, bakes."""

from __future__ import annotations

from . import cut_recording, edit_recordings, recordings, storyboard
from .bake import FRAGMOTION_OT_bake
from .change_style import FRAGMOTION_OT_change_style
from .draw_path import FRAGMOTION_OT_draw_path
from .drive import (
    FRAGMOTION_OT_drive,
    FRAGMOTION_OT_find_pads,
    FRAGMOTION_OT_listen,
    FRAGMOTION_OT_play_trace,
    FRAGMOTION_OT_record,
)
from .follow_path import FRAGMOTION_OT_follow_path
from .populate import FRAGMOTION_OT_populate

__all__ = ["CLASSES"]

CLASSES = (
    FRAGMOTION_OT_bake,
    FRAGMOTION_OT_draw_path,
    FRAGMOTION_OT_drive,
    FRAGMOTION_OT_listen,
    FRAGMOTION_OT_record,
    FRAGMOTION_OT_change_style,
    FRAGMOTION_OT_play_trace,
    FRAGMOTION_OT_find_pads,
    *cut_recording.CLASSES,
    *edit_recordings.CLASSES,
    FRAGMOTION_OT_follow_path,
    FRAGMOTION_OT_populate,
    *recordings.CLASSES,
    *storyboard.CLASSES,
)
