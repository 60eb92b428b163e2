# SPDX-License-Identifier: MIT
"""The core's folders are the stages of its data flow: none needs one further down, and the run time stands alone."""

from __future__ import annotations

import re
from fnmatch import fnmatch
from pathlib import Path

import pytest
from layers import TOP, assert_in_order

STAGES = [
    "base",
    "skeleton",
    "motion",
    "io",
    "retarget",
    "doctor",
    "control",
    "fragments",
    "classes",
    "policy",
    "character",
    "ground",
    "runtime",
    "bake",
    "direct",
    "api",
    "build",
    "evaluate",
]
ROOTS = [TOP / "cpp" / "include" / "fragmotion", TOP / "cpp" / "src"]


RUNTIME_PARTS = re.search(
    r"set\(fragmotion_runtime_parts\s+([^)]+)\)", (TOP / "CMakeLists.txt").read_text(encoding="utf-8")
)


def sources(stage: str) -> list[Path]:
    """The headers and sources of a stage."""
    return [path for root in ROOTS for path in sorted((root / stage).glob("*.?pp"))]


def stages_needed_by(path: Path) -> set[str]:
    """The stages whose headers a file includes."""
    return set(
        re.findall(r'^#include "(?:fragmotion/)?(\w+)/\w+\.hpp"', path.read_text(encoding="utf-8"), re.MULTILINE)
    )


@pytest.mark.parametrize("root", ROOTS, ids=["include", "src"])
def test_every_folder_is_a_stage(root: Path) -> None:
    games = {"fragmotion.h", "fragmotion.hpp"}  # what games see: the C API, and its C++
    assert {path.name for path in root.iterdir()} - games <= set(STAGES)


@pytest.mark.parametrize("stage", STAGES)
def test_a_stage_needs_none_further_down(stage: str) -> None:
    assert_in_order(STAGES, stage, {path: stages_needed_by(path) for path in sources(stage)})


def of_runtime(path: Path) -> bool:
    """Whether a header or source belongs to fragmotion_runtime, by the list in CMakeLists.txt."""
    assert RUNTIME_PARTS
    name = f"{path.parent.name}/{path.stem}"
    return any(fnmatch(name, part) for part in RUNTIME_PARTS[1].split())


def headers_needed_by(path: Path) -> set[Path]:
    """The project's headers that a file includes."""
    names = re.findall(r'^#include "([\w/]+\.hpp)"', path.read_text(encoding="utf-8"), re.MULTILINE)
    return {
        root / name
        for name in names
        for root in (TOP / "cpp" / "include", TOP / "cpp" / "src")
        if (root / name).exists()
    }


def test_the_runtime_library_needs_no_header_of_another_and_no_thread() -> None:
    left = [path for stage in STAGES for path in sources(stage) if path.suffix == ".cpp" and of_runtime(path)]
    assert {path.parent.name for path in left} >= {"character", "runtime"}
    seen: set[Path] = set()
    while left:
        path = left.pop()
        assert of_runtime(path), path.relative_to(TOP)
        assert not re.search(
            r"^#include <(thread|future|mutex|svm\.h)>", path.read_text(encoding="utf-8"), re.MULTILINE
        ), path
        seen.add(path)
        left += headers_needed_by(path) - seen
