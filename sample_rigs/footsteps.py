# SPDX-License-Identifier: MIT
"""Where and when the feet stand, and how they swing: the plan that the rest of the body follows.

All arrays run over the frames of a take with a margin on both sides (Timeline.first). World axes are the armature's.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import body
import numpy as np
import rotations as rot
from manners import MANNERS
from takes import FLIGHT_FRAMES, FPS, GRAVITY, Take

Array = np.ndarray
MARGIN = 75  # frames simulated before and after the take, so that its ends are steady
SPEEDS = np.array([0.0, 1.2, 3.3])  # standing or turning on the spot, walking, running: m/s

# Gait parameters at SPEEDS; lengths in metres, times in seconds, angles in degrees.
STYLE: dict[str, tuple[float, float, float]] = {
    "period": (0.9, 1.0, 2 / 3),  # both steps
    "duty": (0.62, 0.60, 0.36),  # part of the period that a foot stands
    "half_width": (0.105, 0.075, 0.045),  # foot to the path
    "behind": (0.0, 0.06, 0.10),  # mid-stance foot behind the body
    "clearance": (0.07, 0.045, 0.25),  # extra lift of the ankle in swing
    "around": (0.0, 0.11, 0.17),  # detour around the standing leg in side steps
    "strike": (0.0, 20.0, 6.0),  # toes up at landing
    "push": (-10.0, -52.0, -60.0),  # heel up at lift-off
    "strike_time": (0.10, 0.12, 0.07),
    "push_time": (0.18, 0.32, 0.17),
    "bob": (0.003, 0.020, -0.030),
    "drop": (0.014, 0.012, 0.055),
    "reach": (0.985, 0.988, 0.970),  # longest hip-ankle distance of a standing leg, part of the leg's length
    "sway": (0.030, 0.022, 0.010),
    "pelvis_yaw": (0.0, 6.0, 9.0),
    "pelvis_roll": (2.0, 4.0, 4.5),
    "chest_yaw": (0.0, 5.0, 13.0),
    "lean": (0.0, 2.5, 11.0),
    "arm_swing": (2.0, 22.0, 40.0),
    "arm_back": (0.0, -5.0, -13.0),  # mean of the swing; negative is behind
    "elbow": (6.0, 8.0, 80.0),
    "elbow_swing": (0.0, 9.0, 12.0),
}


@dataclass
class Timeline:
    """Path and phase of a take; index 0 is frame first (negative), headings in radians, phase in gait cycles."""

    take: Take
    first: int
    time: Array
    speed: Array
    turn: Array
    heading: Array
    position: Array
    phase: Array
    takeoff: float | None
    landing: float | None

    def style(self, name: str) -> Array:
        """The gait parameter at every frame."""
        return self._styled(name, self.speed)

    def style_at(self, name: str, second: float) -> float:
        """The gait parameter at a moment (clamped to the simulated span)."""
        return float(self._styled(name, np.interp(second, self.time, self.speed)))

    def _styled(self, name: str, speed: Array) -> Array:
        manner = MANNERS[self.take.manner]
        factor, more = manner.changed(name)
        return factor * np.interp(speed / manner.pace, SPEEDS, STYLE[name]) + more

    def flight_height(self) -> Array:
        """Height of the ballistic arc of the jump, metres; 0 outside the flight."""
        if self.takeoff is None or self.landing is None:
            return np.zeros_like(self.time)
        since, left = self.time - self.takeoff, self.landing - self.time
        return np.where((since > 0) & (left > 0), GRAVITY / 2 * since * left, 0.0)


@dataclass
class Stance:
    """A foot on the ground from land to lift (seconds): origin [3] is the ground point under the rest ankle."""

    land: float
    lift: float
    origin: Array
    yaw: float
    strike: float
    push: float
    strike_time: float
    push_time: float

    def pitch(self, second: Array) -> Array:
        """Foot pitch in radians, toes up positive: rolls from strike to flat, then from flat to push."""
        landed = np.clip((second - self.land) / self.strike_time, 0, 1)
        leaving = np.clip(1 - (self.lift - second) / self.push_time, 0, 1)
        return self.strike * (1 - smoothstep(landed)) + self.push * leaving**2

    def ankle(self, second: Array) -> Array:
        """World position of the ankle [N, 3]: the foot pivots about its heel or its ball, which stay in place."""
        pitch = self.pitch(np.atleast_1d(second))
        ankle = body.head("foot.L") * [0, 1, 1]
        ball = body.head("toe.L") * [0, 1, 1]
        pivot = np.where(pitch[:, None] > 0, body.HEEL, ball)
        local = pivot + rot.apply(rot.about_x(-pitch), ankle - pivot)
        return self.origin + rot.apply(rot.about_z(np.full(len(pitch), self.yaw)), local)


@dataclass
class FootMotion:
    """A foot over all frames: ankle [N, 3], yaw, pitch and toe_pitch [N] (radians, world), planted [N] bool."""

    ankle: Array
    yaw: Array
    pitch: Array
    toe_pitch: Array
    planted: Array


def smoothstep(x: Array) -> Array:
    """Cubic ease in and out on [0, 1], clamped."""
    x = np.clip(x, 0, 1)
    return x * x * (3 - 2 * x)


def travel_angle(take: Take) -> float:
    """Direction of travel in radians, left of the facing direction."""
    return math.radians(take.direction)


def pelvis_turn(take: Take) -> float:
    """Radians the pelvis turns towards (or directly away from) the travel, so that legs can stride sideways."""
    angle = take.direction
    folded = angle if abs(angle) <= 90 else angle - math.copysign(180, angle)
    return math.radians(0.2 * folded)


def roll_sign(take: Take) -> float:
    """1 for heel-to-toe steps, -1 for steps backward, less in between."""
    return math.cos(travel_angle(take) - pelvis_turn(take))


def make_timeline(take: Take) -> Timeline:
    """Integrate the take's speeds to a path that passes the origin, facing -y, at frame 0."""
    frames = np.arange(-MARGIN, round(take.seconds * FPS) + MARGIN + 1)
    time = frames / FPS
    speed, turn = (_eased(time, take, column) for column in (1, 2))
    turn = np.radians(turn)
    heading = _integral(turn)
    course = heading + travel_angle(take)
    velocity = speed[:, None] * np.stack([np.sin(course), -np.cos(course), 0 * course], axis=1)
    position = _integral(velocity)
    timeline = Timeline(take, -MARGIN, time, speed, turn, heading, position, time * 0, None, None)
    _add_phase(timeline)
    return timeline


def _eased(time: Array, take: Take, column: int) -> Array:
    """Column of the take's knots at every time, smoothstep between knots and constant outside."""
    knots = take.knots
    value = np.full_like(time, knots[0][column])
    for before, after in zip(knots, knots[1:]):
        part = smoothstep((time - before[0]) / (after[0] - before[0]))
        value += part * (after[column] - before[column])
    return value


def _integral(rate: Array) -> Array:
    """Trapezoid integral over frames, 0 at frame 0."""
    total = np.zeros_like(rate)
    total[1:] = np.cumsum((rate[1:] + rate[:-1]) / 2 / FPS, axis=0)
    return total - total[MARGIN]


def _add_phase(line: Timeline) -> None:
    """Set phase, takeoff and landing. A left stance begins at each whole phase, a right one half a cycle later."""
    take, rate = line.take, 1 / line.style("period") / FPS
    rest = (STYLE["duty"][0] - 0.5) / 2  # both feet are down here: the phase of standing
    if take.stepping is None:
        line.phase = np.full_like(line.time, rest)
    elif math.isinf(take.stepping[0]):
        line.phase = np.cumsum(rate) - np.cumsum(rate)[MARGIN]
    else:
        line.phase = _started_and_stopped(line, rate, rest)
    if take.jump == "both":
        line.takeoff = take.jump_at
        line.landing = take.jump_at + FLIGHT_FRAMES / FPS
    elif take.jump == "one":
        _stretch_for_flight(line)


def _started_and_stopped(line: Timeline, rate: Array, rest: float) -> Array:
    """Phase that waits at rest, runs while the take steps and stops when next both feet are down."""
    begin, end = line.take.stepping or (0.0, 0.0)
    moved = np.cumsum(np.where(line.time >= begin, rate, 0))
    stop = np.ceil(np.interp(end, line.time, moved) * 2) / 2
    return rest + np.minimum(moved, stop)


def _stretch_for_flight(line: Timeline) -> None:
    """Hold the phase back during the flight: the left foot takes off and the right lands at the next half cycle."""
    cycle = math.floor(float(np.interp(line.take.jump_at, line.time, line.phase)))
    leave = cycle + min(0.46, line.style_at("duty", line.take.jump_at))
    index = int(np.searchsorted(line.phase, leave))
    held = np.linspace(line.phase[index], cycle + 0.5, FLIGHT_FRAMES + 1)
    after = cycle + 0.5 + line.phase - line.phase[0]
    line.phase = np.concatenate([line.phase[:index], held, after[1:]])[: len(line.time)]
    line.takeoff = float(line.time[index])
    line.landing = line.takeoff + FLIGHT_FRAMES / FPS


def plan_stances(line: Timeline, side: float) -> list[Stance]:
    """The stances of one foot (side 1 left, -1 right) in order of time; the first and the last reach the margins."""
    shift = 0.0 if side > 0 else 0.5
    first, last = math.floor(line.phase[0] - shift), math.floor(line.phase[-1] - shift)
    spans = []
    for cycle in range(first, last + 1):
        land = _moment(line, cycle + shift)
        lift = _moment(line, cycle + shift + line.style_at("duty", land))
        spans.extend(_without_flight(line, land, lift))
    return [_stance(line, side, land, lift) for land, lift in spans]


def _moment(line: Timeline, phase: float) -> float:
    """The second at which the phase is first reached; beyond the simulated span if it never is."""
    if phase <= line.phase[0]:
        return float(line.time[0]) - 1
    if phase >= line.phase[-1]:
        return float(line.time[-1]) + 1
    return float(np.interp(phase, line.phase + np.arange(len(line.phase)) * 1e-12, line.time))


def _without_flight(line: Timeline, land: float, lift: float) -> list[tuple[float, float]]:
    """The span with the flight of the jump cut out: shortened, or split into two."""
    off, on = line.takeoff, line.landing
    if off is None or on is None or land >= off or lift <= off:
        return [(land, lift)]
    return [(land, off), (on, lift)] if lift > on + 0.25 else [(land, off)]


def _stance(line: Timeline, side: float, land: float, lift: float) -> Stance:
    """Place a stance under where the body passes at its middle."""
    take, middle = line.take, _middle(line, land, lift)
    heading = float(np.interp(middle, line.time, line.heading))
    part = min(1.0, float(np.interp(middle, line.time, line.speed)) / SPEEDS[1])
    aside = abs(math.sin(travel_angle(take) - pelvis_turn(take))) * part
    across = side * (line.style_at("half_width", middle) + 0.035 * aside) - lean_shift(line, middle)
    local = np.array([across, line.style_at("behind", middle) * abs(roll_sign(take)), 0])
    yaw = heading + pelvis_turn(take) * part
    root = np.array([np.interp(middle, line.time, column) for column in line.position.T])
    origin = root + rot.about_z(np.array([yaw]))[0] @ local
    strike, push = _rolls(line, land, lift)
    toe_out = math.radians(7) * side
    times = line.style_at("strike_time", middle), line.style_at("push_time", middle)
    return Stance(land, lift, origin, yaw + toe_out, strike, push, *times)


def _middle(line: Timeline, land: float, lift: float) -> float:
    """The moment of a stance at which the foot is beside the body; stances that never end stay where they began."""
    if land < line.time[0] and lift > line.time[-1]:
        return 0.0
    if land < line.time[0]:
        return float(line.time[0])
    if lift > line.time[-1]:
        return float(line.time[-1])
    return (land + lift) / 2


def _rolls(line: Timeline, land: float, lift: float) -> tuple[float, float]:
    """Foot pitch at landing and at lift-off, radians; backward steps roll from toe to heel."""
    sign = roll_sign(line.take)
    strike, push = line.style_at("strike", land), line.style_at("push", lift)
    if sign < 0:
        strike, push = 0.6 * push, 0.5 * strike
    if land == line.landing:
        strike = -35.0
    if lift == line.takeoff:
        push = -62.0
    return math.radians(strike * abs(sign)), math.radians(push * abs(sign))


def bank(line: Timeline) -> Array:
    """Lean to the left into a curve, radians."""
    return 0.6 * np.arctan(line.speed * line.turn / GRAVITY)


def lean_shift(line: Timeline, second: float) -> float:
    """How far the feet stand to the right of the path because the body leans left into a curve, metres."""
    return 0.75 * math.tan(float(np.interp(second, line.time, bank(line))))


def foot_motion(line: Timeline, side: float) -> FootMotion:
    """The foot at every frame: standing by its plan, swinging between stances."""
    stances = plan_stances(line, side)
    count = len(line.time)
    foot = FootMotion(np.zeros((count, 3)), np.zeros(count), np.zeros(count), np.zeros(count), np.zeros(count, bool))
    for stance in stances:
        now = (line.time >= stance.land - 1e-9) & (line.time <= stance.lift + 1e-9)
        foot.planted |= now
        foot.ankle[now] = stance.ankle(line.time[now])
        foot.pitch[now] = stance.pitch(line.time[now])
        foot.yaw[now] = stance.yaw
    for before, after in zip(stances, stances[1:]):
        _swing(line, foot, before, after, side)
    _hold_ends(line, foot, stances)
    foot.toe_pitch = _toe_pitch(foot)
    return foot


def _hold_ends(line: Timeline, foot: FootMotion, stances: list[Stance]) -> None:
    """Frames outside all stances lie in the margin: repeat the nearest pose."""
    early, late = line.time < stances[0].land, line.time > stances[-1].lift
    for where, stance, moment in ((early, stances[0], stances[0].land), (late, stances[-1], stances[-1].lift)):
        foot.ankle[where] = stance.ankle(np.array([moment]))
        foot.yaw[where] = stance.yaw


def _swing(line: Timeline, foot: FootMotion, before: Stance, after: Stance, side: float) -> None:
    """Fill the frames between two stances with a smooth arc that leaves and arrives without a jerk."""
    now = (line.time > before.lift + 1e-9) & (line.time < after.land - 1e-9)
    second, span = line.time[now], after.land - before.lift
    s = (second - before.lift) / span
    step = 1e-3
    ends = before.ankle(np.array([before.lift - step, before.lift]))
    target = after.ankle(np.array([after.land]))[0]
    ankle = hermite(s[:, None], ends[1], (ends[1] - ends[0]) / step * span, target, 0 * target)
    clearance = line.style_at("clearance", (before.lift + after.land) / 2)
    ankle[:, 2] += clearance * s**2 * (1 - s) ** 2.5 / 0.0643 + line.flight_height()[now]
    ankle += (16 * s**2 * (1 - s) ** 2)[:, None] * _detour(line, before, after, side)
    foot.ankle[now] = ankle
    foot.yaw[now] = before.yaw + smoothstep(s) * (after.yaw - before.yaw)
    slope = (before.pitch(np.array([before.lift])) - before.pitch(np.array([before.lift - step])))[0] / step
    early = np.minimum(s / 0.8, 1)
    foot.pitch[now] = hermite(early, before.push, slope * span * 0.8, after.strike, 0.0)


def _detour(line: Timeline, before: Stance, after: Stance, side: float) -> Array:
    """How far the middle of a swing lies off the straight line [3]: along a curve, and around the standing leg."""
    stride = after.origin - before.origin
    distance = math.hypot(stride[0], stride[1])
    if distance < 1e-6:
        return np.zeros(3)
    outward = np.array([-stride[1], stride[0], 0]) / distance  # left of the stride
    bulge = -math.tan((after.yaw - before.yaw) / 4) / 2 * distance
    ahead = 1.0 if abs(line.take.direction) <= 90 else -1.0
    curve = min(1.0, abs(after.yaw - before.yaw))
    fast = line.style_at("around", (before.lift + after.land) / 2)
    around = side * ahead * fast * (abs(math.sin(travel_angle(line.take))) + curve)
    return outward * (bulge + around)


def hermite(s: Array, start: Array, start_slope: Array, end: Array, end_slope: Array) -> Array:
    """Cubic from start to end for s in [0, 1], slopes per unit of s."""
    s2, s3 = s * s, s * s * s
    return (
        (2 * s3 - 3 * s2 + 1) * start
        + (s3 - 2 * s2 + s) * start_slope
        + (3 * s2 - 2 * s3) * end
        + (s3 - s2) * end_slope
    )


def ball_position(foot: FootMotion) -> Array:
    """World position of the ball of the foot [N, 3]."""
    return foot.ankle + rot.apply(foot_rotation(foot.yaw, foot.pitch), body.head("toe.L") - body.head("foot.L"))


def foot_rotation(yaw: Array, pitch: Array) -> Array:
    """World rotation of a foot or toe from rest."""
    return rot.about_z(yaw) @ rot.about_x(-pitch)


def _toe_pitch(foot: FootMotion) -> Array:
    """Toes follow the foot unless that would put them into the ground."""
    height = ball_position(foot)[:, 2] - body.BALL_HEIGHT
    lowest = -1.1 * np.clip(height / body.length("toe.L"), 0, 1)
    return np.maximum(foot.pitch, np.minimum(lowest, 0))
