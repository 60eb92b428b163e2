# SPDX-License-Identifier: MIT
"""What can be brought onto what, checked before anything is done."""

from __future__ import annotations

import argparse

from ..by_blender import RIGS
from ..files import UNIT
from .roles import role_of

SKELETONS = (".bvh", ".asf")


def check(options: argparse.Namespace) -> None:
    """Fill in what nobody told; ValueError on what cannot be used."""
    if not options.onto.is_file():
        raise ValueError(f"{options.onto}: there is no such file")
    _check_ending(options)
    if options.onto_unit is None:
        options.onto_unit = UNIT if options.unit is None else options.unit
    options.roles = [role_of(text) for text in options.role]
    options.seed = 1 if options.seed is None else options.seed
    for name in ("unit", "onto_unit"):
        value = getattr(options, name)
        if value is not None and not value > 0:
            raise ValueError(f"--{name.replace('_', '-')} is {value:g}, and must be over 0")


def _check_ending(options: argparse.Namespace) -> None:
    ending = options.onto.suffix.lower()
    if ending not in (*SKELETONS, *RIGS):
        raise ValueError(f"{options.onto}: neither a skeleton ({', '.join(SKELETONS)}) nor a rig ({', '.join(RIGS)})")
    if options.armature and ending in SKELETONS:
        raise ValueError(f"--armature is for rigs, and {options.onto.name} is a skeleton alone: leave it out")
