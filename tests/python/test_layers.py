# SPDX-License-Identifier: MIT
"""The core's folders are the stages of its data flow: none needs one further down, and the run time stands alone."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from layers import TOP, assert_in_order

STAGES = [
    "base",
    "skeleton",
    "motion",
    "io",
    "control",
    "fragments",
    "classes",
    "policy",
    "character",
    "runtime",
    "build",
    "evaluate",
]
ROOTS = [TOP / "cpp" / "include" / "fragmotion", TOP / "cpp" / "src"]


def sources(stage: str) -> list[Path]:
    """The headers and sources of a stage."""
    return [path for root in ROOTS for path in sorted((root / stage).glob("*.?pp"))]


def stages_needed_by(path: Path) -> set[str]:
    """The stages whose headers a file includes."""
    return set(re.findall(r'^#include "(?:fragmotion/)?(\w+)/\w+\.hpp"', path.read_text(), re.MULTILINE))


@pytest.mark.parametrize("root", ROOTS, ids=["include", "src"])
def test_every_folder_is_a_stage(root: Path) -> None:
    assert {path.name for path in root.iterdir()} <= set(STAGES)


@pytest.mark.parametrize("stage", STAGES)
def test_a_stage_needs_none_further_down(stage: str) -> None:
    assert_in_order(STAGES, stage, {path: stages_needed_by(path) for path in sources(stage)})
