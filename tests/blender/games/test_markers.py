# SPDX-License-Identifier: MIT
"""What an animator marks in an Action is told to the game that plays the character."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import numpy as np
import pytest

JUMP = "jump up"


def part(addon: ModuleType, name: str) -> Any:
    return import_module(f"{addon.__name__}.{name}")


def mark(action: bpy.types.Action, **frames: int) -> bpy.types.Action:
    """The Action with these markers."""
    for name, frame in frames.items():
        action.pose_markers.new(name).frame = frame
    return action


def test_markers_of_an_action_are_the_clips(addon: ModuleType, obj: bpy.types.Object) -> None:
    action = mark(bpy.data.actions[JUMP], hit=41, late=10_000, begin=1)
    action.pose_markers.new("").frame = 7
    rig = part(addon, "rig.rigs").make_rig(obj)
    sampling = part(addon, "mocap.sampling")
    clip = sampling.sample(bpy.context, obj, action, rig)
    times = sampling.sample_times(bpy.context.scene, obj, action)
    assert [name for _, name in clip.markers] == ["begin", "hit"]
    assert np.interp([at for at, _ in clip.markers], np.arange(len(times)), times) == pytest.approx([1, 41], abs=1e-6)


def test_parts_around_what_is_left_out_keep_theirs(addon: ModuleType, obj: bpy.types.Object) -> None:
    action = mark(bpy.data.actions[JUMP], first=11, gone=31, second=61)
    span = action.fragmotion.left_out.add()
    span.first, span.last = 25, 40
    parts = part(addon, "mocap.sampling").sample_parts(bpy.context, obj, action, part(addon, "rig.rigs").make_rig(obj))
    assert [[name for _, name in clip.markers] for clip in parts] == [["first"], ["second"]]
    assert parts[1].markers[0][0] == pytest.approx(61 - 41, abs=1e-6)


def test_the_exported_policy_has_the_moves_markers_and_a_player_passes_them(
    addon: ModuleType, obj: bpy.types.Object, tmp_path: Path
) -> None:
    mark(bpy.data.actions[JUMP], hit=46, whoosh=36)
    moves = part(addon, "character.moves")
    moves.add_move(bpy.context, obj, bpy.data.actions[JUMP], (31, 91), ["W", "R"])
    assert bpy.ops.fragmotion.export_to_game(filepath=str(tmp_path / "hero.policy")) == {"FINISHED"}
    core = part(addon, "compat.core").core
    character = core.Character.from_bytes((tmp_path / "hero.policy").read_bytes())
    assert [name for _, name in character.moves[0].clip.markers] == ["whoosh", "hit"]
    player = core.Player(character)
    player.start_move(0)
    told = []
    for _ in range(400):
        player.step([0, 0, 0, 0], 1 / 60)
        told += player.passed_markers
    assert told == ["whoosh", "hit"]


def test_a_new_marker_makes_the_character_stale(addon: ModuleType, obj: bpy.types.Object) -> None:
    staleness = part(addon, "character.staleness")
    before = staleness.sources_of(obj)
    mark(part(addon, "mocap.actions").ticked(obj)[0], step=5)
    assert staleness.sources_of(obj) != before
    assert staleness.is_stale(obj)


def test_what_is_retargeted_is_marked_alike(addon: ModuleType, obj: bpy.types.Object) -> None:
    source, made = mark(bpy.data.actions[JUMP], hit=41), bpy.data.actions.new("made")
    part(addon, "mocap.markers").mark_likewise(source, np.arange(1.0, 121), made, 1 + 2 * np.arange(120.0))
    assert [(marker.name, marker.frame) for marker in made.pose_markers] == [("hit", 81)]
