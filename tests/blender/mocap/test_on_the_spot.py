# SPDX-License-Identifier: MIT
"""Actions that go on the spot, as games have them, are learned as if they went the way that their feet tell."""

from __future__ import annotations

from types import ModuleType

import bpy
import making
import numpy as np
import pytest
from mathutils import Matrix, Quaternion

GAITS = ("walk forward", "run forward")


def speed_of(addon: ModuleType, obj: bpy.types.Object, name: str) -> float:
    """How fast the hips go in an Action, m/s."""
    clip = addon.mocap.sampling.sample(bpy.context, obj, bpy.data.actions[name], addon.rig.rigs.make_rig(obj))
    way = clip.root_positions[-1, :2] - clip.root_positions[0, :2]
    return float(np.linalg.norm(way)) / (len(clip.root_positions) - 1) * clip.rate


@pytest.fixture
def speeds(addon: ModuleType) -> dict[str, float]:
    """The sample learns from a stand, a walk and a run alone; the latter two stay on the spot. How fast they went."""
    obj = making.open_sample()
    obj.fragmotion.moves.clear()
    went = {name: speed_of(addon, obj, name) for name in GAITS}
    for action in bpy.data.actions:
        action.fragmotion.use = action.name in (*GAITS, "stand")
    for name in GAITS:
        for curve in addon.compat.versions.curves_of(bpy.data.actions[name], obj):
            if curve.data_path == 'pose.bones["root"].location':
                curve.mute = True
    assert all(speed_of(addon, obj, name) < 0.1 for name in GAITS)
    return went


def test_the_doctor_tells_how_fast_the_feet_go(addon: ModuleType, speeds: dict[str, float]) -> None:
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    for name, speed in speeds.items():
        rows = [row for row in bpy.data.actions[name].fragmotion.findings if row.code == "in_place"]
        assert len(rows) == 1
        found = float(rows[0].text.partition(" go at ")[2].partition(" m/s")[0])
        assert found == pytest.approx(speed, rel=0.05)
    assert not bpy.data.actions["stand"].fragmotion.findings


def test_what_mend_gives_its_way_is_still_known_as_shown_on_the_spot(
    addon: ModuleType, speeds: dict[str, float]
) -> None:
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    obj = bpy.context.view_layer.objects.active
    action, rig = bpy.data.actions["walk forward"], addon.rig.rigs.make_rig(obj)
    (row,) = (row for row in action.fragmotion.findings if row.code == "in_place")
    assert addon.mocap.mending.mend_finding(bpy.context, obj, action, row)
    assert speed_of(addon, obj, action.name) == pytest.approx(speeds[action.name], rel=0.05)
    for name, known in (("walk forward", True), ("stand", False)):
        clip = addon.mocap.sampling.sample(bpy.context, obj, bpy.data.actions[name], rig)
        rest = bpy.context.scene, obj, bpy.data.actions[name], [clip], rig.skeleton
        assert [each.led for each in addon.mocap.on_the_spot.lead_by_feet(*rest)] == [known]


def test_a_few_clips_make_a_character_that_goes_everywhere(addon: ModuleType, speeds: dict[str, float]) -> None:
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    obj = bpy.context.view_layer.objects.active
    figures, character = obj.fragmotion.figures, addon.character.building.load(obj)
    assert figures.abilities.startswith("Walks in all directions and runs forward")
    assert character.space.speeds == pytest.approx(list(speeds.values()), rel=0.15)


def test_the_user_knows_better_how_fast_it_goes(addon: ModuleType, speeds: dict[str, float]) -> None:
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    obj = bpy.context.view_layer.objects.active
    assert not addon.character.staleness.is_stale(obj)
    bpy.data.actions["run forward"].fragmotion.speed = 2 * speeds["run forward"]
    assert addon.character.staleness.is_stale(obj)
    before = addon.character.building.load(obj).space.speeds[-1]
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    assert addon.character.building.load(obj).space.speeds[-1] == pytest.approx(2 * before, rel=0.15)


def test_one_clip_of_a_second_is_enough(addon: ModuleType, speeds: dict[str, float]) -> None:
    for action in bpy.data.actions:
        action.fragmotion.use = action.name == "walk forward"
    walk = bpy.data.actions["walk forward"]
    walk.use_frame_range, walk.frame_start, walk.frame_end = True, 1, 31
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    figures = bpy.context.view_layer.objects.active.fragmotion.figures
    assert "alks" in figures.abilities
    assert 1 < figures.classes <= 97


def test_a_bake_that_hardly_moves_is_a_warning(addon: ModuleType, speeds: dict[str, float]) -> None:
    for action in bpy.data.actions:
        action.fragmotion.use = action.name == "stand"
    obj = bpy.context.view_layer.objects.active
    obj.fragmotion.build.synthesize = False
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    assert obj.fragmotion.figures.abilities == addon.character.abilities.NOTHING
    obj.fragmotion.bake.trace_source = "PLAYER"
    prepared = addon.bake.baking.prepare(bpy.context, obj, obj.fragmotion.bake)
    assert "hardly moves" in prepared.task(lambda *_: None).warning


LEGS = {"leg-left": 1, "leg-right": -1}


GAITS_OF_FIGURE = (("stand", 0.01, 30), ("walk", 0.4, 24), ("run", 0.7, 18))  # how far legs swing, rad; frames


def make_figure() -> bpy.types.Object:
    """A figure whose legs are one bone each, which an importer lets point upward."""
    obj: bpy.types.Object = making.add_armature(
        [
            ("root", None, (0, 0, 0), (0, 0, 0.2)),
            *((name, "root", (0.1 * side, 0, 0.4), (0.1 * side, 0, 0.6)) for name, side in LEGS.items()),
            ("torso", "root", (0, 0, 0.4), (0, 0, 0.6)),
            ("head", "torso", (0, 0, 0.7), (0, 0, 0.9)),
        ]
    )
    return obj


def key_pose(obj: bpy.types.Object, frame: int, height: float, angles: dict[str, float]) -> None:
    """The root so high over where it rests, the legs so far back, rad."""
    rest = {bone: obj.data.bones[bone].matrix_local for bone in ("root", *LEGS)}
    obj.pose.bones["root"].matrix = Matrix.Translation((0, 0, height)) @ rest["root"]
    obj.pose.bones["root"].keyframe_insert("location", frame=frame)
    bpy.context.view_layer.update()
    for bone, angle in angles.items():
        axes = rest[bone].to_3x3()
        turn = axes.inverted() @ Matrix.Rotation(angle, 3, "X") @ axes
        obj.pose.bones[bone].rotation_quaternion = turn.to_quaternion()
        obj.pose.bones[bone].keyframe_insert("rotation_quaternion", frame=frame)


def key_gait(obj: bpy.types.Object, first: int, swing: float, frames: int) -> int:
    """A cycle from a frame on; the frame after it."""
    for frame in range(frames + 1):
        angle = swing * np.sin(2 * np.pi * frame / frames)
        key_pose(obj, first + frame, 0.1 * abs(angle), {bone: side * angle for bone, side in LEGS.items()})
    return first + frames + 1


def key_seat(obj: bpy.types.Object, first: int, frames: int) -> int:
    """Sitting on the ground from a frame on; the frame after it."""
    for frame in range(first, first + frames):
        key_pose(obj, frame, -0.4, dict.fromkeys(LEGS, np.pi / 2))
    return first + frames


@pytest.fixture
def figure() -> bpy.types.Object:
    """With a stand, a walk and a run, which are ticked."""
    obj = make_figure()
    for name, swing, frames in GAITS_OF_FIGURE:
        obj.animation_data_clear()
        key_gait(obj, 1, swing, frames)
        obj.animation_data.action.name = name
        obj.animation_data.action.use_fake_user = True
        obj.animation_data.action.fragmotion.use = True
    return obj


def test_legs_of_a_single_bone_lead_a_character_everywhere(addon: ModuleType, figure: bpy.types.Object) -> None:
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    figures, character = figure.fragmotion.figures, addon.character.building.load(figure)
    assert figures.abilities.startswith("Walks in all directions and runs forward")
    assert character.skeleton.roles["left_foot"] == "leg-left"
    steps = 2 * bpy.context.scene.render.fps / np.array([24, 18])  # a second
    assert character.space.speeds == pytest.approx(steps * 2 * 0.4 * np.sin([0.4, 0.7]), rel=0.1)


def make_ghost() -> bpy.types.Object:
    """A figure without legs, whose cloak and head wave in a cycle."""
    obj: bpy.types.Object = making.add_armature(
        [
            ("root", None, (0, 0, 0.4), (0, 0, 0.6)),
            ("torso", "root", (0, 0, 0.6), (0, 0, 1.2)),
            ("head", "torso", (0, 0, 1.2), (0, 0, 1.5)),
            ("cloak", "root", (0, 0, 0.4), (0, 0.5, 0.1)),
        ]
    )
    for frame in range(25):
        wave = np.sin(2 * np.pi * frame / 24)
        for name, angle in (("torso", 0.05), ("head", 0.1), ("cloak", 0.6)):
            bone = obj.pose.bones[name]
            bone.rotation_quaternion = Quaternion((1, 0, 0), angle * wave)
            bone.keyframe_insert("rotation_quaternion", frame=frame)
    obj.animation_data.action.fragmotion.use = True
    return obj


def test_what_has_no_feet_goes_ahead_at_the_speed_that_the_user_tells(
    addon: ModuleType, capfd: pytest.CaptureFixture[str]
) -> None:
    obj = make_ghost()
    action, asks = obj.animation_data.action, "give its Speed in Doctor"
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    assert asks in capfd.readouterr().out
    assert obj.fragmotion.figures.abilities == addon.character.abilities.NOTHING
    assert [row.code for row in action.fragmotion.findings if row.code == "untold_speed"]
    action.fragmotion.speed = 2
    assert addon.character.staleness.is_stale(obj)
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    assert asks not in capfd.readouterr().out
    character, core = addon.character.building.load(obj), addon.compat.core.core
    assert min(abs(speed - 2) for speed in character.space.speeds) < 0.2
    path = core.Player(character, 1).run(np.tile((0, 2, 0, 0), (60, 1)), 30).path
    assert np.linalg.norm(path[-1, :2] - path[90, :2]) == pytest.approx(2 * 3, rel=0.2)


def test_motions_that_follow_each_other_in_one_action_go_each_on_its_own_way(addon: ModuleType) -> None:
    obj, frame = make_figure(), 1
    spans = {}
    for name, swing, frames in GAITS_OF_FIGURE:
        spans[name] = frame, frame + frames
        frame = key_seat(obj, key_gait(obj, frame, swing, frames), 8)
    action = obj.animation_data.action
    action.fragmotion.use = True
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    character = addon.character.building.load(obj)
    steps = 2 * bpy.context.scene.render.fps / np.array([24, 18])  # a second
    assert character.space.speeds == pytest.approx(steps * 2 * 0.4 * np.sin([0.4, 0.7]), rel=0.1)
    (told,) = (row.text for row in action.fragmotion.findings if row.code == "in_place_parts")
    assert all(f"{spans[name][0]} to {spans[name][1]} (" in told for name in ("walk", "run"))
    assert addon.mocap.left_out.source_of(f"{action.name} from {spans['walk'][0]}") == (action.name, spans["walk"][0])


def test_build_names_each_way_that_is_not_gone_as_it_is_asked_for(
    addon: ModuleType, figure: bpy.types.Object, capfd: pytest.CaptureFixture[str]
) -> None:
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    (told,) = (line for line in capfd.readouterr().out.splitlines() if "Cannot" in line)
    character, core = addon.character.building.load(figure), addon.compat.core.core
    space = character.space
    named = {name for name in told.partition("Cannot ")[2].partition(" as it")[0].split(", ")}
    for number, control in enumerate(space.points):
        if control[2] or control[3] or not number:
            continue
        path = core.Player(character, 1).run(np.tile(control, (60, 1)), 30).path[60:]
        steps, heading = np.diff(path[:, :2], axis=0), path[:-1, 2]
        ahead = steps[:, 1] * np.cos(heading) - steps[:, 0] * np.sin(heading)
        aside = steps[:, 0] * np.cos(heading) + steps[:, 1] * np.sin(heading)
        off = np.hypot(30 * aside.mean() - control[0], 30 * ahead.mean() - control[1])
        gait = space.gaits[int(np.hypot(*control[:2]) > space.speeds[0] * 1.01)]
        direction = round(np.arctan2(-control[0], control[1]) / (np.pi / 4)) % 8
        name = f"{gait} {core.DIRECTIONS[2 * direction]}"
        assert (name in named) == (off > 0.2 * np.hypot(*control[:2])), name
    assert named
