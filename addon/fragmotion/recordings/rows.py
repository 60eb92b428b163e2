# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows that a recording keeps as JSON, as a .blend may hold them: whatever is damaged is told apart."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from typing import Any, TypeVar

_MOST = 1 << 20  # rows that a recording may have

T = TypeVar("T")


def read_rows(text: str, make: Callable[..., T], is_sound: Callable[[T], bool]) -> list[T] | None:
    """The rows in order, each made of its values; empty where there is no text, None where it is damaged."""
    if not text:
        return []
    try:
        rows: Any = json.loads(text)
        if not isinstance(rows, list) or not all(isinstance(row, list) for row in rows[:_MOST]):
            return None
        made = [make(*row) for row in rows[:_MOST]]
    except (ValueError, TypeError, RecursionError):  # no JSON, a row of another length, or one inside another for ever
        return None
    return made if all(map(is_sound, made)) else None


def write_rows(rows: Sequence[Any]) -> str:
    """What `read_rows` reads; empty where there are none."""
    return json.dumps(rows) if rows else ""
