# SPDX-License-Identifier: MIT
"""The binding: shapes, types, views, errors, progress, threads, and the stub."""

from __future__ import annotations

import ast
import inspect
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import fragmotion_core as core
import numpy as np
import pytest
from conftest import NAMES, Array, build_options, make_skeleton, walking_arrays, walking_clips

STUB = Path(__file__).resolve().parents[2] / "cpp" / "bindings" / "fragmotion_core.pyi"


# --- shapes and types ------------------------------------------------------------------------------------------------


def test_character_has_the_documented_shapes_and_types(character: core.Character) -> None:
    fragments, classes = len(character.fragment_clips), 30
    expected = {
        "fragment_clips": ((fragments,), np.int32),
        "fragment_ranges": ((fragments, 2), np.float64),
        "fragment_durations": ((fragments,), np.float64),
        "evident": ((fragments, 4), np.float64),
        "labels": ((fragments,), np.int32),
        "representatives": ((classes,), np.int32),
        "smoothness": ((classes, classes), np.float64),
        "match": ((classes, 102), np.float64),
        "table": ((classes, 102), np.int32),
        "bridges": ((classes, classes), np.int32),
        "coverage_counts": ((102,), np.int32),
        "coverage_distances": ((102,), np.float64),
    }
    for name, (shape, dtype) in expected.items():
        array = getattr(character, name)
        assert array.shape == shape, name
        assert array.dtype == dtype, name
    assert len(character.fragment_origins) == fragments
    assert set(character.fragment_origins) <= {"captured", "mirrored", "interpolated", "transformed"}
    assert character.report["fragments"] == fragments
    assert character.policies == ["anticipate", "iterate", "svm", "greedy"]


def test_character_says_what_holds_together(character: core.Character) -> None:
    np.testing.assert_array_equal(character.labels[character.representatives], np.arange(30))
    assert (character.table >= 0).all() and (character.table < 30).all()
    assert (character.bridges >= -1).all() and (character.bridges < 30).all()
    assert character.coverage_counts.sum() == len(character.labels)
    ranges = character.fragment_ranges
    np.testing.assert_allclose(ranges[:, 1] - ranges[:, 0], character.fragment_durations, atol=1e-12)
    assert character.fragment_clips.max() < len(character.clip_names)
    nearest = [character.space.distance(character.evident[0], point) for point in character.space.points]
    assert character.space.nearest(character.evident[:1])[0] == int(np.argmin(nearest))


@pytest.mark.parametrize("name", ["labels", "representatives", "smoothness", "match", "table", "bridges"])
def test_views_are_read_only_and_outlive_their_owner(
    skeleton: core.Skeleton, clips: list[core.Clip], traces: list[Array], name: str
) -> None:
    made = core.build(skeleton, clips[:3], traces, build_options(classes=4, policies=["greedy"], synthesize=False))
    array = getattr(made, name)
    copy = array.copy()
    with pytest.raises(ValueError, match="read-only"):
        array[0] = 0
    del made
    core.build(skeleton, clips[:2], traces, build_options(classes=4, policies=["greedy"], synthesize=False))
    np.testing.assert_array_equal(array, copy)


def test_clips_and_performances_are_read_only_views(clips: list[core.Clip], character: core.Character) -> None:
    performance = core.Player(character).run(np.zeros((5, 4)), 30)
    for array in (clips[0].root_positions, clips[0].rotations, performance.root_positions, performance.rotations):
        assert not array.flags.owndata
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0


def test_clips_keep_what_they_are_given(skeleton: core.Skeleton) -> None:
    roots, rotations = walking_arrays(turn=0.5)
    clip = core.Clip(skeleton, "walk", 29.97, roots, rotations)
    assert (clip.name, clip.rate) == ("walk", 29.97)
    np.testing.assert_array_equal(clip.root_positions, roots)
    np.testing.assert_allclose(np.abs((clip.rotations * rotations).sum(-1)), 1, atol=1e-12)
    positions, world = clip.world_transforms(skeleton)
    assert positions.shape == (len(roots), len(NAMES), 3) and world.shape == (len(roots), len(NAMES), 4)
    np.testing.assert_allclose(positions[:, 0], roots, atol=1e-12)


@pytest.mark.parametrize("turn", [0.0, 1.2, -0.7])
def test_clips_tell_where_the_character_stands_and_faces(skeleton: core.Skeleton, turn: float) -> None:
    roots, rotations = walking_arrays(side=0.5, turn=turn)
    frames = core.Clip(skeleton, "walk", 30.0, roots, rotations).character_frames(skeleton)
    np.testing.assert_allclose(frames[:, :2], roots[:, :2], atol=1e-12)
    np.testing.assert_allclose(np.unwrap(frames[:, 2]), turn * np.arange(len(roots)) / 30, atol=1e-9)
    with pytest.raises(ValueError, match="number of bones"):
        core.Clip(skeleton, "walk", 30.0, roots, rotations).character_frames(
            make_skeleton(**{name: getattr(skeleton, name)[:5] for name in ("names", "parents", "offsets", "tips", "rest_rotations")})
        )


@pytest.mark.parametrize("kind", [np.float32, np.int64, "F", list])
def test_arrays_of_other_kinds_are_converted(character: core.Character, kind: Any) -> None:
    trace = np.array([[0, 1, 0, 0], [0, 1, 1, 0], [1, 0, 0, 0]])
    given = (
        trace.tolist()
        if kind is list
        else np.asfortranarray(trace.astype(float))
        if kind == "F"
        else trace.astype(kind)
    )
    np.testing.assert_array_equal(character.optimal(given)[0], character.optimal(trace.astype(float))[0])


def test_skeleton_tells_what_it_was_made_of(skeleton: core.Skeleton) -> None:
    assert skeleton.names == NAMES
    assert skeleton.roles["left_foot"] == "foot.L"
    np.testing.assert_allclose(skeleton.rest_heads()[6], [0.1, 0, 0.08])
    np.testing.assert_allclose(skeleton.rest_tails()[6], [0.1, -0.2, 0], atol=1e-12)
    other = make_skeleton(roles={"head": "spine"})
    assert other.roles["head"] == "spine"


# --- errors ----------------------------------------------------------------------------------------------------------


def test_errors_are_value_errors_that_name_the_cause(
    skeleton: core.Skeleton, clips: list[core.Clip], traces: list[Array], character: core.Character
) -> None:
    roots, rotations = walking_arrays()
    broken = rotations.copy()
    broken[7, 2] = np.nan
    few = build_options(classes=5, policies=["greedy"])
    cases: list[tuple[str, Callable[[], object]]] = [
        ("frame 7.*head", lambda: core.Clip(skeleton, "walk", 30, roots, broken)),
        ("shape", lambda: core.Clip(skeleton, "walk", 30, roots[:-1], rotations)),
        ("rate", lambda: core.Clip(skeleton, "walk", 0, roots, rotations)),
        ("no takes", lambda: core.build(skeleton, [], traces, few)),
        ("no trace", lambda: core.build(skeleton, clips, [], few)),
        ("two controls", lambda: core.build(skeleton, clips, [np.zeros((1, 4))], few)),
        ("shape", lambda: core.build(skeleton, clips, [np.zeros((5, 3))], few)),
        ("not a number", lambda: core.build(skeleton, clips, [np.full((5, 4), np.nan)], few)),
        ("4000 classes", lambda: core.build(skeleton, clips, traces, build_options(classes=4000))),
        ("wise", lambda: core.build(skeleton, clips, traces, build_options(classes=5, policies=["wise"]))),
        ("cut", lambda: build_options(cut="bones")),
        ("wise", lambda: character.percent_of_optimal(traces[0], "wise")),
        ("wise", lambda: core.Player(character, policy="wise")),
        ("stitching", lambda: core.Player(character, stitch=3)),
        ("shape", lambda: core.Player(character).step([0, 1, 0], 0.1)),
        ("not a number", lambda: core.Player(character).step([0, np.nan, 0, 0], 0.1)),
        ("not a number", lambda: core.Player(character).step([0, 1, 0, np.inf], 0.1)),
        ("step", lambda: core.Player(character).step([0, 1, 0, 0], -0.1)),
        ("step", lambda: core.Player(character).step([0, 1, 0, 0], np.nan)),
        ("step", lambda: core.Player(character).step([0, 1, 0, 0], np.inf)),
        ("not a number", lambda: core.Player(character).run([[0, 1, 0, np.nan]], 30)),
        ("rate", lambda: core.Player(character).run(traces[0], 0)),
        ("no controls", lambda: core.Player(character).run(np.zeros((0, 4)), 30)),
        ("no controls", lambda: character.optimal(np.zeros((0, 4)))),
        ("shape", lambda: character.optimal(np.zeros(4))),
        ("policy", lambda: core.Character.from_bytes(b"nonsense")),
        ("nowhere", lambda: core.Character.load("/nowhere/at/all")),
        ("nowhere/at/all: No such file", lambda: character.save("/nowhere/at/all")),
        ("nowhere/at/all: No such file", lambda: core.write_trace("/nowhere/at/all", traces[0])),
        ("unheard", lambda: core.simulate_trace("unheard")),
    ]
    for message, call in cases:
        with pytest.raises(ValueError, match=message):
            call()


def test_player_needs_a_character() -> None:
    with pytest.raises(TypeError):
        core.Player(None)  # type: ignore[arg-type]


def test_build_makes_what_it_can_of_little(skeleton: core.Skeleton, clips: list[core.Clip]) -> None:
    """One class, a trace of one control, takes of standing only."""
    forward = np.tile([0, 1.2, 0, 0], (30, 1))
    for takes, classes in ((clips, 1), (clips, 10), (clips[:1], 1)):
        made = core.build(skeleton, takes, [forward], build_options(classes=classes))
        assert (made.table >= 0).all() and (made.table < classes).all()
        for policy in made.policies:
            assert 0 < made.percent_of_optimal(forward, policy) <= 100 + 1e-9
            assert np.isfinite(core.Player(made, policy=policy).run(forward, 30).root_positions).all()


def test_build_refuses_more_classes_than_distinct_fragments(skeleton: core.Skeleton, clips: list[core.Clip]) -> None:
    options = build_options(classes=5, mirror=False, synthesize=False)
    with pytest.raises(ValueError, match="distinct"):
        core.build(skeleton, clips[:1] * 5, [np.zeros((2, 4))], options)


def test_build_refuses_clips_of_another_skeleton(clips: list[core.Clip], traces: list[Array]) -> None:
    small = core.Skeleton(["hips"], [-1], [[1, 0, 0, 0]], [[0, 0, 1]], [[0, 0, 0.1]])
    with pytest.raises(ValueError, match="gait 0"):
        core.build(small, clips, traces, build_options(classes=5))


def test_build_refuses_takes_without_a_fragment(skeleton: core.Skeleton, traces: list[Array]) -> None:
    roots, rotations = walking_arrays(seconds=0.07)
    with pytest.raises(ValueError, match="too short"):
        core.build(skeleton, [core.Clip(skeleton, "blink", 30, roots, rotations)], traces, build_options(classes=2))


def test_build_takes_skeletons_of_one_bone_and_without_feet(traces: list[Array]) -> None:
    bone = core.Skeleton(["stick"], [-1], [[1, 0, 0, 0]], [[0, 0, 0]], [[0, 0, 1]])
    roots, rotations = walking_arrays()
    clip = core.Clip(bone, "slide", 30, roots, rotations[:, :1])
    assert len(core.build(bone, [clip], traces, build_options(classes=3)).representatives) == 3
    names = [f"part {i}" for i in range(len(NAMES))]
    footless = make_skeleton(names=names)
    assert "left_foot" not in footless.roles
    made = core.build(footless, walking_clips(footless), traces, build_options(classes=5, policies=["greedy"]))
    assert len(made.representatives) == 5


# --- progress and threads --------------------------------------------------------------------------------------------


def small_build(
    skeleton: core.Skeleton, clips: list[core.Clip], traces: list[Array], progress: core.Progress
) -> core.Character:
    return core.build(skeleton, clips, traces, build_options(classes=10), progress)


def test_progress_tells_growing_fractions_and_stages(
    skeleton: core.Skeleton, clips: list[core.Clip], traces: list[Array]
) -> None:
    told: list[tuple[float, str]] = []

    def tell(fraction: float, stage: str) -> bool:
        told.append((fraction, stage))
        return True

    small_build(skeleton, clips, traces, tell)
    fractions = [fraction for fraction, _ in told]
    assert fractions == sorted(fractions) and len(set(fractions)) > 5
    assert fractions[0] >= 0 and fractions[-1] == 1
    assert len({stage for _, stage in told}) >= 4 and all(stage for _, stage in told)


def test_progress_goes_on_where_nothing_is_returned(
    skeleton: core.Skeleton, clips: list[core.Clip], traces: list[Array], character: core.Character
) -> None:
    told: list[float] = []
    small_build(skeleton, clips, traces, lambda fraction, _: told.append(fraction))
    assert told[-1] == 1
    core.Player(character).run(np.zeros((60, 4)), 60, lambda *_: None)


@pytest.mark.parametrize("calls", [1, 3, 6])
def test_progress_cancels(skeleton: core.Skeleton, clips: list[core.Clip], traces: list[Array], calls: int) -> None:
    left = iter(range(calls - 1, -1, -1))
    with pytest.raises(core.Cancelled):
        small_build(skeleton, clips, traces, lambda *_: next(left) > 0)
    assert next(left, None) is None
    assert issubclass(core.Cancelled, RuntimeError)


def test_player_is_cancelled(character: core.Character) -> None:
    with pytest.raises(core.Cancelled):
        core.Player(character).run(np.zeros((600, 4)), 60, lambda fraction, _: fraction < 0.5)


def test_what_the_callback_raises_comes_through(
    skeleton: core.Skeleton, clips: list[core.Clip], traces: list[Array], character: core.Character
) -> None:
    class Odd(Exception):
        pass

    def fail(*_: object) -> bool:
        raise Odd("as it was")

    with pytest.raises(Odd, match="as it was"):
        small_build(skeleton, clips, traces, fail)
    with pytest.raises(Odd, match="as it was"):
        core.Player(character).run(np.zeros((60, 4)), 60, fail)
    with pytest.raises(Odd, match="as it was"):
        core.cluster(np.random.default_rng(1).random((20, 2, 3)), 3, progress=fail)


def test_progress_must_return_a_truth(skeleton: core.Skeleton, clips: list[core.Clip], traces: list[Array]) -> None:
    with pytest.raises((RuntimeError, TypeError, ValueError)):
        small_build(skeleton, clips, traces, lambda *_: "yes")  # type: ignore[arg-type]


def rig_of(skeleton: core.Skeleton) -> core.Rig:
    """An armature whose bones are the skeleton's, pointing up."""
    upright = np.array([[1.0, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]])
    bones = len(skeleton.names)
    rest = np.tile(upright, (bones, 1, 1))
    rest[:, :3, 3] = skeleton.rest_heads()
    return core.Rig(skeleton.names, skeleton.parents, rest, np.full(bones, 0.1), np.eye(4))


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


# --- policy files ----------------------------------------------------------------------------------------------------


def test_policy_files_come_back_bit_for_bit(character: core.Character, tmp_path: Path) -> None:
    data = character.to_bytes()
    assert core.Character.from_bytes(data).to_bytes() == data
    character.save(tmp_path / "a.policy")
    assert (tmp_path / "a.policy").read_bytes() == data
    loaded = core.Character.load(str(tmp_path / "a.policy"))
    trace = core.simulate_trace("explorer", 10, 3)
    one, two = (core.Player(c, seed=4).run(trace, 29.97) for c in (character, loaded))
    np.testing.assert_array_equal(one.rotations, two.rotations)
    np.testing.assert_array_equal(one.root_positions, two.root_positions)


def test_damaged_policy_files_are_refused(character: core.Character, tmp_path: Path) -> None:
    data = character.to_bytes()
    for damaged, message in (
        (data[:1000], "cut short"),
        (b"X" + data[1:], "no Fragmotion"),
        (data[:500] + bytes([data[500] ^ 1]) + data[501:], "damaged"),
        (data[:8] + b"\x63" + data[9:], "version"),
        (b"", "no Fragmotion"),
    ):
        (tmp_path / "bad.policy").write_bytes(damaged)
        with pytest.raises(ValueError, match=message):
            core.Character.from_bytes(damaged)
        with pytest.raises(ValueError, match=f"bad.policy.*{message}"):
            core.Character.load(tmp_path / "bad.policy")


# --- player ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("rate", [24, 25, 29.97, 30, 60, 120])
def test_player_gives_every_frame_of_any_rate(character: core.Character, rate: float) -> None:
    performance = core.Player(character).run(core.simulate_trace("explorer", 7, 1), rate)
    frames = round(7 * rate) + 1
    bones = len(NAMES)
    assert performance.rate == rate
    shapes = {"root_positions": (frames, 3), "rotations": (frames, bones, 4), "frames": (frames, 3)}
    shapes |= {"classes": (frames,), "fragments": (frames,), "entered": (frames,)} if hasattr(dict, "__or__") else {}
    for name, shape in shapes.items():
        assert getattr(performance, name).shape == shape
    np.testing.assert_allclose(np.linalg.norm(performance.rotations, axis=-1), 1, atol=1e-6)
    np.testing.assert_allclose(performance.frames[:, :2], performance.root_positions[:, :2], atol=1e-9)
    assert 0 < performance.quality <= 1
    assert performance.velocity_error >= 0 and performance.commanded_speed > 0 and performance.drift > 0
    assert performance.classes.dtype == np.int32
    np.testing.assert_array_equal(character.labels[performance.fragments], performance.classes)


def test_player_steps_as_it_runs(character: core.Character) -> None:
    one, two = core.Player(character, seed=2), core.Player(character, seed=2)
    for player in (one, two):
        player.reset(2, -1, 0.5)
        np.testing.assert_allclose(player.frame, (2, -1, 0.5), atol=1e-9)
    performance = one.run(np.tile([0, 1.2, 0, 0], (20, 1)), 30)
    for f in range(1, 61):
        root, rotations = two.step([0, 1.2, 0, 0], 1 / 30)
        np.testing.assert_allclose(root, performance.root_positions[f], atol=1e-9)
        np.testing.assert_allclose(rotations, performance.rotations[f], atol=1e-9)
    assert two.playing == (performance.classes[-1], performance.fragments[-1])


def test_player_keeps_its_character_alive(skeleton: core.Skeleton, clips: list[core.Clip], traces: list[Array]) -> None:
    player = core.Player(small_build(skeleton, clips, traces, lambda *_: True))
    for _ in range(50):
        root, _ = player.step([0, 1.2, 0, 0], 0.05)
    assert np.isfinite(root).all()


def test_player_plays_each_of_the_policies(character: core.Character, traces: list[Array]) -> None:
    for policy in character.policies:
        assert 0 < character.percent_of_optimal(traces[0], policy) <= 100 + 1e-9
        assert core.Player(character, policy=policy).run(traces[0][:50], 30).quality > 0
    assert character.percent_of_optimal(traces[0]) == character.percent_of_optimal(traces[0], character.policies[0])


def test_classes_have_the_names_of_what_they_do(character: core.Character) -> None:
    names = character.class_names
    assert len(names) == len(set(names)) == len(character.representatives)
    still = character.space.nearest([[0, 0, 0, 0]])[0]
    for name, representative in zip(names, character.representatives):
        performed = character.space.nearest(character.evident[[representative]])[0]
        assert name.startswith("stand") == (performed == still), name


def test_excluded_classes_are_not_played(character: core.Character, traces: list[Array]) -> None:
    often = [int(k) for k in np.argsort(np.bincount(character.table.ravel()))[-4:]]
    left = character.without(often)
    assert np.isin(character.table, often).any() and not np.isin(left.table, often).any()
    assert not left.match[often].any() and (left.evident == character.evident).all()
    assert not np.isin(core.Player(left).run(traces[0], 30).classes, often).any()
    with pytest.raises(ValueError, match="class 30 does not exist"):
        character.without([30])
    with pytest.raises(ValueError, match="all classes are excluded"):
        character.without(range(30))


def test_a_forced_class_plays(character: core.Character) -> None:
    excluded = int(character.table[0, 0])
    player = core.Player(character.without([excluded]))
    player.force(excluded)
    player.step([0, 1.2, 0, 0], 0.01)
    assert player.playing[0] == excluded
    player.step([0, 1.2, 0, 0], 1.0)
    assert player.playing[0] != excluded
    with pytest.raises(ValueError, match="class -1 does not exist"):
        player.force(-1)


# --- the stub --------------------------------------------------------------------------------------------------------


def public_names(owner: object) -> set[str]:
    return {name for name in vars(owner) if not name.startswith("_")}


def stub_of_class(node: ast.ClassDef) -> dict[str, ast.AST]:
    members: dict[str, ast.AST] = {}
    for item in node.body:
        if isinstance(item, ast.FunctionDef):
            members[item.name] = item
        elif isinstance(item, ast.AnnAssign) and isinstance(item.target, ast.Name):
            members[item.target.id] = item
    return members


def arguments_of(node: ast.FunctionDef) -> list[str]:
    names = [argument.arg for argument in node.args.args]
    return names[1:] if names[:1] == ["self"] else names


def arguments_told(function: object) -> list[str]:
    """The names of the parameters as pybind11's docstring tells them."""
    signature = (inspect.getdoc(function) or "").splitlines()[0]
    inner = signature[signature.index("(") + 1 : signature.rindex(") ->")]
    parsed = ast.parse(f"def f({inner_names(inner)}): ...").body[0]
    assert isinstance(parsed, ast.FunctionDef)
    return arguments_of(parsed)


def inner_names(inner: str) -> str:
    """The parameters' names of 'a: T[x, y], b: U = 1', separated by commas."""
    names, depth, start = [], 0, 0
    for i, letter in enumerate(inner + ","):
        depth += (letter in "[({<") - (letter in "])}>")
        if letter == "," and depth == 0:
            names.append(inner[start:i].split(":")[0].split("=")[0].strip())
            start = i + 1
    return ", ".join(name for name in names if name)


def test_stub_names_what_the_module_has() -> None:
    body = ast.parse(STUB.read_text()).body
    classes = {node.name: node for node in body if isinstance(node, ast.ClassDef)}
    functions = {node.name: node for node in body if isinstance(node, ast.FunctionDef)}
    constants = {n.target.id for n in body if isinstance(n, ast.AnnAssign) and isinstance(n.target, ast.Name)}
    assert public_names(core) == set(classes) | set(functions) | {c for c in constants if not c.startswith("_")}
    for name, function in functions.items():
        assert arguments_told(getattr(core, name)) == arguments_of(function), name
    for name, node in classes.items():
        if name == "Cancelled":
            continue
        members = stub_of_class(node)
        assert public_names(getattr(core, name)) == {m for m in members if not m.startswith("_")}, name
        for member, item in members.items():
            if isinstance(item, ast.FunctionDef):
                told = arguments_told(getattr(getattr(core, name), member))
                assert told == arguments_of(item), f"{name}.{member}"


def test_stub_has_the_modules_defaults() -> None:
    player = inspect.getdoc(core.Player.__init__) or ""
    for node in ast.walk(ast.parse(STUB.read_text())):
        if isinstance(node, ast.ClassDef) and node.name == "Player":
            init = stub_of_class(node)["__init__"]
            assert isinstance(init, ast.FunctionDef)
            stitch = ast.literal_eval(init.args.defaults[1])
            assert f"stitch: float = {stitch}" in player or f"= {stitch}" in player
