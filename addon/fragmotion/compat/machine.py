# SPDX-License-Identifier: GPL-3.0-or-later
"""What Python does not say of the computer on all platforms."""

from __future__ import annotations

import ctypes
import os
import sys


def memory() -> int:
    """Bytes of the computer's memory, used or not."""
    if sys.platform == "win32":
        return _windows_memory()
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")


def _windows_memory() -> int:
    kilobytes = ctypes.c_ulonglong()
    ctypes.windll.kernel32.GetPhysicallyInstalledSystemMemory(ctypes.byref(kilobytes))  # type: ignore[attr-defined]
    return 1024 * kilobytes.value
