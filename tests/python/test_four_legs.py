# SPDX-License-Identifier: MIT
"""A folder with takes of an animal whose names are a man's and whose rest pose shows nothing."""

from __future__ import annotations

from pathlib import Path

import fragmotion_command
import fragmotion_core as core
import numpy as np
import pytest
from made_dog import HEIGHT, write_dog


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A dog's stand, walk and trot."""
    path = tmp_path_factory.mktemp("dog")
    for name, speed, stride in (("stand", 0.0, 1.0), ("walk", 0.6, 0.6), ("trot", 1.2, 0.4)):
        write_dog(path / f"{name}.bvh", speed, stride=stride)
    return path


def test_a_folder_alone_makes_a_dog(folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["build", folder, "--policy", tmp_path / "dog.policy", "--classes", 12]
    assert fragmotion_command.main([str(word) for word in words]) == 0
    said = capsys.readouterr().err
    assert said.count("mended") == said.count("metres (a unit of 1 m)") == 3, said
    dog = core.Character.load(tmp_path / "dog.policy")
    roles = dog.skeleton.roles
    assert roles["left_fore_foot"] == "LeftHand" and roles["right_foot"] == "RightFoot" and "left_hand" not in roles
    performance = core.Player(dog, 1).run(np.tile([0.0, dog.space.walk, 0, 0], (60, 1)), 60.0)
    way = performance.path[-1, :2] - performance.path[180, :2]
    assert np.linalg.norm(way) / 3 == pytest.approx(dog.space.walk, rel=0.2)
    assert performance.root_positions[:, 2].mean() == pytest.approx(HEIGHT, abs=0.05)
    metrics = core.MotionMetrics(dog)
    assert metrics.of(performance).foot_skate < metrics.takes.foot_skate


def test_the_doctor_says_only_what_is_so(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert fragmotion_command.main(["doctor", str(folder)]) == 0
    said = capsys.readouterr().out
    assert said.count("on four legs") == 6, said
    assert "3 unit" in said and "1 frozen" in said and "no arms" not in said
