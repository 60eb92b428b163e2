# SPDX-License-Identifier: MIT
"""Follow Path: every kind of path, what becomes of it, and what is refused."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from types import ModuleType
from typing import Any

import bpy
import numpy as np
import pytest
from mathutils import Vector

CORNERS = [(0.0, 0.0, 0.0), (0.0, 4.0, 0.5), (3.0, 6.0, 1.0), (6.0, 6.0, 0.0)]
NEAR = 0.15  # m from the path, in the mean


def add_curve(kind: str = "POLY", corners: Sequence[Sequence[float]] = CORNERS, **settings: Any) -> bpy.types.Object:
    """A curve object through or along corners."""
    data: Any = bpy.data.curves.new("Way", "CURVE")
    data.dimensions = "3D"
    add_spline(data, kind, corners)
    for name, value in settings.items():
        setattr(data, name, value)
    obj = bpy.data.objects.new("Way", data)
    bpy.context.scene.collection.objects.link(obj)
    return obj


def add_spline(data: Any, kind: str, corners: Sequence[Sequence[float]]) -> None:
    spline = data.splines.new(kind)
    knots = spline.bezier_points if kind == "BEZIER" else spline.points
    knots.add(len(corners) - 1)
    for knot, place in zip(knots, corners):
        knot.co = place if kind == "BEZIER" else (*place, 1.0)
        if kind == "BEZIER":
            knot.handle_left_type = knot.handle_right_type = "AUTO"
    if kind == "NURBS":
        spline.order_u, spline.use_endpoint_u = 3, True


def add_stroke(corners: Sequence[Sequence[float]] = CORNERS) -> bpy.types.Object:
    """A Grease Pencil object with a stroke, of this Blender's kind."""
    if bpy.app.version >= (4, 3, 0):
        data: Any = bpy.data.grease_pencils.new("Stroke")
        if hasattr(bpy.data, "grease_pencils_v3"):
            data = bpy.data.grease_pencils_v3.new("Stroke")
        drawing = data.layers.new("Layer").frames.new(1).drawing
        drawing.add_strokes([len(corners)])
        for point, place in zip(drawing.strokes[0].points, corners):
            point.position, point.radius = place, 0.02
    else:
        data = bpy.data.grease_pencils.new("Stroke")
        stroke = data.layers.new("Layer").frames.new(1).strokes.new()
        stroke.points.add(len(corners))
        for point, place in zip(stroke.points, corners):
            point.co = place
    obj = bpy.data.objects.new("Stroke", data)
    bpy.context.scene.collection.objects.link(obj)
    return obj


def add_empties(corners: Sequence[Sequence[float]] = CORNERS) -> list[bpy.types.Object]:
    empties = []
    for number, place in enumerate(corners):
        empty = bpy.data.objects.new(f"Stop {number}", None)
        bpy.context.scene.collection.objects.link(empty)
        empty.location = place
        empties.append(empty)
    return empties


def follow(obj: bpy.types.Object, **settings: Any) -> Any:
    """Follow a path as settings say; the recording."""
    for name, value in settings.items():
        setattr(obj.fragmotion.path, name, value)
    before = len(obj.fragmotion.recordings)
    bpy.context.view_layer.update()
    assert bpy.ops.fragmotion.follow_path("EXEC_DEFAULT") == {"FINISHED"}
    assert len(obj.fragmotion.recordings) == before + 1
    return obj.fragmotion.recordings[-1]


def refused(obj: bpy.types.Object, **settings: Any) -> str:
    """What Follow Path says where it refuses to; nothing is left behind."""
    for name, value in settings.items():
        setattr(obj.fragmotion.path, name, value)
    bpy.context.view_layer.update()
    counts = [len(kind) for kind in (bpy.data.objects, bpy.data.curves, bpy.data.meshes, obj.fragmotion.recordings)]
    with pytest.raises(RuntimeError) as refusal:
        bpy.ops.fragmotion.follow_path("EXEC_DEFAULT")
    assert counts == [
        len(kind) for kind in (bpy.data.objects, bpy.data.curves, bpy.data.meshes, obj.fragmotion.recordings)
    ]
    return str(refusal.value)


@pytest.fixture
def frames(addon: ModuleType) -> Callable[[Any], np.ndarray]:
    """The character frames [F,3] that a recording shows."""

    def read(recording: Any) -> np.ndarray:
        shown = addon.recordings.recordings.shown_of(recording)
        assert shown is not None
        return np.asarray(shown[1].path)

    return read


def off(places: np.ndarray, line: Sequence[Sequence[float]]) -> np.ndarray:
    """Distances of places [N,2] from a line from point to point."""
    fine = np.concatenate([np.linspace(a[:2], b[:2], 200) for a, b in zip(line[:-1], line[1:])])
    found: np.ndarray = np.linalg.norm(places[:, None] - fine, axis=2).min(1)
    return found


def test_a_poly_curve_is_walked_and_replayed_as_it_was(
    addon: ModuleType, obj: bpy.types.Object, frames: Callable[[Any], np.ndarray]
) -> None:
    recording = follow(obj, curve=add_curve())
    shown = frames(recording)
    assert off(shown[:, :2], CORNERS).mean() < NEAR
    assert math.dist(shown[-1, :2], CORNERS[-1][:2]) < 0.2
    player = addon.character.building.make_player(obj, addon.character.building.load(obj), recording.seed)
    trace = addon.recordings.recordings.trace_of(recording)
    start = tuple(recording.start)
    again = player
    again.reset(*start)
    played = again.run(trace, addon.recordings.recordings.POSE_RATE).path
    assert np.abs(played[:, :2] - shown[:, :2]).max() < 1e-3
    assert recording.quality > 0 and recording.policy


@pytest.mark.parametrize("kind", ["BEZIER", "NURBS", "POLY"])
def test_every_kind_of_curve_is_followed_as_blender_draws_it(
    addon: ModuleType, obj: bpy.types.Object, frames: Callable[[Any], np.ndarray], kind: str
) -> None:
    curve = add_curve(kind)
    shown = curve.to_mesh()
    line = [tuple(vertex.co) for vertex in shown.vertices]
    curve.to_mesh_clear()
    curve.data.bevel_depth = 0.2  # what makes it thick is not its way
    assert off(frames(follow(obj, curve=curve))[:, :2], line).mean() < NEAR


def test_a_stroke_is_followed(obj: bpy.types.Object, frames: Callable[[Any], np.ndarray]) -> None:
    assert off(frames(follow(obj, curve=add_stroke()))[:, :2], CORNERS).mean() < NEAR


def test_empties_are_way_points(obj: bpy.types.Object, frames: Callable[[Any], np.ndarray]) -> None:
    empties = add_empties()
    for empty in empties:
        empty.select_set(True)
    shown = frames(follow(obj, source="SELECTED"))
    for place in CORNERS:
        assert np.linalg.norm(shown[:, :2] - place[:2], axis=1).min() < 0.3
    stops = bpy.data.collections.new("Stops")
    for empty in empties:
        stops.objects.link(empty)
    assert np.array_equal(frames(follow(obj, source="COLLECTION", collection=stops)), shown)


def test_a_curve_is_followed_where_its_parent_has_it(
    obj: bpy.types.Object, frames: Callable[[Any], np.ndarray]
) -> None:
    curve, (parent,) = add_curve(), add_empties([(5.0, -3.0, 0.0)])
    curve.parent, parent.rotation_euler[2] = parent, math.pi / 2
    shown = frames(follow(obj, curve=curve))
    moved = [(5 - y, -3 + x) for x, y, _ in CORNERS]
    assert off(shown[:, :2], moved).mean() < NEAR


def test_a_curve_that_moves_is_followed_where_it_is(
    addon: ModuleType, obj: bpy.types.Object, frames: Callable[[Any], np.ndarray]
) -> None:
    curve = add_curve()
    curve.keyframe_insert("location", frame=1)
    curve.location = (10.0, 0.0, 0.0)
    curve.keyframe_insert("location", frame=101)
    bpy.context.scene.frame_set(101)
    shown = frames(follow(obj, curve=curve))
    assert off(shown[:, :2], [(x + 10, y) for x, y, _ in CORNERS]).mean() < NEAR
    line = addon.paths.lines.line_of(bpy.context, curve)
    assert line.remarks == ["'Way' is animated and was taken as it is at frame 101"]


def test_it_arrives_at_a_frame(obj: bpy.types.Object, frames: Callable[[Any], np.ndarray]) -> None:
    scene = bpy.context.scene
    first = obj.fragmotion.bake.frame_start
    asked = first + round(12 * scene.render.fps / scene.render.fps_base)
    shown = frames(follow(obj, curve=add_curve(), speed_by="ARRIVE", arrive_frame=asked))
    end = np.array(CORNERS[-1][:2])
    assert np.linalg.norm(shown[60 * 12 + 15, :2] - end) < 0.2
    assert np.linalg.norm(shown[60 * 12 - 60, :2] - end) > 0.2
    said = refused(obj, arrive_frame=first)
    assert "choose a later frame" in said


def test_a_radius_is_a_pace(obj: bpy.types.Object, frames: Callable[[Any], np.ndarray]) -> None:
    curve = add_curve(corners=[(0, 0, 0), (0, 6, 0), (0, 6.1, 0), (0, 12, 0)])
    for point, radius in zip(curve.data.splines[0].points, (1, 1, 2, 2)):
        point.radius = radius
    along = frames(follow(obj, curve=curve, speed_by="RADIUS", speed=1.0))[:, 1]
    slow = np.diff(along[(along > 2) & (along < 5)]).mean()
    assert np.diff(along[(along > 8) & (along < 10)]).mean() > 1.6 * slow


def test_it_faces_where_it_is_told(obj: bpy.types.Object, frames: Callable[[Any], np.ndarray]) -> None:
    curve = add_curve()
    fixed = frames(follow(obj, curve=curve, facing="FIXED", heading=0.0))
    assert np.abs(fixed[60:, 2]).max() < 0.2
    (watched,) = add_empties([(3.0, 0.0, 0.0)])
    facing = frames(follow(obj, facing="OBJECT", look_at=watched))[90:]
    towards = np.arctan2(-(3.0 - facing[:, 0]), 0.0 - facing[:, 1])
    assert np.abs((facing[:, 2] - towards + math.pi) % (2 * math.pi) - math.pi).mean() < 0.2


def test_it_loops_for_as_long_as_it_is_told(obj: bpy.types.Object) -> None:
    assert follow(obj, curve=add_curve(), end="LOOP", seconds=30.0).seconds == pytest.approx(30)
    assert follow(obj, end="GO_ON", seconds=15.0).seconds == pytest.approx(15)


def test_it_comes_from_where_it_stands(obj: bpy.types.Object, frames: Callable[[Any], np.ndarray]) -> None:
    obj.location = (-3.0, 0.0, 0.0)
    recording = follow(obj, curve=add_curve(), start="CHARACTER")
    shown = frames(recording)
    assert shown[0, 0] == pytest.approx(-3, abs=0.3)
    assert math.dist(shown[-1, :2], CORNERS[-1][:2]) < 0.2


def test_it_is_baked_as_any_recording(obj: bpy.types.Object) -> None:
    recording = follow(obj, curve=add_curve())
    assert bpy.ops.fragmotion.bake("EXEC_DEFAULT", trace_source="RECORDING", recording=0) == {"FINISHED"}
    fps = bpy.context.scene.render.fps / bpy.context.scene.render.fps_base
    assert obj.animation_data.action.frame_range[1] == pytest.approx(1 + recording.seconds * fps, abs=1.5)


def test_what_is_no_path_is_refused(obj: bpy.types.Object) -> None:
    assert "No path is chosen" in refused(obj, curve=None)
    assert "has no line with two points" in refused(obj, curve=add_curve(corners=[(0, 0, 0)]))
    assert "Way.001: the path has no length on the ground" in refused(
        obj, curve=add_curve(corners=[(0, 0, 0), (0, 0, 3)])
    )
    assert "No collection is chosen" in refused(obj, source="COLLECTION")
    assert "0 way points, and a path needs two" in refused(obj, source="SELECTED")
    assert "No object to face" in refused(obj, source="CURVE", curve=add_curve(), facing="OBJECT")


def test_a_cusp_is_walked_to_and_back(obj: bpy.types.Object, frames: Callable[[Any], np.ndarray]) -> None:
    shown = frames(follow(obj, curve=add_curve(corners=[(0, 0, 0), (0, 4, 0), (0, 0.5, 0)])))
    assert shown[:, 1].max() > 3.6 and shown[-1, 1] == pytest.approx(0.5, abs=0.2)


def test_what_cannot_be_done_is_said(addon: ModuleType, obj: bpy.types.Object) -> None:
    curve = add_curve()
    add_spline(curve.data, "POLY", [(0, 0, 0), (1, 1, 1)])
    settings = obj.fragmotion.path
    settings.curve, settings.speed = curve, 20.0
    _, told, warnings = addon.paths.following.follow(bpy.context, obj, settings, (0.0, 0.0, 0.0))
    assert "stands 0." in told
    several, fast = warnings
    assert several == "'Way' has 2 lines, of which the first is followed"
    assert fast.startswith("The path asks for 20.0 m/s, and the character runs at 3.")


def test_a_drawn_path_is_a_curve_object(addon: ModuleType, obj: bpy.types.Object) -> None:

    curve = addon.paths.drawing.add_curve(bpy.context, [Vector(place) for place in CORNERS])
    line = addon.paths.lines.line_of(bpy.context, curve)
    assert np.allclose(line.points, CORNERS) and bpy.context.view_layer.objects.active == obj
