# SPDX-License-Identifier: MIT
"""Real motion on every checkout: takes of the sample character, written as mocap files, read, built and played."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import fragmotion_core as core
import numpy as np
import pytest
from conftest import Array, build_options

SAMPLE = Path(__file__).resolve().parents[2] / "sample_rigs"
sys.path.insert(0, str(SAMPLE))

import body  # noqa: E402
import gait  # noqa: E402
import takes  # noqa: E402

NAMES = ("stand", "walk forward", "walk left", "run forward", "turn left", "walk start stop", "jump up")
UNIT = 0.01  # metres: centimetres in the file
BONES = [bone.name for bone in body.BONES]


def y_up(places: Array) -> Array:
    """The file's axes and unit of a place in the z-up world."""
    x, y, z = np.moveaxis(np.asarray(places, float) / UNIT, -1, 0)
    return np.stack([x, z, -y], -1)


def euler_zxy(rotation: Array) -> Array:
    """Degrees [N, 3] about z, x and y of R = Rz Rx Ry in the y-up world, for rotations [N, 3, 3] of the z-up one."""
    turn = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])
    r = turn @ rotation @ turn.T
    about_x = np.arcsin(np.clip(r[:, 2, 1], -1, 1))
    about_z = np.arctan2(-r[:, 0, 1], r[:, 1, 1])
    about_y = np.arctan2(-r[:, 2, 0], r[:, 2, 2])
    angles: Array = np.degrees(np.stack([about_z, about_x, about_y], 1))
    return angles


def children(name: str | None) -> list[body.Bone]:
    return [bone for bone in body.BONES if bone.parent == name]


def offset(bone: body.Bone) -> Array:
    """From the parent's head to this bone's, in the file's axes and unit."""
    return y_up(bone.head - (body.head(bone.parent) if bone.parent else 0))


def words(values: Array) -> str:
    return " ".join(f"{value:.5f}" for value in values)


def bvh_joint(bone: body.Bone) -> str:
    """A joint with all below it; root and hips have positions, too."""
    moves = bone.name in ("root", "hips")
    places = "Xposition Yposition Zposition " if moves else ""
    inner = "".join(bvh_joint(child) for child in children(bone.name))
    if not inner:
        inner = f"End Site {{\nOFFSET {words(y_up(bone.tail - bone.head))}\n}}\n"
    return (
        f"{'JOINT' if bone.parent else 'ROOT'} {bone.name} {{\nOFFSET {words(offset(bone))}\n"
        f"CHANNELS {6 if moves else 3} {places}Zrotation Xrotation Yrotation\n{inner}}}\n"
    )


def depth_first(name: str | None = None) -> Iterator[str]:
    for bone in children(name):
        yield bone.name
        yield from depth_first(bone.name)


def channels(motion: gait.Motion, name: str) -> Array:
    """What a file tells of a bone, frame by frame: degrees about z, x, y, and places before them."""
    angles = euler_zxy(motion.local(name))
    if name == "root":
        return np.column_stack([y_up(motion.root), angles])
    if name == "hips":
        back = np.swapaxes(motion.world["root"], 1, 2)
        return np.column_stack([y_up(np.einsum("nij,nj->ni", back, motion.hips - motion.root)), angles])
    return angles


def write_bvh(path: Path, motion: gait.Motion) -> Path:
    rows = np.column_stack([channels(motion, name) for name in depth_first()])
    head = f"HIERARCHY\n{bvh_joint(body.BONES[0])}MOTION\nFrames: {len(rows)}\nFrame Time: {1 / takes.FPS:.7f}\n"
    path.write_text(head + "\n".join(words(row) for row in rows) + "\n")
    return path


# An Acclaim bone begins where its parent ends; one that does not hangs on a still link from its parent's end.


def asf_text() -> str:
    """The body below its hips, which are Acclaim's root; lengths in centimetres."""
    bones, lines = [], []
    for bone in body.BONES[2:]:
        parent = body.BY_NAME[bone.parent or ""]
        above = "root" if parent.name == "hips" else parent.name
        gap = bone.head - (parent.head if above == "root" else parent.tail)
        if np.linalg.norm(gap) > 1e-9:
            bones.append((f"to_{bone.name}", gap, ""))
            lines.append(f"{above} to_{bone.name}")
            above = f"to_{bone.name}"
        bones.append((bone.name, bone.tail - bone.head, "dof ry rx rz\n"))
        lines.append(f"{above} {bone.name}")
    data = "".join(
        f"begin\nname {name}\ndirection {words(y_up(way) / np.linalg.norm(y_up(way)))}\n"
        f"length {np.linalg.norm(y_up(way)):.5f}\naxis 0 0 0 XYZ\n{dof}end\n"
        for name, way, dof in bones
    )
    return (
        f":units\nlength 2.54\nangle deg\n:root\norder TX TY TZ RY RX RZ\naxis XYZ\nposition 0 0 0\norientation 0 0 0\n"
        f":bonedata\n{data}:hierarchy\nbegin\n" + "\n".join(lines) + "\nend\n"
    )


def write_amc(path: Path, motion: gait.Motion) -> Path:
    angles = {name: euler_zxy(motion.local(name))[:, ::-1] for name in BONES[2:]}  # the first dof turns first
    root = np.column_stack([y_up(motion.hips), euler_zxy(motion.world["hips"])[:, [2, 1, 0]]])
    lines = [":FULLY-SPECIFIED", ":DEGREES"]
    for frame in range(len(root)):
        lines += [str(frame + 1), f"root {words(root[frame])}"]
        lines += [f"{name} {words(values[frame])}" for name, values in angles.items()]
    path.write_text("\n".join(lines) + "\n")
    return path


@pytest.fixture(scope="module")
def motions() -> dict[str, gait.Motion]:
    return {take.name: gait.synthesize(take) for take in takes.all_takes() if take.name in NAMES}


@pytest.fixture(scope="module", params=["bvh", "amc"])
def read(request: Any, motions: dict[str, gait.Motion], tmp_path_factory: pytest.TempPathFactory) -> list[core.Take]:
    """The takes as they come back from files."""
    folder = tmp_path_factory.mktemp("sample")
    if request.param == "bvh":
        return [core.read_bvh(write_bvh(folder / f"{name}.bvh", m), UNIT) for name, m in motions.items()]
    asf = folder / "body.asf"
    asf.write_text(asf_text())
    return [
        core.read_asf_amc(asf, write_amc(folder / f"{name}.amc", m), float(takes.FPS)) for name, m in motions.items()
    ]


def test_takes_come_back_as_they_were_made(read: list[core.Take], motions: dict[str, gait.Motion]) -> None:
    assert len(read) == len(NAMES)
    for take in read:
        motion = motions[take.name]
        names = list(take.skeleton.names)
        heads, turned = take.world_transforms()
        hips = names.index("hips") if "hips" in names else 0
        np.testing.assert_allclose(heads[:, hips], motion.hips, atol=1e-5)
        for name in ("head", "hand.L", "foot.R", "toe.L"):
            w, x, y, z = np.moveaxis(turned[:, names.index(name)], -1, 0)
            up = np.stack([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)], 1)
            np.testing.assert_allclose(up, motion.world[name][:, :, 2], atol=1e-5)


def test_a_character_of_the_takes_walks_where_the_stick_says(read: list[core.Take]) -> None:
    skeleton = read[0].skeleton
    assert skeleton.roles["left_foot"] and skeleton.roles["head"]
    assert skeleton.stature == pytest.approx(1.8, abs=0.04)
    clips = [core.Clip.from_take(take, skeleton) for take in read]
    character = core.build(skeleton, clips, [core.simulate_trace("explorer", 30, 1)], build_options(classes=40))
    player = core.Player(character)
    played = player.run(np.tile([0, 1.2, 0, 0], (50, 1)), 30)
    assert np.isfinite(played.root_positions).all() and np.isfinite(played.rotations).all()
    way = played.root_positions[-1] - played.root_positions[30]
    assert 0.7 * 1.2 * 4 < np.linalg.norm(way[:2]) < 1.3 * 1.2 * 4
