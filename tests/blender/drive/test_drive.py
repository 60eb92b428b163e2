# SPDX-License-Identifier: MIT
"""A drive without its window: the armature follows the inputs, and what is recorded replays."""

from __future__ import annotations

import math
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import driving
import making
import numpy as np
import pytest
from driving import RATE, go_on, hips, start, way


@pytest.fixture(scope="module")
def built(addon: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A file with a small character, which goes where it is told."""
    folder = tmp_path_factory.mktemp("built")
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    making.write_gaits(folder)
    assert bpy.ops.fragmotion.import_mocap(directory=str(folder)) == {"FINISHED"}
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=24, seconds=20.0, synthesize=False) == {"FINISHED"}
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "built.blend"))
    return folder / "built.blend"


def test_before_build_the_body_slides_as_the_stick_says(session: ModuleType) -> None:
    obj = making.add_armature()
    obj.location, obj.rotation_euler = (1, 2, 0), (0, 0, 0.5)
    driven = start(session, obj)
    begin, space = hips(obj), driven.actor.space
    driven.inputs.keyboard.press("W")
    go_on(driven, 2)
    forward = np.array((math.sin(0.5), -math.cos(0.5), 0))  # it faces its -Y
    np.testing.assert_allclose(hips(obj), begin + 2 * space.walk * forward, atol=1e-4)
    driven.inputs.keyboard.press("LEFT_SHIFT")
    go_on(driven, 1)
    np.testing.assert_allclose(hips(obj), begin + (2 * space.walk + space.run) * forward, atol=1e-4)
    driven.inputs.keyboard.release()
    driven.inputs.keyboard.press("Q")
    go_on(driven, 1)
    foot = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).pose.bones["foot.L"]
    toes = np.array(obj.matrix_world.to_3x3() @ (foot.tail - foot.head))[:2]
    assert math.remainder(math.atan2(toes[1], toes[0]) - (0.5 - math.pi / 2 + space.turn_rate), 2 * math.pi) == (
        pytest.approx(0, abs=1e-4)
    )


def test_the_armature_shows_what_the_player_plays(
    addon: ModuleType, session: ModuleType, obj: bpy.types.Object
) -> None:
    driven = start(session, obj)
    driven.play(addon.compat.core.core.simulate_trace("runner", 5.0, 3, driven.actor.space))
    places = [hips(obj)]
    for _ in range(10):
        go_on(driven, 0.3)
        x, y, _ = driven.player.frame
        places.append(hips(obj))
        np.testing.assert_allclose(places[-1][:2], (x, y), atol=1e-4)
    assert way(places) > 6, "a runner in three seconds"


@pytest.mark.parametrize(
    ("keys", "velocity"),  # x and y in m/s, heading in rad/s; it faces -y
    [
        ("W", (0, -making.WALK, 0)),
        ("S", (0, making.WALK, 0)),
        ("A", (making.WALK, 0, 0)),
        ("D", (-making.WALK, 0, 0)),
        (("W", "LEFT_SHIFT"), (0, -making.RUN, 0)),
        ("Q", (0, 0, making.TURN)),
        ("E", (0, 0, -making.TURN)),
    ],
)
def test_the_character_goes_where_it_is_told(
    session: ModuleType, obj: bpy.types.Object, keys: Sequence[str], velocity: tuple[float, float, float]
) -> None:
    driven = start(session, obj)
    for key in keys:
        driven.inputs.keyboard.press(key)
    go_on(driven, 1)
    begin = np.array(driven.player.frame)
    go_on(driven, 2)
    np.testing.assert_allclose((driven.player.frame - begin) / 2, velocity, atol=0.1)


def test_the_motion_does_not_depend_on_how_often_the_screen_is_drawn(
    session: ModuleType, obj: bpy.types.Object
) -> None:
    places = []
    for rate in (60, 30, 144, 20):
        driven = start(session, obj)
        driven.inputs.keyboard.press("W")
        go_on(driven, 2, rate)
        places.append(driven.player.frame)
    assert places[0][1] < -1.8, "two seconds of a walk forward"
    np.testing.assert_allclose(places, [places[0]] * 4, atol=0.1)
    assert places[0] == places[1] == places[3]


def test_a_drive_begins_where_the_character_stands_or_at_the_origin(
    addon: ModuleType, session: ModuleType, obj: bpy.types.Object
) -> None:
    take = next(action for action in bpy.data.actions if action.name.startswith("gait 5"))
    making.play(obj, take, 60)
    obj.location, obj.rotation_euler.z = (2, -1, 0), 0.7
    bpy.context.view_layer.update()
    stands = hips(obj)
    driven = start(session, obj)
    assert math.dist(stands[:2], (2, -1)) > 1, "the take has gone away from the origin"
    np.testing.assert_allclose(driven.actor.frame[:2], stands[:2], atol=0.15)
    forward = making.play(obj, take, 62) and hips(obj) - stands
    assert math.remainder(driven.actor.frame[2] - math.atan2(-forward[0], forward[1]), 2 * math.pi) == (
        pytest.approx(0, abs=0.2)
    )
    session.stop()
    obj.fragmotion.drive.start = "ORIGIN"
    driven = start(session, obj)
    np.testing.assert_allclose(driven.actor.frame, addon.bake.performing.origin_frame(obj), atol=1e-6)


def test_a_long_pause_does_not_make_the_character_leap(session: ModuleType) -> None:
    driven = start(session, making.add_armature())
    driven.inputs.keyboard.press("W")
    driven.update(30.0)
    assert np.linalg.norm(hips(driven.obj)[:2]) == pytest.approx(0.1 * driven.actor.space.walk, rel=0.01)


def record(driven: Any) -> list[tuple[float, float, float]]:
    """Record some keys, and a tap on the jump button; the character frames that were seen."""
    seen = []
    driven.toggle_recording()
    for key, seconds in (("W", 0.4), ("A", 0.35), ("LEFT_SHIFT", 0.8), ("SPACE", 0.03), ("E", 1.02)):
        driven.inputs.keyboard.press(key)
        for _ in range(round(seconds * RATE)):
            driven.update(1 / RATE)
            seen.append(driven.player.frame)
        driven.inputs.keyboard.let_go("SPACE")
    driven.toggle_recording()
    return seen


def test_what_is_recorded_replays_as_it_was_seen(addon: ModuleType, session: ModuleType, obj: bpy.types.Object) -> None:
    driven = start(session, obj)
    go_on(driven, 0.5)
    begin, seen = driven.player.frame, record(driven)
    (recording,) = obj.fragmotion.recordings
    trace = import_module(f"{addon.__name__}.recordings.recordings").trace_of(recording)
    assert len(trace) == math.ceil(len(seen) / 6) == 26
    assert trace[:, 3].sum() == 1, "the tap on the jump button is lost, or lasts"
    assert tuple(recording.start) == pytest.approx(begin) and recording.policy == driven.actor.character.policy
    player = addon.compat.core.core.Player(driven.actor.character, recording.seed)
    player.reset(*begin)
    performance = player.run(trace, RATE)
    assert way(seen) > 2, "the character stood while it was recorded"
    np.testing.assert_allclose(performance.path[1 : len(seen) + 1, :2], np.array(seen)[:, :2], atol=1e-9)
    assert recording.quality == pytest.approx(performance.quality, abs=0.01)


def test_a_recording_is_replayed_live(session: ModuleType, obj: bpy.types.Object) -> None:
    driven = start(session, obj)
    seen = record(driven)
    (recording,) = obj.fragmotion.recordings
    driven = driving.recorded(session).replay(bpy.context, obj, recording)
    assert driven.inputs.label == "Trace" and driven.seed == recording.seed
    replayed = []
    for _ in seen:
        driven.update(1 / RATE)
        replayed.append(driven.player.frame)
    assert way(replayed) > 2
    np.testing.assert_allclose(replayed, seen, atol=1e-4)
    go_on(driven, 1)
    assert driven.control == (0, 0, 0, 0) and not driven.inputs.trace.playing
    other = driving.recorded(session).replay(bpy.context, obj, recording, seed=7, policy="greedy")
    assert (other.seed, other.actor.policy) == (7, "greedy")


def test_a_replay_says_how_far_it_is(addon: ModuleType, session: ModuleType, obj: bpy.types.Object) -> None:
    recording = addon.recordings.recordings.add_recording(obj, np.tile([0, 1.2, 0, 0], (40, 1)).astype(float))
    driven = driving.recorded(session).replay(bpy.context, obj, recording)
    go_on(driven, 1.5)
    assert driven.playing == "Replaying 1.5 of 4.0 s" and driven.shown().title == "Replaying 1.5 of 4.0 s"
    go_on(driven, 3)
    assert driven.playing == "" and driven.shown().title == f"Driving {obj.name}"
    driven.play(np.tile([0, 1.2, 0, 0], (20, 1)).astype(float))
    go_on(driven, 0.5)
    assert driven.playing == "Playing 0.5 of 2.0 s"


def test_a_recording_that_begins_in_motion_keeps_what_was_seen(
    addon: ModuleType, session: ModuleType, obj: bpy.types.Object
) -> None:
    driven = start(session, obj)
    driven.inputs.keyboard.press("W")
    go_on(driven, 2)
    assert math.hypot(*driven.readings.velocity) == pytest.approx(making.WALK, abs=0.1)
    before = driven.player.frame
    seen = record(driven)
    assert math.dist(before[:2], seen[0][:2]) < 0.1, "the character leaps where the recording begins"
    (recording,) = obj.fragmotion.recordings
    times, motion = import_module(f"{addon.__name__}.recordings.recordings").shown_of(recording)
    np.testing.assert_allclose(times, np.arange(len(seen) + 1) / RATE, atol=1e-5)
    np.testing.assert_allclose(motion.path, [before, *seen], atol=1e-5)


def test_a_recording_under_way_is_kept_when_the_drive_ends(session: ModuleType, obj: bpy.types.Object) -> None:
    bpy.ops.ed.undo_push(message="before")
    driven = start(session, obj)
    driven.toggle_recording()
    driven.inputs.keyboard.press("W")
    go_on(driven, 1)
    session.stop()
    assert [each.seconds for each in obj.fragmotion.recordings] == [1]
    bpy.ops.ed.undo()
    assert not bpy.context.view_layer.objects.active.fragmotion.recordings, "a recording is one undo step"
    bpy.ops.ed.redo()
    assert len(bpy.context.view_layer.objects.active.fragmotion.recordings) == 1


def test_before_build_a_trace_is_recorded_too(addon: ModuleType, session: ModuleType) -> None:
    driven = start(session, making.add_armature())
    driven.toggle_recording()
    driven.inputs.keyboard.press("W")
    go_on(driven, 0.5)
    driven.toggle_recording()
    (recording,) = driven.obj.fragmotion.recordings
    trace = import_module(f"{addon.__name__}.recordings.recordings").trace_of(recording)
    np.testing.assert_allclose(trace, [(0, driven.actor.space.walk, 0, 0)] * 5)
    assert recording.policy == "" and recording.quality == 0


def test_the_figures_say_what_is_asked_and_done(addon: ModuleType, session: ModuleType, obj: bpy.types.Object) -> None:
    figures = import_module(f"{session.__package__}.hud.figures")
    driven = start(session, obj)
    driven.update(1 / RATE)
    assert dict(figures.rows(driven.shown()))["Asked"] == "nothing yet: push a stick, or press W A S D"
    driven.inputs.keyboard.press("W")
    go_on(driven, 3)
    rows = dict(figures.rows(driven.shown()))
    assert list(rows) == ["Asked", "Does", "Time"] and rows["Time"] == "3.0 s"
    assert rows["Asked"] == "walk forward" and rows["Does"].startswith("walk forward")
    driven.toggle_recording()
    go_on(driven, 1)
    assert driven.shown().title == "Recording 1.0 s" and driven.shown().recording
    for _ in range(100):
        driven.update(0.2)
    assert dict(figures.rows(driven.shown()))["Updates"] == "5 a second, too slow: slow motion"


def test_the_box_is_as_wide_as_all_that_it_says(
    session: ModuleType, obj: bpy.types.Object, monkeypatch: pytest.MonkeyPatch
) -> None:
    figures = import_module(f"{session.__package__}.hud.figures")
    monkeypatch.setattr(figures.blf, "dimensions", lambda _font, text: (10.0 * len(text), 10.0))
    driven = start(session, obj)
    driven.update(1 / RATE)
    free = import_module(f"{session.__package__}.hud.views").Free(0, 0, 1000, 800)
    shown = driven.shown()
    assert figures.lay_out(shown._replace(title="Kept"), free, 1.0).width < 600
    assert figures.lay_out(shown._replace(title="K" * 70), free, 1.0).width > 700


def test_details_say_how_well_it_is_done(addon: ModuleType, session: ModuleType, obj: bpy.types.Object) -> None:
    figures = import_module(f"{session.__package__}.hud.figures")
    obj.fragmotion.drive.show_details = True
    driven = start(session, obj)
    driven.inputs.keyboard.press("W")
    go_on(driven, 3)
    rows = dict(figures.rows(driven.shown()))
    assert rows["Input"] == "Keyboard"
    assert rows["Class"].startswith(f"{driven.player.playing[0]}, ")
    judge, character = driven.readings.judge, driven.actor.character
    assert 0 < judge.mean <= 1 and 0 < judge.quality <= 1
    assert 0 <= judge.left <= character.fragment_durations[driven.player.playing[1]]
    assert rows["Updates"].startswith("60 a second") and rows["Updates"].endswith("ms each")


def test_the_status_bar_names_keys_and_buttons(addon: ModuleType, session: ModuleType, obj: bpy.types.Object) -> None:
    told = import_module(f"{addon.__name__}.operators.directing.drive_hints")
    driven = start(session, obj)
    keyboard = {hint.text: hint.keys for hint in told.hints(driven)}
    assert keyboard["Go"] == ("W", "A", "S", "D") and keyboard["Record"] == ("R",) and keyboard["End"] == ("ESC",)
    assert list(keyboard)[:2] == ["End", "Record"] and "Walk There" in keyboard
    driven.settings.click_to_walk = False
    driven.toggle_recording()
    recording = {hint.text: hint.keys for hint in told.hints(driven)}
    assert recording["End Recording"] == ("R",) and "Walk There" not in recording


def test_the_view_is_drawn_anew_only_where_a_step_was_due(session: ModuleType, obj: bpy.types.Object) -> None:
    driven = start(session, obj)
    assert [driven.update(0.25 / RATE) for _ in range(8)].count(True) == 2


def test_while_driving_nothing_else_may_change_the_armature(session: ModuleType, obj: bpy.types.Object) -> None:
    assert bpy.ops.fragmotion.bake.poll() and not bpy.ops.fragmotion.record.poll()
    start(session, obj)
    assert not bpy.ops.fragmotion.bake.poll() and not bpy.ops.fragmotion.build.poll()
    assert not bpy.ops.fragmotion.import_mocap.poll()
    assert bpy.ops.fragmotion.record.poll() and bpy.ops.fragmotion.drive.poll()


def test_the_ghost_goes_just_as_the_trace_says(addon: ModuleType, session: ModuleType, obj: bpy.types.Object) -> None:
    driven = start(session, obj)
    space = driven.actor.space
    driven.play(np.array([(0, space.walk, 0, 0)] * 10 + [(0, 0, 1, 0)] * 10 + [(space.run, 0, 0, 0)] * 10))
    x, y, heading = driven.player.frame
    go_on(driven, 3.05)
    rotate = addon.input.steering.rotate
    ahead, aside = rotate(0, space.walk, heading), rotate(space.run, 0, heading + space.turn_rate)
    wanted = (x + ahead[0] + aside[0], y + ahead[1] + aside[1], heading + space.turn_rate)
    assert driven.readings.ideal.frame == pytest.approx(wanted, abs=1e-6)
    assert driven.readings.ideal_path.points[0] == pytest.approx((x, y), abs=0.1)


def test_the_feet_that_stand_are_seen(session: ModuleType, obj: bpy.types.Object) -> None:
    driven = start(session, obj)
    go_on(driven, 1)
    bpy.context.view_layer.update()
    roles, soles = driven.actor.skeleton.roles, []  # it has no toes
    for side in ("left", "right"):
        foot = obj.pose.bones[roles[f"{side}_foot"]]
        heel, ball = obj.matrix_world @ foot.head, obj.matrix_world @ foot.tail
        soles.append((*(heel + ball).xy / 2, min(heel.z, ball.z)))
    feet = driven.readings.standing_feet
    assert len(feet) == 2, "it stands"
    np.testing.assert_allclose(feet, soles, atol=1e-4)


def test_a_body_that_slides_stands_on_no_foot(session: ModuleType) -> None:
    driven = start(session, making.add_armature())
    go_on(driven, 0.1)
    assert len(driven.readings.standing_feet) == 0


def test_the_time_to_answer_is_measured(session: ModuleType) -> None:
    """A body that slides answers at once; what is measured is the window over which a velocity is taken."""
    driven = start(session, making.add_armature())
    go_on(driven, 1)
    driven.inputs.keyboard.press("W")
    go_on(driven, 1)
    assert 0.05 < driven.readings.stopwatch.seconds < 0.15
