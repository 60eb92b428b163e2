# SPDX-License-Identifier: MIT
"""How many tests passed, failed and were skipped, and which were skipped why, by the JUnit reports."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple


class Skip(NamedTuple):
    """A test that was skipped."""

    test: str
    reason: str


@dataclass(frozen=True)
class Counts:
    """Numbers of tests, and those that were skipped by name."""

    passed: int = 0
    failed: int = 0
    skipped: int = 0
    skips: tuple[Skip, ...] = ()

    def __add__(self, other: Counts) -> Counts:
        """Both together."""
        return Counts(
            self.passed + other.passed,
            self.failed + other.failed,
            self.skipped + other.skipped,
            self.skips + other.skips,
        )


def read_report(report: Path) -> Counts:
    """The counts of a JUnit report of pytest's, GoogleTest's or ctest's; none where there is no report."""
    if not report.exists():
        return Counts()
    root = ElementTree.parse(report).getroot()
    suites = list(root.iter("testsuite"))
    total, failures, errors, skipped, disabled = (
        sum(int(suite.get(name, 0)) for suite in suites)
        for name in ("tests", "failures", "errors", "skipped", "disabled")
    )
    left = skipped + disabled
    skips = tuple(skip for case in root.iter("testcase") if (skip := _skip(case)))
    return Counts(total - failures - errors - left, failures + errors, left, skips)


def _skip(case: ElementTree.Element) -> Skip | None:
    said = case.find("skipped")
    if said is None and case.get("status") not in ("notrun", "disabled"):
        return None
    reason = (said.get("message") if said is not None else "") or "disabled"
    reason = re.sub(r"^\S+:\d+\n", "", reason)  # GoogleTest's place in the source
    names = [name for name in (case.get("classname"), case.get("name")) if name]
    return Skip(".".join(dict.fromkeys(names)), reason.strip())
