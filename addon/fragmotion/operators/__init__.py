# SPDX-License-Identifier: GPL-3.0-or-later
"""The buttons, a file each."""

from __future__ import annotations

from . import base, character, directing, games, mocap

__all__ = ["CLASSES", "DROP_HANDLERS"]

CLASSES = (*base.CLASSES, *mocap.CLASSES, *character.CLASSES, *directing.CLASSES, *games.CLASSES)
DROP_HANDLERS = mocap.DROP_HANDLERS
