# SPDX-License-Identifier: MIT
"""A crowd: copies that share their data, stand apart, and each do at their place what the core's player plays."""

from __future__ import annotations

import itertools
import math
from types import ModuleType
from typing import Any

import bpy
import making
import numpy as np
import pytest

SECONDS, SEED = 3.0, 5


@pytest.fixture
def obj(obj: bpy.types.Object) -> bpy.types.Object:
    """The built armature, turned and away from the world's origin, with an empty on a hand."""
    bpy.context.scene.frame_set(1)
    obj.location, obj.rotation_euler.z = (2, -1, 0.5), 0.7
    held = bpy.data.objects.new("Held", None)
    held.parent, held.parent_type, held.parent_bone = obj, "BONE", "hand.L"
    bpy.context.scene.collection.objects.link(held)
    bpy.context.view_layer.update()
    return obj


def populate(**fields: Any) -> list[bpy.types.Object]:
    """The new armatures, by number."""
    former = set(bpy.data.objects)
    assert bpy.ops.fragmotion.populate(**{"seconds": SECONDS, "seed": SEED, **fields}) == {"FINISHED"}
    added = [o for o in bpy.data.objects if o not in former and o.type == "ARMATURE"]
    return sorted(added, key=lambda o: int(o.name.rpartition(" ")[2]))


def digest() -> dict[str, Any]:
    """What is in the file."""
    found = making.contents()
    collections = sorted(collection.name for collection in bpy.data.collections)
    return {**{key: found[key] for key in found if key != "playing"}, "collections": collections}


@pytest.mark.parametrize("layout", ["SQUARE", "RING"])
@pytest.mark.parametrize("count", [1, 2, 8, 11])
def test_nobody_stands_nearer_than_the_spacing(addon: ModuleType, layout: str, count: int) -> None:
    places = [(0.0, 0.0), *(spot[:2] for spot in addon.bake.populating.spots(count, layout, 1.5))]
    assert len(places) == count + 1
    assert min(math.dist(a, b) for a, b in itertools.combinations(places, 2)) > 1.5 - 1e-9


def test_every_copy_does_what_the_player_plays(addon: ModuleType, obj: bpy.types.Object) -> None:
    core, character = addon.compat.core.core, addon.character.building.load(obj)
    copies = populate(count=3, layout="RING", player="walker")
    scene, frame = bpy.context.scene, round(SECONDS * bpy.context.scene.render.fps)
    for index, copy in enumerate(copies):
        player = core.Player(character, SEED + index)
        place = copy.matrix_world
        player.reset(place.translation.x, place.translation.y, place.to_euler().z + math.pi)
        trace = core.simulate_trace("walker", SECONDS, SEED + index, character.space)
        played = player.run(trace, scene.render.fps / scene.render.fps_base)
        scene.frame_set(obj.fragmotion.bake.frame_start + frame)
        posed = copy.evaluated_get(bpy.context.evaluated_depsgraph_get())
        hips = posed.matrix_world @ posed.pose.bones["hips"].head
        np.testing.assert_allclose(hips, played.root_positions[frame], atol=1e-4)


def test_copies_share_their_data_and_have_names_actions_and_parts_of_their_own(obj: bpy.types.Object) -> None:
    copies = populate(count=2, spacing=3.0)
    meshes = [o for o in obj.children_recursive if o.type == "MESH"]
    assert meshes, "the sample has a body"
    for number, copy in enumerate(copies, 1):
        assert copy.name == f"{obj.name} {number}" and copy.data == obj.data
        assert copy.animation_data.action.name == copy.name and copy.animation_data.action.users == 1
        assert copy.fragmotion.figures.classes == 0 and not copy.fragmotion.policy, "the policy is kept once"
        assert {o.name for o in copy.children_recursive} == {f"{o.name} {number}" for o in obj.children_recursive}
        for part in (o for o in copy.children_recursive if o.type == "MESH"):
            assert part.data in [mesh.data for mesh in meshes]
            assert all(m.object == copy for m in part.modifiers if m.type == "ARMATURE")
        held = bpy.data.objects[f"Held {number}"]
        assert (held.parent, held.parent_type, held.parent_bone) == (copy, "BONE", "hand.L")
        assert math.dist(copy.location, obj.location) > 3 - 1e-5 and copy.location.z == pytest.approx(0.5)
    assert {o for o in bpy.data.collections[f"{obj.name} Crowd"].objects} >= set(copies)


def test_ticked_recordings_drive_in_turn(addon: ModuleType, obj: bpy.types.Object) -> None:
    with pytest.raises(RuntimeError, match="is ticked: tick some under Recordings"):
        bpy.ops.fragmotion.populate(traces="RECORDINGS")
    for rows in (10, 20, 30):
        recording = addon.recordings.recordings.add_recording(obj, np.tile([0.0, 1.2, 0, 0], (rows, 1)))
        recording.train = rows != 20
    first = obj.fragmotion.bake.frame_start
    rate = bpy.context.scene.render.fps
    lengths = [copy.animation_data.action.frame_range[1] - first for copy in populate(count=3, traces="RECORDINGS")]
    assert lengths == [rate, 3 * rate, rate]


def test_a_crowd_is_one_undo_step(obj: bpy.types.Object) -> None:
    bpy.ops.ed.undo_push(message="before")
    before = digest()
    assert bpy.ops.fragmotion.populate("EXEC_DEFAULT", True, count=2, seconds=SECONDS) == {"FINISHED"}
    assert digest() != before
    bpy.ops.ed.undo()
    assert digest() == before


def test_a_crowd_that_fails_while_it_is_written_changes_nothing(
    addon: ModuleType, obj: bpy.types.Object, monkeypatch: pytest.MonkeyPatch
) -> None:
    before, written, write = digest(), [], addon.bake.populating.write

    def fail_the_second(*arguments: Any) -> Any:
        if written:
            raise MemoryError("no memory")
        written.append(write(*arguments))

    monkeypatch.setattr(addon.bake.populating, "write", fail_the_second)
    with pytest.raises(RuntimeError, match="no memory"):
        populate(count=3)
    assert written and digest() == before


def test_esc_stops_a_crowd_and_changes_nothing(
    addon: ModuleType, obj: bpy.types.Object, monkeypatch: pytest.MonkeyPatch
) -> None:
    prepare = addon.bake.baking.prepare
    heard: list[str] = []

    def slow(*arguments: Any) -> Any:
        prepared = prepare(*arguments)

        def task(report: Any) -> Any:
            heard.append(addon.operators.base.background.current.label)
            if len(heard) == 2:
                assert bpy.ops.fragmotion.cancel() == {"FINISHED"}
            return prepared.task(report)

        return prepared._replace(task=task)

    monkeypatch.setattr(addon.bake.baking, "prepare", slow)
    before = digest()
    assert bpy.ops.fragmotion.populate(count=3, seconds=SECONDS) == {"CANCELLED"}
    assert len(heard) == 2 and digest() == before


def add_path(points: list[tuple[float, float]], closed: bool) -> bpy.types.Object:
    """A curve object through points on the ground."""
    data: Any = bpy.data.curves.new("Way", "CURVE")
    data.dimensions = "3D"
    spline = data.splines.new("POLY")
    spline.points.add(len(points) - 1)
    for point, place in zip(spline.points, points):
        point.co = (*place, 0.0, 1.0)
    spline.use_cyclic_u = closed
    way = bpy.data.objects.new("Way", data)
    bpy.context.scene.collection.objects.link(way)
    bpy.context.view_layer.update()
    return way


def hips_of(copy: bpy.types.Object) -> np.ndarray:
    posed = copy.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return np.array(posed.matrix_world @ posed.pose.bones["hips"].head)[:2]


@pytest.mark.parametrize("end", ["STAND", "LOOP"])
def test_copies_on_one_path_keep_apart(obj: bpy.types.Object, end: str) -> None:
    around = [(4 * math.cos(angle), 4 * math.sin(angle)) for angle in np.linspace(0, 2 * math.pi, 60, endpoint=False)]
    settings = obj.fragmotion.path
    settings.curve, settings.end, settings.seconds = add_path(around, end == "LOOP"), end, 30.0
    copies = populate(count=4, layout="PATH", spacing=2.0)
    assert len(copies) == 4
    nearest = []
    for frame in range(1, 300, 15):
        bpy.context.scene.frame_set(frame)
        places = [hips_of(copy) for copy in copies]
        nearest.append(min(math.dist(a, b) for a, b in itertools.combinations(places, 2)))
        assert all(abs(float(np.linalg.norm(place)) - 4) < 0.4 for place in places), frame
    assert min(nearest) > 1.5


def test_a_path_too_short_for_so_many_is_refused(obj: bpy.types.Object) -> None:
    obj.fragmotion.path.curve = add_path([(0, 0), (0, 5)], closed=False)
    former = digest()
    with pytest.raises(RuntimeError, match=r"Way is 5\.0 m long, too short for 8 copies 2 m apart"):
        populate(count=8, layout="PATH", spacing=2.0)
    assert digest() == former


def test_copies_carry_no_curves_of_recordings(addon: ModuleType, obj: bpy.types.Object) -> None:
    addon.recordings.recordings.add_recording(obj, np.tile([0, 1.2, 0, 0], (20, 1)).astype(float))
    assert bpy.ops.fragmotion.edit_curves() == {"FINISHED"}
    bpy.context.view_layer.objects.active = obj
    held = [child.name for child in obj.children]
    copies = populate(count=2)
    assert [child.name for child in obj.children] == held and len(held) == 3
    assert all(len(copy.children) == 2 for copy in copies), "the body, and what is in the hand"
