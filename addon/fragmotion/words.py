# SPDX-License-Identifier: GPL-3.0-or-later
"""Words for people."""

from __future__ import annotations


def counted(count: int, thing: str) -> str:
    """So many of a thing whose plural ends in -s: "1 take", "2 takes"."""
    return f"{count} {thing}" if count == 1 else f"{count} {thing}s"
