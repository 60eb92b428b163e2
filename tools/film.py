# SPDX-License-Identifier: MIT
"""A film of two minutes: the sample character as a simulated player drives it, with its moves, and with a tray for a
while. `dev.py docs film` makes it, in build/film; it is not kept in the repository."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from pathlib import Path

import fragmotion_core as core
from PIL import Image, ImageDraw, ImageFont

from tools.docs.drive_picture import bodies, hands_of, with_hands
from tools.measuring.blend import read_moves
from tools.measuring.directing.inputs import SAMPLE
from tools.motion_pictures.actor import bpy, open_blend
from tools.motion_pictures.motions import of_performance
from tools.motion_pictures.movements import STEPS_A_SECOND
from tools.paths import BUILD
from tools.shell import say

FILM = BUILD / "film" / "drive.mp4"
_SECONDS, _SEED = 120, 3
_FPS, _EVERY = 15, 4  # frames a second, of four times as many that are played
_MOVES = ((20, "wave"), (45, "kick"), (62, "sit"), (100, "wave"))  # s at which they are asked for
_HELD = 3  # s
_TRAY = (76, 94)  # s from and to which it carries one
_HANDS = ((0, -0.17), (1, 0.17))  # m to the right of the middle, at the tray
_AHEAD, _HIGH = 0.42, 1.12  # m, of the tray
_DARK = (70, 70, 70)


def film() -> None:
    """Write the film."""
    moves = read_moves(SAMPLE)
    actor, clips = open_blend(SAMPLE)
    character = core.build(actor.rig.skeleton, clips, [core.simulate_trace("explorer")]).with_moves(moves)
    names, trace = list(character.move_names), core.simulate_trace("walker", _SECONDS, _SEED, character.space)
    presses = [
        [second * STEPS_A_SECOND, names.index(name), _HELD * STEPS_A_SECOND] for second, name in _MOVES if name in names
    ]
    played = core.Player(character, _SEED).run(trace, _FPS * _EVERY, moves=presses, reaches=_reaches())
    frames = range(0, len(played.path) - 1, _EVERY)
    shown = zip(
        bodies(of_performance("Film", played), trace, actor, frames),
        hands_of(trace, character.space, len(frames), _FPS),
    )
    with tempfile.TemporaryDirectory() as folder:
        files = []
        for number, (body, hands) in enumerate(shown):
            playing = max(played.moves[frames[number]])
            second = number / _FPS
            words = names[playing] if playing >= 0 else "a tray" if _TRAY[0] <= second < _TRAY[1] else ""
            files.append(Path(folder) / f"{number:05}.jpg")
            _titled(with_hands(body, hands), words).save(files[-1], quality=92)
        _write(files)
    say(f"{FILM}: {len(files) / _FPS:.0f} s, {FILM.stat().st_size / 1e6:.2f} MB")


def _reaches() -> list[list[float]]:
    """Both hands take the tray, and let it go."""
    return [
        [float(second * STEPS_A_SECOND), hand, weight, 1, x, _AHEAD, _HIGH]
        for second, weight in zip(_TRAY, (1.0, 0.0))
        for hand, x in _HANDS
    ]


def _titled(picture: Image.Image, words: str) -> Image.Image:
    ImageDraw.Draw(picture).text((16, 12), words, fill=_DARK, font=ImageFont.load_default(18))
    return picture


def _write(files: Sequence[Path]) -> None:
    """The pictures as H.264 in an MP4, by Blender."""
    FILM.parent.mkdir(parents=True, exist_ok=True)
    scene = bpy.data.scenes.new("Film")
    strip = scene.sequence_editor_create().sequences.new_image("Film", str(files[0]), 1, 1)
    for file in files[1:]:
        strip.elements.append(file.name)
    scene.frame_start, scene.frame_end = 1, len(files)
    render = scene.render
    width, height = Image.open(files[0]).size
    render.resolution_x, render.resolution_y, render.resolution_percentage, render.fps = width, height, 100, _FPS
    render.image_settings.file_format, render.filepath = "FFMPEG", str(FILM)
    render.ffmpeg.format, render.ffmpeg.codec, render.ffmpeg.gopsize = "MPEG4", "H264", 4 * _FPS
    render.ffmpeg.constant_rate_factor = "LOW"
    scene.view_settings.view_transform = "Standard"
    bpy.ops.render.render(animation=True, scene=scene.name)
    bpy.data.scenes.remove(scene)


if __name__ == "__main__":
    film()
