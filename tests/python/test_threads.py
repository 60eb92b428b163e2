# SPDX-License-Identifier: MIT
"""Other threads run beside the binding's long calls, and their number does not change what comes out."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from collections.abc import Callable
from pathlib import Path

import fragmotion_core as core
import numpy as np
import pytest
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


def in_threads(calls: list[Callable[[], object]]) -> None:
    """Make the calls at the same time, and wait for all of them."""
    begin = threading.Barrier(len(calls))

    def run(call: Callable[[], object]) -> None:
        begin.wait()
        call()

    threads = [threading.Thread(target=run, args=(call,)) for call in calls]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


def test_a_crowd_that_threads_step_at_once_takes_each_step_whole_or_says_so(character: core.Character) -> None:
    controls = np.tile([0.0, 1.2, 0.0, 0.0], (40, 1))
    crowd, alone = (core.Crowd(character, 40, threads=2) for _ in range(2))
    taken: list[bool] = []

    def step() -> None:
        for _ in range(150):
            try:
                crowd.step_many(controls, 1 / 60)
                taken.append(True)
            except RuntimeError as refusal:
                assert "Crowd is in the middle of another call" in str(refusal)
                taken.append(False)

    in_threads([step] * 4)
    assert len(taken) == 600 and any(taken) and not all(taken)
    for _ in range(sum(taken)):
        alone.step_many(controls, 1 / 60)
    np.testing.assert_array_equal(crowd.character_frames, alone.character_frames)
    np.testing.assert_array_equal(crowd.playing, alone.playing)


def test_a_player_that_runs_refuses_other_calls(character: core.Character, traces: list[Array]) -> None:
    player, same = core.Player(character), core.Player(character)
    calls: list[Callable[[], object]] = [
        lambda: player.step([0, 0, 0, 0], 0.1),
        lambda: player.run(traces[0], 30),
        lambda: player.reset(),
        lambda: player.force(0),
        lambda: player.frame,
        lambda: player.playing,
    ]
    refusals: list[str] = []

    def attempt(call: Callable[[], object]) -> None:
        try:
            call()
        except RuntimeError as refusal:
            refusals.append(str(refusal))

    def callback(fraction: float, _: str) -> None:
        if fraction == 0:
            for call in calls:
                attempt(call)
                in_threads([lambda call=call: attempt(call)])  # type: ignore[misc]

    performance = player.run(traces[0], 30, callback)
    assert len(refusals) == 2 * len(calls) and all("Player is in the middle" in refusal for refusal in refusals)
    np.testing.assert_array_equal(performance.rotations, same.run(traces[0], 30).rotations)
    for call in calls:
        call()


def test_players_and_crowds_of_one_character_run_beside_each_other(
    character: core.Character, traces: list[Array]
) -> None:
    controls = np.tile(traces[0][5], (20, 1))

    def crowd(seed: int) -> Array:
        stepped = core.Crowd(character, 20, seed, threads=1 + seed % 2)
        return np.stack([stepped.step_many(controls, 1 / 30)[1] for _ in range(60)])

    def player(seed: int) -> Array:
        return core.Player(character, seed).run(traces[0][:100], 60).rotations

    shown: dict[int, Array] = {}
    makers = [crowd, player, crowd, player]
    in_threads([lambda i=i: shown.update({i: makers[i](i)}) for i in range(4)])  # type: ignore[misc]
    for i, maker in enumerate(makers):
        np.testing.assert_array_equal(shown[i], maker(i))


LEAVING = """
import itertools, sys, threading
import numpy as np
import fragmotion_core as core
from conftest import make_skeleton, small_build, walking_clips

skeleton = make_skeleton()
clips, traces = walking_clips(skeleton), [core.simulate_trace("walker", 30, 1)]
begun = threading.Event()

def busy(*_):
    begun.set()
    for _ in itertools.count():
        pass

def short_calls():
    while True:
        clips[0].world_transforms(skeleton)
        begun.set()

work = {
    "a callback": lambda: small_build(skeleton, clips, traces, busy),
    "another's callback": lambda: core.cluster(np.random.default_rng(1).random((300, 9, 3)), 30, progress=busy),
    "short calls": short_calls,
}
threading.Thread(target=work[sys.argv[1]], daemon=True).start()
begun.wait()
"""


@pytest.mark.parametrize("work", ["a callback", "another's callback", "short calls"])
def test_python_ends_while_a_thread_is_in_the_core(work: str) -> None:
    path = os.pathsep.join([*sys.path, str(Path(__file__).parent)])
    done = subprocess.run(
        [sys.executable, "-c", LEAVING, work],
        env={**os.environ, "PYTHONPATH": path},
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
