# SPDX-License-Identifier: MIT
"""Every kind of bake shows, frame by frame in Blender's evaluation, what the core's player plays; or nothing at all."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from types import ModuleType
from typing import Any, NamedTuple

import bpy
import making
import numpy as np
import pytest

FIRST = 5
SEED = 3
RATE = 30


class Oracle(NamedTuple):
    """What the core's player plays: names of the bones below the hips, their heads [F,B,3] and rotations [F,B,3,3] in
    the world, and the player's performance."""

    names: list[str]
    heads: np.ndarray
    turned: np.ndarray
    performance: Any


@pytest.fixture
def trace(addon: ModuleType) -> np.ndarray:
    """Four seconds of walking and turning."""
    return np.concatenate([np.tile([0, 1.2, 0, 0], (15, 1)), np.tile([0, 1.2, 1, 0], (25, 1))]).astype(float)


@pytest.fixture
def obj(obj: bpy.types.Object) -> bpy.types.Object:
    """The built armature, away from the world's origin, at 30 frames a second."""
    scene = bpy.context.scene
    scene.render.fps, scene.render.fps_base = RATE, 1.0
    scene.frame_set(1)
    obj.location, obj.rotation_euler.z = (2, -1, 0.5), 0.7
    return obj


@pytest.fixture
def recording(addon: ModuleType, obj: bpy.types.Object, trace: np.ndarray) -> Any:
    """A recording of the trace, selected."""
    return addon.recordings.recordings.add_recording(obj, trace, name="Stroll", seed=SEED, start=(2, -1, 0.7 + np.pi))


def play(
    addon: ModuleType,
    obj: bpy.types.Object,
    trace: np.ndarray,
    rate: float = RATE,
    start: Any = None,
    policy: str = "",
    **feel: Any,
) -> Oracle:
    """The trace played from the armature's place in the fixture `obj`."""
    core, character = addon.compat.core.core, addon.character.building.load(obj)
    player = core.Player(character, SEED, policy=policy, **feel)
    player.reset(*(start or (2, -1, 0.7 + np.pi)))
    performance = player.run(trace, rate)
    clip = core.Clip(character.skeleton, "played", rate, performance.root_positions, performance.rotations)
    heads, rotations = clip.world_transforms(character.skeleton)
    body = making.body_bones(character.skeleton)
    names = [character.skeleton.names[index] for index in body]
    return Oracle(names, heads[:, body], making.to_matrices(rotations[:, body]), performance)


def seen_at(obj: bpy.types.Object, frames: Iterable[int], names: Sequence[str]) -> tuple[np.ndarray, np.ndarray]:
    """Heads [F,B,3] and rotations [F,B,3,3] of bones in the world as the scene shows them."""
    matrices = []
    for frame in frames:
        bpy.context.scene.frame_set(int(frame))
        posed = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
        matrices.append([np.array(posed.matrix_world @ posed.pose.bones[name].matrix) for name in names])
    seen = np.array(matrices)
    return seen[..., :3, 3], seen[..., :3, :3] / np.linalg.norm(seen[..., :3, :3], axis=-2, keepdims=True)


def assert_seen(obj: bpy.types.Object, oracle: Oracle, first: int = FIRST, step: int = 7) -> None:
    """The scene shows what was played."""
    rows = np.arange(0, len(oracle.heads), step)
    heads, turned = seen_at(obj, first + rows, oracle.names)
    assert heads.shape[0] > 10
    np.testing.assert_allclose(heads, oracle.heads[rows], atol=1e-4)
    np.testing.assert_allclose(turned, oracle.turned[rows], atol=1e-4)


def about_z(angles: np.ndarray) -> np.ndarray:
    """Matrices [F,3,3] that turn about the vertical."""
    turns = np.zeros((len(angles), 3, 3))
    turns[:, 0, 0] = turns[:, 1, 1] = np.cos(angles)
    turns[:, 1, 0] = np.sin(angles)
    turns[:, 0, 1] = -turns[:, 1, 0]
    turns[:, 2, 2] = 1
    return turns


def on_a_treadmill(oracle: Oracle) -> Oracle:
    """The same poses with the character frame where it was at first."""
    frames = oracle.performance.frames
    back = about_z(frames[0, 2] - frames[:, 2])
    ground = np.column_stack((frames[:, :2], np.zeros(len(frames))))
    heads = ground[0] + np.einsum("fij,fbj->fbi", back, oracle.heads - ground[:, None])
    return oracle._replace(heads=heads, turned=np.einsum("fij,fbjk->fbik", back, oracle.turned))


def bake(**fields: Any) -> None:
    assert bpy.ops.fragmotion.bake(frame_start=FIRST, **fields) == {"FINISHED"}


def bake_recording(**fields: Any) -> None:
    bake(trace_source="RECORDING", **fields)


@pytest.mark.parametrize("root", ["BONE", "OBJECT", "IN_PLACE"])
@pytest.mark.parametrize("target", ["NEW", "NLA"])
def test_a_recording_is_shown_as_the_player_plays_it(
    addon: ModuleType, obj: bpy.types.Object, trace: np.ndarray, recording: Any, root: str, target: str
) -> None:
    oracle = play(addon, obj, trace)
    assert np.ptp(oracle.performance.frames, axis=0).min() > 0.5, "the character neither travels nor turns"
    bake_recording(root=root, target=target)
    assert_seen(obj, on_a_treadmill(oracle) if root == "IN_PLACE" else oracle)
    assert "Stroll" in bpy.data.actions
    hips = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world.translation
    travels = np.hypot(*(np.array(hips)[:2] - (2, -1))) > 0.5
    assert travels == (root == "OBJECT")


def test_the_object_carries_the_character_and_its_root_bone_rests(
    addon: ModuleType, obj: bpy.types.Object, trace: np.ndarray, recording: Any
) -> None:
    obj.rotation_mode = "QUATERNION"
    obj.rotation_quaternion = (np.cos(0.35), 0, 0, np.sin(0.35))
    parent = making.add_mesh()
    parent.location, parent.rotation_euler = (1, 2, 0.25), (0.2, -0.1, 0.4)
    obj.parent = parent
    bpy.context.view_layer.update()
    obj.matrix_parent_inverse = parent.matrix_world.inverted()
    bake_recording(root="OBJECT")
    assert_seen(obj, play(addon, obj, trace))
    character = addon.character.building.load(obj)
    root = seen_at(obj, range(FIRST, FIRST + 100, 9), [character.skeleton.names[0]])[0][:, 0]
    frames = play(addon, obj, trace).performance.frames[:100:9]
    np.testing.assert_allclose(root[:, :2], frames[:, :2], atol=1e-3)


@pytest.mark.parametrize(
    ("setting", "option", "value"),
    [("promptness", "responsiveness", 0.0), ("pull", "root_adjustment", 0.25), ("lock_feet", "lock_feet", False)],
)
def test_a_bake_moves_as_the_armature_is_set_to(
    addon: ModuleType, obj: bpy.types.Object, setting: str, option: str, value: Any
) -> None:
    trace = np.repeat([(0, 1.2, 0, 0), (0, -1.2, 0, 0), (1.2, 0, 0, 0), (0, 3.0, 0, 0), (0, 1.2, 1, 0)], 9, axis=0)
    addon.recordings.recordings.add_recording(obj, trace, seed=SEED, start=(2, -1, 0.7 + np.pi))
    usual, oracle = play(addon, obj, trace), play(addon, obj, trace, **{option: value})
    assert np.abs(oracle.heads - usual.heads).max() > 1e-3, "it makes no difference here"
    setattr(obj.fragmotion.feel, setting, value)
    bake_recording()
    assert_seen(obj, oracle)


@pytest.mark.parametrize(("fps", "base"), [(24, 1.001), (60, 1.0), (12, 1.0)])
def test_a_bake_keeps_time_at_any_frame_rate(
    addon: ModuleType, obj: bpy.types.Object, trace: np.ndarray, recording: Any, fps: int, base: float
) -> None:
    render = bpy.context.scene.render
    render.fps, render.fps_base = fps, base
    bake_recording()
    frames = obj.animation_data.action.frame_range
    assert (frames[1] - frames[0]) / (fps / base) == pytest.approx(4, abs=0.5 / fps)
    assert_seen(obj, play(addon, obj, trace, fps / render.fps_base), step=3)


def test_a_recording_is_baked_with_its_own_seed_policy_and_start_or_others(
    addon: ModuleType, obj: bpy.types.Object, trace: np.ndarray, recording: Any
) -> None:
    recording.policy, recording.start = "greedy", (-3, 4, 1.5)
    bake_recording(seed=99)
    assert_seen(obj, play(addon, obj, trace, start=(-3, 4, 1.5), policy="greedy"))
    bake_recording(as_recorded=False, seed=SEED, policy="svm")
    assert_seen(obj, play(addon, obj, trace, policy="svm"))
    bake_recording(as_recorded=False, seed=SEED)
    assert_seen(obj, play(addon, obj, trace))
    recording.policy = "unheard-of"
    before = making.contents()
    with pytest.raises(RuntimeError, match=r"Bake: .*unheard-of"):
        bake_recording()
    assert making.contents() == before


def test_a_recording_that_was_seen_is_baked_as_it_was_seen(
    addon: ModuleType, obj: bpy.types.Object, trace: np.ndarray, recording: Any
) -> None:
    oracle = play(addon, obj, trace)
    played, motion = oracle.performance, addon.rig.motion.Motion
    shown = motion(played.root_positions, played.rotations, played.frames, played.classes)
    uneven = np.sort(np.random.default_rng(1).permutation(len(shown.classes))[:-20])  # a preview that left frames out
    uneven[[0, -1]] = 0, len(shown.classes) - 1
    some = motion(*(values[uneven] for values in shown))
    addon.recordings.recordings.set_shown(recording, uneven / RATE, some)
    recording.seed = 99  # what was seen counts
    bake_recording()
    heads, _ = seen_at(obj, FIRST + uneven[::5], oracle.names)
    np.testing.assert_allclose(heads, oracle.heads[uneven[::5]], atol=1e-4)
    between = np.setdiff1d(np.arange(len(shown.classes)), uneven)
    heads, _ = seen_at(obj, FIRST + between, oracle.names)
    np.testing.assert_allclose(heads, oracle.heads[between], atol=0.05)

    addon.recordings.recordings.trim_recording(recording, 1.0, 3.0)
    assert tuple(recording.start) == pytest.approx(tuple(played.frames[uneven[uneven >= RATE][0]]), abs=1e-4)
    bake_recording()
    assert tuple(obj.animation_data.action.frame_range) == pytest.approx((FIRST, FIRST + 2 * RATE), abs=1)
    inside = uneven[(uneven >= RATE) & (uneven <= 3 * RATE)]
    heads, _ = seen_at(obj, FIRST + inside - RATE, oracle.names)
    np.testing.assert_allclose(heads, oracle.heads[inside], atol=1e-4)


def test_a_bake_into_the_current_action_replaces_its_keys_from_the_playhead_on(
    addon: ModuleType, obj: bpy.types.Object, trace: np.ndarray, recording: Any
) -> None:
    bake(trace_source="PLAYER", player="runner", seconds=8)
    action = obj.animation_data.action
    names = play(addon, obj, trace).names
    before = seen_at(obj, range(FIRST, FIRST + 240, 10), names)[0]
    bpy.context.scene.frame_set(60)
    assert bpy.ops.fragmotion.bake(trace_source="RECORDING", target="CURRENT", fit_end=False) == {"FINISHED"}
    assert obj.animation_data.action == action and tuple(action.frame_range) == (FIRST, FIRST + 240)
    assert_seen(obj, play(addon, obj, trace), first=60)
    after = seen_at(obj, range(FIRST, FIRST + 240, 10), names)[0]
    kept = np.array([not 60 <= frame <= 180 for frame in range(FIRST, FIRST + 240, 10)])
    np.testing.assert_allclose(after[kept], before[kept], atol=1e-6)
    for curve in addon.compat.versions.curves_of(action, obj):
        frames = [key.co.x for key in curve.keyframe_points]
        assert frames == list(range(FIRST, FIRST + 241))


def test_a_bake_goes_on_where_the_character_stands(
    addon: ModuleType, obj: bpy.types.Object, trace: np.ndarray, recording: Any
) -> None:
    bake_recording()
    played = play(addon, obj, trace).performance
    bpy.context.scene.frame_set(FIRST + 100)
    bake(trace_source="RECORDING", as_recorded=False, place="CHARACTER", seed=SEED, target="CURRENT")
    x, y, heading = played.frames[100]
    heads = seen_at(obj, [FIRST + 100], play(addon, obj, trace).names)[0]
    np.testing.assert_allclose(heads[0, 0, :2], (x, y), atol=0.01)
    far = play(addon, obj, trace, start=(x, y, heading))
    bpy.context.scene.frame_set(FIRST + 200)
    np.testing.assert_allclose(
        seen_at(obj, [FIRST + 200], far.names)[0][0, 0, :2], far.heads[100, 0, :2], atol=0.6
    )  # the hips' own heading is not the smoothed one


def test_an_nla_strip_covers_what_played_only_while_it_lasts(
    addon: ModuleType, obj: bpy.types.Object, trace: np.ndarray, recording: Any
) -> None:
    bake(trace_source="PLAYER", player="runner", seconds=8, action="Run")
    names = play(addon, obj, trace).names
    outside = [*range(FIRST, 50, 6), *range(200, 240, 6)]
    before = seen_at(obj, outside, names)[0]
    assert bpy.ops.fragmotion.bake(trace_source="RECORDING", target="NLA", frame_start=60) == {"FINISHED"}
    data = obj.animation_data
    assert data.action is None
    assert [(track.name, len(track.strips)) for track in data.nla_tracks] == [("Run", 1), ("Stroll", 1)]
    assert_seen(obj, play(addon, obj, trace), first=60)
    np.testing.assert_allclose(seen_at(obj, outside, names)[0], before, atol=1e-5)


@pytest.mark.parametrize("below", ["NEW", "NLA"])
@pytest.mark.parametrize("frame", [1, 80])
def test_a_strip_over_keys_that_move_the_object_shows_its_own_path(
    addon: ModuleType, obj: bpy.types.Object, trace: np.ndarray, recording: Any, below: str, frame: int
) -> None:
    """Wherever the playhead is, and so the object, when it is baked."""
    bake_recording(root="OBJECT", target=below, action="Below")
    bpy.context.scene.frame_set(frame)
    bake_recording(target="NLA", root="BONE")
    assert_seen(obj, play(addon, obj, trace))
    assert [track.name for track in obj.animation_data.nla_tracks][-2:] == ["Below", "Stroll"]


@pytest.mark.parametrize("root", ["BONE", "OBJECT"])
@pytest.mark.parametrize("modes", [("QUATERNION",), ("XYZ", "AXIS_ANGLE", "ZYX", "QUATERNION")])
def test_reduced_keys_keep_every_bone_within_the_bound_on_every_frame(
    addon: ModuleType, obj: bpy.types.Object, recording: Any, root: str, modes: tuple[str, ...]
) -> None:
    for index, bone in enumerate(obj.pose.bones):
        bone.rotation_mode = modes[index % len(modes)]
    names = obj.pose.bones.keys()
    bake_recording(root=root, action="all")
    expected = seen_at(obj, range(FIRST, FIRST + 121), names)
    every = count_keys(addon, obj)
    counts = []
    for distance, angle in ((0.02, 3.0), (0.005, 0.5)):
        bake_recording(root=root, action="few", reduce=True, reduce_distance=distance, reduce_angle=np.radians(angle))
        heads, turned = seen_at(obj, range(FIRST, FIRST + 121), names)
        assert np.linalg.norm(heads - expected[0], axis=-1).max() <= distance + 2e-6
        chord = np.linalg.norm(turned - expected[1], axis=(-2, -1))
        assert np.degrees(2 * np.arcsin(chord / np.sqrt(8))).max() <= angle + 1e-3
        counts.append(count_keys(addon, obj))
    assert counts[0] < 0.5 * every and counts[0] < counts[1] < every
    print(f"\n{root} {modes}: {every} keys, {counts[0]} within 20 mm and 3 degrees, {counts[1]} within 5 mm and 0.5")


def count_keys(addon: ModuleType, obj: bpy.types.Object) -> int:
    action = obj.animation_data.action
    return sum(len(curve.keyframe_points) for curve in addon.compat.versions.curves_of(action, obj))


@pytest.mark.parametrize("root", ["BONE", "IN_PLACE"])
def test_a_loop_ends_as_it_began(addon: ModuleType, obj: bpy.types.Object, recording: Any, root: str) -> None:
    names = play(addon, obj, np.zeros((10, 4))).names
    bake_recording(root=root, action="once")
    once = seen_from_itself(obj, names, root)
    bake_recording(root=root, action="round", loop=True, loop_seconds=0.5)
    heads, turned, path = seen_from_itself(obj, names, root)
    np.testing.assert_allclose(heads[:-15], once[0][:-15], atol=1e-4, err_msg="it began to turn too early")
    assert np.abs(once[0][-1] - once[0][0]).max() > 0.05, "the recording ends as it began by itself"
    np.testing.assert_allclose(heads[-1], heads[0], atol=1e-4)
    np.testing.assert_allclose(turned[-1], turned[0], atol=1e-4)
    steps = np.diff(heads, axis=0)  # the bones turn as fast, so that their heads, on circles, move nearly as fast
    np.testing.assert_allclose(steps[-1], steps[0], atol=0.2 * np.abs(steps[0]).max())
    np.testing.assert_allclose(path[-1], path[0], atol=1e-4)
    fastest = np.abs(np.diff(once[0], axis=0)).max()
    assert np.abs(np.diff(heads, axis=0)).max() < 1.5 * fastest, "the end jerks"


def seen_from_itself(obj: bpy.types.Object, names: list[str], root: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Heads [F,B,3] and rotations seen from the root bone's heading and place, and the root's steps [F-1,2] from there;
    in place, as the world sees them."""
    heads, turned = seen_at(obj, range(FIRST, FIRST + 121), names)
    if root == "IN_PLACE":
        return heads, turned, np.diff(heads[:, 0, :2], axis=0)
    frames = np.array([character_frame(obj, frame) for frame in range(FIRST, FIRST + 121)])
    back = about_z(-frames[:, 2])
    ground = np.column_stack((frames[:, :2], np.zeros(len(frames))))
    steps = np.einsum("fij,fj->fi", back[:-1], np.diff(ground, axis=0))[:, :2]
    return np.einsum("fij,fbj->fbi", back, heads - ground[:, None]), np.einsum("fij,fbjk->fbik", back, turned), steps


def character_frame(obj: bpy.types.Object, frame: int) -> tuple[float, float, float]:
    """Under the hips, along the line between the thighs."""
    bpy.context.scene.frame_set(frame)
    posed = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    hips, left, right = (
        np.array(posed.matrix_world @ posed.pose.bones[name].head) for name in ("hips", "thigh.L", "thigh.R")
    )
    return hips[0], hips[1], np.arctan2(right[1] - left[1], right[0] - left[0])


def changes_of_class(oracle: Oracle, names: list[str]) -> list[tuple[int, str]]:
    classes = oracle.performance.classes
    return [(FIRST + i, names[c]) for i, c in enumerate(classes) if i == 0 or classes[i - 1] != c]


def test_markers_stand_where_the_class_changes(
    addon: ModuleType, obj: bpy.types.Object, trace: np.ndarray, recording: Any
) -> None:
    oracle = play(addon, obj, trace)
    obj.fragmotion.classes[oracle.performance.classes[60]].name = "my own wave"
    expected = changes_of_class(oracle, [row.name for row in obj.fragmotion.classes])
    assert len(expected) > 5 and "my own wave" in dict(expected).values()
    scene = bpy.context.scene
    bake_recording(action="none")
    assert not scene.timeline_markers and not obj.animation_data.action.pose_markers
    bake_recording(action="scene", markers="SCENE")
    assert sorted((m.frame, m.name) for m in scene.timeline_markers) == expected
    for _ in range(2):
        bake_recording(action="action", markers="ACTION")
        markers = bpy.data.actions["action"].pose_markers
        assert sorted((m.frame, m.name) for m in markers) == expected
    assert len(scene.timeline_markers) == len(expected)


@pytest.mark.parametrize("target", ["NEW", "CURRENT", "NLA"])
def test_every_bake_is_one_undo_step(obj: bpy.types.Object, recording: Any, target: str) -> None:
    bake_recording(action="Former")
    bpy.ops.ed.undo_push(message="before")
    before = digest()
    fields = {"target": target, "markers": "SCENE", "root": "IN_PLACE", "loop": True}
    assert bpy.ops.fragmotion.bake("EXEC_DEFAULT", True, trace_source="RECORDING", **fields) == {"FINISHED"}
    assert digest() != before
    bpy.ops.ed.undo()
    assert digest() == before


@pytest.mark.parametrize(
    ("target", "fresh"),
    [("NEW", True), ("NLA", True), ("NEW", False), ("NLA", False), ("CURRENT", False), ("REPLACED", False)],
)
def test_a_bake_that_fails_while_it_writes_changes_nothing(
    addon: ModuleType, obj: bpy.types.Object, recording: Any, target: str, fresh: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    if fresh:
        obj.animation_data_clear()
    else:
        bake_recording(action="Former", markers="ACTION", root="OBJECT", seed=2)
    bpy.context.view_layer.update()
    before = digest()

    def fail(*_: object) -> None:
        raise MemoryError("no memory")

    monkeypatch.setattr(addon.bake.targets, "_mark", fail)
    fields = {"action": "Former", "target": "NEW"} if target == "REPLACED" else {"target": target}
    with pytest.raises(RuntimeError, match="no memory"):
        bake_recording(root="OBJECT", **fields)
    assert digest() == before


@pytest.mark.parametrize("stage", ["Playing", "Reducing keys"])
def test_a_bake_that_is_cancelled_changes_nothing(
    addon: ModuleType, obj: bpy.types.Object, recording: Any, stage: str
) -> None:
    settings = obj.fragmotion.bake
    settings.trace_source, settings.as_recorded, settings.reduce = "RECORDING", False, True
    before = digest()
    job = addon.jobs.Job("test", addon.bake.baking.prepare(bpy.context, obj, settings).task)
    heard = []

    def stop(_fraction: float) -> None:
        heard.append(job.stage)
        if job.stage == stage:
            job.cancel()

    job.run(stop)
    with pytest.raises(addon.compat.core.core.Cancelled):
        job.result()
    assert heard.count(stage) == 1 and heard[-1] == stage, "it went on"
    assert digest() == before


def digest() -> dict[str, Any]:
    """All that a bake may touch."""
    obj, scene = bpy.context.view_layer.objects.active, bpy.context.scene
    data = obj.animation_data
    return {
        **{name: value for name, value in making.contents().items() if name not in {"playing", "actions"}},
        "actions": {a.name: (a.use_fake_user, keys_of(a), markers_of(a.pose_markers)) for a in bpy.data.actions},
        "playing": data and data.action and data.action.name,
        "slot": data and data.action and getattr(data, "action_slot", None) and data.action_slot.identifier,
        "tracks": data
        and [(t.name, [(s.name, s.frame_start, s.frame_end) for s in t.strips]) for t in data.nla_tracks],
        "nla": data and data.use_nla,
        "markers": markers_of(scene.timeline_markers),
        "place": [tuple(row) for row in obj.matrix_basis],
    }


def markers_of(markers: Iterable[Any]) -> list[tuple[int, str]]:
    return sorted((marker.frame, marker.name) for marker in markers)


def keys_of(action: bpy.types.Action) -> list[Any]:
    """All keys of an Action."""
    if bpy.app.version >= (4, 4, 0):
        bags = [bag for layer in action.layers for strip in layer.strips for bag in strip.channelbags]
        curves = [curve for bag in bags for curve in bag.fcurves]
    else:
        curves = list(action.fcurves)
    return [(c.data_path, c.array_index, [tuple(key.co) for key in c.keyframe_points]) for c in curves]


def test_what_cannot_be_baked_is_said_and_changes_nothing(
    addon: ModuleType, obj: bpy.types.Object, recording: Any
) -> None:
    def refuses(message: str, **fields: Any) -> None:
        before = digest()
        with pytest.raises(RuntimeError, match=message):
            bpy.ops.fragmotion.bake(**fields)
        assert digest() == before

    refuses("'Fragmotion Sample' has no such recording: record or import", trace_source="RECORDING", recording=7)
    refuses("is a take that Build learns from", target="CURRENT")
    bake_recording(root="OBJECT", action="Moves")
    refuses("'Moves' moves the armature object itself", target="CURRENT", trace_source="RECORDING")
    obj.delta_location.x = 1
    refuses("has delta transforms.* or choose Root Bone", root="OBJECT", trace_source="RECORDING")
    refuses("has delta transforms.* or bake to a new Action", target="NLA", trace_source="RECORDING")
    obj.delta_location.x = 0
    obj.animation_data_clear()
    refuses("plays no Action to bake into: bake to a new", target="CURRENT", trace_source="RECORDING")
    recording.controls = b"?"
    refuses("Recording 'Stroll' is damaged", trace_source="RECORDING")


def test_esc_stops_a_bake_and_changes_nothing(
    addon: ModuleType, obj: bpy.types.Object, recording: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    button, play_on = addon.operators.background, addon.bake.performing.prepare

    def slow(*arguments: Any) -> Any:
        play = play_on(*arguments)

        def cancelled(report: Any) -> Any:
            assert not bpy.ops.fragmotion.bake.poll() and not bpy.ops.fragmotion.build.poll()
            assert bpy.ops.fragmotion.cancel() == {"FINISHED"}
            return play(report)

        return cancelled

    monkeypatch.setattr(addon.bake.performing, "prepare", slow)
    before = digest()
    assert bpy.ops.fragmotion.bake(trace_source="RECORDING", target="NLA") == {"CANCELLED"}
    assert digest() == before
    assert button.current is None and bpy.ops.fragmotion.bake.poll()
