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
    return sorted(added, key=lambda o: float(o.name.rpartition(" ")[2]))


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
    copies = populate(count=3, layout="RING", player="walker", clear=False)
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


def test_what_would_fill_the_memory_is_refused(obj: bpy.types.Object) -> None:
    before = making.contents()
    with pytest.raises(RuntimeError, match=r"1000 copies for 3000 s need some \d+ GB, and this computer has \d+: let"):
        bpy.ops.fragmotion.populate("EXEC_DEFAULT", count=1000, seconds=3000)
    assert making.contents() == before


def test_recordings_and_paths_that_would_fill_the_memory_are_refused(
    addon: ModuleType, obj: bpy.types.Object, monkeypatch: pytest.MonkeyPatch
) -> None:
    recording = addon.recordings.recordings.add_recording(obj, np.tile([0, 1.2, 0, 0], (200, 1)).astype(float))
    recording.train = True
    obj.fragmotion.path.curve = add_path([(0, 0), (0, 50)], closed=False)
    monkeypatch.setattr(addon.bake.populating, "memory", lambda: 10**6)
    before = making.contents()
    with pytest.raises(RuntimeError, match="8 copies for 20 s need some"):
        populate(count=8, traces="RECORDINGS")
    with pytest.raises(RuntimeError, match=r"8 copies for \d+ s need some"):
        populate(count=8, layout="PATH", spacing=2.0)
    assert making.contents() == before


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


def hips_over_time(copies: list[bpy.types.Object], frames: range) -> np.ndarray:
    """Where the copies' hips are seen from above [frames, copies, 2], as Blender shows them."""
    places = []
    for frame in frames:
        bpy.context.scene.frame_set(frame)
        graph = bpy.context.evaluated_depsgraph_get()
        seen = [copy.evaluated_get(graph) for copy in copies]
        places.append([(each.matrix_world @ each.pose.bones["hips"].head).xy[:] for each in seen])
    return np.array(places)


def nearest(places: np.ndarray) -> float:
    """How near two of them ever come to each other, m."""
    off = np.linalg.norm(places[:, :, None] - places[:, None], axis=-1)
    off[:, np.arange(off.shape[1]), np.arange(off.shape[1])] = np.inf
    return float(off.min())


def test_what_was_selected_stays_so_alone(addon: ModuleType, obj: bpy.types.Object) -> None:
    obj.select_set(True)
    populate(count=2)
    assert bpy.context.selected_objects == [obj]


def make_area(size: float, painted: bool = False) -> bpy.types.Object:
    """A square in the world, of which the half on the positive side is painted."""
    data = bpy.data.meshes.new("Area")
    halves = [[(x * size, y * size, 0) for x, y in ((a, -1), (a + 1, -1), (a + 1, 1), (a, 1))] for a in (-1, 0)]
    data.from_pydata([*halves[0], *halves[1]], [], [(0, 1, 2, 3), (4, 5, 6, 7)])
    area = bpy.data.objects.new("Area", data)
    bpy.context.scene.collection.objects.link(area)
    if painted:
        area.vertex_groups.new(name="Walk").add([4, 5, 6, 7], 1.0, "REPLACE")
    bpy.context.view_layer.update()
    return area


@pytest.mark.thorough
def test_a_crowd_on_a_square_keeps_clear(addon: ModuleType, obj: bpy.types.Object) -> None:
    fields = {"count": 12, "spacing": 0.9, "seconds": 8.0, "player": "explorer"}
    frames = range(1, 190, 3)
    heedless = nearest(hips_over_time(populate(**fields, clear=False), frames))
    heeding = nearest(hips_over_time(populate(**fields), frames))
    assert heedless < 0.4 < heeding


def test_a_crowd_goes_about_on_what_is_painted(addon: ModuleType, obj: bpy.types.Object) -> None:
    settings = obj.fragmotion.crowd
    with pytest.raises(RuntimeError, match="No area is chosen"):
        populate(layout="AREA")
    settings.area = make_area(5.0, painted=True)
    copies = populate(layout="AREA", count=6, seconds=10.0, spacing=1.0)
    places = hips_over_time(copies, range(1, 240, 4))
    assert nearest(places) > 0.4
    assert places[..., 0].min() > 0 and np.abs(places).max() < 5, "none leaves it"
    assert (np.linalg.norm(np.diff(places, axis=0), axis=-1).sum(0) > 3).all(), "all walk"
    with pytest.raises(RuntimeError, match="has room for"):
        populate(layout="AREA", count=300, spacing=2.0)
    settings.area.vertex_groups.active.remove(range(8))
    with pytest.raises(RuntimeError, match="'Area' is no area: nothing of the area is painted"):
        populate(layout="AREA")


def test_a_crowd_goes_around_obstacles(addon: ModuleType, obj: bpy.types.Object) -> None:
    settings = obj.fragmotion.crowd
    settings.area = make_area(3.0)
    box = bpy.data.objects.new("Box", make_area(0.8).data)
    things = bpy.data.collections.new("Things")
    bpy.context.scene.collection.children.link(things)
    things.objects.link(box)
    settings.obstacles = things
    bpy.context.view_layer.update()
    places = hips_over_time(populate(layout="AREA", count=3, seconds=12.0, spacing=2.5, seed=4), range(1, 280, 4))
    inside = (np.abs(places[20:]) < 0.8).all(-1)
    assert not inside.any()


def test_a_crowd_goes_around_the_original_where_it_is_seen(addon: ModuleType, obj: bpy.types.Object) -> None:
    path = add_path([(-4.0, 0.0), (10.0, 0.0)], False)
    obj.fragmotion.path.curve = path
    obj.animation_data_clear()
    obj.rotation_euler.z = 0.0
    for frame, y in ((1, 0.0), (200, 0.2)):
        obj.location = (3, y, 0)
        obj.keyframe_insert("location", frame=frame)

    def off() -> float:
        bpy.context.scene.frame_set(7)
        copies = populate(layout="PATH", count=2, spacing=1.5)
        assert bpy.context.scene.frame_current == 7
        return float(np.linalg.norm(hips_over_time(copies, range(1, 200, 2)) - np.array([3.0, 0.1]), axis=-1).min())

    seen = off()
    obj.hide_set(True)
    hidden = off()
    assert hidden < 0.35 < seen


def test_copies_are_shared_out_among_several_paths_and_sizes(addon: ModuleType, obj: bpy.types.Object) -> None:
    lines = bpy.data.collections.new("Lines")
    bpy.context.scene.collection.children.link(lines)
    for y in (0.0, 8.0):
        line = add_path([(0.0, y), (9.0, y)], False)
        lines.objects.link(line)
    settings = obj.fragmotion.crowd
    settings.paths = lines
    bpy.context.view_layer.update()
    copies = populate(layout="PATH", count=4, spacing=1.5, sizes=0.1)
    scales = [copy.scale.x / obj.scale.x for copy in copies]
    assert 0.9 <= min(scales) < max(scales) <= 1.1
    places = hips_over_time(copies, range(30, 110, 5))
    assert nearest(places) > 0.4
    off = np.abs(places[..., 1] - np.array([0.0, 8.0, 0.0, 8.0]))
    assert off.max() < 0.5
    lines.objects.unlink(lines.objects[0])
    lines.objects.unlink(lines.objects[0])
    with pytest.raises(RuntimeError, match="holds no curve"):
        populate(layout="PATH")
