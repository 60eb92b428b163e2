# SPDX-License-Identifier: MIT
"""A reader of policy files that shares no code with the core: what docs/game.md says of the format."""

from __future__ import annotations

import struct
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]
BLOCK = 8
ROLES = ("hips", "head", "left_hand", "right_hand", "left_foot", "right_foot", "left_toe", "right_toe")
THIGHS = ("left_thigh", "right_thigh")


@dataclass
class Grid:
    """What a style's clips share, [bones]; how a mirror image follows, in files that have any."""

    usual: Array
    steps: Array
    counterparts: Array = field(default_factory=lambda: np.zeros(0, int))
    before: Array = field(default_factory=lambda: np.zeros((0, 4)))
    after: Array = field(default_factory=lambda: np.zeros((0, 4)))


@dataclass
class Clip:
    """A take: hips' places [F,3], headings [F], rotations [F,B,4], and bytes of the file that are its own."""

    name: str
    rate: float
    places: Array
    headings: Array
    rotations: Array
    size: int
    markers: list[tuple[float, str]] = field(default_factory=list)
    original: int = -1


@dataclass
class Style:
    """What a style of a character has."""

    name: str = ""
    clips: list[Clip] = field(default_factory=list)
    fragments: list[tuple[int, int, int, int, tuple[float, ...]]] = field(default_factory=list)
    speeds: list[float] = field(default_factory=list)
    controls: int = 0
    labels: Array = field(default_factory=lambda: np.zeros(0))
    representatives: Array = field(default_factory=lambda: np.zeros(0))
    tables: dict[str, Array] = field(default_factory=dict)


@dataclass
class Policy:
    """What a policy file holds."""

    bones: list[str]
    parents: Array
    rest: Array
    offsets: Array
    tips: Array
    roles: dict[str, int]
    styles: list[Style]
    moves: list[tuple[str, int, bool, float, int, int]]


class Bytes:
    """Little-endian numbers, lists and texts one after the other."""

    def __init__(self, data: bytes) -> None:
        self._data, self.at = data, 0

    def one(self, kind: str) -> Any:
        (value,) = struct.unpack_from("<" + kind, self._data, self.at)
        self.at += struct.calcsize("<" + kind)
        return value

    def some(self, kind: str, count: int) -> list[Any]:
        return [self.one(kind) for _ in range(count)]

    def numbers(self, dtype: str) -> Array:
        """A count of 8 bytes, and so many numbers."""
        count = self.one("Q")
        values = np.frombuffer(self._data, np.dtype(dtype).newbyteorder("<"), count, self.at)
        self.at += values.nbytes
        return values

    def packed(self) -> Array:
        """A count of 8 bytes, the least number, bits of each, and what they are more than the least."""
        count, least, bits = self.one("Q"), self.one("i"), self.one("B")
        size = (count * bits + 7) // 8
        stream = np.unpackbits(np.frombuffer(self._data, np.uint8, size, self.at), bitorder="little")[: count * bits]
        self.at += size
        values: Array = least + stream.reshape(count, bits).astype(np.int64) @ (1 << np.arange(bits, dtype=np.int64))
        return values

    def text(self) -> str:
        size = self.one("I")
        self.at += size
        return self._data[self.at - size : self.at].decode()

    def section(self, name: str) -> bool:
        """Whether a part follows that only some files have, which begins with its name."""
        follows = self._data.startswith(name.encode(), self.at)
        self.at += len(name) if follows else 0
        return follows

    @property
    def done(self) -> bool:
        return self.at == len(self._data)


def checksum(data: bytes, version: int) -> int:
    """FNV-1a of 64 bits; since version 4 of words of 8 bytes, each folded."""
    value, width = 0xCBF29CE484222325, 1 if version == 3 else 8
    for at in range(0, len(data), width):
        value = (value ^ int.from_bytes(data[at : at + width], "little")) * 0x100000001B3 % 2**64
        value ^= value >> 32 if version > 3 else 0
    return value


def read_policy(data: bytes) -> Policy:
    """Read a file's bytes, all of them."""
    assert data[:8] == b"FRAGMOTN"
    version, size = struct.unpack_from("<IQ", data, 8)
    payload = data[20 : 20 + size]
    assert version in (3, 4, 5, 6) and len(data) == 20 + size + 8
    assert struct.unpack("<Q", data[-8:]) == (checksum(payload, version),)
    read = Bytes(payload)
    bones = [read.text() for _ in range(read.one("Q"))]
    parents = read.numbers("i4")
    rest, offsets, tips = (np.array([read.some("d", n) for _ in range(read.one("Q"))]) for n in (4, 3, 3))
    roles = dict(zip((*ROLES, *THIGHS), read.some("i", 10)))
    styles = [read_style(read, version)]
    if version > 5:  # looks and arms
        read.numbers("f4"), read.some("d", 7 + 2 * 4)
    moves: list[tuple[str, int, bool, float, int, int]] = []
    if read.section("moves"):
        for _ in range(read.one("Q")):
            moves.append((read.text(), read.one("i"), bool(read.one("B")), read.one("d"), read.one("i"), read.one("i")))
    if read.section("styles"):
        styles[0].name = read.text()
        for _ in range(read.one("Q")):
            name = read.text()
            styles.append(read_style(read, version))
            styles[-1].name = name
    if read.section("markers"):
        for clips in (style.clips for style in styles):
            for clip in clips:
                if clip.original >= 0:
                    clip.markers = clips[clip.original].markers
                else:
                    clip.markers = [(read.text(), read.one("d"))[::-1] for _ in range(read.one("Q"))]
    assert read.done
    return Policy(bones, parents, rest[:, [3, 0, 1, 2]], offsets, tips, roles, styles, moves)


def read_style(read: Bytes, version: int) -> Style:
    """Read all of a style but its name."""
    style = Style()
    grid = read_grid(read, version)
    turns: list[Array] = []
    for _ in range(read.one("Q")):
        begin, name, original = read.at, read.text(), read.one("i") if version > 3 else -1
        clip, turned = (
            read_clip(read, name, grid, version) if original < 0 else (style.clips[original], turns[original])
        )
        style.clips.append(clip if original < 0 else mirrored(clip, name, turned, grid))
        style.clips[-1].size, style.clips[-1].original = read.at - begin, original
        turns.append(turned)
    if version < 5:
        for _ in range(read.one("Q")):
            clip, begin, end = read.some("i", 3)
            style.fragments.append((clip, begin, end, read.one("B"), tuple(read.some("d", 4))))
    style.speeds = read.some("d", 2)
    _, scale = read.some("d", 2)  # turn rate; 1.8 m over the stature
    read.some("d", 3)  # weights of velocity, turn and jump
    directions, turn, jump = 8, 1, 1
    if read.section("controls"):
        style.speeds = list(read.numbers("f8"))
        directions, turn, jump = read.some("B", 3)
    style.controls = (1 + len(style.speeds) * directions) * (3 if turn else 1) * (2 if jump else 1)
    if version > 4:
        style.fragments = read_fragments(read, np.array([1e-3 / scale, 1e-3 / scale, 1e-3, 1e-3]))
    integers = read.packed if version > 4 else lambda: read.numbers("i4")
    read.one("i")  # classes
    style.labels, style.representatives = integers(), integers()
    read.one("d"), read.one("i")  # inertia; quality: classes,
    if version > 4:
        read.numbers("f4"), integers()  # distances, classes left out
    else:
        read.numbers("f8"), read.numbers("f8")  # smoothness and match
    for _ in range(read.one("Q")):
        name, classes, table = read.text(), read.one("i"), integers()
        style.tables[name] = table.reshape(classes, style.controls)
    integers(), read.numbers("f4" if version > 4 else "f8")  # bridges; how controls follow each other
    for _ in range(read.one("Q")):  # contacts of each clip
        read.packed() if version > 4 else read.numbers("u1")
        read.some("d", 4)
    read.some("d", 6)  # what the knees bend about
    return style


def read_fragments(read: Bytes, steps: Array) -> list[tuple[int, int, int, int, tuple[float, ...]]]:
    """Read clips, first frames, last frames, origins, and what each is evident of in steps."""
    count = read.one("Q")
    clips, begins, ends, origins, *evident = (read.packed() for _ in range(8))
    assert all(len(column) == count for column in (clips, begins, ends, origins, *evident))
    controls = (np.stack(evident, -1) * steps).tolist()
    rows = zip(clips.tolist(), begins.tolist(), ends.tolist(), origins.tolist(), map(tuple, controls))
    return list(rows)


def read_grid(read: Bytes, version: int) -> Grid:
    """Read what the clips share."""

    def rotations() -> Array:
        return read.numbers("f4").astype(float).reshape(-1, 4, BLOCK).transpose(0, 2, 1).reshape(-1, 4)[:bones]

    bones = read.one("i")
    grid = Grid(rotations(), read.numbers("f4")[:bones].astype(float))
    if version > 3:
        grid.counterparts, grid.before, grid.after = read.numbers("i4"), rotations(), rotations()
    return grid


def read_clip(read: Bytes, name: str, grid: Grid, version: int) -> tuple[Clip, Array]:
    """Read a clip, and unpack its poses; also the turns from the usual rotations."""
    rate, frames = read.one("d"), read.one("i")
    origin, step = np.array(read.some("d", 4)), np.array(read.some("d", 4))
    least = read.packed() if version > 4 else read.numbers("i4")
    bits, packed = read.numbers("u1"), read.numbers("u1")
    width = (len(packed) - 4) // frames
    stream = np.unpackbits(packed[: width * frames].reshape(frames, width), axis=1, bitorder="little")
    ends = np.cumsum(bits.astype(int))
    numbers = np.zeros((frames, len(bits)), np.int64)
    for i, (end, count) in enumerate(zip(ends, bits)):
        numbers[:, i] = stream[:, end - count : end].astype(np.int64) @ (1 << np.arange(count, dtype=np.int64))
    root = origin + step * numbers[:, :4]
    turns = (numbers[:, 4:] + least).reshape(frames, -1, 3, BLOCK).transpose(0, 1, 3, 2).reshape(frames, -1, 3)
    axis = turns[:, : len(grid.usual)] * grid.steps[None, :, None]
    square = (axis**2).sum(-1, keepdims=True)
    turned = np.concatenate([1 - square, 2 * axis], -1) / (1 + square)
    return Clip(name, rate, root[:, :3], root[:, 3], product(grid.usual[None], turned), 0), turned


def mirrored(clip: Clip, name: str, turned: Array, grid: Grid) -> Clip:
    """Return the mirror image of a clip whose bones turn so."""
    rotations = np.empty_like(clip.rotations)
    rotations[:, grid.counterparts] = product(product(grid.before[None], turned), grid.after[None])
    return Clip(name, clip.rate, clip.places * [-1, 1, 1], -clip.headings, rotations, 0)


def product(a: Array, b: Array) -> Array:
    """Of quaternions w, x, y, z."""
    w, x, y, z = np.moveaxis(a, -1, 0)
    p, q, r, s = np.moveaxis(b, -1, 0)
    parts = (
        w * p - x * q - y * r - z * s,
        w * q + x * p + y * s - z * r,
        w * r - x * s + y * p + z * q,
        w * s + x * r - y * q + z * p,
    )
    return np.stack(parts, -1)
