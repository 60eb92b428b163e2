# SPDX-License-Identifier: MIT
"""What the binding's tests share: a made character, and the motion capture beside the project."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any, NamedTuple

import fragmotion_core as core
import numpy as np
import pytest
from numpy.typing import NDArray

Array = NDArray[Any]

pytest.register_assert_rewrite("evaluated")

if sys.platform != "linux":
    # The commands of dev.py, which run on Debian, and what is read in the sources.
    collect_ignore = [
        "test_addon_layers.py",
        "test_beside.py",
        "test_directing.py",
        "test_directing_command.py",
        "test_docs.py",
        "test_doctor_command.py",
        "test_evaluate.py",
        "test_evaluate_inputs.py",
        "test_evaluate_run_time.py",
        "test_layers.py",
        "test_likeness.py",
        "test_motion_matching.py",
        "test_motion_pictures.py",
        "test_packages.py",
        "test_pin_figures.py",
        "test_quality.py",
        "test_retarget_command.py",
        "test_running.py",
        "test_testing.py",
    ]

MOCAP = Path(__file__).resolve().parents[3] / "shared" / "mocap"
BANDAI = MOCAP / "bandai-namco"
CMU = MOCAP / "cmu"

NAMES = ["hips", "spine", "head", "hand.L", "hand.R", "thigh.L", "foot.L", "thigh.R", "foot.R"]
PARENTS = [-1, 0, 1, 1, 1, 0, 5, 0, 7]
OFFSETS = [
    [0, 0, 0.95],
    [0, 0, 0.1],
    [0, 0, 0.5],
    [0.2, 0, 0.4],
    [-0.2, 0, 0.4],
    [0.1, 0, 0],
    [0, 0, -0.87],
    [-0.1, 0, 0],
    [0, 0, -0.87],
]
TIPS = [[0, 0, 0.1], [0, 0, 0.5], [0, 0, 0.2]] + [[0, 0, -0.6]] * 2 + [[0, 0, -0.87], [0, -0.2, -0.08]] * 2


def make_skeleton(**changes: Any) -> core.Skeleton:
    """Nine bones whose rest frames are the world's axes; faces -y."""
    arguments: dict[str, Any] = {
        "names": NAMES,
        "parents": PARENTS,
        "rest_rotations": np.tile([1.0, 0, 0, 0], (len(NAMES), 1)),
        "offsets": OFFSETS,
        "tips": TIPS,
    }
    return core.Skeleton(**{**arguments, **changes})


def walking_arrays(
    speed: float = 1.2, side: float = 0.0, turn: float = 0.0, seconds: float = 3.0, rate: float = 30.0
) -> tuple[Array, Array]:
    """Root positions and rotations of a stiff-legged walk: velocity to the right and forward, turn rate in rad/s."""
    t = np.arange(round(seconds * rate) + 1) / rate
    heading = turn * t
    forward = np.stack([-np.sin(heading), np.cos(heading)], 1)
    right = np.stack([np.cos(heading), np.sin(heading)], 1)
    velocity = speed * forward + side * right
    path = np.concatenate([[[0, 0]], np.cumsum((velocity[1:] + velocity[:-1]) / 2 / rate, 0)])
    moving = min(1.0, np.hypot(speed, side) / 1.2)
    roots = np.column_stack([path, 0.95 + 0.02 * moving * np.cos(4 * np.pi * t)])
    rotations = np.tile([1.0, 0, 0, 0], (len(t), len(NAMES), 1))
    rotations[:, 0] = np.stack([np.cos((heading + np.pi) / 2), 0 * t, 0 * t, np.sin((heading + np.pi) / 2)], 1)
    swing = 0.4 * moving * np.sin(2 * np.pi * t)
    for bone, sign in (("thigh.L", 1), ("thigh.R", -1), ("hand.L", -1), ("hand.R", 1)):
        rotations[:, NAMES.index(bone)] = np.stack(
            [np.cos(sign * swing / 2), np.sin(sign * swing / 2), 0 * t, 0 * t], 1
        )
    return roots, rotations


def walking_clips(skeleton: core.Skeleton) -> list[core.Clip]:
    """Standing, walks, runs and curves."""
    gaits = [(0, 0, 0), (1.2, 0, 0), (0, 1.2, 0), (-1.2, 0, 0), (3, 0, 0), (1.2, 0, 1.2), (1.2, 0, -1.2), (0, 0, 1.2)]
    return [
        core.Clip(skeleton, f"gait {i}", 30.0, *walking_arrays(speed, side, turn))
        for i, (speed, side, turn) in enumerate(gaits)
    ]


def build_options(**settings: object) -> core.BuildOptions:
    """Options with some fields set."""
    options = core.BuildOptions()
    for name, value in settings.items():
        setattr(options, name, value)
    return options


def small_build(
    skeleton: core.Skeleton, clips: list[core.Clip], traces: list[Array], progress: core.Progress
) -> core.Character:
    return core.build(skeleton, clips, traces, build_options(classes=10), progress)


@pytest.fixture(scope="session")
def skeleton() -> core.Skeleton:
    return make_skeleton()


@pytest.fixture(scope="session")
def clips(skeleton: core.Skeleton) -> list[core.Clip]:
    return walking_clips(skeleton)


@pytest.fixture(scope="session")
def traces() -> list[Array]:
    return [core.simulate_trace("explorer", 60, 1), core.simulate_trace("walker", 30, 2)]


@pytest.fixture(scope="session")
def character(skeleton: core.Skeleton, clips: list[core.Clip], traces: list[Array]) -> core.Character:
    """A made character of 30 classes with every policy."""
    return core.build(
        skeleton, clips, traces, build_options(classes=30, policies=["anticipate", "iterate", "svm", "greedy"])
    )


class Bandai(NamedTuple):
    """The whole Bandai-Namco set as one character."""

    skeleton: core.Skeleton
    clips: list[core.Clip]
    character: core.Character


@pytest.fixture(scope="session")
def bandai() -> Bandai:
    """All takes of shared/mocap/bandai-namco on one skeleton, built with the defaults."""
    files = sorted(BANDAI.glob("*.bvh"))
    if not files:
        pytest.skip("no motion capture beside the project")
    takes = [core.read_bvh(path) for path in files]
    skeleton = takes[0].skeleton
    clips = [core.Clip.from_take(take, skeleton) for take in takes]
    traces = [core.simulate_trace("explorer", 60, 1)]
    options = build_options(policies=["anticipate", "iterate", "svm", "greedy"])
    return Bandai(skeleton, clips, core.build(skeleton, clips, traces, options))
