# SPDX-License-Identifier: MIT
"""The add-on's icon: a runner, of whom fragments follow each other. `dev.py docs icon` draws it."""

from __future__ import annotations

from PIL import Image, ImageDraw

from tools.paths import ADDON
from tools.shell import say

_SIZE, _FINER = 256, 4  # pixels; how much finer it is drawn
_GROUND, _RUNNER = (30, 58, 95), (255, 255, 255)
_FORMER = ((-26, (244, 128, 36)), (-13, (250, 190, 120)))  # of the whole width, and its colour: where it was before
_SHIFT = 10  # of the whole width, to have all of it in the middle
_LIMB, _HEAD = 8, 8  # hundredths of the whole width: how thick a limb is, and the head's radius

# In hundredths of the whole width, from its left upper corner.
_PLACE_OF_HEAD = (61, 21)
_LIMBS = (
    ((57, 34), (50, 56)),
    ((57, 35), (66, 46), (77, 40)),
    ((57, 35), (46, 42), (38, 52)),
    ((50, 56), (65, 63), (61, 81), (69, 83)),
    ((50, 56), (47, 73), (30, 78), (27, 86)),
)


def draw_icon() -> None:
    """Write it."""
    scale = _SIZE * _FINER / 100
    picture = Image.new("RGBA", (_SIZE * _FINER, _SIZE * _FINER))
    draw = ImageDraw.Draw(picture)
    draw.rounded_rectangle((0, 0, picture.width - 1, picture.height - 1), 18 * scale, _GROUND)
    for before, colour in (*_FORMER, (0, _RUNNER)):
        _draw_runner(draw, scale, before + _SHIFT, colour)
    path = ADDON / "icon.png"
    picture.resize((_SIZE, _SIZE), Image.Resampling.LANCZOS).quantize(64).save(path, optimize=True)
    say(f"{path}: {path.stat().st_size / 1000:.1f} kB")


def _draw_runner(draw: ImageDraw.ImageDraw, scale: float, aside: float, colour: tuple[int, int, int]) -> None:
    def disk(x: float, y: float, radius: float) -> None:
        draw.ellipse(tuple(scale * edge for edge in (x - radius, y - radius, x + radius, y + radius)), colour)

    disk(_PLACE_OF_HEAD[0] + aside, _PLACE_OF_HEAD[1], _HEAD)
    for limb in _LIMBS:
        draw.line([(scale * (x + aside), scale * y) for x, y in limb], colour, round(scale * _LIMB))
        for x, y in limb:
            disk(x + aside, y, _LIMB / 2)


if __name__ == "__main__":
    draw_icon()
