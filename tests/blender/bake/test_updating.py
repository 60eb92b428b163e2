# SPDX-License-Identifier: MIT
"""A recording knows its Action: whether it was changed since, and where Update Bake writes."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import bpy
import numpy as np
import pytest
from baked import assert_seen, bake_recording, play


def actions() -> list[str]:
    return [action.name for action in bpy.data.actions if "Stroll" in action.name]


def test_a_change_makes_the_bake_stale_and_update_bake_writes_into_the_same_action(
    addon: ModuleType, obj: bpy.types.Object, trace: np.ndarray, recording: Any
) -> None:
    recordings = addon.recordings.recordings
    assert recording.baked is None and not recordings.is_bake_stale(recording)
    bake_recording()
    action = obj.animation_data.action
    assert action.name == "Stroll Bake" and recording.baked == action and not recordings.is_bake_stale(recording)
    recordings.set_trace(recording, trace[:-20])
    assert recordings.is_bake_stale(recording)
    action.name = "Renamed Stroll"
    obj.animation_data.action = None
    bake_recording(update=True)
    assert obj.animation_data.action == recording.baked == action and actions() == ["Renamed Stroll"]
    assert not recordings.is_bake_stale(recording)
    assert_seen(obj, play(addon, obj, trace[:-20]), step=3)
    assert bpy.ops.fragmotion.bake(trace_source="RECORDING") == {"FINISHED"}
    assert sorted(actions()) == ["Renamed Stroll", "Stroll Bake"] and recording.baked.name == "Stroll Bake"


def test_update_bake_writes_into_the_strip_that_plays_the_action(
    addon: ModuleType, obj: bpy.types.Object, trace: np.ndarray, recording: Any
) -> None:
    bake_recording(target="NLA")
    strip = obj.animation_data.nla_tracks[-1].strips[0]
    action, tracks = strip.action, len(obj.animation_data.nla_tracks)
    assert recording.baked == action
    before = strip.frame_end - strip.frame_start
    strip.frame_start += 10
    addon.recordings.recordings.set_trace(recording, trace[:-20])
    recording.shown = b""
    bake_recording(update=True)
    strip = obj.animation_data.nla_tracks[-1].strips[0]
    assert strip.action == recording.baked == action and actions() == [action.name]
    assert len(obj.animation_data.nla_tracks) == tracks and obj.animation_data.action is None
    rate = bpy.context.scene.render.fps / bpy.context.scene.render.fps_base
    assert strip.frame_end - strip.frame_start == pytest.approx(before - 2 * rate, abs=1)
    assert not addon.recordings.recordings.is_bake_stale(recording)


def test_anything_that_a_bake_shows_makes_it_stale(addon: ModuleType, recording: Any) -> None:
    recordings = addon.recordings.recordings
    digests = {recordings.digest_of(recording)}
    changes = {"seed": 99, "start": (1, 2, 3), "policy": "greedy", "style": "tired", "moves": '[[1,"wave",2]]'}
    for field, value in changes.items():
        setattr(recording, field, value)
        digests.add(recordings.digest_of(recording))
    assert len(digests) == 1 + len(changes)
    recording.name, recording.train = "Other", True
    assert recordings.digest_of(recording) in digests


def test_update_bake_says_where_there_is_nothing_to_update(obj: bpy.types.Object, recording: Any) -> None:
    with pytest.raises(RuntimeError, match="No Action is known to which this was baked: press Bake"):
        bpy.ops.fragmotion.bake(trace_source="RECORDING", update=True)
    bake_recording()
    bpy.data.actions.remove(obj.animation_data.action)
    assert recording.baked is None
