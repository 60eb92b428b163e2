# SPDX-License-Identifier: MIT
"""Other threads run beside the binding's long calls, and their number does not change what comes out."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable
from pathlib import Path

import fragmotion_core as core
import numpy as np
from conftest import Array, build_options, small_build, walking_arrays

BVH = """HIERARCHY
ROOT hips
{
OFFSET 0 90 0
CHANNELS 3 Zrotation Xrotation Yrotation
End Site
{
OFFSET 0 20 0
}
}
MOTION
Frames: 9000
Frame Time: 0.01
"""


def rig_of(skeleton: core.Skeleton) -> core.Rig:
    """An armature whose bones are the skeleton's, pointing up."""
    upright = np.array([[1.0, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]])
    bones = len(skeleton.names)
    rest = np.tile(upright, (bones, 1, 1))
    rest[:, :3, 3] = skeleton.rest_heads()
    return core.Rig(skeleton.names, skeleton.parents, rest, np.full(bones, 0.1), np.eye(4))


def take_of(folder: Path) -> core.Take:
    """A file of one bone and 9000 frames."""
    (folder / "turn.bvh").write_text(BVH + "0 0 5\n" * 9000)
    return core.read_bvh(folder / "turn.bvh")


def long_calls(
    skeleton: core.Skeleton, clips: list[core.Clip], made: core.Character, take: core.Take
) -> dict[str, Callable[[], object]]:
    """Calls that take a while. Their arrays are ready, so that NumPy, which may let threads run, has nothing to do."""
    rig, taken = rig_of(skeleton), rig_of(take.skeleton)
    data, trace = made.to_bytes(), np.zeros((3000, 4))
    clip = core.Clip(skeleton, "walk", 30.0, *walking_arrays(seconds=60))
    frames, bones = clip.rotations.shape[:2]
    locations, rotations = np.zeros((frames, bones, 3)), np.tile([1.0, 0, 0, 0], (frames, bones, 1))
    matrices = np.tile(np.eye(4), (frames, bones, 1, 1))
    points = np.random.default_rng(1).random((90, 9, 3), np.float32)
    numbers = np.zeros(3000, np.int32)
    few = numbers[:50]
    factors = (made.smoothness, made.match)
    features = core.class_features(made)
    return {
        "build": lambda: core.build(skeleton, clips[:2], [trace], build_options(classes=2, synthesize=False)),
        "cluster": lambda: core.cluster(points, 9),
        "percent_of_optimal": lambda: made.percent_of_optimal(trace),
        "optimal": lambda: made.optimal(trace),
        "without": lambda: made.without([0]),
        "to_bytes": made.to_bytes,
        "from_bytes": lambda: core.Character.from_bytes(data),
        "Clip": lambda: core.Clip(skeleton, "clip", 30.0, clip.root_positions, clip.rotations),
        "world_transforms of a clip": lambda: clip.world_transforms(skeleton),
        "character_frames": lambda: clip.character_frames(skeleton),
        "world_transforms of a take": take.world_transforms,
        "from_take": lambda: core.Clip.from_take(take),
        "Rig.clip": lambda: rig.clip("clip", 30.0, locations, rotations),
        "Rig.clip_from_matrices": lambda: rig.clip_from_matrices("clip", 30.0, matrices),
        "Rig.take_channels": lambda: taken.take_channels(take),
        "Rig.channels": lambda: rig.channels(clip.root_positions, clip.rotations),
        "trajectories": lambda: core.trajectories(made),
        "class_features": lambda: core.class_features(made),
        "optimal_path": lambda: core.optimal_path(*factors, numbers),
        "percent_of_optimal of a table": lambda: core.percent_of_optimal(*factors, made.table, numbers),
        "greedy_table": lambda: core.greedy_table(*factors),
        "iterate_table": lambda: core.iterate_table(*factors, [numbers]),
        "svm_samples": lambda: core.svm_samples(*factors, [numbers], features, made.space),
        "svm_table": lambda: core.svm_table(*factors, [few], features, made.space, 1.0, 1.0),
    }


def runs_beside(call: Callable[[], object]) -> bool:
    """Whether another thread gets to run during some of the calls. Python does not switch threads by itself here, so it
    does only where the call lets it."""
    ran: list[bool] = []
    gate = threading.Lock()
    gate.acquire()

    def run() -> None:
        with gate:
            ran.append(True)

    thread = threading.Thread(target=run)
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1000)
    try:
        thread.start()
        gate.release()
        for _ in range(2000):
            call()
            if ran:
                return True
        return False
    finally:
        sys.setswitchinterval(interval)
        thread.join()


def test_other_threads_run_during_long_calls(
    skeleton: core.Skeleton, clips: list[core.Clip], character: core.Character, tmp_path: Path
) -> None:
    assert not runs_beside(lambda: core.ControlSpace().points)  # the test sees a call that holds the lock
    for name, call in long_calls(skeleton, clips, character, take_of(tmp_path)).items():
        assert runs_beside(call), name


def test_builds_run_beside_each_other(skeleton: core.Skeleton, clips: list[core.Clip], traces: list[Array]) -> None:
    tables: dict[int, Array] = {}

    def run(number: int) -> None:
        tables[number] = small_build(skeleton, clips, traces, lambda *_: True).table

    threads = [threading.Thread(target=run, args=(number,)) for number in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for number in range(3):
        np.testing.assert_array_equal(tables[number], tables[0])


def test_build_is_the_same_for_any_number_of_threads(
    skeleton: core.Skeleton, clips: list[core.Clip], traces: list[Array]
) -> None:
    made = [core.build(skeleton, clips, traces, build_options(classes=20, threads=n, seed=5)) for n in (1, 2, 3)]
    for other in made[1:]:
        np.testing.assert_array_equal(other.labels, made[0].labels)
        np.testing.assert_array_equal(other.table, made[0].table)
        np.testing.assert_array_equal(other.match, made[0].match)
    different = core.build(skeleton, clips, traces, build_options(classes=20, seed=6))
    assert (different.labels != made[0].labels).any()
