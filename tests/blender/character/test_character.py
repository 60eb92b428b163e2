# SPDX-License-Identifier: MIT
"""Build and bake on the sample rig: the file keeps the character, and the baked Action is what the player plays."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType, SimpleNamespace
from unittest.mock import MagicMock

import bpy
import making
import numpy as np
import pytest


def test_build_reports_what_it_found_and_survives_saving(addon: ModuleType, obj: bpy.types.Object) -> None:
    character = addon.character.building.load(obj)
    figures = obj.fragmotion.figures
    assert figures.fragments == len(character.labels) > figures.captured > 97
    assert (figures.classes, figures.controls) == character.table.shape == (97, 102)
    assert 0 < figures.seconds < 60
    exam = addon.compat.core.core.simulate_trace(figures.examiner, 60.0, 7001, character.space)
    assert figures.quality == pytest.approx(character.percent_of_optimal(exam), abs=1e-3)
    assert 50 < figures.quality <= 100.001
    assert character.policies[0] == obj.fragmotion.build.policy
    found = {row.name: row.quality for row in figures.policies}
    assert found == pytest.approx({name: character.percent_of_optimal(exam, name) for name in character.policies})
    assert figures.examiner != obj.fragmotion.build.player
    assert figures.captured == character.report.get("captured", figures.captured)


def test_the_panel_says_how_tall_the_legs_make_the_body(addon: ModuleType, obj: bpy.types.Object) -> None:
    shown: list[str] = []
    layout = MagicMock()
    for part in ("box", "column", "split"):
        getattr(layout, part).return_value = layout
    layout.label.side_effect = lambda text, **_: shown.append(text)
    figures = obj.fragmotion.figures
    addon.settings.drawing.draw_figures(layout, figures)
    assert figures.stature == pytest.approx(1.8, abs=0.04), "the sample's height"
    assert shown[shown.index("Stature, by its legs") + 1] == f"{figures.stature:.2f} m"
    figures.stature = 0
    shown.clear()
    addon.settings.drawing.draw_figures(layout, figures)
    assert "Stature, by its legs" not in shown, "what an earlier version built does not say it"


def test_the_coverage_shown_is_the_cores(addon: ModuleType, obj: bpy.types.Object) -> None:
    character, figures = addon.character.building.load(obj), obj.fragmotion.figures
    done = np.array(addon.compat.core.core.abilities(character))
    assert figures.performed == done.sum() > 50
    x, y, turn, jump = character.space.points.T
    speed, ahead = np.hypot(x, y), y > 0.1
    back, running = y < -0.1, speed > (character.space.walk + character.space.run) / 2
    columns = [(turn == 0) & (jump == 0), (turn != 0) & (jump == 0), jump == 1]
    rows = {"Stand": speed == 0}
    for gait, of_gait in (("Walk", (speed > 0) & ~running), ("Run", running)):
        rows |= {
            f"{gait} ahead": of_gait & ahead,
            f"{gait} aside": of_gait & ~ahead & ~back,
            f"{gait} back": of_gait & back,
        }
    assert [row.name for row in figures.coverage] == list(rows)
    for name, row in rows.items():
        assert list(figures.coverage[name].total) == [(row & column).sum() for column in columns]
        assert list(figures.coverage[name].performed) == [done[row & column].sum() for column in columns]


def test_the_coverage_says_where_no_take_jumps(addon: ModuleType, obj: bpy.types.Object) -> None:
    character = addon.character.building.load(obj)
    makes_its_jumps = addon.character.coverage.makes_its_jumps
    assert makes_its_jumps(character) == obj.fragmotion.figures.makes_jumps
    origins, evident = np.array(character.fragment_origins), np.array(character.evident)
    assert not makes_its_jumps(character), "the sample's own take jumps"
    taken = (evident[:, 3] > 0.75) & np.isin(origins, ["captured", "mirrored"])
    assert makes_its_jumps(SimpleNamespace(evident=evident[~taken], fragment_origins=list(origins[~taken])))
    stands = evident[:, 3] == 0
    assert not makes_its_jumps(SimpleNamespace(evident=evident[stands], fragment_origins=list(origins[stands])))


def test_a_character_saved_as_a_policy_file_is_loaded_onto_the_same_bones(
    addon: ModuleType, obj: bpy.types.Object, tmp_path: Path
) -> None:
    policy, figures = bytes(obj.fragmotion.policy), obj.fragmotion.figures
    shown = {row.name: tuple(row.performed) for row in figures.coverage}
    counts = (figures.captured, figures.fragments, figures.classes, figures.controls, figures.performed)
    assert bpy.ops.fragmotion.save_policy(filepath=str(tmp_path / "mine")) == {"FINISHED"}
    assert (tmp_path / "mine.policy").read_bytes() == policy
    making.open_sample()
    assert not bpy.ops.fragmotion.save_policy.poll() and not bpy.ops.fragmotion.bake.poll()
    bpy.ops.ed.undo_push(message="before")
    path = str(tmp_path / "mine.policy")
    assert bpy.ops.fragmotion.load_policy("EXEC_DEFAULT", True, filepath=path) == {"FINISHED"}
    obj = bpy.data.objects[making.ARMATURE]
    figures = obj.fragmotion.figures
    assert bytes(obj.fragmotion.policy) == policy
    assert {row.name: tuple(row.performed) for row in figures.coverage} == shown
    assert (figures.captured, figures.fragments, figures.classes, figures.controls, figures.performed) == counts
    assert figures.examiner in addon.compat.core.core.PLAYERS and 50 < figures.quality <= 100.001
    assert bpy.ops.fragmotion.bake(seconds=1) == {"FINISHED"}
    bpy.ops.ed.undo()
    assert not addon.character.building.has_character(bpy.data.objects[making.ARMATURE]), "loading is not one undo step"


def test_a_policy_file_that_does_not_fit_or_is_damaged_changes_nothing(obj: bpy.types.Object, tmp_path: Path) -> None:
    path = tmp_path / "mine.policy"
    assert bpy.ops.fragmotion.save_policy(filepath=str(path)) == {"FINISHED"}
    before = making.contents()
    damaged = bytearray(path.read_bytes())
    damaged[len(damaged) // 2] ^= 1
    (tmp_path / "bad.policy").write_bytes(damaged)
    causes = {
        "bad.policy": r"bad\.policy.*damaged",
        "missing.policy": r"missing\.policy' cannot be read",
        "": "No file is chosen",
    }
    for name, cause in causes.items():
        with pytest.raises(RuntimeError, match=cause):
            bpy.ops.fragmotion.load_policy(filepath=name and str(tmp_path / name))
    with pytest.raises(RuntimeError, match=r"cannot.*no folder.*mine\.policy"):
        bpy.ops.fragmotion.save_policy(filepath=str(tmp_path / "no folder" / "mine.policy"))
    assert making.contents() == before
    making.add_armature()
    with pytest.raises(RuntimeError, match=r"another skeleton than armature 'Rig' has: here bone '.*' is missing"):
        bpy.ops.fragmotion.load_policy(filepath=str(path))


def test_a_mesh_leads_to_its_armature(addon: ModuleType, obj: bpy.types.Object) -> None:
    deformed, carried = making.add_mesh(), making.add_mesh(obj)
    deformed.modifiers.new("Armature", "ARMATURE").object = obj
    hat = making.add_mesh(deformed)
    for thing in (deformed, carried, hat):
        making.activate(thing)
        assert addon.operators.base.context.active_armature(bpy.context) == obj
        assert bpy.ops.fragmotion.bake(seconds=1, action=f"of {thing.name}") == {"FINISHED"}
        assert obj.animation_data.action.name == f"of {thing.name}"
    making.activate(making.add_mesh())
    assert addon.operators.base.context.active_armature(bpy.context) is None


def test_the_character_is_decoded_once(addon: ModuleType, obj: bpy.types.Object) -> None:
    assert addon.character.building.load(obj) is addon.character.building.load(obj)
    data = bytes(obj.fragmotion.policy)
    obj.fragmotion.policy = data[:-1] + bytes([data[-1] ^ 1])
    with pytest.raises(addon.errors.UserError, match=f"policy kept in armature '{making.ARMATURE}'"):
        addon.character.building.load(obj)


@pytest.mark.parametrize(("fps", "base"), [(30, 1.0), (24, 1.0), (30, 1.001)])
def test_a_baked_action_poses_the_armature_as_the_player_does(
    addon: ModuleType, obj: bpy.types.Object, fps: int, base: float
) -> None:
    scene = bpy.context.scene
    scene.render.fps, scene.render.fps_base = fps, base
    obj.location, obj.rotation_euler.z = (2, -1, 0), 0.7
    former = obj.animation_data.action
    fields = {"trace_source": "PLAYER", "player": "explorer", "seconds": 10, "frame_start": 5, "seed": 3}
    assert bpy.ops.fragmotion.bake(**fields) == {"FINISHED"}
    action = obj.animation_data.action
    assert action != former and action.name == f"{making.ARMATURE} Bake"
    frames = round(10 * fps / base) + 1
    assert tuple(action.frame_range) == (5, 4 + frames)

    core = addon.compat.core.core
    character = addon.character.building.load(obj)
    player = core.Player(character, 3)
    start = addon.bake.performing.origin_frame(obj)  # to Blender's single precision
    np.testing.assert_allclose(start, (2, -1, 0.7 + np.pi), atol=1e-6)
    player.reset(*start)
    trace = core.simulate_trace("explorer", 10, 3, character.space)
    played = player.run(trace, fps / scene.render.fps_base)
    clip = core.Clip(character.skeleton, "played", played.rate, played.root_positions, played.rotations)
    heads, rotations = clip.world_transforms(character.skeleton)
    assert len(heads) == frames
    body = making.body_bones(character.skeleton)
    rows = np.arange(0, frames, 7)
    names = [character.skeleton.names[index] for index in body]
    matrices = making.blender_poses(obj, action, 5 + rows, names)
    making.assert_same_poses(matrices, heads[rows][:, body], rotations[rows][:, body], 1e-4)
    assert np.ptp(heads[:, 0], axis=0).max() > 1, "the character did not travel"


def test_a_baked_character_walks_where_its_front_points(obj: bpy.types.Object, tmp_path: Path) -> None:
    trace = tmp_path / "forward.csv"
    trace.write_text("velocity_x,velocity_y,turn,jump\n" + "0,1.2,0,0\n" * 60)
    obj.rotation_euler.z = np.pi / 2  # the armature's -Y is now the world's +X
    assert bpy.ops.fragmotion.bake(trace_source="FILE", trace_file=str(trace)) == {"FINISHED"}
    hips = making.blender_poses(obj, obj.animation_data.action, (1, 181), ["hips"])[:, 0, :3, 3]
    travel = hips[1] - hips[0]
    assert travel[0] > 5 and abs(travel[1]) < 0.3 * travel[0]


@pytest.mark.parametrize(("end", "fit", "expected"), [(50, True, 64), (50, False, 50), (250, True, 250)])
def test_a_bake_extends_the_scene_where_it_is_told_to(
    obj: bpy.types.Object, end: int, fit: bool, expected: int
) -> None:
    scene = bpy.context.scene
    scene.render.fps, scene.frame_end = 30, end
    assert bpy.ops.fragmotion.bake(seconds=2, frame_start=4, fit_end=fit) == {"FINISHED"}
    assert scene.frame_end == expected


def test_bake_is_undone_in_one_step(obj: bpy.types.Object) -> None:
    played = obj.animation_data.action.name
    bpy.context.scene.frame_end = 10
    bpy.ops.ed.undo_push(message="before")
    before = making.contents()
    before.pop("playing")
    assert bpy.ops.fragmotion.bake("EXEC_DEFAULT", True, seconds=2) == {"FINISHED"}
    assert bpy.data.objects[making.ARMATURE].animation_data.action.name != played
    bpy.ops.ed.undo()
    after = making.contents()
    after.pop("playing")
    assert after == before
    assert bpy.data.objects[making.ARMATURE].animation_data.action.name == played


def test_build_is_undone_in_one_step(addon: ModuleType, obj: bpy.types.Object) -> None:
    before = bytes(obj.fragmotion.policy)
    bpy.ops.ed.undo_push(message="before")
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", True, classes=20, seconds=5) == {"FINISHED"}
    obj = bpy.data.objects[making.ARMATURE]
    assert obj.fragmotion.figures.classes == 20 and len(addon.character.building.load(obj).representatives) == 20
    bpy.ops.ed.undo()
    obj = bpy.data.objects[making.ARMATURE]
    assert obj.fragmotion.figures.classes == 97 and bytes(obj.fragmotion.policy) == before


@pytest.mark.thorough
def test_the_same_seed_builds_and_bakes_the_same(addon: ModuleType, obj: bpy.types.Object) -> None:
    before = bytes(obj.fragmotion.policy)
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    first, second = addon.compat.core.core.Character.from_bytes(before), addon.character.building.load(obj)
    np.testing.assert_array_equal(first.table, second.table)
    np.testing.assert_array_equal(first.labels, second.labels)


def test_a_bake_never_writes_into_an_action_of_something_else(obj: bpy.types.Object) -> None:
    light = bpy.data.objects.new("Lamp", None)
    bpy.context.scene.collection.objects.link(light)
    light.location = (1, 2, 3)
    light.keyframe_insert("location", frame=1)
    action = light.animation_data.action
    with pytest.raises(RuntimeError, match="which would be lost"):
        bpy.ops.fragmotion.bake(action=action.name, seconds=1)
    light.location = (0, 0, 0)
    bpy.context.scene.frame_set(1)
    assert tuple(light.location) == (1, 2, 3)


def test_a_bake_replaces_its_own_action_but_never_a_take(obj: bpy.types.Object) -> None:
    assert bpy.ops.fragmotion.bake(action="My Run", seconds=4) == {"FINISHED"}
    count = len(bpy.data.actions)
    bpy.ops.fragmotion.tick_actions(use=True)
    assert not obj.animation_data.action.fragmotion.use, "a bake is not offered to learn from"
    assert bpy.ops.fragmotion.bake(action="My Run", seconds=1) == {"FINISHED"}
    assert len(bpy.data.actions) == count
    assert tuple(obj.animation_data.action.frame_range) == (1, 31)
    take = next(action for action in bpy.data.actions if action.fragmotion.use)
    before = making.contents()
    with pytest.raises(RuntimeError, match=f"'{take.name}' is a take"):
        bpy.ops.fragmotion.bake(action=take.name)
    assert making.contents() == before


def test_a_bake_is_written_in_each_bones_rotation_mode(addon: ModuleType, obj: bpy.types.Object) -> None:
    fields = {"player": "runner", "seconds": 3, "seed": 2}
    assert bpy.ops.fragmotion.bake(action="quaternions", **fields) == {"FINISHED"}
    names = obj.pose.bones.keys()
    expected = making.blender_poses(obj, bpy.data.actions["quaternions"], (1, 40, 90), names)
    for index, bone in enumerate(obj.pose.bones):
        bone.rotation_mode = ("XYZ", "AXIS_ANGLE", "ZYX", "QUATERNION")[index % 4]
    assert bpy.ops.fragmotion.bake(action="mixed", **fields) == {"FINISHED"}
    mixed = bpy.data.actions["mixed"]
    channels = {curve.data_path.rpartition(".")[2] for curve in addon.compat.versions.curves_of(mixed, obj)}
    assert channels == {"location", "rotation_quaternion", "rotation_euler", "rotation_axis_angle"}
    np.testing.assert_allclose(making.blender_poses(obj, mixed, (1, 40, 90), names), expected, atol=1e-4)


def test_a_cancelled_build_changes_nothing(addon: ModuleType, obj: bpy.types.Object) -> None:
    before = making.contents()
    job = addon.jobs.Job("test", addon.character.building.prepare(bpy.context, obj, obj.fragmotion.build).task)
    heard = []

    def stop(fraction: float) -> None:
        heard.append(fraction)
        if fraction > 0.1:
            job.cancel()

    job.run(stop)
    with pytest.raises(addon.compat.core.core.Cancelled):
        job.result()
    assert 0.1 < max(heard) < 0.9, "it was not stopped in the middle"
    assert making.contents() == before


def test_the_cancel_button_stops_the_build(
    addon: ModuleType, obj: bpy.types.Object, monkeypatch: pytest.MonkeyPatch
) -> None:
    button = addon.operators.base.background
    assert not bpy.ops.fragmotion.cancel.poll()
    build = addon.character.building.core.build
    stages = []

    def press_cancel(skeleton: object, clips: object, traces: object, options: object, progress: object) -> object:
        def spy(fraction: float, stage: str) -> bool:
            stages.append(stage)
            if fraction > 0.1 and not button.current._cancelled.is_set():
                assert bpy.ops.fragmotion.cancel() == {"FINISHED"}
            return progress(fraction, stage)

        return build(skeleton, clips, traces, options, spy)

    monkeypatch.setattr(addon.character.building.core, "build", press_cancel)
    before = making.contents()
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"CANCELLED"}
    assert stages and making.contents() == before
    assert button.current is None and bpy.ops.fragmotion.build.poll()


def test_a_build_in_the_background_ends_with_the_same_character(addon: ModuleType, obj: bpy.types.Object) -> None:
    job = addon.jobs.Job("test", addon.character.building.prepare(bpy.context, obj, obj.fragmotion.build).task)
    job.start()
    job.wait()
    built = job.result()
    assert not job.running and job.fraction >= 0.95
    np.testing.assert_array_equal(built.character.table, addon.character.building.load(obj).table)


def test_build_says_that_a_stand_is_none_of_an_idle(
    addon: ModuleType, obj: bpy.types.Object, capfd: pytest.CaptureFixture[str]
) -> None:
    """Here the Action of that name walks."""
    for action in bpy.data.actions:
        action.fragmotion.use = action.name in ("stand", "walk forward")
    walk, stand = bpy.data.actions["walk forward"], bpy.data.actions["stand"]
    for names, said in ((("Hero|Idle", "nod"), True), (("midlength", "nod"), False), (("walk", "Idle_01"), False)):
        walk.name, stand.name = names
        assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
        assert ("stands as in 'nod', not as in 'Hero|Idle'" in capfd.readouterr().out) == said


def test_build_leaves_out_what_only_stands_where_an_idle_does_and_says_so(
    addon: ModuleType, obj: bpy.types.Object, capfd: pytest.CaptureFixture[str]
) -> None:
    stand = bpy.data.actions["stand"]
    act = stand.copy()
    for action in bpy.data.actions:
        action.fragmotion.use = action in (stand, act, bpy.data.actions["walk forward"])
    for names, said in ((("Hero|Idle", "Hero|Wave"), True), (("Hero|Rest", "Hero|Wave"), False)):
        stand.name, act.name = names
        assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
        text = "'Hero|Idle' is how it stands; what does nothing but stand besides is left out: 'Hero|Wave'"
        assert (text in capfd.readouterr().out) == said
        character = addon.character.building.load(obj)
        learned = {character.clip_names[clip] for clip in character.fragment_clips}
        assert ("Hero|Wave" in learned) != said
