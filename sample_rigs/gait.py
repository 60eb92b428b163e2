# SPDX-License-Identifier: MIT
"""Whole-body motion of a take in NumPy: pelvis over the planned feet, analytic leg IK, torso, arms and head.

The result is independent of bone rolls: a world rotation is the rotation from the rest pose, in armature axes.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import body
import footsteps as steps
import numpy as np
import rotations as rot
from footsteps import FootMotion, Timeline, hermite, smoothstep
from gestures import GESTURES, Gesture
from manners import MANNERS
from takes import FPS, GRAVITY, Take

Array = np.ndarray
BREATH = 4.0  # seconds


@dataclass
class Motion:
    """A take, frame by frame: world rotations from rest [N, 3, 3] by bone, root and hips positions [N, 3] in metres."""

    take: Take
    world: dict[str, Array]
    root: Array
    hips: Array
    planted: dict[str, Array]

    def local(self, name: str) -> Array:
        """Rotation from rest relative to the parent's, in armature axes [N, 3, 3]."""
        parent = body.BY_NAME[name].parent
        return self.world[name] if parent is None else rot.transpose(self.world[parent]) @ self.world[name]


def synthesize(take: Take) -> Motion:
    """Make the motion of a take, frame 0 to its last frame."""
    line = steps.make_timeline(take)
    feet = {".L": steps.foot_motion(line, 1.0), ".R": steps.foot_motion(line, -1.0)}
    gesture = GESTURES.get(take.gesture, Gesture({}))
    for side, foot in feet.items():
        _move_foot(line, gesture, side, foot)
    jump = _jump_height(line)
    world = {"root": rot.about_z(line.heading)}
    _add_torso(line, jump, gesture, world)
    hips = _hips_position(line, jump, gesture, world["hips"], feet)
    for side, foot in feet.items():
        _add_leg(line, side, foot, hips, world)
        _add_arm(line, side, gesture, world)
    count = round(take.seconds * FPS) + 1
    kept = slice(steps.MARGIN, steps.MARGIN + count)
    planted = {side: foot.planted[kept] for side, foot in feet.items()}
    return Motion(take, {k: v[kept] for k, v in world.items()}, line.position[kept], hips[kept], planted)


def _wave(line: Timeline, shift: float, per_cycle: int = 1) -> Array:
    """A sine of the gait phase that is 0 and rising at phase shift."""
    return np.sin(2 * math.pi * per_cycle * (line.phase - shift))


def _breath(line: Timeline, shift: float = 0.0) -> Array:
    """Breathing, -1 to 1; it drowns in the motion of faster gaits."""
    calm = np.clip(1 - line.speed / steps.SPEEDS[1], 0, 1) * (np.abs(line.turn) < 0.2)
    return calm * np.sin(2 * math.pi * (line.time / BREATH - shift))


def _jump_height(line: Timeline) -> Array:
    """What the jump adds to the height of the hips: crouch, ballistic flight, absorbing the landing; metres."""
    off, on = line.takeoff, line.landing
    if off is None or on is None:
        return np.zeros_like(line.time)
    speed = GRAVITY * (on - off) / 2
    low, up, absorb = (-0.29, 0.06, -0.25) if line.take.jump == "both" else (-0.07, 0.035, -0.13)
    crouch, ready, settle, over = (0.80, 0.30, 0.22, 0.95) if line.take.jump == "both" else (0.5, 0.18, 0.2, 0.75)
    knots = [
        (off - crouch, 0, 0), (off - ready, low, 0), (off, up, speed),
        (on, up, -speed), (on + settle, absorb, 0), (on + over, 0, 0),
    ]  # fmt: skip
    return _through(line.time, knots) + line.flight_height() - _chord(line.time, knots[2], knots[3])


def _through(time: Array, knots: list[tuple[float, float, float]]) -> Array:
    """Cubic curve through (second, value, slope per second); constant outside."""
    value = np.where(time < knots[0][0], knots[0][1], knots[-1][1]).astype(float)
    for (t0, v0, m0), (t1, v1, m1) in zip(knots, knots[1:]):
        span = t1 - t0
        now = (time >= t0) & (time <= t1)
        value[now] = hermite((time[now] - t0) / span, v0, m0 * span, v1, m1 * span)
    return value


def _chord(time: Array, start: tuple[float, float, float], end: tuple[float, float, float]) -> Array:
    """How far the cubic between two knots rises over their common height (to replace it by the true parabola)."""
    inside = (time > start[0]) & (time < end[0])
    return np.where(inside, _through(time, [start, end]) - start[1], 0.0)


def _airborne(line: Timeline, before: float, after: float) -> Array:
    """1 around the jump, eased in and out over the given seconds; 0 in takes without one."""
    if line.takeoff is None or line.landing is None:
        return np.zeros_like(line.time)
    rising = smoothstep((line.time - line.takeoff + before) / before)
    return rising * smoothstep((line.landing + after - line.time) / after)


def _move_foot(line: Timeline, gesture: Gesture, side: str, foot: FootMotion) -> None:
    """Lift a foot as the gesture does."""
    ahead, up, pitch = (gesture.value(f"{name}{side}", line.time) for name in ("ahead", "up", "pitch"))
    foot.ankle += rot.apply(rot.about_z(line.heading), np.stack([0 * up, -ahead, up], axis=1))
    foot.pitch += np.radians(pitch)
    foot.toe_pitch += np.radians(pitch)
    foot.planted &= ~gesture.lifts(side, line.time)


def _add_torso(line: Timeline, jump: Array, gesture: Gesture, world: dict[str, Array]) -> None:
    """Pelvis turning and tilting with the steps, the chest against it, the head steady and looking ahead."""
    calm, straight = 1 - _airborne(line, 0.4, 0.5), steps.roll_sign(line.take)
    moving = np.clip(line.speed / steps.SPEEDS[1], 0, 1)
    twist = steps.pelvis_turn(line.take) * moving
    crouch = np.maximum(-jump, 0)
    lean, side = _lean(line, crouch)
    lean = lean + np.radians(gesture.value("lean", line.time))
    yaw = -np.radians(line.style("pelvis_yaw")) * np.cos(2 * math.pi * line.phase) * straight * calm
    roll = -np.radians(line.style("pelvis_roll")) * _wave(line, 0.04) * calm + 0.012 * _breath(line, 0.1)
    chest_yaw = np.radians(line.style("chest_yaw")) * np.cos(2 * math.pi * line.phase) * straight * calm
    look, manner = 0.18 * line.turn, MANNERS[line.take.manner]
    hips = rot.about_z(line.heading + twist + yaw) @ rot.about_x(0.5 * lean) @ rot.about_y(0.5 * side + roll)
    chest_lean = lean - np.radians(1.3) * _breath(line) + np.radians(0.8) * _wave(line, 0.1, 2) * calm * moving
    chest = rot.about_z(line.heading + 0.2 * twist + chest_yaw + 0.3 * look)
    world["hips"] = hips
    world["chest"] = chest @ rot.about_x(chest_lean + math.radians(manner.hunch)) @ rot.about_y(side - 0.35 * roll)
    world["spine"] = rot.between(hips, world["chest"], 0.5)
    nod = rot.about_x(0.25 * lean + math.radians(manner.nod))
    world["head"] = rot.about_z(line.heading + look + 0.05 * twist) @ nod @ rot.about_y(0.3 * side)
    world["neck"] = rot.between(world["chest"], world["head"], 0.5)


def _lean(line: Timeline, crouch: Array) -> tuple[Array, Array]:
    """Lean forward and to the left, radians: with speed, acceleration, curves and crouching."""
    angle = steps.travel_angle(line.take)
    acceleration = np.gradient(line.speed, 1 / FPS)
    along = np.radians(line.style("lean")) + 0.5 * np.arctan(acceleration / GRAVITY)
    ahead = along * math.cos(angle) * (1.0 if math.cos(angle) > 0 else 0.25)
    return ahead + 2.0 * crouch, 0.6 * along * math.sin(angle) + steps.bank(line)


def _hips_position(line: Timeline, jump: Array, gesture: Gesture, hips: Array, feet: dict[str, FootMotion]) -> Array:
    """Position of the hips bone's head: over the path, bobbing and swaying, no higher than the standing legs reach."""
    calm = 1 - _airborne(line, 0.4, 0.5)
    middle = line.style("duty") / 2
    height = body.mid_hips()[2] - line.style("drop") - 0.003 * (1 + _breath(line, 0.2))
    height = height + line.style("bob") * np.cos(4 * math.pi * (line.phase - middle)) * calm
    sway = line.style("sway") * _wave(line, 0.06) * calm + 0.012 * _breath(line, 0.1)
    back = 0.25 * np.maximum(-jump, 0)
    left, behind, down = (gesture.value(f"hips_{name}", line.time) for name in ("left", "back", "down"))
    offset = np.stack([sway + left, back + behind, height + jump - down], axis=1)
    position = line.position + rot.apply(rot.about_z(line.heading), offset)
    need = np.zeros_like(line.time)
    for side, foot in feet.items():
        need = np.maximum(need, _excess(line, position + _hip_joint(hips, side), foot))
    position[:, 2] -= _smooth_cover(need)
    return position


def _hip_joint(hips: Array, side: str) -> Array:
    """From the hips bone's head to the hip joint of a side, world [N, 3]."""
    return rot.apply(hips, body.head("thigh" + side) - body.mid_hips())


def _leg_length() -> float:
    return body.length("thigh.L") + body.length("shin.L")


def _excess(line: Timeline, joint: Array, foot: FootMotion) -> Array:
    """How much the hips must come down for a standing foot to be in reach, metres."""
    across = np.linalg.norm((joint - foot.ankle)[:, :2], axis=1)
    allowed = np.sqrt(np.maximum((line.style("reach") * _leg_length()) ** 2 - across**2, 0))
    return np.where(foot.planted, np.maximum(joint[:, 2] - foot.ankle[:, 2] - allowed, 0), 0)


def _smooth_cover(need: Array, half: int = 4) -> Array:
    """A smooth curve that is nowhere below need: the running maximum, averaged over the same window."""
    padded = np.pad(need, 2 * half, mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(padded, 2 * half + 1)
    kernel = np.hanning(2 * half + 3)[1:-1]
    return np.convolve(windows.max(axis=1), kernel / kernel.sum(), mode="valid")


def _soft_reach(line: Timeline, distance: Array) -> Array:
    """Distances beyond the gait's reach are eased towards (never to) the fully stretched leg."""
    start, end = line.style("reach") * _leg_length(), 0.997 * _leg_length()
    beyond = np.maximum(distance - start, 0)
    return np.where(beyond > 0, start + (end - start) * (1 - np.exp(-beyond / (end - start))), distance)


def _add_leg(line: Timeline, side: str, foot: FootMotion, hips: Array, world: dict[str, Array]) -> None:
    """Two-bone IK by the law of cosines; the knee points half-way between the pelvis's front and the foot's."""
    joint = hips + _hip_joint(world["hips"], side)
    reach = foot.ankle - joint
    distance = np.linalg.norm(reach, axis=1)
    direction = reach / distance[:, None]
    thigh, shin = body.length("thigh" + side), body.length("shin" + side)
    bent = np.clip(_soft_reach(line, distance), 0.35 * (thigh + shin), None)
    cosine = (thigh**2 + bent**2 - shin**2) / (2 * thigh * bent)
    front = _knee_front(world["hips"], foot)
    hinge = np.cross(front, direction)
    hinge /= np.linalg.norm(hinge, axis=1, keepdims=True)
    thigh_direction = rot.apply(rot.about(-hinge, np.arccos(np.clip(cosine, -1, 1))), direction)
    shin_direction = direction * bent[:, None] - thigh_direction * thigh
    for name, along in (("thigh", thigh_direction), ("shin", shin_direction)):
        world[name + side] = rot.frame_of(along, hinge) @ _rest_frame(name + side).T
    world["foot" + side] = steps.foot_rotation(foot.yaw, foot.pitch)
    world["toe" + side] = steps.foot_rotation(foot.yaw, foot.toe_pitch)


def _knee_front(hips: Array, foot: FootMotion) -> Array:
    """Horizontal direction [N, 3] that the knee bends to."""
    ahead = np.array([0.0, -1.0, 0.0])
    pelvis = rot.apply(hips, ahead) * [1, 1, 0]
    toes = rot.apply(rot.about_z(foot.yaw), ahead)
    return pelvis / np.linalg.norm(pelvis, axis=1, keepdims=True) + toes


def _rest_frame(name: str) -> Array:
    """Frame [3, 3] of a leg bone at rest with the same meaning of the hinge as in _add_leg."""
    bone = body.BY_NAME[name]
    along = (bone.tail - bone.head)[None]
    return rot.frame_of(along, np.cross(np.array([[0.0, -1.0, 0.0]]), along))[0]


def _add_arm(line: Timeline, side: str, gesture: Gesture, world: dict[str, Array]) -> None:
    """Arm swing against the legs: shoulder, upper arm hanging from the A-pose, elbow and a relaxed hand."""
    sign = 1.0 if side == ".L" else -1.0
    more = {name: np.radians(gesture.value(f"{name}{side}", line.time)) for name in ("swing", "elbow", "out", "twist")}
    swing, elbow, out = _arm_angles(line, sign)
    swing, elbow, out = swing + more["swing"], elbow + more["elbow"], out + more["out"]
    hang, axis = _hang(side)
    shoulder = rot.about_z(-sign * 0.10 * swing) @ rot.about_y(-sign * 0.02 * _breath(line))
    inward = -sign * (0.12 + 0.30 * np.clip(elbow / 1.5, 0, 1)) * np.clip(2.0 - np.abs(swing) / 0.6, 0, 1)
    inward = inward + sign * more["twist"]
    upper = rot.about_x(-swing) @ rot.about_y(-sign * out) @ rot.about_z(inward) @ hang
    world["shoulder" + side] = world["chest"] @ shoulder
    world["upper_arm" + side] = world["shoulder" + side] @ upper
    world["forearm" + side] = world["upper_arm" + side] @ rot.about(axis, elbow)
    world["hand" + side] = world["forearm" + side] @ rot.about(axis, 0.10 + 0.06 * swing)


def _arm_angles(line: Timeline, sign: float) -> tuple[Array, Array, Array]:
    """Forward swing of the upper arm, bend of the elbow beyond rest and abduction, radians."""
    calm = 1 - 0.6 * _airborne(line, 0.4, 0.5)
    forward = -sign * np.cos(2 * math.pi * (line.phase - 0.02))
    straight = 0.55 + 0.45 * steps.roll_sign(line.take) if abs(line.take.direction) < 91 else 0.6
    swing = line.style("arm_back") + line.style("arm_swing") * forward * straight * calm + 1.5 * _breath(line, 0.15)
    bend = line.style("elbow") + line.style("elbow_swing") * (forward + 0.3) * calm
    run = np.clip((line.speed - 1.2) / 2.1, 0, 1)
    out = 9 + MANNERS[line.take.manner].out + 5 * run + 26 * _airborne(line, 0.25, 0.45)
    if line.take.jump == "both" and line.takeoff is not None and line.landing is not None:
        off, on = line.takeoff, line.landing
        reach = [(off - 0.8, 0, 0), (off - 0.26, -55, 0), (off + 0.1, 120, 0), (on - 0.1, 70, -150),
                 (on + 0.25, 12, 0), (on + 0.5, 18, 0), (on + 1.1, 0, 0)]  # fmt: skip
        swing = swing + _through(line.time, reach)
        bend = bend + 22 * _airborne(line, 0.6, 0.6)
    return np.radians(swing), np.radians(np.maximum(bend, 4)), np.radians(out)


def _hang(side: str) -> tuple[Array, Array]:
    """Rotation [1, 3, 3] that lets the resting upper arm hang straight down, and the rest axis of the elbow [3]."""
    bone = body.BY_NAME["upper_arm" + side]
    along = (bone.tail - bone.head) / body.length("upper_arm" + side)
    across = np.cross(along, [0.0, 0.0, -1.0])
    hang = rot.about(across, np.array([math.asin(np.linalg.norm(across))]))
    axis = np.cross(along, [0.0, -1.0, 0.0])
    return hang, axis / np.linalg.norm(axis)
