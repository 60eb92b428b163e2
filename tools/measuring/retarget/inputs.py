# SPDX-License-Identifier: MIT
"""The command line of `dev.py retarget`. Needs Python alone."""

from __future__ import annotations

import argparse
from pathlib import Path

from tools.measuring.evaluate.inputs import find_takes
from tools.shell import Failure

SKELETONS = (".bvh", ".asf")
RIGS = (".blend", ".glb", ".gltf", ".vrm", ".fbx", ".usd", ".usda", ".usdc", ".usdz")
"""What Blender reads."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What can be asked for."""
    parser.add_argument("mocap", nargs="+", type=Path, metavar="MOCAP", help="BVH or AMC files, or folders of them")
    parser.add_argument(
        "--onto", required=True, type=Path, metavar="FILE", help=f"the target: {', '.join(SKELETONS + RIGS)}"
    )
    parser.add_argument("--armature", metavar="NAME", help="the target, where the file has several armatures")
    parser.add_argument("--blend", type=Path, metavar="OUT", help="save the rig with a minute of the character there")
    parser.add_argument("--json", type=Path, metavar="FILE", help="save roles and figures there")
    parser.add_argument(
        "--unit", type=float, default=0.01, metavar="M", help="metres in one unit of a BVH file (default 0.01)"
    )
    parser.add_argument(
        "--onto-unit", type=float, metavar="M", help="metres in one unit of the target, a BVH file (default: --unit)"
    )
    parser.add_argument("--seed", type=int, default=1, metavar="S", help="of all that is drawn at random (default 1)")


def needs_blender(options: argparse.Namespace) -> bool:
    """Whether Blender reads the target."""
    return bool(options.onto.suffix.lower() in RIGS)


def check(options: argparse.Namespace) -> None:
    """Raise Failure on what cannot be used, before anything is done."""
    for take in find_takes(options.mocap):
        if take.path.suffix.lower() == ".blend":
            raise Failure(f"{take.path}: takes are read from BVH and AMC files; a .blend may be the target")
    if not options.onto.is_file():
        raise Failure(f"{options.onto}: there is no such file")
    if options.onto.suffix.lower() not in SKELETONS + RIGS:
        raise Failure(f"{options.onto}: not a skeleton or rig that can be read ({', '.join(SKELETONS + RIGS)})")
    for option in ("armature", "blend"):
        if getattr(options, option) and not needs_blender(options):
            raise Failure(f"--{option} is for rigs ({', '.join(RIGS)}), and {options.onto.name} is none")
    if options.blend and options.blend.suffix.lower() != ".blend":
        raise Failure(f"{options.blend}: --blend saves a .blend")
    if not options.unit > 0:
        raise Failure(f"--unit is {options.unit:g}, and must be over 0")
    if options.onto_unit is not None and not options.onto_unit > 0:
        raise Failure(f"--onto-unit is {options.onto_unit:g}, and must be over 0")
    if options.seed < 0:
        raise Failure(f"--seed is {options.seed}, and must be 0 or more")
