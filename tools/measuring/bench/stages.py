# SPDX-License-Identifier: MIT
"""The stages of a build in NumPy and scikit-learn, on the core's data: seconds, and how results compare."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tests.reference import numpy_build as reference

Arrays = dict[str, NDArray[Any]]
Stage = Callable[[Arrays], tuple[float, str]]

_ENOUGH = 1.0  # s: a reference that took less is measured again
_REPEATS = 3
_FRAMES = 200  # of the NumPy player
_DECISIONS = 200  # of NumPy


@dataclass(frozen=True)
class Row:
    """One stage; `seconds` are the core's."""

    name: str
    seconds: float
    reference: str
    reference_seconds: float
    ratio: float


def timed(work: Callable[[], Any]) -> tuple[float, Any]:
    """The shortest of a few runs in seconds, and the result."""
    best, result = float("inf"), None
    for _ in range(_REPEATS):
        start = time.perf_counter()
        result = work()
        best = min(best, time.perf_counter() - start)
        if best > _ENOUGH:
            break
    return best, result


def _trajectories(data: Arrays) -> tuple[float, str]:
    seconds, (whole, first, last) = timed(
        lambda: reference.trajectories(_body(data), _motion(data), data["ranges"], data["played"])
    )
    ours = np.moveaxis(data["trajectories"], 1, 2)[:, : whole.shape[1]]
    data.update(whole=whole, first=first, last=last)
    return seconds, f"largest difference {np.abs(whole - ours).max() * 1e3:.4f} mm"


def _cluster(data: Arrays) -> tuple[float, str]:
    points, classes = data["whole"].astype(np.float32), len(data["representatives"])
    restarts = int(data["restarts"][0])
    seconds, (_, _, inertia) = timed(lambda: reference.cluster(points, classes, restarts=restarts))
    return seconds, f"inertia: core {data['inertia'][0]:.0f}, NumPy {inertia:.0f}"


def _k_means(data: Arrays) -> tuple[float, str]:
    from sklearn.cluster import KMeans

    points, classes = data["whole"].astype(np.float32), len(data["representatives"])
    model = KMeans(classes, n_init=int(data["restarts"][0]), random_state=1)
    seconds, _ = timed(lambda: model.fit(points.reshape(len(points), -1)))
    means = [points[model.labels_ == k].mean(axis=0) for k in range(classes)]
    own = [reference.distances(points[model.labels_ == k], mean[None]) for k, mean in enumerate(means)]
    inertia = sum(float((apart**2).sum()) for apart in own)
    return seconds, f"inertia under Dis: core {data['inertia'][0]:.0f}, scikit-learn {inertia:.0f}"


def _quality(data: Arrays) -> tuple[float, str]:
    chosen = data["representatives"]
    first, last, evident = (data[name][chosen] for name in ("first", "last", "evident"))
    seconds, (smoothness, match) = timed(
        lambda: reference.quality_table(first, last, evident, data["points"], data["control_weights"])
    )
    worst = max(np.abs(smoothness - data["smoothness"]).max(), np.abs(match - data["match"]).max())
    return seconds, f"largest difference {worst:.0e}"


def _optimal(data: Arrays) -> tuple[float, str]:
    seconds, (_, quality) = timed(lambda: reference.optimal_path(data["smoothness"], data["match"], data["trace"]))
    return seconds, f"total quality: core {data['optimal'][0]:.6f}, NumPy {quality:.6f}"


def _svm(data: Arrays) -> tuple[float, str]:
    seconds, (table, c, gamma, accuracy) = timed(
        lambda: reference.svm_table(
            data["smoothness"], data["match"], data["trace"], data["features"], data["points"], data["control_weights"]
        )
    )
    same = (table == data["svm_table"]).mean()
    return seconds, f"{same:.2%} of the table equal; C {c:g}, gamma {gamma:g}, cross-validated accuracy {accuracy:.1%}"


def _iterate(data: Arrays) -> tuple[float, str]:
    seconds, table = timed(lambda: reference.iterate_table(data["smoothness"], data["match"], [data["trace"]]))
    return seconds, f"{(table == data['iterate_table']).mean():.2%} of the table equal"


def _decision(data: Arrays) -> tuple[float, str]:
    controls = np.random.default_rng(1).uniform([-4, -4, -1.2, 0], [4, 4, 1.2, 1], (_DECISIONS, 4))
    table, points, weights = data["iterate_table"], data["points"], data["control_weights"]
    seconds, _ = timed(lambda: [reference.decide(table, 0, control, points, weights) for control in controls])
    return seconds / _DECISIONS, "the nearest of the 102 points, and the table's next class"


def _player_frame(data: Arrays) -> tuple[float, str]:
    motion, offset = _motion(data), np.zeros(3)
    frames = [10 + 0.5 * k for k in range(_FRAMES)]
    seconds, _ = timed(
        lambda: [reference.player_frame(motion, at, at + 20, 0.5, 0.3, offset) for at in frames],
    )
    return seconds / _FRAMES, "a frame in the middle of a stitch; the core's: all frames, and the places of all bones"


def _body(data: Arrays) -> reference.Body:
    return reference.Body(
        data["parents"], data["offsets"], data["tips"], data["measured"], scale=float(data["scale"][0])
    )


def _motion(data: Arrays) -> reference.Motion:
    return reference.Motion(data["root_positions"], data["rotations"], data["headings"])


_STAGES: dict[str, tuple[str, str, Stage]] = {
    "trajectories": ("trajectories", "NumPy", _trajectories),
    "cluster": ("cluster", "NumPy", _cluster),
    "cluster, Euclidean": ("cluster", "scikit-learn KMeans", _k_means),
    "quality table": ("quality table", "NumPy", _quality),
    "optimal": ("optimal", "NumPy", _optimal),
    "svm": ("svm", "scikit-learn SVC", _svm),
    "iterate": ("iterate", "NumPy", _iterate),
    "decision": ("decision", "NumPy", _decision),
    "player frame": ("small frame, free, held", "NumPy", _player_frame),
}
_WHOLE = ("trajectories", "quality table", "optimal", "iterate")  # and the faster of both ways to cluster
_CLUSTER = ("cluster", "cluster, Euclidean")


def compare(core: dict[str, float], data: Arrays) -> tuple[list[Row], dict[str, str]]:
    """Measure every stage's reference; the rows, and a remark on the results of each."""
    rows, remarks = [], {}
    for name, (measured, library, stage) in _STAGES.items():
        seconds, remarks[name] = stage(data)
        rows.append(Row(name, core[measured], library, seconds, seconds / core[measured]))
    clustered = min((row for row in rows if row.name in _CLUSTER), key=lambda row: row.reference_seconds)
    whole = clustered.reference_seconds + sum(row.reference_seconds for row in rows if row.name in _WHOLE)
    rows.append(Row("whole build", core["whole build"], "NumPy, scikit-learn", whole, whole / core["whole build"]))
    stages = ", ".join((clustered.name, *_WHOLE))
    remarks["whole build"] = f"reference: {stages}; without cutting, mirroring and synthesis, as the core's has"
    return rows, remarks
