# SPDX-License-Identifier: MIT
"""The classes of a character: listed, renamed, left out, forced, previewed, explained, and how many to build."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType, SimpleNamespace

import bpy
import making
import numpy as np
import pytest
from driving import everything

ARMATURE = "Fragmotion Sample"
NUMBER = 40


def build(classes: int = NUMBER) -> None:
    """A small character from the sample's takes."""
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", True, classes=classes, seconds=20) == {"FINISHED"}


@pytest.fixture(scope="module")
def built(addon: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The sample file after Build, saved."""
    bpy.ops.wm.open_mainfile(filepath=str(making.SAMPLE))
    making.activate(bpy.data.objects[ARMATURE])
    build()
    path = tmp_path_factory.mktemp("built") / "built.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


@pytest.fixture
def obj(addon: ModuleType, built: Path) -> Iterator[bpy.types.Object]:
    """The built armature, after loading the file."""
    addon.character.building.forget()
    bpy.ops.wm.open_mainfile(filepath=str(built))
    armature = bpy.data.objects[ARMATURE]
    making.activate(armature)
    yield armature
    addon.character.classes.session = None


def often(character: object, count: int) -> list[int]:
    """The classes that the driving table says most often."""
    uses = np.bincount(character.table.ravel(), minlength=len(character.representatives))
    return [int(number) for number in np.argsort(-uses, kind="stable")[:count]]


def test_the_classes_are_listed_with_what_they_do(addon: ModuleType, obj: bpy.types.Object) -> None:
    character, rows = addon.character.building.load(obj), obj.fragmotion.classes
    assert [row.name for row in rows] == [row.suggested for row in rows] == character.class_names
    assert [row.fragments for row in rows] == np.bincount(character.labels).tolist()
    assert not any(row.excluded for row in rows)
    assert all(row.sketch and row.described for row in rows)


@pytest.mark.parametrize(
    ("control", "sketch", "words"),
    [
        ((0, 0, 0, 0), "\u00b7", "at rest"),
        ((0, 1.2, 0, 0), "\u21911.2", "1.2 m/s forward"),
        ((-0.9, 0.9, 1, 0), "\u21961.3 L", "0.9 m/s forward, 0.9 m/s left, turning 60\u00b0/s left"),
        ((3, -0.01, -1, 1), "\u21923.0 R J", "3.0 m/s right, turning 60\u00b0/s right, jumping"),
        ((0, -1.0, 0, 0), "\u21931.0", "1.0 m/s back"),
    ],
)
def test_controls_are_told_in_words_and_signs(
    addon: ModuleType, control: tuple[float, ...], sketch: str, words: str
) -> None:
    space = addon.compat.core.core.ControlSpace(turn_rate=np.radians(60))
    assert addon.character.classes.sketch(control, space) == sketch
    assert addon.character.classes.describe(control, space) == words


def test_an_emptied_name_is_the_suggested_one_again(obj: bpy.types.Object) -> None:
    row = obj.fragmotion.classes[3]
    row.name = "my wave"
    assert row.name == "my wave"
    row.name = ""
    assert row.name == row.suggested != ""


def test_what_was_said_of_a_class_goes_with_its_fragment_to_the_next_build(
    addon: ModuleType, obj: bpy.types.Object
) -> None:
    before = addon.character.building.load(obj)
    obj.fragmotion.classes[5].name, obj.fragmotion.classes[7].excluded = "wave", True
    build()
    rows = bpy.data.objects[ARMATURE].fragmotion.classes
    assert rows[5].name == "wave" and [row.excluded for row in rows].index(True) == 7
    build(NUMBER + 5)
    obj = bpy.data.objects[ARMATURE]
    after, rows = addon.character.building.load_whole(obj), obj.fragmotion.classes
    assert len(rows) == NUMBER + 5
    assert rows[int(after.labels[before.representatives[5]])].name == "wave"
    assert [n for n, row in enumerate(rows) if row.excluded] == [int(after.labels[before.representatives[7]])]
    assert sum(row.name != row.suggested for row in rows) == 1


def test_a_class_that_is_left_out_is_neither_driven_nor_baked_nor_saved(
    addon: ModuleType, obj: bpy.types.Object, tmp_path: Path
) -> None:
    whole = addon.character.building.load(obj)
    numbers = often(whole, 4)
    for number in numbers:
        obj.fragmotion.classes[number].excluded = True
    left = addon.character.building.load(obj)
    assert np.isin(whole.table, numbers).any() and not np.isin(left.table, numbers).any()
    assert addon.character.building.load(obj) is left, "it is made again for each call"
    assert (addon.character.building.load_whole(obj).table == whole.table).all()
    assert bpy.ops.fragmotion.bake(seconds=2) == {"FINISHED"}
    assert bpy.ops.fragmotion.save_policy(filepath=str(tmp_path / "left")) == {"FINISHED"}
    assert (addon.compat.core.core.Character.load(tmp_path / "left.policy").table == left.table).all()
    obj.fragmotion.classes[numbers[0]].excluded = False
    assert np.isin(addon.character.building.load(obj).table, numbers[0]).any()


def test_leaving_a_class_out_can_be_undone(addon: ModuleType, obj: bpy.types.Object) -> None:
    bpy.ops.ed.undo_push(message="before")
    obj.fragmotion.classes[2].excluded = True
    bpy.ops.ed.undo_push(message="left out")
    assert addon.character.classes.excluded(obj) == (2,)
    bpy.ops.ed.undo()
    assert addon.character.classes.excluded(bpy.data.objects[ARMATURE]) == ()


def test_leaving_all_classes_out_is_refused(obj: bpy.types.Object) -> None:
    for row in obj.fragmotion.classes:
        row.excluded = True
    with pytest.raises(RuntimeError, match="all classes are excluded"):
        bpy.ops.fragmotion.bake(seconds=1)


def start_session(addon: ModuleType, obj: bpy.types.Object) -> SimpleNamespace:
    """As a drive does."""
    player = addon.compat.core.core.Player(addon.character.building.load(obj))
    addon.character.classes.session = SimpleNamespace(armature=obj.name, player=player, control=(0.0, 3.0, 0.0, 0.0))
    return addon.character.classes.session


def test_a_class_is_forced_while_driving_only(addon: ModuleType, obj: bpy.types.Object) -> None:
    with pytest.raises(RuntimeError, match="not being driven: start Drive first"):
        bpy.ops.fragmotion.force_class()
    session = start_session(addon, obj)
    for chosen, number, expected in ((6, -1, 6), (6, 9, 9)):
        bpy.context.window_manager.fragmotion.active_class = chosen
        assert bpy.ops.fragmotion.force_class(number=number) == {"FINISHED"}
        session.player.step((0, 0, 0, 0), 0.2)
        assert session.player.playing[0] == expected
    with pytest.raises(RuntimeError, match=f"has no class {NUMBER}"):
        bpy.ops.fragmotion.force_class(number=NUMBER)
    making.activate(making.add_armature())
    assert not bpy.ops.fragmotion.force_class.poll(), "another armature's drive is forced"


def test_the_preview_plays_the_class_alone_and_puts_everything_back(addon: ModuleType, obj: bpy.types.Object) -> None:
    obj.pose.bones[3].location = (0.1, 0.2, 0.3)
    bpy.context.scene.frame_set(17)
    before, played = making.contents(), addon.compat.versions.assignment(obj)
    character = addon.character.building.load(obj)
    _, number = min((int(count), label) for label, count in enumerate(np.bincount(character.labels)) if count > 2)
    members = set(np.flatnonzero(character.labels == number).tolist())
    place = obj.matrix_world.copy()
    solo = addon.preview.class_preview.ClassPreview(bpy.context, obj, number)
    seen, poses = set(), []
    for _ in range(40 * len(members)):
        solo.step(1 / 8)
        assert solo.playing[0] == number
        seen.add(solo.playing[1])
        bpy.context.view_layer.update()
        poses.append((obj.matrix_world @ obj.pose.bones["hips"].matrix).translation.copy())
    assert seen == members, "not all of its fragments were shown"
    moved = np.array(poses)
    assert np.ptp(moved, axis=0).max() > 1e-3 and np.linalg.norm(moved[:, :2], axis=1).max() < 5
    solo.end()
    assert making.contents() == before and addon.compat.versions.assignment(obj) == played
    assert obj.matrix_world == place


def test_the_preview_of_a_deleted_armature_says_so_and_ends(addon: ModuleType, obj: bpy.types.Object) -> None:
    armature, name = obj.data, obj.name
    armature.pose_position = "REST"
    solo = addon.preview.class_preview.ClassPreview(bpy.context, obj, 0)
    assert solo.trouble() == "" and armature.pose_position == "POSE"
    bpy.data.objects.remove(obj)
    assert solo.trouble() == f"Armature '{name}' was deleted"
    solo.end()
    assert armature.pose_position == "REST"


@pytest.mark.parametrize("told", [True, False], ids=["saved", "autosaved"])
def test_a_file_that_is_saved_during_a_preview_has_the_armature_as_it_was(
    addon: ModuleType, obj: bpy.types.Object, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, told: bool
) -> None:
    previews = addon.preview.previews
    obj.animation_data.action.use_fake_user = False
    obj.pose.bones[3].location = (0.1, 0.2, 0.3)
    before, path = repr(everything(obj)), tmp_path / "saved.blend"
    previews.show(addon.preview.class_preview.ClassPreview(bpy.context, obj, 0))
    previews.current.step(1 / 8)
    listening = [] if told else list(bpy.app.handlers.save_pre)
    for handler in listening:  # Blender tells nobody of what it saves by itself
        bpy.app.handlers.save_pre.remove(handler)
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
    bpy.app.handlers.save_pre.extend(listening)
    assert (previews.current is None) == told
    previews.stop()
    assert repr(everything(obj)) == before
    assert repr(everything(making.open_armature(path))) == before


def test_a_preview_that_is_too_far_away_says_so(addon: ModuleType, obj: bpy.types.Object) -> None:
    preview, before, said = addon.preview.class_preview.ClassPreview, making.contents(), set()
    obj.location.xy = 1e6, 1e6
    for number in range(len(addon.character.building.load(obj).representatives)):
        try:
            preview(bpy.context, obj, number).end()
        except addon.errors.UserError as error:
            said.add(str(error))
        assert making.contents() == before
    (text,) = said
    assert re.match(f"Armature '{obj.name}': .*more than 1000 km from the origin", text)


def test_the_inspector_shows_the_best_and_the_chosen(addon: ModuleType, obj: bpy.types.Object) -> None:
    core, character = addon.compat.core.core, addon.character.building.load(obj)
    settings = bpy.context.window_manager.fragmotion.inspector
    settings.gait, settings.direction, settings.turn, settings.jump = "run", "0", "2", True
    what = addon.character.inspector.decision(obj, settings, 4)
    _, playing, control, live = what
    assert (playing, live) == (4, False)
    assert character.space.points[control].tolist() == [0, character.space.run, 1, 1]
    lines = addon.character.inspector.explain(obj, what)
    ranked = core.Explainer(character)(playing, control)
    best = [each.next for each in ranked[: addon.character.inspector.BEST]]
    assert [line.number for line in lines[: addon.character.inspector.BEST]] == best
    assert [line.number for line in lines if line.chosen] == [character.table[playing, control]]
    for line, each in zip(lines, ranked):
        assert line.name == obj.fragmotion.classes[each.next].name
        assert line.value == pytest.approx(line.smoothness * line.match + line.future_value)
    assert list(settings.match)[: len(lines)] == pytest.approx([line.match for line in lines])


def test_the_inspector_follows_the_drive(addon: ModuleType, obj: bpy.types.Object) -> None:
    settings, session = bpy.context.window_manager.fragmotion.inspector, start_session(addon, obj)
    space = session.player and addon.character.building.load(obj).space
    expected = (0, session.player.playing[0], int(space.nearest([session.control])[0]), True)
    assert addon.character.inspector.decision(obj, settings, 0) == expected
    settings.follow = False
    assert addon.character.inspector.decision(obj, settings, 0).live is False


def test_the_inspector_offers_no_class_that_is_left_out(addon: ModuleType, obj: bpy.types.Object) -> None:
    what = addon.character.inspector.Decision(0, 0, 8, False)
    first = [line.number for line in addon.character.inspector.explain(obj, what)][:2]
    for number in first:
        obj.fragmotion.classes[number].excluded = True
    lines = addon.character.inspector.explain(obj, what)
    assert not {line.number for line in lines} & set(first) and any(line.chosen for line in lines)


def test_a_fragment_leads_to_its_take_and_frame(addon: ModuleType, obj: bpy.types.Object) -> None:
    character = addon.character.building.load(obj)
    clips, ranges = character.clip_names, character.fragment_ranges
    for origin in ("captured", "mirrored"):
        fragment = 1 + character.fragment_origins.index(origin)
        shown = addon.character.inspector.inspect(character).fragment(fragment)
        action = bpy.data.actions[shown.action]
        assert clips[character.fragment_clips[fragment]] in {action.name, f"{action.name} mirrored"}
        rate = bpy.context.scene.render.fps
        assert shown.frame == pytest.approx(action.frame_range[0] + ranges[fragment, 0] * rate)
        assert bpy.ops.fragmotion.show_fragment(action=shown.action, frame=shown.frame) == {"FINISHED"}
        assert obj.animation_data.action == action
        assert bpy.context.scene.frame_current == round(shown.frame)
    made = next(i for i, origin in enumerate(character.fragment_origins) if origin not in {"captured", "mirrored"})
    assert addon.character.inspector.inspect(character).fragment(made).action == ""
    with pytest.raises(RuntimeError, match="There is no Action 'gone'"):
        bpy.ops.fragmotion.show_fragment(action="gone", frame=1)


def test_suggest_sets_the_number_and_keeps_what_it_tried(
    addon: ModuleType, obj: bpy.types.Object, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    tried = [SimpleNamespace(classes=n, velocity_error=e, quality=q) for n, e, q in ((97, 0.4, 0.5), (137, 0.38, 0.6))]
    heard: list[tuple[object, ...]] = []

    def suggest(*arguments: object) -> tuple[int, list[SimpleNamespace]]:
        heard.append(arguments)
        return 137, tried

    monkeypatch.setattr(addon.character.suggesting.core, "suggest_classes", suggest)
    obj.fragmotion.build.classes = 97
    policy = bytes(obj.fragmotion.policy)
    bpy.ops.ed.undo_push(message="before")
    assert bpy.ops.fragmotion.suggest_classes("EXEC_DEFAULT", True) == {"FINISHED"}
    assert "Classes 97 -> 137: 5 % less velocity error" in capfd.readouterr().out
    obj = bpy.data.objects[ARMATURE]
    assert obj.fragmotion.build.classes == 137 and bytes(obj.fragmotion.policy) == policy
    shown = [(row.classes, row.velocity_error, row.quality) for row in obj.fragmotion.tried]
    np.testing.assert_allclose(shown, [(97, 0.4, 0.5), (137, 0.38, 0.6)], rtol=1e-6)
    _, clips, traces, options, _ = heard[0]
    takes = [action.name for action in addon.mocap.actions.ticked(obj)]
    assert [clip.name for clip in clips] == takes and traces[0].shape[1] == 4 and options.seed == 1
    bpy.ops.ed.undo()
    assert bpy.data.objects[ARMATURE].fragmotion.build.classes == 97, "it is not one undo step"


def test_suggest_tries_numbers_of_classes_in_the_core(addon: ModuleType) -> None:
    obj = making.add_armature()
    for index in range(3):
        making.add_action(obj, 90, seed=index, name=f"take {index}").fragmotion.use = True
    assert bpy.ops.fragmotion.suggest_classes("EXEC_DEFAULT", seconds=10) == {"FINISHED"}
    rows = obj.fragmotion.tried
    assert obj.fragmotion.build.classes in [row.classes for row in rows]
    assert all(0 < row.quality <= 1 and row.velocity_error > 0 for row in rows)


def test_a_cancelled_trial_changes_nothing(
    addon: ModuleType, obj: bpy.types.Object, monkeypatch: pytest.MonkeyPatch
) -> None:
    def cancel(*_: object) -> None:
        bpy.ops.fragmotion.cancel()

    monkeypatch.setattr(addon.character.suggesting.core, "suggest_classes", cancel)
    before = obj.fragmotion.build.classes
    assert bpy.ops.fragmotion.suggest_classes("EXEC_DEFAULT") == {"CANCELLED"}
    assert obj.fragmotion.build.classes == before and not obj.fragmotion.tried


@pytest.mark.parametrize("scale", [1.0, 2.0])
def test_a_long_name_is_shown_whole_in_a_narrow_sidebar(addon: ModuleType, scale: float) -> None:
    lines: list[tuple[str, str]] = []
    layout = SimpleNamespace(label=lambda text, icon, translate: lines.append((text, icon)))
    region = SimpleNamespace(width=220 * scale)  # as Blender opens the sidebar
    preferences = SimpleNamespace(system=SimpleNamespace(ui_scale=scale))
    context = SimpleNamespace(region=region, preferences=preferences)
    for name, broken in (("walk forward", 1), ("running jump back right turning left 2", 2)):
        for icon, next_icon in (("NONE", "NONE"), ("RADIOBUT_ON", "BLANK1")):
            lines.clear()
            addon.settings.drawing.draw_wrapped(layout, context, name, icon)
            assert " ".join(text for text, _ in lines) == name
            assert [shown for _, shown in lines] == [icon, next_icon][:broken]
            assert max(len(text) for text, _ in lines) <= (25 if icon == "RADIOBUT_ON" else 30), "the room there is"


# --- the picture of the coverage --------------------------------------------------------------------------------------


def pixel(addon: ModuleType, picture: np.ndarray, place: np.ndarray, off: float = 0.0) -> np.ndarray:
    """The colour at a place of the picture, `off` to the right."""
    column, row = ((place + (off, 0) + 1) / 2 * addon.character.coverage_picture.SIZE).astype(int)
    return picture[row, column]


def test_the_picture_shows_each_velocity_where_the_stick_would_be(addon: ModuleType) -> None:
    drawing = addon.character.coverage_picture
    points = addon.compat.core.core.ControlSpace().points[2::6]  # straight, no jump
    layout = addon.character.control_layout.ControlLayout()
    for index, (place, point) in enumerate(zip(drawing.places(layout), points)):
        radius = np.hypot(*place)
        if index > 0:
            np.testing.assert_allclose(place / radius, point[:2] / np.hypot(*point[:2]), atol=1e-9)
        distances = np.zeros(17)
        distances[index] = np.inf
        picture = drawing.draw_controls(distances, layout)
        np.testing.assert_allclose(pixel(addon, picture, place), drawing._CROSS, atol=0.05)
        np.testing.assert_allclose(pixel(addon, picture, place, 0.09)[:3], drawing.colour_of(np.inf), atol=0.05)
        others = [pixel(addon, picture, other) for i, other in enumerate(drawing.places(layout)) if i != index]
        np.testing.assert_allclose(np.array(others)[:, :3], np.tile(drawing.colour_of(0), (16, 1)), atol=0.05)


def test_every_dot_has_one_of_the_legends_colours(addon: ModuleType) -> None:
    drawing = addon.character.coverage_picture
    legend = {name: tuple(drawing.colour_of(distance)) for name, distance in drawing._SWATCHES.items()}
    assert len(set(legend.values())) == 3
    well, poor = addon.character.coverage.WELL, drawing._POOR
    for distance in (0, well, well + 1e-3, 0.5, 0.9, poor, poor + 1e-3, 9, np.inf):
        kind = "well" if distance <= well else "nearly" if distance <= poor else "not"
        assert tuple(drawing.colour_of(distance)) == legend[kind], distance


def test_a_control_is_marked_as_a_hole_where_none_performs_it_well(addon: ModuleType) -> None:
    drawing, well = addon.character.coverage_picture, addon.character.coverage.WELL
    centre, layout = np.zeros(2), addon.character.control_layout.ControlLayout()
    for distance, crossed in ((0, False), (well, False), (well + 1e-3, True), (9, True)):
        colour = pixel(addon, drawing.draw_controls(np.full(17, distance), layout), centre)
        assert (np.abs(colour - drawing._CROSS).max() < 0.05) == crossed, distance


def test_build_keeps_the_distances_that_the_picture_shows(addon: ModuleType, obj: bpy.types.Object) -> None:
    stored = np.frombuffer(obj.fragmotion.figures.distances, np.float32)
    np.testing.assert_allclose(stored, addon.character.building.load(obj).coverage_distances, rtol=1e-6)


def test_pictures_become_icons_once_and_are_given_back(addon: ModuleType) -> None:
    drawing, made = addon.character.coverage_picture, []
    layout = addon.character.control_layout.ControlLayout()

    def draw() -> np.ndarray:
        made.append(1)
        return drawing.draw_controls(np.linspace(0, 2, 17), layout)

    icon = drawing.icon_of("test", draw, b"1")  # 0 where Blender has no window
    assert drawing.icon_of("test", draw, b"1") == icon and len(made) == 1
    shown = np.array(drawing._previews["test"].image_pixels_float[:]).reshape(drawing.SIZE, drawing.SIZE, 4)
    np.testing.assert_allclose(shown, drawing.draw_controls(np.linspace(0, 2, 17), layout), atol=1 / 128)
    drawing.icon_of("test", draw, b"2")
    assert len(made) == 2
    drawing.free()
    assert drawing._previews is None
