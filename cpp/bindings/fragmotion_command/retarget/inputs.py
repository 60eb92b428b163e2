# SPDX-License-Identifier: MIT
"""What can be brought onto what, checked before anything is done."""

from __future__ import annotations

import argparse
from pathlib import Path

from ..files import UNIT
from .roles import role_of

SKELETONS = (".bvh", ".asf")


def check(options: argparse.Namespace) -> None:
    """Fill in what nobody told; ValueError on what cannot be used."""
    if not options.onto.is_file():
        raise ValueError(f"{options.onto}: there is no such file")
    if options.onto_unit is None:
        options.onto_unit = UNIT if options.unit is None else options.unit
    options.roles = [role_of(text) for text in options.role]
    options.seed = 1 if options.seed is None else options.seed
    for name in ("unit", "onto_unit"):
        value = getattr(options, name)
        if value is not None and not value > 0:
            raise ValueError(f"--{name.replace('_', '-')} is {value:g}, and must be over 0")


def check_skeleton(path: Path) -> None:
    """ValueError where the target is nothing that the core reads."""
    if path.suffix.lower() not in SKELETONS:
        raise ValueError(
            f"{path}: not a skeleton that is read without Blender ({', '.join(SKELETONS)}); rigs are read by "
            "`blender -c fragmotion retarget`"
        )
