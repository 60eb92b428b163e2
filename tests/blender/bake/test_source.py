# SPDX-License-Identifier: MIT
"""Bake's button bakes what is selected; a script that says what is to be baked has that."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import bpy
import numpy as np
import pytest


def baked_frames() -> int:
    """How many frames the bake of Bake's own button, without a word of a source, is long."""
    assert bpy.ops.fragmotion.bake(action="Baked") == {"FINISHED"}
    first, last = bpy.data.actions["Baked"].frame_range
    return round(last - first) + 1


def test_the_recording_that_is_selected_is_the_source(
    addon: ModuleType, obj: bpy.types.Object, recording: Any, trace: np.ndarray
) -> None:
    addon.recordings.recordings.add_recording(obj, trace[:20], name="Short")
    assert baked_frames() == 61, "the one that was recorded last is selected"
    obj.fragmotion.active_recording = 0
    assert baked_frames() == 121


def test_what_was_selected_last_is_the_source(obj: bpy.types.Object, recording: Any) -> None:
    bake = obj.fragmotion.bake
    bake.trace_source, bake.seconds = "PLAYER", 2.0
    assert baked_frames() == 61, "another source may be chosen"
    obj.fragmotion.active_recording = 0
    assert bake.trace_source == "RECORDING" and baked_frames() == 121


def test_while_there_is_no_recording_a_simulated_player_is_baked(obj: bpy.types.Object) -> None:
    obj.fragmotion.bake.seconds = 2.0
    assert baked_frames() == 61
    obj.fragmotion.active_recording = 0
    assert obj.fragmotion.bake.property_unset("trace_source") is None and baked_frames() == 61


def test_a_script_that_asks_for_a_recording_is_told_that_there_is_none(obj: bpy.types.Object) -> None:
    with pytest.raises(RuntimeError, match="has no such recording"):
        bpy.ops.fragmotion.bake(trace_source="RECORDING")


def test_a_script_has_the_source_that_it_asks_for(obj: bpy.types.Object, recording: Any) -> None:
    assert bpy.ops.fragmotion.bake(action="Baked", trace_source="PLAYER", seconds=2.0) == {"FINISHED"}
    first, last = bpy.data.actions["Baked"].frame_range
    assert round(last - first) + 1 == 61
