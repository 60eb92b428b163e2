# SPDX-License-Identifier: MIT
"""A bake is one undo step, or nothing at all where it fails, is stopped or cannot be."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import bpy
import making
import numpy as np
import pytest
from baked import bake_recording, markers_of


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


def keys_of(action: bpy.types.Action) -> list[Any]:
    """All keys of an Action."""
    if bpy.app.version >= (4, 4, 0):
        bags = [bag for layer in action.layers for strip in layer.strips for bag in strip.channelbags]
        curves = [curve for bag in bags for curve in bag.fcurves]
    else:
        curves = list(action.fcurves)
    return [(curve.data_path, curve.array_index, places_of(curve)) for curve in curves]


def places_of(curve: bpy.types.FCurve) -> bytes:
    """Frames and values of a curve's keys."""
    places = np.empty(2 * len(curve.keyframe_points), np.float32)
    curve.keyframe_points.foreach_get("co", places)
    return places.tobytes()


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
    button, play_on = addon.operators.base.background, addon.bake.performing.prepare

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
