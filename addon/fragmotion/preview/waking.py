# SPDX-License-Identifier: GPL-3.0-or-later
"""What wakes modal operators; nothing of it stays with Blender when the add-on goes."""

from __future__ import annotations

import bpy

_timers: list[bpy.types.Timer] = []


def wake(window: bpy.types.Window, seconds: float) -> bpy.types.Timer:
    """Send the window's modal operators a timer event that often, until `rest`."""
    timer = bpy.context.window_manager.event_timer_add(seconds, window=window)
    _timers.append(timer)
    return timer


def rest(timer: bpy.types.Timer | None) -> None:
    """Send no more of them, and say nothing in the status bar."""
    if timer not in _timers:
        return
    _timers.remove(timer)
    bpy.context.window_manager.event_timer_remove(timer)
    if bpy.context.workspace is not None:  # there is none where no window is the context's
        bpy.context.workspace.status_text_set(None)


def unregister() -> None:
    """Wake none any more."""
    for timer in list(_timers):
        rest(timer)
