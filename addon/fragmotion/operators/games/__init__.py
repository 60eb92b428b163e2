# SPDX-License-Identifier: GPL-3.0-or-later
"""Buttons that lead out of Blender."""

from __future__ import annotations

from .export_to_game import FRAGMOTION_OT_export_to_game
from .open_in_browser import FRAGMOTION_OT_open_in_browser

CLASSES = (FRAGMOTION_OT_export_to_game, FRAGMOTION_OT_open_in_browser)
