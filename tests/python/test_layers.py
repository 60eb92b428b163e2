# SPDX-License-Identifier: MIT
"""The core's folders are the stages of its data flow: none needs one further down, and the run time stands alone."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

import pytest
from layers import TOP, assert_in_order

STAGES = [
    "base",
    "skeleton",
    "motion",
    "feet",
    "io",
    "retarget",
    "doctor",
    "control",
    "fragments",
    "classes",
    "policy",
    "character",
    "runtime",
    "bake",
    "direct",
    "api",
    "build",
    "evaluate",
]
SOURCES = TOP / "cpp" / "src"
PLAY, MAKE = SOURCES / "play", SOURCES / "make"


def sources(stage: str) -> list[Path]:
    """The headers and sources of a stage."""
    return [path for root in (PLAY, MAKE) for path in sorted((root / stage).glob("*.?pp"))]


def stages_needed_by(path: Path) -> set[str]:
    """The stages whose headers a file includes."""
    return {name.partition("/")[0] for name in headers_needed_by(path)}


def headers_needed_by(path: Path) -> set[str]:
    """The private headers that a file includes, as they are named: "stage/name.hpp"."""
    return set(re.findall(r'^#include "(\w+/\w+\.hpp)"', path.read_text(encoding="utf-8"), re.MULTILINE))


@pytest.mark.parametrize("root", [PLAY, MAKE], ids=["play", "make"])
def test_every_folder_is_a_stage(root: Path) -> None:
    mathematics = {"same_math"}  # in C, of which no stage knows
    assert {path.name for path in root.iterdir()} - mathematics <= set(STAGES)


@pytest.mark.parametrize("stage", STAGES)
def test_a_stage_needs_none_further_down(stage: str) -> None:
    assert_in_order(STAGES, stage, {path: stages_needed_by(path) for path in sources(stage)})


def test_games_see_the_c_api_and_its_wrapper_alone() -> None:
    headers = [path for path in (TOP / "cpp" / "include").rglob("*") if path.is_file()]
    assert {path.name for path in headers} == {"fragmotion.h", "fragmotion.hpp"}
    for path in headers:
        assert headers_needed_by(path) <= {"fragmotion/fragmotion.h"}, path.relative_to(TOP)


def test_what_plays_needs_nothing_of_what_makes_and_no_thread() -> None:
    files = sorted(PLAY.glob("*/*.?pp"))
    assert {path.parent.name for path in files} >= {"character", "runtime"}
    for path in files:
        missing = {name for name in headers_needed_by(path) if not (PLAY / name).exists()}
        assert missing <= {"fragmotion/fragmotion.hpp"}, path.relative_to(TOP)
        lines = path.read_text(encoding="utf-8")
        assert not re.search(r"^#include <(thread|future|mutex|svm\.h)>", lines, re.MULTILINE), path


def test_no_header_of_what_makes_is_named_as_one_of_what_plays() -> None:
    assert not {f"{path.parent.name}/{path.name}" for path in MAKE.glob("*/*.hpp")} & {
        f"{path.parent.name}/{path.name}" for path in PLAY.glob("*/*.hpp")
    }


def test_no_two_types_have_one_name() -> None:
    defined = re.compile(r"^(?:class|struct|enum class|enum) (\w+)(?: final)?(?: :[^;{]*)? \{", re.MULTILINE)
    headers = sorted(SOURCES.glob("*/*/*.hpp"))
    names = Counter(name for path in headers for name in defined.findall(path.read_text(encoding="utf-8")))
    assert len(names) > 100
    assert [name for name, count in names.items() if count > 1] == []
