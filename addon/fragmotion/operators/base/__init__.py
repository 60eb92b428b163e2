# SPDX-License-Identifier: GPL-3.0-or-later
"""What operators share: tasks in the background, the armature in context, file dialogs."""

from __future__ import annotations

from .background import FRAGMOTION_OT_cancel

__all__ = ["CLASSES"]

CLASSES = (FRAGMOTION_OT_cancel,)
