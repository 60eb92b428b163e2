# SPDX-License-Identifier: MIT
"""What the binding refuses, and the cause that it names."""

from __future__ import annotations

from collections.abc import Callable

import fragmotion_core as core
import numpy as np
import pytest
from conftest import Array, build_options, walking_arrays


def test_errors_are_value_errors_that_name_the_cause(
    skeleton: core.Skeleton, clips: list[core.Clip], traces: list[Array], character: core.Character
) -> None:
    roots, rotations = walking_arrays()
    broken = rotations.copy()
    broken[7, 2] = np.nan
    few = build_options(classes=5, policies=["greedy"])
    cases: list[tuple[str, Callable[[], object]]] = [
        ("frame 7.*head", lambda: core.Clip(skeleton, "walk", 30, roots, broken)),
        ("shape", lambda: core.Clip(skeleton, "walk", 30, roots[:-1], rotations)),
        ("rate", lambda: core.Clip(skeleton, "walk", 0, roots, rotations)),
        ("no takes", lambda: core.build(skeleton, [], traces, few)),
        ("no trace", lambda: core.build(skeleton, clips, [], few)),
        ("two controls", lambda: core.build(skeleton, clips, [np.zeros((1, 4))], few)),
        ("shape", lambda: core.build(skeleton, clips, [np.zeros((5, 3))], few)),
        ("not a number", lambda: core.build(skeleton, clips, [np.full((5, 4), np.nan)], few)),
        ("wise", lambda: core.build(skeleton, clips, traces, build_options(classes=5, policies=["wise"]))),
        ("cut", lambda: build_options(cut="bones")),
        ("wise", lambda: character.percent_of_optimal(traces[0], "wise")),
        ("wise", lambda: core.Player(character, policy="wise")),
        ("stitching", lambda: core.Player(character, stitch=3)),
        ('there is no stitching "glue"', lambda: core.Player(character, stitching="glue")),
        ("shape", lambda: core.Player(character).step([0, 1, 0], 0.1)),
        ("not a number", lambda: core.Player(character).step([0, np.nan, 0, 0], 0.1)),
        ("not a number", lambda: core.Player(character).step([0, 1, 0, np.inf], 0.1)),
        ("step", lambda: core.Player(character).step([0, 1, 0, 0], -0.1)),
        ("step", lambda: core.Player(character).step([0, 1, 0, 0], np.nan)),
        ("step", lambda: core.Player(character).step([0, 1, 0, 0], np.inf)),
        ("not a number", lambda: core.Player(character).run([[0, 1, 0, np.nan]], 30)),
        ("rate", lambda: core.Player(character).run(traces[0], 0)),
        ("no controls", lambda: core.Player(character).run(np.zeros((0, 4)), 30)),
        ("no controls", lambda: character.optimal(np.zeros((0, 4)))),
        ("shape", lambda: character.optimal(np.zeros(4))),
        ("policy", lambda: core.Character.from_bytes(b"nonsense")),
        ("all: cannot be read", lambda: core.Character.load("/nowhere/at/all")),
        ("nowhere/at/all: No such file", lambda: character.save("/nowhere/at/all")),
        ("nowhere/at/all: No such file", lambda: core.write_trace("/nowhere/at/all", traces[0])),
        ("unheard", lambda: core.simulate_trace("unheard")),
    ]
    for message, call in cases:
        with pytest.raises(ValueError, match=message):
            call()


def test_player_needs_a_character() -> None:
    with pytest.raises(TypeError):
        core.Player(None)  # type: ignore[arg-type]
