# SPDX-License-Identifier: MIT
"""The stages of a build in plain NumPy and scikit-learn: an oracle for the tests, a yardstick for the benchmarks.

Written from the paper and from what the core's headers promise, not from its sources. n is the number of classes, N of
fragments, S of samples, B of bones, K of points; quaternions are (w, x, y, z).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[Any]
Ints = NDArray[Any]

COSTS = (1.0, 8.0, 64.0, 512.0)
GAMMAS = (1 / 64, 1 / 16, 1 / 4, 1.0)
FOLDS = 3
BLOCK = 50  # samples that stay together in the cross-validation
CONTROLS = 102


@dataclass(frozen=True)
class Body:
    """A skeleton whose first bone is the hips."""

    parents: Ints  # [B]
    offsets: Floats  # [B,3] m
    tips: Floats  # [B,3] m
    measured: Ints  # bones whose tips count
    scale: float  # 1.8 m / stature


@dataclass(frozen=True)
class Motion:
    """Clips behind one another."""

    root_positions: Floats  # [F,3] m
    rotations: Floats  # [F,B,4]
    headings: Floats  # [F] rad


# Kinematics.


def multiply(a: Floats, b: Floats) -> Floats:
    """Products of quaternions [...,4]."""
    aw, ax, ay, az = np.moveaxis(a, -1, 0)
    bw, bx, by, bz = np.moveaxis(b, -1, 0)
    return np.stack(
        [
            aw * bw - ax * bx - ay * by - az * bz,
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
        ],
        axis=-1,
    )


def rotate(q: Floats, v: Floats) -> Floats:
    """Vectors [...,3] turned by quaternions [...,4]."""
    axis = q[..., 1:]
    twice = 2 * np.cross(axis, np.broadcast_to(v, axis.shape))
    turned: Floats = v + q[..., :1] * twice + np.cross(axis, twice)
    return turned


def slerp(a: Floats, b: Floats, weight: Floats) -> Floats:
    """Unit quaternions [...,4] interpolated on the shorter arc; weight broadcasts against [...]."""
    cosine = np.sum(a * b, axis=-1)
    angle = np.arccos(np.clip(np.abs(cosine), 0, 1))
    sine = np.sin(angle)
    near = sine < 1e-9
    safe = np.where(near, 1, sine)
    first = np.where(near, 1 - weight, np.sin((1 - weight) * angle) / safe)
    second = np.where(near, weight, np.sin(weight * angle) / safe) * np.where(cosine < 0, -1, 1)
    blended: Floats = first[..., None] * a + second[..., None] * b
    return blended


def sample(motion: Motion, frames: Floats) -> tuple[Floats, Floats, Floats]:
    """Root positions [S,3], rotations [S,B,4] and headings [S] at fractional frames [S]."""
    low = np.floor(frames).astype(int)
    high = np.minimum(low + 1, len(motion.headings) - 1)
    weight = frames - low
    across = weight[:, None]
    roots = (1 - across) * motion.root_positions[low] + across * motion.root_positions[high]
    headings = (1 - weight) * motion.headings[low] + weight * motion.headings[high]
    return roots, slerp(motion.rotations[low], motion.rotations[high], across), headings


def bone_tips(body: Body, roots: Floats, rotations: Floats) -> Floats:
    """World positions [S,B,3] of the bones' tips."""
    heads, turns = np.empty((*rotations.shape[:2], 3)), np.empty_like(rotations)
    heads[:, 0], turns[:, 0] = roots, rotations[:, 0]
    for bone in range(1, len(body.parents)):
        parent = body.parents[bone]
        heads[:, bone] = heads[:, parent] + rotate(turns[:, parent], body.offsets[bone])
        turns[:, bone] = multiply(turns[:, parent], rotations[:, bone])
    return heads + rotate(turns, body.tips)


def seen_from(points: Floats, places: Floats, headings: Floats) -> Floats:
    """World points [S,K,3] in character frames at places [S,2] with headings [S]."""
    cosine, sine = np.cos(headings)[:, None], np.sin(headings)[:, None]
    x, y = np.moveaxis(points[..., :2] - places[:, None], -1, 0)
    return np.stack([cosine * x + sine * y, cosine * y - sine * x, points[..., 2]], axis=-1)


# Fragments (Sec. 3.1).


def trajectories(
    body: Body, motion: Motion, ranges: Ints, played: Ints, poses: int = 16
) -> tuple[Floats, Floats, Floats]:
    """Fragments [N,2] (first and last frame) as points: [N,poses*K,3] in the character frame of the first pose, and the
    first and the last pose that are played [N,K,3] each in its own; metres of a 1.8 m character."""
    phases = np.arange(poses) / (poses - 1)
    frames = ranges[:, :1] + (ranges[:, 1:] - ranges[:, :1]) * phases
    tips, places, headings = _tips(body, motion, frames.ravel())
    begin = np.arange(0, len(tips), poses)
    ends = [seen_from(*_tips(body, motion, at)) for at in played.T]
    return seen_from(tips.reshape(len(ranges), -1, 3), places[begin], headings[begin]), ends[0], ends[1]


def _tips(body: Body, motion: Motion, frames: Floats) -> tuple[Floats, Floats, Floats]:
    """Of poses [F]: the tips of the measured bones [F,K,3], and where the body stands [F,2] and faces [F]."""
    roots, rotations, headings = sample(motion, frames)
    return bone_tips(body, roots, rotations)[:, body.measured] * body.scale, roots[:, :2] * body.scale, headings


def distances(points: Floats, others: Floats) -> Floats:
    """Dis between all points [N,K,3] and others [M,K,3]: [N,M], sums of Euclidean distances."""
    axes = [np.ascontiguousarray(points[..., axis]) for axis in range(3)]
    columns = []
    for other in others:
        x, y, z = (np.square(axis - other[:, k]) for k, axis in enumerate(axes))
        columns.append(np.sqrt(x + y + z).sum(axis=-1))
    return np.stack(columns, axis=1)


# Classes (Sec. 3.1).


def cluster(
    points: Floats, classes: int, weights: Floats | None = None, restarts: int = 4, seed: int = 1, iterations: int = 100
) -> tuple[Ints, Ints, float]:
    """k-means under Dis: labels [N], representatives [n], inertia. Best of several k-means++ starts."""
    mass = np.ones(len(points)) if weights is None else np.asarray(weights, dtype=float)
    random = np.random.default_rng(seed)
    runs = [_kmeans(points, classes, mass, random, iterations) for _ in range(restarts)]
    return min(runs, key=lambda run: run[2])


def _kmeans(
    points: Floats, classes: int, mass: Floats, random: np.random.Generator, iterations: int
) -> tuple[Ints, Ints, float]:
    means = _spread_means(points, classes, mass, random)
    labels = np.full(len(points), -1)
    for _ in range(iterations):
        apart = distances(points, means)
        before, labels = labels, apart.argmin(axis=1)
        _refill(labels, apart, classes)
        if np.array_equal(before, labels):
            break
        means = np.stack([np.average(points[labels == k], axis=0, weights=mass[labels == k]) for k in range(classes)])
    own = np.take_along_axis(distances(points, means), labels[:, None], axis=1)[:, 0]
    medoids = np.array([np.where(labels == k, own, np.inf).argmin() for k in range(classes)])
    return labels, medoids, float((mass * own**2).sum())


def _spread_means(points: Floats, classes: int, mass: Floats, random: np.random.Generator) -> Floats:
    """k-means++: each next mean is a fragment drawn by its squared distance to the nearest so far."""
    chosen = [int(random.integers(len(points)))]
    nearest = distances(points, points[chosen])[:, 0]
    while len(chosen) < classes:
        chance = mass * nearest**2
        chosen.append(int(random.choice(len(points), p=chance / chance.sum())))
        nearest = np.minimum(nearest, distances(points, points[chosen[-1:]])[:, 0])
    return points[chosen]


def _refill(labels: Ints, apart: Floats, classes: int) -> None:
    """Give every empty class the fragment that is furthest from its mean."""
    for empty in np.setdiff1d(np.arange(classes), labels):
        alone = np.bincount(labels, minlength=classes)[labels] == 1
        own = np.take_along_axis(apart, labels[:, None], axis=1)[:, 0]
        furthest = np.where(alone, -1, own).argmax()
        labels[furthest] = empty
        apart[furthest] = 0


# Quality (Eq. 2).


def control_distances(evident: Floats, points: Floats, weights: Floats) -> Floats:
    """ControlDis between controls [N,4] and [M,4]: [N,M]; weights are (velocity, turn, jump)."""
    velocity, turn, jump = weights
    scaled = np.array([velocity, velocity, turn, jump])
    apart: Floats = np.linalg.norm((evident[:, None] - points[None]) * scaled, axis=-1)
    return apart


def quality_table(
    first: Floats, last: Floats, evident: Floats, points: Floats, weights: Floats
) -> tuple[Floats, Floats]:
    """The factors of Eq. 2 for the representatives' first and last poses [n,K,3] and controls [n,4]: [n,n], [n,102]."""
    return 1 / (1 + distances(last, first)), 1 / (1 + control_distances(evident, points, weights))


# Policies (Secs. 3.3 and 4).


def optimal_path(smoothness: Floats, match: Floats, trace: Ints) -> tuple[Ints, float]:
    """Eqs. 1, 3 and 4: classes [T+1] and total quality of the best path over control indices [T]."""
    value = np.zeros(len(smoothness))
    choices = []
    for control in trace[::-1]:
        worth = smoothness * match[:, control] + value
        choices.append(worth.argmax(axis=1))
        value = worth.max(axis=1)
    path = [int(value.argmax())]
    for choice in choices[::-1]:
        path.append(int(choice[path[-1]]))
    return np.array(path), float(value.max())


def table_quality(smoothness: Floats, match: Floats, table: Ints, trace: Ints, start: int) -> float:
    """Sum of Eq. 2 along a policy table's [n,102] path from a class."""
    total, at = 0.0, start
    for control in trace:
        following = table[at, control]
        total += smoothness[at, following] * match[following, control]
        at = following
    return total


def greedy_table(smoothness: Floats, match: Floats) -> Ints:
    """[n,102]: argmax of Eq. 2."""
    return np.stack([(smoothness * match[:, c]).argmax(axis=1) for c in range(match.shape[1])], axis=1)


def control_model(traces: list[Ints], stays: float, goes_anywhere: float) -> Floats:
    """[102,102]: P(next control | control) from counts and a prior: `stays` of itself, `goes_anywhere` over all."""
    counts = stays * np.eye(CONTROLS) + np.full((CONTROLS, CONTROLS), goes_anywhere / CONTROLS)
    for trace in traces:
        np.add.at(counts, (trace[:-1], trace[1:]), 1)
    model: Floats = counts / counts.sum(axis=1, keepdims=True)
    return model


def iterate_table(
    smoothness: Floats, match: Floats, traces: list[Ints], discount: float = 0.9, tolerance: float = 1e-4
) -> Ints:
    """[n,102] by value iteration (McCann and Pollard 2007)."""
    return value_iteration(smoothness, match, control_model(traces, 0.5, 0), discount, tolerance)


def anticipate_table(smoothness: Floats, match: Floats, traces: list[Ints]) -> Ints:
    """[n,102], the default policy: every control is kept in 8.5 of ten counts, and else anything may follow."""
    return value_iteration(smoothness, match, control_model(traces, 8.5, 1.5), 0.9, 1e-4)


def value_iteration(smoothness: Floats, match: Floats, model: Floats, discount: float, tolerance: float) -> Ints:
    """[n,102]: the best class by quality and the discounted value to come under a control model."""
    value = np.zeros((CONTROLS, len(smoothness)))
    while True:
        promise = discount * model @ value
        worth = smoothness * match.T[:, None, :] + promise[:, None, :]
        before, value = value, worth.max(axis=2)
        if np.abs(value - before).max() <= tolerance:
            table: Ints = worth.argmax(axis=2).T
            return table


def svm_inputs(features: Floats, controls: Floats, weights: Floats) -> Floats:
    """Features [S,.] of the previous class and controls [S,4] in ControlDis' units."""
    velocity, turn, jump = weights
    return np.hstack([features, controls * np.array([velocity, velocity, turn, jump])])


def svm_table(
    smoothness: Floats, match: Floats, trace: Ints, features: Floats, points: Floats, weights: Floats
) -> tuple[Ints, float, float, float]:
    """[n,102] by scikit-learn's SVC on Optimal's path; C, gamma and the accuracy of the cross-validation."""
    from sklearn.svm import SVC

    path, _ = optimal_path(smoothness, match, trace)
    inputs, labels = svm_inputs(features[path[:-1]], points[trace], weights), path[1:]
    c, gamma, accuracy = _cross_validate(inputs, labels)
    model = SVC(C=c, gamma=gamma, cache_size=16).fit(inputs, labels)
    n = len(smoothness)
    everything = svm_inputs(np.repeat(features, CONTROLS, axis=0), np.tile(points, (n, 1)), weights)
    table: Ints = model.predict(everything).reshape(n, CONTROLS)
    return table, c, gamma, accuracy


def _cross_validate(inputs: Floats, labels: Ints) -> tuple[float, float, float]:
    """The best C and gamma of the grid, the lower ones on a tie. Neighbours in time stay in one fold."""
    import warnings

    from sklearn.model_selection import GridSearchCV, PredefinedSplit
    from sklearn.svm import SVC

    folds = PredefinedSplit(np.arange(len(labels)) // BLOCK % FOLDS)
    search = GridSearchCV(SVC(cache_size=16), {"C": COSTS, "gamma": GAMMAS}, cv=folds, refit=False)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # a class may lie in one fold only
        search.fit(inputs, labels)
    return search.best_params_["C"], search.best_params_["gamma"], float(search.best_score_)


def decide(table: Ints, playing: int, control: Floats, points: Floats, weights: Floats) -> int:
    """The class after `playing` that a policy table [n,102] gives for any control [4]."""
    return int(table[playing, control_distances(control[None], points, weights)[0].argmin()])


# The player (Sec. 3.3, Fig. 3).


def ease(t: float) -> float:
    """Ease-in-ease-out: 0 at 0, 1 at 1, flat at both."""
    return t * t * (3 - 2 * t)


def player_frame(motion: Motion, now: float, before: float, weight: float, turn: float, offset: Floats) -> Floats:
    """One frame while two fragments are stitched: both sampled at fractional frames, placed (turned about z, moved) and
    blended. Returns rotations [B,4], the hips' in the world, with the root position [3] behind them, flat."""
    roots, rotations, _ = sample(motion, np.array([before, now]))
    cosine, sine = np.cos(turn), np.sin(turn)
    roots = roots @ np.array([[cosine, sine, 0], [-sine, cosine, 0], [0, 0, 1]]) + offset
    rotations[:, 0] = multiply(np.array([np.cos(turn / 2), 0, 0, np.sin(turn / 2)]), rotations[:, 0])
    share = ease(weight)
    blended = slerp(rotations[0], rotations[1], np.asarray(share))
    return np.concatenate([blended.ravel(), roots[0] + share * (roots[1] - roots[0])])
