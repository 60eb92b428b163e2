# SPDX-License-Identifier: MIT
"""Draw the sheets of all movements and the turntable. `dev.py docs motion` runs this with the built core."""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

import fragmotion_core as core

from tools.measuring.blend import read_moves, read_styles
from tools.motion_pictures.actor import open_blend, open_folder
from tools.motion_pictures.motions import Feet
from tools.motion_pictures.movements import MOVEMENTS
from tools.motion_pictures.rows import SEED, Cast
from tools.motion_pictures.sequences import draw_hands, draw_moves, draw_styles
from tools.motion_pictures.sheet import draw_sheet
from tools.motion_pictures.turntable import draw_turntable
from tools.shell import Failure, say


def draw(takes: Path, folder: Path) -> None:
    """All pictures of a character that is built from a .blend or a folder of BVH files."""
    folder.mkdir(parents=True, exist_ok=True)
    moves = read_moves(takes) if takes.suffix == ".blend" else []
    if takes.suffix == ".blend":
        _draw_styles(takes, folder / "styles.jpg")
    actor, clips = open_blend(takes) if takes.suffix == ".blend" else open_folder(takes)
    clips = core.on_one_floor(actor.rig.skeleton, clips)
    cast, feet = Cast(actor.rig.skeleton, clips), Feet(actor.rig.skeleton, clips)
    for movement in MOVEMENTS:
        path, rows = folder / f"{movement.name}.jpg", cast.rows(movement)
        draw_sheet(movement, rows, actor, feet, path)
        say(f"{path}: {path.stat().st_size / 1000:.0f} kB")
        for row in rows:
            say(f"  {row.title}: {row.figures}")
    if moves:
        draw_moves(cast.character, moves, actor, folder / "moves.jpg")
    draw_hands(cast.character, actor, folder / "hands.jpg")
    path = folder / "turntable.webp"
    draw_turntable(cast.character, actor, path, SEED)
    say(f"{path}: {path.stat().st_size / 1e6:.2f} MB")


def _draw_styles(takes: Path, path: Path) -> None:
    """Where the file has several."""
    styles = read_styles(takes)
    if styles:
        draw_styles(styles, open_blend(takes)[0], path)
        say(f"{path}: {path.stat().st_size / 1000:.0f} kB")


def main(arguments: list[str]) -> int:
    """Run, and return the exit code."""
    parser = argparse.ArgumentParser(prog="motion_pictures", description=__doc__)
    parser.add_argument("takes", type=Path, help="a .blend, or a folder of BVH files")
    parser.add_argument("folder", type=Path, help="where the pictures go")
    options = parser.parse_args(arguments)
    start = time.monotonic()
    try:
        draw(options.takes, options.folder)
    except (Failure, OSError, ValueError) as failure:
        print(f"motion_pictures: {failure}", file=sys.stderr)
        return 1
    say(f"{time.monotonic() - start:.0f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
