# SPDX-License-Identifier: MIT
"""The README's moving picture: the sample character, and in a corner the sticks and the button that drive it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import fragmotion_core as core
import numpy as np
from PIL import Image, ImageDraw, ImageFont

from tools.measuring.directing.inputs import SAMPLE
from tools.motion_pictures.actor import Actor, add_disc, filmstrip, open_blend, stage, upright, use_workbench
from tools.motion_pictures.motions import Motion, of_performance
from tools.motion_pictures.movements import STEPS_A_SECOND, Part, trace_of
from tools.motion_pictures.turntable import add_arrow, add_squares, aim, calm, show_command
from tools.paths import TOP
from tools.shell import say

PICTURE = TOP / "docs" / "drive.webp"
_SEED = 1
_DRIVE = (
    Part(0.6, "stand"), Part(1.3, "walk"), Part(1.1, "run"), Part(1.2, "run", turn=1), Part(0.4, "run"),
    Part(0.3, "run", jump=1), Part(1.1, "run"), Part(1.3, "walk", turn=-1), Part(0.2, "walk"), Part(1.2, "stand"),
)  # fmt: skip
_FPS, _EVERY = 20, 3  # frames a second, of three times as many that are played
_SIZE, _QUALITY = (600, 340), 62
_SIDE, _DISTANCE = 62, 2.3  # degrees from where it faces at first to the camera, to its left; statures
_CALM = 0.6  # s over which the camera's place is a mean
_FADE = 8  # frames over which the end becomes the beginning
_SHADOW = (0.7, 0.7, 0.7)
_RING, _KNOB, _BUTTON = 27, 11, 15  # pixels, radii
_PLACES = {"move": 418, "turn": 492, "jump": 556}  # pixels from the left edge
_UP, _BELOW, _FINE = 58, 14, 4  # pixels of middles and of words over the lower edge; drawn this many times as large
_DARK, _PALE, _BLUE = (70, 70, 70), (250, 250, 248), (40, 120, 200)
_HAND = 0.12  # s in which a thumb moves


class Hands(NamedTuple):
    """The left stick (right and up, 1 at its rim), the right one (right), and whether the button is down."""

    move: tuple[float, float]
    turn: float
    jump: bool


def draw() -> None:
    """Write the picture."""
    actor, clips = open_blend(SAMPLE)
    character = core.build(actor.rig.skeleton, clips, [core.simulate_trace("explorer")])
    trace = trace_of(_DRIVE, character.space)
    motion = of_performance("Drive", core.Player(character, _SEED).run(trace, _FPS * _EVERY))
    frames = range(0, len(motion.roots) - 1, _EVERY)
    shown = zip(bodies(motion, trace, actor, frames), hands_of(trace, character.space, len(frames)))
    pictures = _looped([with_hands(body, hands) for body, hands in shown])
    pictures[0].save(
        PICTURE, save_all=True, append_images=pictures[1:], duration=1000 // _FPS, loop=0, quality=_QUALITY, method=4
    )
    say(f"{PICTURE}: {len(pictures) / _FPS:.1f} s, {PICTURE.stat().st_size / 1e6:.2f} MB")


def bodies(motion: Motion, trace: core.Doubles, actor: Actor, frames: range) -> Iterator[Image.Image]:
    """The character on these frames of the motion that a trace led to."""
    actor.play(motion)
    size, middles = actor.stature, calm(motion.roots[:, :2], round(_CALM * motion.rate))
    angle = motion.path[0, 2] + math.radians(_SIDE)
    with stage.stage() as scene:
        use_workbench(scene)
        add_squares(scene, motion.roots)
        shadow, arrow = add_disc(scene, (0, 0, 0), 0.13 * size, _SHADOW), add_arrow(scene)
        for frame in frames:
            moment = filmstrip.freeze(actor.armature, scene, frame + 1)
            shadow.location = (moment.middle.x, moment.middle.y, 0.004)
            show_command(arrow, motion, trace[int(frame / motion.rate * STEPS_A_SECOND)], frame)
            aim(scene.camera, middles[frame], angle, size, _DISTANCE)
            yield Image.fromarray((255 * upright(stage.render(scene, _SIZE))).astype(np.uint8))
            for ghost in moment.ghosts:
                filmstrip.bpy.data.objects.remove(ghost)


def hands_of(trace: core.Doubles, space: core.ControlSpace, count: int, fps: int = _FPS) -> Iterator[Hands]:
    """What a player's hands do for the trace, frame by frame: half way is a walk, the rim a run."""
    speeds = np.hypot(trace[:, 0], trace[:, 1])
    pushed = np.interp(speeds, [0, space.walk, space.run], [0, 0.5, 1]) / np.maximum(speeds, 1e-9)
    held = np.column_stack((trace[:, 0] * pushed, trace[:, 1] * pushed, -trace[:, 2]))
    rows = np.arange(count) * STEPS_A_SECOND // fps
    for (right, up, turn), jump in zip(calm(held[rows], round(_HAND * fps)), trace[rows, 3]):
        yield Hands((right, up), turn, jump > 0)


def with_hands(body: Image.Image, hands: Hands) -> Image.Image:
    """The picture with sticks and button in its lower right corner."""
    layer = Image.new("RGBA", (body.width * _FINE, body.height * _FINE))
    pen, font = ImageDraw.Draw(layer), ImageFont.load_default(12 * _FINE)
    knobs = {"move": hands.move, "turn": (hands.turn, 0.0)}
    for name, x in _PLACES.items():
        middle = (x, body.height - _UP)
        if name in knobs:
            _disc(pen, middle, _RING, (*_PALE, 190))
            right, up = knobs[name]
            reach = _RING - _KNOB / 2
            _disc(pen, (middle[0] + reach * right, middle[1] - reach * up), _KNOB, _BLUE if right or up else _DARK)
        else:
            _disc(pen, middle, _BUTTON, _BLUE if hands.jump else (*_PALE, 190))
        pen.text((x * _FINE, (body.height - _BELOW) * _FINE), name, fill=_DARK, font=font, anchor="ms")
    small = layer.resize(body.size, Image.Resampling.LANCZOS)
    return Image.alpha_composite(body.convert("RGBA"), small).convert("RGB")


def _disc(pen: ImageDraw.ImageDraw, middle: tuple[float, float], radius: float, colour: tuple[int, ...]) -> None:
    x, y, r = (_FINE * value for value in (*middle, radius))
    pen.ellipse((x - r, y - r, x + r, y + r), fill=colour, outline=_DARK, width=2 * _FINE)


def _looped(pictures: list[Image.Image]) -> list[Image.Image]:
    """The last frames fade into the first, which then begin the next round."""
    first, last = pictures[:_FADE], pictures[-_FADE:]
    faded = [Image.blend(old, new, (i + 1) / (_FADE + 1)) for i, (old, new) in enumerate(zip(last, first))]
    return pictures[_FADE:-_FADE] + faded


if __name__ == "__main__":
    draw()
