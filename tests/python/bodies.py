# SPDX-License-Identifier: MIT
"""Skeletons that are the same body in other bones, and bodies of other proportions, for tests of retargeting."""

from __future__ import annotations

from collections.abc import Callable

import fragmotion_core as core
import numpy as np
from conftest import Array


def times(a: Array, b: Array) -> Array:
    """Products of quaternions (w, x, y, z)."""
    w, v, x, u = a[..., :1], a[..., 1:], b[..., :1], b[..., 1:]
    return np.concatenate([w * x - (v * u).sum(-1, keepdims=True), w * u + x * v + np.cross(v, u)], -1)


def inverse(a: Array) -> Array:
    """Of unit quaternions."""
    return a * [1, -1, -1, -1]


def turned(rotation: Array, vectors: Array) -> Array:
    """Vectors turned by quaternions."""
    pure = np.concatenate([np.zeros_like(vectors[..., :1]), vectors], -1)
    return times(times(rotation, pure), inverse(rotation))[..., 1:]


def about(axis: Array | list[float], degrees: float) -> Array:
    """The rotation about an axis."""
    half = np.radians(degrees) / 2
    return np.concatenate([[np.cos(half)], np.sin(half) * np.asarray(axis, float) / np.linalg.norm(axis)])


def rest_rotations(skeleton: core.Skeleton) -> Array:
    """World rotations [B,4] at rest."""
    world = np.array(skeleton.rest_rotations)
    for bone, parent in enumerate(skeleton.parents):
        if parent >= 0:
            world[bone] = times(world[parent], world[bone])
    return world


def remade(
    skeleton: core.Skeleton,
    world: Array | None = None,
    size: float = 1.0,
    rename: Callable[[str], str] = str,
    stretch: Callable[[str], float] = lambda name: 1.0,
    rolls: Array | None = None,
) -> core.Skeleton:
    """The skeleton resting in other world rotations, of another size, with other names and with bones (their children's
    offsets) of other lengths. `rolls` [B,4]: how bones' frames are turned within the bones."""
    world = rest_rotations(skeleton) if world is None else world
    rolls = np.tile([1.0, 0, 0, 0], (len(world), 1)) if rolls is None else rolls
    framed = times(world, rolls)
    offsets, tips, local = np.array(skeleton.offsets), np.array(skeleton.tips), framed.copy()
    for bone, parent in enumerate(skeleton.parents):
        factor = size * stretch(skeleton.names[bone])
        tips[bone] = turned(inverse(rolls[bone]), size * tips[bone])
        offsets[bone] *= factor
        if parent >= 0:
            offsets[bone] = turned(inverse(rolls[parent]), offsets[bone])
            local[bone] = times(inverse(framed[parent]), framed[bone])
    names = [rename(name) for name in skeleton.names]
    roles = {role: rename(bone) for role, bone in skeleton.roles.items()}
    return core.Skeleton(names, skeleton.parents, local, offsets, tips, roles)


def map_of(body: core.Body, rename: Callable[[str], str] = str) -> dict[str, str]:
    """The roles of a body's bones under other names."""
    return {role: rename(bone) for role, bone in body.roles.items()}


def random_rolls(skeleton: core.Skeleton, seed: int = 1) -> Array:
    """Any rotations."""
    rolls = np.random.default_rng(seed).normal(size=(len(skeleton.names), 4))
    return np.asarray(rolls / np.linalg.norm(rolls, axis=1, keepdims=True))


def posed(skeleton: core.Skeleton, world: Array, turns: dict[str, Array]) -> Array:
    """World rotations with bones, and what hangs on them, turned about world axes."""
    whole = np.tile([1.0, 0, 0, 0], (len(world), 1))
    for bone, parent in enumerate(skeleton.parents):
        if parent >= 0:
            whole[bone] = whole[parent]
        if skeleton.names[bone] in turns:
            whole[bone] = times(turns[skeleton.names[bone]], whole[bone])
    return times(whole, world)


def angles(a: Array, b: Array) -> Array:
    """Between rotations, degrees."""
    return np.asarray(np.degrees(2 * np.arccos(np.clip(np.abs((a * b).sum(-1)), 0, 1))))


class Builder:
    """Bones by their heads in the world; frames are the world's axes until `finished` gives them a family's."""

    def __init__(self) -> None:
        self.names: list[str] = []
        self.parents: list[int] = []
        self.heads: list[Array] = []
        self.tails: list[Array] = []
        self.roles: dict[str, str] = {}

    def add(self, name: str, parent: str, head: list[float], tail: list[float]) -> str:
        """A bone; returns its name."""
        self.names.append(name)
        self.parents.append(self.names.index(parent) if parent else -1)
        self.heads.append(np.array(head, float))
        self.tails.append(np.array(tail, float))
        return name

    def add_chain(self, names: list[str], parent: str, places: list[list[float]]) -> str:
        """Bones from place to place; returns the last one's name."""
        for name, head, tail in zip(names, places, places[1:]):
            parent = self.add(name, parent, head, tail)
        return parent

    def finished(self, size: float = 1.0) -> core.Skeleton:
        """Frames with y along the bone, as Blender's, each rolled by another angle."""
        heads, tails = np.array(self.heads) * size, np.array(self.tails) * size
        world = np.array([along_y(tail - head, 40.0 * i) for i, (head, tail) in enumerate(zip(heads, tails))])
        local, offsets, tips = world.copy(), heads.copy(), turned(inverse(world), tails - heads)
        for bone, parent in enumerate(self.parents):
            if parent >= 0:
                local[bone] = times(inverse(world[parent]), world[bone])
                offsets[bone] = turned(inverse(world[parent]), heads[bone] - heads[parent])
        return core.Skeleton(self.names, self.parents, local, offsets, tips, self.roles)


def along_y(direction: Array, roll: float) -> Array:
    """A rotation whose y axis goes along a direction."""
    y = direction / np.linalg.norm(direction)
    axis = np.cross([0, 1, 0], y)
    if np.linalg.norm(axis) < 1e-9:
        turn = about([1, 0, 0], 0 if y[1] > 0 else 180)
    else:
        turn = about(axis, np.degrees(np.arctan2(np.linalg.norm(axis), y[1])))
    return times(turn, about([0, 1, 0], roll))


FAMILIES: dict[str, dict[str, list[str]]] = {
    "mixamo": {
        "above": [],
        "trunk": ["Hips", "Spine", "Spine1", "Spine2"],
        "neck": ["Neck"],
        "head": ["Head"],
        "arm": ["@Shoulder", "@Arm", "@ForeArm", "@Hand"],
        "leg": ["@UpLeg", "@Leg", "@Foot", "@ToeBase"],
        "sides": ["Left", "Right"],
        "fingers": ["@HandThumb#", "@HandIndex#", "@HandMiddle#", "@HandRing#", "@HandPinky#"],
    },
    "rigify": {
        "above": [],
        "trunk": ["spine", "spine.001", "spine.002", "spine.003"],
        "neck": ["spine.004", "spine.005"],
        "head": ["spine.006"],
        "arm": ["shoulder.@", "upper_arm.@", "forearm.@", "hand.@"],
        "leg": ["thigh.@", "shin.@", "foot.@", "toe.@"],
        "sides": ["L", "R"],
        "fingers": ["thumb.0#.@", "f_index.0#.@", "f_middle.0#.@", "f_ring.0#.@", "f_pinky.0#.@"],
    },
    "unreal": {
        "above": ["root"],
        "trunk": ["pelvis", "spine_01", "spine_02", "spine_03", "spine_04", "spine_05"],
        "neck": ["neck_01", "neck_02"],
        "head": ["head"],
        "arm": ["clavicle_@", "upperarm_@", "lowerarm_@", "hand_@"],
        "leg": ["thigh_@", "calf_@", "foot_@", "ball_@"],
        "sides": ["l", "r"],
        "fingers": ["thumb_0#_@", "index_0#_@", "middle_0#_@", "ring_0#_@", "pinky_0#_@"],
    },
}


def humanoid(
    family: str,
    size: float = 1.0,
    leg: float = 1.0,
    thigh: float = 1.0,
    wide: float = 1.0,
    arms: float = 0.0,
    fingers: bool = True,
) -> core.Skeleton:
    """A body of some 1.75 m times `size` that faces -y, in the bones of a family of rigs. `leg`: the length of its legs
    of the usual, its trunk as long as ever; `thigh`: that of the thigh, at the cost of the shin; `wide`: that of its
    hips; `arms`: how far they hang down from a T, degrees; `fingers`: whether it has any."""
    names, builder = FAMILIES[family], Builder()
    if not fingers:
        names = {**names, "fingers": []}
    rise = 0.83 * (leg - 1)
    chest = add_trunk(builder, names, rise)
    for side, sign in zip(names["sides"], (1, -1)):
        sided = {key: [name.replace("@", side) for name in value] for key, value in names.items()}
        add_arm(builder, sided, chest, sign, rise, arms)
        hip = 0.09 * wide * sign
        knee = 0.92 - 0.42 * thigh
        places = [[hip, 0, 0.92], [hip, -0.01, knee], [hip, 0.02, 0.09], [hip, -0.12, 0.02], [hip, -0.19, 0.02]]
        for place in places[:2]:
            place[2] = 0.09 + leg * (place[2] - 0.09)
        builder.add_chain(sided["leg"], names["trunk"][0], places)
    return builder.finished(size)


def add_trunk(builder: Builder, names: dict[str, list[str]], rise: float) -> str:
    """From the root to the head; returns the bone that the arms hang on."""
    above = ""
    for name in names["above"]:
        above = builder.add(name, above, [0, 0, 0], [0, 0.1, 0])
    last, necks = len(names["trunk"]) - 1, len(names["neck"])
    spine = [[0, 0.01 * np.sin(i / last * np.pi), rise + 1.0 + 0.42 * (i - 1) / (last - 1)] for i in range(1, last + 1)]
    neck = [[0, 0, rise + 1.48 + 0.09 * i / necks] for i in range(necks)]
    places = [[0, 0, rise + 0.97], *spine, *neck, [0, -0.02, rise + 1.57], [0, -0.02, rise + 1.76]]
    builder.add_chain(names["trunk"] + names["neck"] + names["head"], above, places)
    builder.roles["hips"] = names["trunk"][0]
    return names["trunk"][-1]


def add_arm(builder: Builder, names: dict[str, list[str]], chest: str, sign: int, rise: float, arms: float) -> None:
    """From the shoulder to the fingers."""
    drop, joint = about([0, 1, 0], sign * arms), np.array([0.16 * sign, 0.01, rise + 1.43])

    def place(x: float, y: float, z: float) -> list[float]:
        return list(joint + turned(drop, np.array([x * sign, y, z])))

    places = [place(0, 0, 0), place(0.28, 0.01, 0), place(0.53, 0, 0), place(0.61, 0, 0)]
    hand = builder.add_chain(names["arm"], chest, [[0.03 * sign, 0, rise + 1.41], *places])
    for finger, name in enumerate(names["fingers"]):
        bones = [name.replace("#", str(number + 1)) for number in range(3)]
        thumb = [place(0.54 + 0.02 * j, -0.03 - 0.025 * j, -0.01) for j in range(4)]
        other = [place(0.62 + 0.03 * j, 0.02 * finger - 0.03, 0) for j in range(4)]
        builder.add_chain(bones, hand, other if finger else thumb)
