# SPDX-License-Identifier: MIT
"""A drive, seen by a camera that circles the character, as an animated picture."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import fragmotion_core as core
import numpy as np
from numpy.typing import NDArray
from PIL import Image

from tools.motion_pictures.actor import Actor, add_disc, add_mesh, filmstrip, mathutils, stage, upright, use_workbench
from tools.motion_pictures.motions import Motion, of_performance
from tools.motion_pictures.movements import STEPS_A_SECOND, Part, trace_of

_DRIVE = (
    Part(0.5, "stand"), Part(1.3, "walk"), Part(1.4, "run"), Part(1.0, "run", turn=1), Part(0.7, "walk"),
    Part(0.3, "walk", jump=1), Part(0.9, "walk"), Part(1.1, "walk", turn=-1), Part(0.6, "stand"),
)  # fmt: skip
_FPS, _EVERY = 20, 3  # frames a second, of three times as many that are played
_SIZE, _QUALITY = (560, 400), 78
_AROUND, _START = 330, -60  # degrees that the camera goes round, and where it starts: to the left of the front
_DISTANCE, _HEIGHT, _LOOK = 2.0, 0.8, 0.5  # of the camera and what it looks at, statures
_CALM = 0.5  # s over which the camera's place is a mean
_SQUARE, _AWAY = 0.5, 25  # m
_CORNERS = ((0, 0), (1, 0), (1, 1), (0, 1))
_LIGHT, _DARK, _SHADOW, _COMMAND = (2.0, 2.0, 1.95), (1.6, 1.6, 1.56), (0.7, 0.7, 0.7), (0.1, 0.6, 1.6)


def draw_turntable(character: core.Character, actor: Actor, path: Path, seed: int) -> None:
    """Write the animated WebP."""
    trace = trace_of(_DRIVE, character.space)
    performance = core.Player(character, seed).run(trace, _FPS * _EVERY)
    motion = of_performance("Turntable", performance)
    pictures = [Image.fromarray((255 * picture).astype(np.uint8)) for picture in _pictures(motion, trace, actor)]
    pictures[0].save(
        path, save_all=True, append_images=pictures[1:], duration=1000 // _FPS, loop=0, quality=_QUALITY, method=4
    )


def _pictures(motion: Motion, trace: core.Doubles, actor: Actor) -> Iterator[NDArray[Any]]:
    actor.play(motion)
    size, middles = actor.stature, calm(motion.roots[:, :2], round(_CALM * motion.rate))
    frames = range(0, len(motion.roots) - 1, _EVERY)
    with stage.stage() as scene:
        use_workbench(scene)
        add_squares(scene, motion.roots)
        shadow, arrow = add_disc(scene, (0, 0, 0), 0.13 * size, _SHADOW), add_arrow(scene)
        for frame in frames:
            moment = filmstrip.freeze(actor.armature, scene, frame + 1)
            shadow.location = (moment.middle.x, moment.middle.y, 0.004)
            show_command(arrow, motion, trace[int(frame / motion.rate * STEPS_A_SECOND)], frame)
            angle = math.radians(_START + _AROUND * frame / frames[-1]) + motion.path[0, 2]
            aim(scene.camera, middles[frame], angle, size)
            yield upright(stage.render(scene, _SIZE))
            for ghost in moment.ghosts:
                filmstrip.bpy.data.objects.remove(ghost)


def calm(places: core.Doubles, width: int) -> core.Doubles:
    """Means over so many frames."""
    padded = np.pad(places, ((width, width), (0, 0)), "edge")
    sums = np.cumsum(padded, axis=0)
    return ((sums[2 * width :] - sums[: -2 * width]) / (2 * width))[: len(places)]


def add_squares(scene: Any, roots: core.Doubles) -> None:
    """Squares around all of the way."""
    low = np.floor((roots[:, :2].min(axis=0) - _AWAY) / _SQUARE).astype(int)
    high = np.ceil((roots[:, :2].max(axis=0) + _AWAY) / _SQUARE).astype(int)
    for parity, colour in enumerate((_LIGHT, _DARK)):
        cells = [(x, y) for x in range(low[0], high[0]) for y in range(low[1], high[1]) if (x + y) % 2 == parity]
        corners = [(_SQUARE * (x + i), _SQUARE * (y + j), 0) for x, y in cells for i, j in _CORNERS]
        add_mesh(scene, corners, np.arange(len(corners)).reshape(-1, 4).tolist(), [colour])


def add_arrow(scene: Any) -> Any:
    """What is asked for: an arrow along y of length 1."""
    half = [(0.05, 0.3), (0.05, 0.8), (0.14, 0.8), (0, 1)]
    points = [(x, y, 0) for x, y in half] + [(-x, y, 0) for x, y in half[-2::-1]]
    return add_mesh(scene, points, [range(7)], [_COMMAND])


def show_command(arrow: Any, motion: Motion, control: core.Doubles, frame: int) -> None:
    """Let the arrow say what is asked for at a frame."""
    x, y, heading = motion.path[frame]
    speed = math.hypot(control[0], control[1])
    arrow.hide_render = speed == 0
    arrow.location = (x, y, 0.006)
    arrow.rotation_euler = (0, 0, heading + math.atan2(-control[0], control[1]))
    arrow.scale = (1, 0.6 + 0.4 * speed, 1)


def aim(camera: Any, middle: core.Doubles, angle: float, size: float, distance: float = _DISTANCE) -> None:
    """From a place around the character, `angle` counter-clockwise from +y, `distance` statures away."""
    target = mathutils.Vector((*middle, _LOOK * size))
    away = mathutils.Vector((-math.sin(angle), math.cos(angle), 0)) * distance * size
    camera.data.type, camera.data.lens, camera.data.sensor_fit = "PERSP", 38, "HORIZONTAL"
    position = mathutils.Vector((*middle, _HEIGHT * size)) + away
    camera.matrix_world = stage.looking_at(position, target)
