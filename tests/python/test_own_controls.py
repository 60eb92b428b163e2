# SPDX-License-Identifier: MIT
"""Control spaces that are not the paper's, from Python: their arrays, tables and refusals."""

from __future__ import annotations

import math
from pathlib import Path

import fragmotion_command
import fragmotion_core as core
import numpy as np
import pytest
from conftest import Array
from sample_motions import write_sample

FINE = core.ControlSpace(speeds=[0.7, 1.3, 2.2, 3.5], directions=16)
PLAIN = core.ControlSpace(speeds=[1.3], directions=4, turn=False, jump=False)


def test_the_default_is_the_papers() -> None:
    space = core.ControlSpace()
    assert (space.shape, space.speeds, space.gaits, space.directions) == ((17, 3, 2), [1.2, 3.3], ["walk", "run"], 8)
    assert space.turns and space.jumps
    usual = core.BuildOptions().usual_space
    assert usual.shape == space.shape and np.array_equal(usual.points, space.points)


@pytest.mark.parametrize("space", [FINE, PLAIN, core.ControlSpace()])
def test_points_are_a_table_of_velocity_turn_and_jump(space: core.ControlSpace) -> None:
    table = space.points.reshape(*space.shape, 4)
    velocities = [(0.0, 0.0)]
    for speed in space.speeds:
        angles = 2 * np.pi * np.arange(space.directions) / space.directions
        velocities += list(zip(-speed * np.sin(angles), speed * np.cos(angles)))
    np.testing.assert_allclose(table[:, 0, 0, :2], velocities, atol=1e-12)
    assert table[0, :, 0, 2].tolist() == ([-1, 0, 1] if space.turns else [0])
    assert table[0, 0, :, 3].tolist() == ([0, 1] if space.jumps else [0])
    assert np.array_equal(space.nearest(space.points), np.arange(len(space.points)))


def test_gaits_and_directions_have_names() -> None:
    assert FINE.gaits == ["stroll", "walk", "jog", "run"] and PLAIN.gaits == ["walk"]
    assert set(FINE.gaits) < set(core.GAITS) and (FINE.walk, FINE.run) == (1.3, 3.5)
    assert len(core.DIRECTIONS) == 16 and core.DIRECTIONS[::4] == ["forward", "left", "back", "right"]


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"speeds": []}, "number of speeds is 0, expected 1 to 4"),
        ({"speeds": [1, 2, 3, 4, 5]}, "number of speeds is 5, expected 1 to 4"),
        ({"speeds": [2, 1]}, r"run \(m/s\) is 1, expected more than what is slower"),
        ({"speeds": [1, math.nan, 3]}, r"speed \(m/s\) is nan"),
        ({"directions": 6}, "number of directions is 6, expected 4, 8 or 16"),
    ],
)
def test_what_is_no_space_is_refused(given: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        core.ControlSpace(**given)  # type: ignore[arg-type]


@pytest.mark.parametrize(("field", "value"), [("speeds", 0), ("speeds", 5), ("directions", 12)])
def test_a_build_is_refused_before_it_begins(field: str, value: int, character: core.Character) -> None:
    options = core.BuildOptions()
    setattr(options, field, value)
    clip = core.Clip(
        character.skeleton, "x", 30.0, np.zeros((5, 3)), np.tile([1.0, 0, 0, 0], (5, len(character.skeleton.names), 1))
    )
    with pytest.raises(ValueError, match=rf"number of {field} is {value}"):
        core.build(character.skeleton, [clip], [core.simulate_trace("walker", 2)], options)


def random_factors(classes: int, controls: int) -> tuple[Array, Array]:
    random = np.random.default_rng(controls)
    return random.uniform(0.1, 1, (classes, classes)), random.uniform(0.1, 1, (classes, controls))


@pytest.mark.parametrize("controls", [5, 390])
def test_tables_are_of_as_many_controls_as_match(controls: int) -> None:
    smoothness, match = random_factors(6, controls)
    trace = np.random.default_rng(1).integers(0, controls, 50)
    greedy = core.greedy_table(smoothness, match)
    assert np.array_equal(greedy, (smoothness[:, :, None] * match).argmax(1))
    for table in (
        greedy,
        core.anticipate_table(smoothness, match, [trace]),
        core.iterate_table(smoothness, match, [trace]),
    ):
        assert table.shape == (6, controls)
        assert 0 < core.percent_of_optimal(smoothness, match, table, trace) <= 100 + 1e-9
    model = core.control_model([trace], controls=controls)
    assert model.shape == (controls, controls)
    np.testing.assert_allclose(model.sum(1), 1)
    with pytest.raises(ValueError, match="a trace of controls"):
        core.optimal_path(smoothness, match, [controls])
    with pytest.raises(ValueError, match=f"match is of {controls} controls, and space has 102"):
        core.svm_table(smoothness, match, [trace], np.ones((6, 2)), core.ControlSpace())


def test_the_command_builds_with_controls_of_its_own(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "takes").mkdir()
    write_sample(tmp_path / "takes")
    words = ["build", str(tmp_path / "takes"), "--policy", str(tmp_path / "own.policy"), "--classes", "20"]
    assert fragmotion_command.main([*words, "--speeds", "3", "--directions", "4", "--no-jump"]) == 0
    space = core.Character.load(tmp_path / "own.policy").space
    assert space.shape == (13, 3, 1)
    capsys.readouterr()
    assert fragmotion_command.main(["info", str(tmp_path / "own.policy")]) == 0
    assert "directions 4, controls 39" in capsys.readouterr().out
    assert fragmotion_command.main([*words, "--controls", "found"]) == 0
    assert core.Character.load(tmp_path / "own.policy").space.turns
