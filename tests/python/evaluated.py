# SPDX-License-Identifier: MIT
"""What the tests of `fragmotion evaluate` share: a few made takes, a run of the tool on them, and its character."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, NamedTuple

import fragmotion_core as core
import numpy as np
import pytest
from conftest import NAMES, OFFSETS, PARENTS, TIPS, build_options, walking_arrays
from fragmotion_command import main
from fragmotion_command.evaluate.loading import read_recordings
from fragmotion_command.evaluate.measures import synthesis

CLASSES = 12
SEED = 5


def y_up(points: Any) -> Any:
    """z-up metres to a BVH file's y-up centimetres."""
    return 100 * np.asarray(points, float)[..., [0, 2, 1]] * (1, 1, -1)


def write_bvh(path: Path, names: list[str], roots: Any, rotations: Any) -> None:
    """A take of the made skeleton, its bones called `names`."""
    lines = ["HIERARCHY"]

    def joint(bone: int, depth: int) -> None:
        children = [child for child, parent in enumerate(PARENTS) if parent == bone]
        offset = " ".join(f"{value:.4f}" for value in y_up(OFFSETS[bone] if bone else [0, 0, 0]))
        channels = "6 Xposition Yposition Zposition" if bone == 0 else "3"
        tip = " ".join(f"{value:.4f}" for value in y_up(TIPS[bone]))
        lines.append(f"{'JOINT' if bone else 'ROOT'} {names[bone]} {{ OFFSET {offset}")
        lines.append(f"CHANNELS {channels} Zrotation Xrotation Yrotation")
        for child in children:
            joint(child, depth + 1)
        if not children:
            lines.append(f"End Site {{ OFFSET {tip} }}")
        lines.append("}")

    joint(0, 0)
    turned = rotations[..., [0, 1, 3, 2]] * (1, 1, 1, -1)
    angles = [np.degrees(core.quaternion_to_euler("YXZ", turned[:, bone])) for bone in range(len(names))]
    columns = np.hstack([y_up(roots), *(angle[:, [2, 0, 1]] for angle in angles)])
    lines += ["MOTION", f"Frames: {len(roots)}", "Frame Time: 0.0333333"]
    lines += [" ".join(f"{value:.5f}" for value in row) for row in columns]
    path.write_text("\n".join(lines) + "\n")


@pytest.fixture(scope="session")
def takes(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder of walks, runs and curves as BVH files."""
    folder = tmp_path_factory.mktemp("takes")
    gaits = [(0, 0, 0), (1.2, 0, 0), (0, 1.2, 0), (-1.2, 0, 0), (3, 0, 0), (1.2, 0, 1.2), (0, 0, 1.2)]
    for i, (speed, side, turn) in enumerate(gaits):
        write_bvh(folder / f"gait_{i}.bvh", NAMES, *walking_arrays(speed, side, turn))
    return folder


class Run(NamedTuple):
    """What a run of the tool left."""

    folder: Path
    result: dict[str, Any]


def refuse_constant(name: str) -> float:
    raise AssertionError(f"the JSON file holds {name}")


def command(*words: str | Path | int) -> int:
    """The tool's exit code, with one process for each controller's synthesis: medians are for those who read them."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(synthesis, "_PROCESSES", 1)
        return main(["evaluate", *(str(word) for word in words)])


def evaluate(takes: Path, folder: Path, *arguments: str | Path) -> Run:
    """Run the tool without curves."""
    options = ("--classes", CLASSES, "--seed", SEED, "--json", folder / "all.json", "--no-curves", *arguments)
    assert command(takes, *options) == 0
    return Run(folder, json.loads((folder / "all.json").read_text(), parse_constant=refuse_constant))


@pytest.fixture(scope="session")
def run(takes: Path, tmp_path_factory: pytest.TempPathFactory) -> Run:
    """The tool on the simulated players, with pictures."""
    folder = tmp_path_factory.mktemp("run")
    return evaluate(takes, folder, "--figures", folder / "figures")


def trace(run: Run, kind: str, name: str) -> Any:
    return core.read_trace(run.folder / "figures" / "traces" / kind / f"{name}.csv")


@pytest.fixture(scope="session")
def built(takes: Path, run: Run) -> core.Character:
    """The character that the tool built, built by hand."""
    recordings = read_recordings([takes], 0.01)
    options = build_options(classes=CLASSES, seed=SEED, policies=["anticipate", "greedy", "svm", "iterate"])
    return core.build(*recordings, [trace(run, "train", run.result["train"][0])], options)
