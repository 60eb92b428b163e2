# SPDX-License-Identifier: MIT
"""Figures in words."""

from __future__ import annotations

UNITS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}


def nanoseconds(seconds: float) -> str:
    """Of a frame."""
    return f"{seconds * 1e9:.0f} ns"


def megabytes(count: float) -> str:
    """Of memory or of a file, in bytes."""
    return f"{count / 1e6:.0f} MB"


def duration(seconds: float) -> str:
    """By its largest unit."""
    unit = next((unit for unit in ("s", "ms", "us") if seconds >= UNITS[unit]), "ns")
    return f"{seconds / UNITS[unit]:.3g} {unit}"
