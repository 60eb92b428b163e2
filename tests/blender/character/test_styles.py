# SPDX-License-Identifier: MIT
"""Styles: of takes, of the character that is built of them, and while it is driven, replayed, baked and copied."""

from __future__ import annotations

import math
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import driving
import making
import numpy as np
import pytest

NEUTRAL, PROUD, TIRED = 0, 1, 2
NAMES = ["neutral", "proud", "tired"]
WALK = (0.0, 1.0, 0.0, 0.0)


def part(addon: ModuleType, name: str) -> Any:
    return import_module(f"{addon.__name__}.{name}")


@pytest.fixture(scope="module")
def styled(addon: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The sample file after Build with the takes of all its styles, without its moves, saved."""
    obj = making.open_sample()
    assert bpy.ops.fragmotion.tick_actions(use=True) == {"FINISHED"}
    obj.fragmotion.moves.clear()
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=40) == {"FINISHED"}
    path = tmp_path_factory.mktemp("styled") / "styled.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


@pytest.fixture
def obj(addon: ModuleType, styled: Path) -> Iterator[bpy.types.Object]:
    """The armature in that file, active."""
    part(addon, "character.building").forget()
    bpy.ops.wm.open_mainfile(filepath=str(styled))
    return bpy.context.view_layer.objects.active


@pytest.mark.parametrize(
    ("styles", "groups"),
    [
        (["", ""], [("", [0, 1])]),
        (["b", "", "a", "b"], [("neutral", [1]), ("a", [2]), ("b", [0, 3])]),
        (["neutral", ""], [("", [0, 1])]),
        (["tired"], [("tired", [0])]),
    ],
)
def test_takes_are_grouped_by_their_styles(addon: ModuleType, styles: list[str], groups: list[Any]) -> None:
    grouped = part(addon, "mocap.styles").grouped
    assert grouped((style, index) for index, style in enumerate(styles)) == groups


@pytest.mark.parametrize(
    ("name", "pattern", "fits"),
    [("walk_tired_1", "*_tired_*", True), ("Walk_TIRED_1", "*_tired_*", True), ("tired walk", "*_tired_*", False)],
)
def test_a_pattern_fits_names(addon: ModuleType, name: str, pattern: str, fits: bool) -> None:
    assert part(addon, "mocap.styles").fits_pattern(name, pattern) == fits


def test_takes_get_styles_by_hand_and_by_pattern(addon: ModuleType) -> None:
    making.open_sample()
    bpy.ops.fragmotion.tick_actions(use=False)
    bpy.ops.fragmotion.tick_actions(use=True, search="run")
    before = {action.name: action.fragmotion.style for action in bpy.data.actions}
    assert bpy.ops.fragmotion.set_style(style="happy") == {"FINISHED"}
    assert all((action.fragmotion.style == "happy") == ("run" in action.name) for action in bpy.data.actions)
    assert bpy.ops.fragmotion.set_style(style="", pattern="*JUMP*") == {"FINISHED"}
    styles = {action.name: action.fragmotion.style for action in bpy.data.actions}
    assert styles["jump up"] == styles["tired jump up"] == "" and styles["tired stand"] == before["tired stand"]
    with pytest.raises(RuntimeError, match=r"No take's name fits '\*dance\*'"):
        bpy.ops.fragmotion.set_style(style="happy", pattern="*dance*")
    bpy.ops.fragmotion.tick_actions(use=False)
    with pytest.raises(RuntimeError, match="No take is ticked"):
        bpy.ops.fragmotion.set_style(style="happy")


def test_a_folder_of_folders_tells_styles(addon: ModuleType, tmp_path: Path) -> None:
    for seed, style in enumerate(("happy", "tired"), 1):
        (tmp_path / style).mkdir()
        making.write_bvh(tmp_path / style / f"walk {seed}.bvh", seed=seed)
    assert bpy.ops.fragmotion.import_mocap(directory=str(tmp_path), style="FOLDER") == {"FINISHED"}
    assert {action.name: action.fragmotion.style for action in bpy.data.actions} == {
        "walk 1": "happy",
        "walk 2": "tired",
    }


def test_a_build_has_the_styles_of_its_takes(addon: ModuleType, obj: bpy.types.Object) -> None:
    building, core = part(addon, "character.building"), part(addon, "compat.core").core
    character = building.load(obj)
    assert character.style_names == NAMES == [row.name for row in obj.fragmotion.figures.styles]
    assert [row.classes for row in obj.fragmotion.figures.styles] == [40, 40, 40]
    assert all(row.quality > 85 for row in obj.fragmotion.figures.styles)
    settings = obj.fragmotion.build
    settings.classes = 40
    material = building.gather(bpy.context, obj, settings)
    alone = core.build(material.rig.skeleton, material.styles[TIRED][1], material.traces, material.options)
    np.testing.assert_array_equal(character.in_style(TIRED).table, alone.table)
    np.testing.assert_array_equal(character.in_style(TIRED).match, alone.match)


def test_each_style_has_its_coverage(addon: ModuleType, obj: bpy.types.Object) -> None:
    building, core = part(addon, "character.building"), part(addon, "compat.core").core
    character, rows = building.load(obj), obj.fragmotion.figures.styles
    kept_layout = part(addon, "character.control_layout").kept_layout
    for number, row in enumerate(rows):
        distances = character.in_style(number).coverage_distances
        np.testing.assert_array_equal(np.frombuffer(row.distances, np.float32), distances.astype(np.float32))
        assert kept_layout(row) == kept_layout(obj.fragmotion.figures)
        assert sum(sum(kind.total) for kind in row.coverage) == len(distances)
        done = sum(core.abilities(character.in_style(number)))
        assert row.performed == sum(sum(kind.performed) for kind in row.coverage) == done
    assert rows[NEUTRAL].performed > rows[TIRED].performed > 0


def test_the_style_that_is_shown_is_one_that_there_is(addon: ModuleType, obj: bpy.types.Object) -> None:
    figures = obj.fragmotion.figures
    bpy.context.view_layer.objects.active = making.add_mesh(obj)  # whose panel is the armature's
    figures.shown_style = str(TIRED)
    assert figures.shown_style == str(TIRED)
    figures.styles.remove(TIRED)
    assert figures.shown_style == str(PROUD)
    figures.styles.clear()
    assert figures.shown_style == ""


def test_the_classes_of_each_style_are_listed(addon: ModuleType, obj: bpy.types.Object) -> None:
    classes, building = part(addon, "character.classes"), part(addon, "character.building")
    for number, styled in enumerate(building.in_styles(building.load(obj))):
        obj.fragmotion.figures.shown_style = str(number)
        rows = classes.shown_rows(obj)
        assert [row.name for row in rows] == styled.class_names
        assert [row.fragments for row in rows] == np.bincount(styled.labels).tolist()


@pytest.mark.thorough
def test_classes_of_a_style_are_named_and_left_out_for_themselves(addon: ModuleType, obj: bpy.types.Object) -> None:
    classes, building = part(addon, "character.classes"), part(addon, "character.building")
    whole = building.load(obj)
    often = int(np.bincount(whole.in_style(TIRED).table.ravel()).argmax())
    row = classes.rows_of(obj, TIRED)[often]
    row.name, row.excluded = "trudge", True
    left = building.load(obj)
    assert building.load(obj) is left is building.load_to_draw(obj), "it is made again for each call"
    assert not (left.in_style(TIRED).table == often).any()
    for style in (NEUTRAL, PROUD):
        assert (left.in_style(style).table == whole.in_style(style).table).all()
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=30) == {"FINISHED"}
    named = [row.name for row in classes.rows_of(obj, TIRED) if row.excluded]
    assert named == ["trudge"] and classes.all_excluded(obj)[0][0] == TIRED


def test_a_file_that_lists_the_classes_of_one_style_alone_drives(addon: ModuleType, obj: bpy.types.Object) -> None:
    inspector, building = part(addon, "character.inspector"), part(addon, "character.building")
    for style in obj.fragmotion.figures.styles:
        style.rows.clear()
    obj.fragmotion.figures.shown_style = str(TIRED)
    settings = bpy.context.window_manager.fragmotion.inspector
    assert building.load(obj).style_names == NAMES
    assert inspector.explain(obj, inspector.decision(obj, settings, 99))[0].name.startswith("Class ")
    obj.fragmotion.figures.styles.remove(TIRED)
    with pytest.raises(addon.errors.UserError, match="lists 2 styles, but its policy has 3: press Build again"):
        building.load(obj)


def test_the_inspector_explains_the_style_that_is_shown(addon: ModuleType, obj: bpy.types.Object) -> None:
    inspector, core = part(addon, "character.inspector"), part(addon, "compat.core").core
    settings, character = bpy.context.window_manager.fragmotion.inspector, part(addon, "character.building").load(obj)
    for style in (TIRED, NEUTRAL):
        obj.fragmotion.figures.shown_style = str(style)
        what = inspector.decision(obj, settings, 7)
        styled = character.in_style(style)
        lines = inspector.explain(obj, what)
        best = [each.next for each in core.Explainer(styled)(7, what.control)][: inspector.BEST]
        assert (what.style, what.playing, what.live) == (style, 7, False)
        assert [line.number for line in lines][: inspector.BEST] == best
        assert [line.name for line in lines] == [styled.class_names[line.number] for line in lines]
        assert [line.number for line in lines if line.chosen] == [styled.table[7, what.control]]


def test_the_inspector_and_force_are_of_the_style_that_is_driven(
    addon: ModuleType, session: ModuleType, obj: bpy.types.Object
) -> None:
    inspector, classes = part(addon, "character.inspector"), part(addon, "character.classes")
    settings, driven = bpy.context.window_manager.fragmotion.inspector, driving.start(session, obj)
    driven.styling.want(TIRED)
    driving.go_on(driven, 1.5)
    what = inspector.decision(obj, settings, 0)
    assert (what.style, what.playing, what.live) == (TIRED, driven.player.playing[0], True)
    rows = classes.rows_of(obj, TIRED)
    assert all(line.name == rows[line.number].name for line in inspector.explain(obj, what))
    assert not bpy.ops.fragmotion.force_class.poll(), "the list is of another style"
    obj.fragmotion.figures.shown_style = str(TIRED)
    assert bpy.ops.fragmotion.force_class(number=9) == {"FINISHED"}
    played = set()
    for _ in range(30):
        driving.go_on(driven, 1 / driving.RATE)
        played.add((driven.player.playing_style, driven.player.playing[0]))
    assert (TIRED, 9) in played


def test_a_preview_is_of_the_style_that_is_shown(addon: ModuleType, obj: bpy.types.Object) -> None:
    character = part(addon, "character.building").load(obj)
    solo = part(addon, "preview.class_preview").ClassPreview(bpy.context, obj, 5, TIRED)
    members = set(np.flatnonzero(character.in_style(TIRED).labels == 5).tolist())
    for _ in range(20):
        solo.step(1 / 8)
        assert solo.playing[0] == 5 and solo.playing[1] in members
    solo.end()


def test_another_style_of_a_take_makes_the_character_stale(addon: ModuleType, obj: bpy.types.Object) -> None:
    is_stale = part(addon, "character.staleness").is_stale
    looks = range(len(bpy.data.actions) + 1)
    assert not any(is_stale(obj) for _ in looks)
    bpy.data.actions["tired stand"].fragmotion.style = "weary"
    assert any(is_stale(obj) for _ in looks)


@pytest.mark.thorough
def test_a_style_that_cannot_be_built_is_named_and_nothing_changes(addon: ModuleType, obj: bpy.types.Object) -> None:
    for action in bpy.data.actions:
        fragmotion = action.fragmotion
        fragmotion.use = fragmotion.use and not fragmotion.style and action.name != "stand"
    short = bpy.data.actions["stand"]
    short.fragmotion.use, short.fragmotion.style = True, "frozen"
    short.use_frame_range, short.frame_end = True, short.frame_start + 2
    policy = obj.fragmotion.policy
    with pytest.raises(RuntimeError, match='style "frozen": '):
        bpy.ops.fragmotion.build("EXEC_DEFAULT")
    assert obj.fragmotion.policy == policy
    assert [row.name for row in obj.fragmotion.figures.styles] == NAMES


def test_a_style_without_gaits_of_the_others_is_told(addon: ModuleType, capfd: pytest.CaptureFixture[str]) -> None:
    making.open_sample()
    for action in bpy.data.actions:
        action.fragmotion.use = action.name in {"stand", "walk forward", "run forward", "jump up", "tired stand"}
    bpy.data.actions["tired stand"].fragmotion.style = "frozen"
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=4, synthesize=False) == {"FINISHED"}
    told = capfd.readouterr().out
    assert "Style 'frozen' has no takes to make these of, and does what comes nearest: Walk ahead" in told
    assert "Run ahead, Jump" in told and "Style 'neutral' has no takes" not in told


def test_keys_and_buttons_change_the_style_of_a_drive(
    addon: ModuleType, session: ModuleType, obj: bpy.types.Object
) -> None:
    driven = driving.start(session, obj)
    rows = part(addon, "drive.hud.figures").rows
    assert ("Style", "neutral") in rows(driven.shown())
    walk = driven.actor.space.walk
    driven.styling.step_by(-1)
    driving.go_on(driven, 1.0)
    assert ("Style", "tired") in rows(driven.shown())
    assert driven.actor.space.walk < 0.9 * walk, "half way the stick is that style's walk"
    assert bpy.ops.fragmotion.change_style(style=PROUD) == {"FINISHED"}
    driving.go_on(driven, 1.0)
    assert driven.player.playing_style == PROUD
    with pytest.raises(RuntimeError, match="There is no style 3"):
        bpy.ops.fragmotion.change_style(style=3)
    driven.styling.step_by(-1)
    driving.go_on(driven, 1.0)
    assert driven.player.playing_style == NEUTRAL


def test_the_ghost_goes_as_the_style_that_plays(session: ModuleType, obj: bpy.types.Object) -> None:
    driven = driving.start(session, obj)
    neutral = driven.actor.space.turn_rate
    driven.styling.want(TIRED)
    driving.go_on(driven, 1.0)
    tired = driven.actor.space.turn_rate
    assert driven.player.playing_style == TIRED and tired != pytest.approx(neutral, rel=0.01)
    before = driven.readings.ideal.frame[2]
    driven.play(np.tile([0.0, 0.0, 1.0, 0.0], (10, 1)), styled=session.Styled(TIRED))
    driving.go_on(driven, 1.0)
    assert driven.readings.ideal.frame[2] - before == pytest.approx(tired, rel=1e-6)


def test_a_click_is_walked_to_at_the_pace_of_the_style_that_plays(session: ModuleType, obj: bpy.types.Object) -> None:
    driven = driving.start(session, obj)
    driven.walk_to((0.0, -20.0))
    driving.go_on(driven, 2.0)
    driven.styling.want(TIRED)
    driving.go_on(driven, 3.0)
    assert driven.player.playing_style == TIRED and driven.inputs.label == "Click on the ground"
    assert math.hypot(*driven.control[:2]) == pytest.approx(driven.actor.space.walk, rel=1e-3)


def record(session: ModuleType, obj: bpy.types.Object) -> Any:
    """Three seconds of a walk that becomes tired after one."""
    driven = driving.start(session, obj)
    driving.go_on(driven, 0.5)
    driven.toggle_recording()
    driven.inputs.keyboard.press("W")
    driving.go_on(driven, 1)
    driven.styling.want(TIRED)
    driving.go_on(driven, 2)
    assert driven.player.playing_style == TIRED
    driven.toggle_recording()
    session.stop()
    return obj.fragmotion.recordings[0]


def test_a_recording_keeps_its_styles_and_is_replayed_with_them(
    addon: ModuleType, session: ModuleType, obj: bpy.types.Object
) -> None:
    recordings, building = part(addon, "recordings.recordings"), part(addon, "character.building")
    recording = record(session, obj)
    assert recording.style == "neutral"
    assert recordings.styles_of(recording) == [(10, "tired")]
    _, shown = recordings.shown_of(recording)
    player = building.make_player(obj, building.load(obj), recording.seed, recording.policy)
    player.reset(*recording.start)
    ran = player.run(recordings.trace_of(recording), 60, styles=[[10, TIRED]])
    count = min(len(ran.root_positions), len(shown.root_positions))
    np.testing.assert_allclose(ran.root_positions[:count], shown.root_positions[:count], atol=1e-5)
    again = driving.recorded(session).replay(bpy.context, obj, recording)
    roots = []
    for _ in range(count - 2):
        driving.go_on(again, 1 / 60)
        roots.append(driving.hips(obj))
    assert again.player.playing_style == TIRED
    session.stop()
    np.testing.assert_allclose(np.array(roots)[:, 2], shown.root_positions[1 : count - 1, 2], atol=0.02)


def baked(obj: bpy.types.Object, **fields: Any) -> np.ndarray:
    """Where Blender shows the head bone of a bake, in each frame [F,3]."""
    assert bpy.ops.fragmotion.bake("EXEC_DEFAULT", **fields) == {"FINISHED"}
    first, last = (round(frame) for frame in obj.animation_data.action.frame_range)
    places = []
    for frame in range(first, last + 1):
        bpy.context.scene.frame_set(frame)
        posed = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
        places.append(np.array(posed.matrix_world @ posed.pose.bones["head"].tail))
    return np.array(places)


def test_a_bake_plays_a_recordings_styles(addon: ModuleType, obj: bpy.types.Object) -> None:
    recordings, styles = part(addon, "recordings.recordings"), part(addon, "recordings.styles")
    obj.fragmotion.bake.trace_source, obj.fragmotion.bake.as_recorded = "RECORDING", False
    trace = np.tile(np.array(WALK), (60, 1))
    recordings.add_recording(obj, trace, name="Tiring", style="proud", styles=[styles.StyleChange(30, "tired")])
    heads = baked(obj)
    assert heads[:20, 2].mean() > heads[-20:, 2].mean() + 0.03, "a tired head hangs"


def test_a_bake_has_the_style_that_is_asked_for(addon: ModuleType, obj: bpy.types.Object) -> None:
    heights = [baked(obj, trace_source="PLAYER", seconds=3, style=name)[:, 2].mean() for name in ("", *NAMES)]
    assert heights[0] == heights[1] and heights[3] < min(heights[:3]) - 0.06
    with pytest.raises(RuntimeError, match="has no style 'happy': its styles are neutral, proud, tired"):
        bpy.ops.fragmotion.bake("EXEC_DEFAULT", trace_source="PLAYER", style="happy")


def test_a_recording_of_a_style_that_is_gone_is_baked_and_that_is_said(
    addon: ModuleType, obj: bpy.types.Object, capfd: pytest.CaptureFixture[str]
) -> None:
    recordings, styles = part(addon, "recordings.recordings"), part(addon, "recordings.styles")
    trace = np.tile(np.array(WALK), (20, 1))
    lost = [styles.StyleChange(5, "happy"), styles.StyleChange(9, "tired")]
    recordings.add_recording(obj, trace, name="Happy", style="sad", styles=lost)
    numbered = recordings.numbered_styles(obj.fragmotion.recordings[0], NAMES)
    assert numbered == (NEUTRAL, [[9, TIRED]], "without style 'happy', which the character does not have")
    obj.fragmotion.bake.as_recorded = False
    baked(obj, trace_source="RECORDING")
    assert "without style 'happy', which the character does not have" in capfd.readouterr().out


def test_a_crowd_draws_styles(addon: ModuleType, obj: bpy.types.Object) -> None:
    former = set(bpy.data.objects)
    assert bpy.ops.fragmotion.populate(count=8, seconds=1, seed=3) == {"FINISHED"}
    added = [o for o in bpy.data.objects if o not in former and o.type == "ARMATURE"]
    bpy.context.scene.frame_set(1)
    bpy.context.view_layer.update()
    heads = [(o.matrix_world @ o.pose.bones["head"].tail).z for o in added]
    assert np.ptp(heads) > 0.06
    assert bpy.ops.fragmotion.populate(count=4, seconds=1, seed=3, mix_styles=False) == {"FINISHED"}
    bpy.context.view_layer.update()
    alike = [
        (o.matrix_world @ o.pose.bones["head"].tail).z for o in set(bpy.data.objects) - former - set(added) if o.pose
    ]
    assert np.ptp(alike) < 0.03


def test_recordings_keep_their_styles_when_they_are_trimmed_and_copied(
    addon: ModuleType, obj: bpy.types.Object
) -> None:
    recordings, styles = part(addon, "recordings.recordings"), part(addon, "recordings.styles")
    changes = [styles.StyleChange(5, "tired"), styles.StyleChange(20, "proud"), styles.StyleChange(35, "tired")]
    recording = recordings.add_recording(obj, np.zeros((40, 4)), style="proud", styles=changes)
    recordings.trim_recording(recording, 1, 3)
    assert (recording.style, recordings.styles_of(recording)) == ("tired", [(10, "proud")])
    copy = recordings.duplicate_recording(obj, 0)
    assert (copy.style, recordings.styles_of(copy)) == ("tired", [(10, "proud")])


@pytest.mark.parametrize(
    "forged",
    ["nonsense", "5", "[[1]]", '[["1", "a"]]', "[[1, 2]]", '[[99, "a"]]', "{}{", *making.OTHER_JSON],
)
def test_forged_styles_of_a_recording_are_refused(addon: ModuleType, obj: bpy.types.Object, forged: str) -> None:
    recordings = part(addon, "recordings.recordings")
    recording = recordings.add_recording(obj, np.zeros((40, 4)))
    recording.styles = forged
    with pytest.raises(addon.errors.UserError, match="is damaged"):
        recordings.styles_of(recording)


def test_a_policy_file_brings_its_styles(addon: ModuleType, obj: bpy.types.Object, tmp_path: Path) -> None:
    path = str(tmp_path / "styled.policy")
    assert bpy.ops.fragmotion.save_policy(filepath=path) == {"FINISHED"}
    obj.fragmotion.figures.styles.clear()
    assert bpy.ops.fragmotion.load_policy(filepath=path) == {"FINISHED"}
    assert [row.name for row in obj.fragmotion.figures.styles] == NAMES
    assert part(addon, "character.building").load(obj).style_names == NAMES


@pytest.mark.thorough
def test_moves_and_classes_left_out_leave_the_styles(addon: ModuleType, obj: bpy.types.Object) -> None:
    moves, building = part(addon, "character.moves"), part(addon, "character.building")
    moves.add_move(bpy.context, obj, bpy.data.actions["jump up"], None, [])
    assert building.load(obj).style_names == NAMES and building.load(obj).move_names == ["jump up"]
    obj.fragmotion.classes[3].excluded = True
    assert building.load(obj).style_names == NAMES
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=40) == {"FINISHED"}
    assert building.load(obj).style_names == NAMES and building.load(obj).move_names == ["jump up"]
