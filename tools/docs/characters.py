# SPDX-License-Identifier: MIT
"""The pictures of docs/characters.md: downloaded characters by clips of their own, and driven with what is built of
these alone. `dev.py docs characters --packs DIR` runs this; the folder holds the files that PACKS names, which are no
part of the repository."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

import fragmotion_core as core
import matplotlib as mpl
import numpy as np
from numpy.typing import NDArray

from tools.measuring.blend import addon
from tools.motion_pictures.actor import PAPER, Actor, filmstrip
from tools.motion_pictures.motions import Motion, of_clip, of_performance
from tools.paths import ADDON, TOP
from tools.shell import Failure, say

mpl.use("Agg")
from matplotlib import pyplot

bpy: Any = import_module("bpy")

FOLDER = TOP / "docs" / "characters"
SEED, RATE, SETTLED = 1, 30.0, 3  # s after which a gait is held
MOMENTS, WIDTH, LINE = 9, 1300, 24  # pixels
ROOM, ASIDE = 1.1, 1.05  # of a body's length, and of its height: how wide a moment is, at least
OVERHEAD = 1.3  # of its height, that a row shows
CURVE, CHANGE = 1.6, 1.6  # s that the rows of what no clip shows last


class Pack(NamedTuple):
    """A character's file, who made it, and which of its Actions are ticked: a stand, a walk and a run."""

    file: str
    maker: str
    ticked: tuple[str, str, str]
    gaits: tuple[str, str] = ("walk", "run")


PACKS = (
    Pack("Knight.glb", "Knight of KayKit's Adventurers, by Kay Lousberg, CC0", ("Idle", "Walking_A", "Running_A")),
    Pack("Astronaut.glb", "Astronaut by Quaternius, CC0", ("Idle", "Walk", "Run")),
    Pack("Fox.glb", "Fox by Quaternius, CC0", ("Idle", "Walk", "Gallop"), ("walk", "gallop")),
)


class Row(NamedTuple):
    """A strip: its title, and moments of a motion."""

    title: str
    motion: Motion
    frames: list[int]


def draw(folder: Path) -> None:
    """Draw each pack's character."""
    building = addon("character.building")
    import_module(ADDON.name).register()
    FOLDER.mkdir(exist_ok=True)
    for pack in PACKS:
        picture = FOLDER / f"{Path(pack.file).stem.lower()}.jpg"
        _draw(pack, building, folder / pack.file, picture)
        say(f"{picture}: {picture.stat().st_size / 1000:.0f} kB")


def _draw(pack: Pack, building: Any, path: Path, picture: Path) -> None:
    obj, actions = _open(path, pack)
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    character = building.load(obj)
    actor, skeleton = Actor(obj), character.skeleton
    rows = []
    for gait, action, speed in zip(pack.gaits, actions[1:], (character.space.walk, character.space.run)):
        own = addon("mocap.sampling").sample(bpy.context, obj, action, actor.rig)
        frames = _spread(0, len(own.root_positions) - 1)
        rows.append(Row(f"{gait.capitalize()}: its own clip, on the spot", of_clip(own, skeleton), frames))
        played = _play(character, [((0, speed, 0, 0), SETTLED + 2 * _seconds(own))], own.rate)
        begin = _nearest(played, own, skeleton)
        driven = of_performance(gait, played)
        rows.append(Row(f"The same of a {gait} that is held: {speed:.1f} m/s", driven, [begin + f for f in frames]))
    rows += _made(character, pack.gaits)
    _compose(pack, rows, actor, picture)


def _seconds(clip: core.Clip) -> float:
    """From its first pose to its last."""
    return (len(clip.root_positions) - 1) / clip.rate


def _open(path: Path, pack: Pack) -> tuple[Any, list[Any]]:
    """The armature of a file and the Actions that are ticked, the ticks set."""
    if not path.is_file():
        raise Failure(f"{path}: there is no such file: {pack.maker}")
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.import_scene.gltf(filepath=str(path))
    armatures = [thing for thing in bpy.context.scene.objects if thing.type == "ARMATURE"]
    obj = max(armatures, key=lambda each: len(each.data.bones))
    bpy.context.view_layer.objects.active = obj
    fitting = {action.name.rpartition("|")[2]: action for action in addon("mocap.actions").fitting(obj)}
    for name, action in fitting.items():
        action.fragmotion.use = name in pack.ticked
    return obj, [fitting[name] for name in pack.ticked]


def _play(character: core.Character, parts: Sequence[tuple[tuple[float, ...], float]], rate: float) -> core.Performance:
    """What a player does who asks for one control after the other, each for so many seconds."""
    trace = np.concatenate([np.tile(control, (round(10 * seconds), 1)) for control, seconds in parts])
    return core.Player(character, SEED).run(trace, rate)


def _made(character: core.Character, gaits: tuple[str, str]) -> list[Row]:
    """What no clip shows: a curve, and how a stand becomes a run and the run a stand."""
    space = character.space
    curve = _play(character, [((0, space.walk, 1, 0), SETTLED + CURVE)], RATE)
    begin = round(SETTLED * RATE)
    runs = _play(character, [((0, 0, 0, 0), 1.0), ((0, space.run, 0, 0), CHANGE), ((0, 0, 0, 0), CHANGE)], RATE)
    middle, end = round(RATE), len(runs.root_positions) - 1
    stop = middle + round(CHANGE * RATE)
    return [
        Row(f"A {gaits[0]} in a curve, of which there is no clip", of_performance("curve", curve),
            _spread(begin, len(curve.root_positions) - 1)),
        Row(f"From a stand to a {gaits[1]}", of_performance("start", runs), _spread(middle, stop)),
        Row(f"From the {gaits[1]} to a stand", of_performance("stop", runs), _spread(stop, end)),
    ]  # fmt: skip


def _spread(first: int, last: int) -> list[int]:
    return [round(frame) for frame in np.linspace(first, last, MOMENTS).tolist()]


def _nearest(played: core.Performance, own: core.Clip, skeleton: core.Skeleton) -> int:
    """The frame from which a held gait is most like the clip: its bones' places, as the character frame sees them."""
    clip = core.Clip(skeleton, "played", played.rate, played.root_positions, played.rotations)
    first, seen = _seen(own, skeleton)[0], _seen(clip, skeleton)
    begin = round(SETTLED * played.rate)
    apart = np.linalg.norm(seen[begin : len(seen) - len(own.root_positions)] - first, axis=-1).sum(axis=1)
    return begin + int(apart.argmin())


def _seen(clip: core.Clip, skeleton: core.Skeleton) -> NDArray[np.float64]:
    """Heads [F,B,3] in each pose's own character frame."""
    heads = np.array(clip.world_transforms(skeleton)[0])
    x, y, heading = np.moveaxis(clip.character_frames(skeleton), 1, 0)[:, :, None]
    aside, ahead = heads[..., 0] - x, heads[..., 1] - y
    cosine, sine = np.cos(heading), np.sin(heading)
    return np.stack([cosine * aside + sine * ahead, cosine * ahead - sine * aside, heads[..., 2]], axis=-1)


def _compose(pack: Pack, rows: Sequence[Row], actor: Actor, picture: Path) -> None:
    length, height = _extents(actor.armature)
    actor.stature = height  # of the body that is seen; legs say otherwise of a head as large as the rest
    width = MOMENTS * max(ROOM * length, ASIDE * height)
    high = round(WIDTH / width * OVERHEAD * height)
    tall = LINE + len(rows) * (LINE + high)
    figure = pyplot.figure(figsize=(WIDTH / 100, tall / 100), dpi=100, facecolor=PAPER)
    figure.text(0.01, 1 - LINE / 2 / tall, pack.maker, va="center", size=9, color="#555555")
    for index, row in enumerate(rows):
        top = LINE + index * (LINE + high)
        figure.text(0.01, 1 - (top + LINE / 2) / tall, row.title, va="center", size=11, weight="bold")
        axes = figure.add_axes((0, 1 - (top + LINE + high) / tall, 1, high / tall))
        axes.axis("off")
        places = [(k + 0.5) * width / MOMENTS for k in range(MOMENTS)]
        axes.imshow(actor.strip(row.motion, row.frames, places, width, (WIDTH, high)), aspect="auto")
    figure.savefig(picture, pil_kwargs={"quality": 80})
    pyplot.close(figure)


def _extents(armature: Any) -> tuple[float, float]:
    """How long and how high a body is that stands as its first Action begins, m."""
    vector = import_module("mathutils").Vector
    depsgraph = bpy.context.evaluated_depsgraph_get()
    skins = [each.evaluated_get(depsgraph) for each in filmstrip.skins(armature)]
    corners = np.array([skin.matrix_world @ vector(corner) for skin in skins for corner in skin.bound_box])
    return float(np.ptp(corners[:, 1])), float(corners[:, 2].max())


if __name__ == "__main__":
    draw(Path(sys.argv[1]))
