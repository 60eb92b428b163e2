# SPDX-License-Identifier: MIT
"""What the core finds in files, as the JSON file says it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TypedDict

from ..core import core
from ..takes import hear, read_all

_FORMATS = {".bvh": "BVH", ".amc": "ASF/AMC"}
_IN_FILE = {"+X": "+X", "-X": "-X", "+Z": "+Y", "-Z": "-Y", "-Y": "+Z", "+Y": "-Z", "": None}  # readers turn y up to z


class Finding(TypedDict):
    """`mended`: whether it is safe to mend, so that importing may do it unasked; the file stays as it is."""

    code: str
    severity: str
    frames: list[int]
    text: str
    mended: bool


class File(TypedDict):
    """A take of a file; what cannot be told is None. Axes are the file's own."""

    path: str
    take: str | None
    format: str
    unit_m: float | None
    stature_m: float | None
    up: str | None
    facing: str | None
    rate: float | None
    root_motion: bool | None
    rest_pose: str | None
    roles: dict[str, str]
    findings: list[Finding]


class Result(TypedDict):
    """All that was examined."""

    files: list[File]


def examine(paths: Sequence[Path]) -> Result:
    """Read and examine the files; one that cannot be read has a finding `unreadable` with the reader's words."""
    read = read_all(paths)
    takes = [take for _, take in read if isinstance(take, core.Take)]
    examinations = iter(core.examine(takes, progress=hear))
    return {
        "files": [
            _told(path, take, next(examinations)) if isinstance(take, core.Take) else _unreadable(path, take)
            for path, take in read
        ]
    }


def is_readable(file: File) -> bool:
    """Whether there is a take in the file."""
    return all(finding["code"] != "unreadable" for finding in file["findings"])


def _told(path: Path, take: core.Take, examination: core.Examination) -> File:
    return {
        **_empty(path),
        "take": take.name,
        "unit_m": take.unit * examination.scale,
        "stature_m": examination.stature,
        "up": _IN_FILE[examination.up],
        "facing": _IN_FILE[examination.facing],
        "rate": examination.rate,
        "root_motion": examination.root_motion,
        "rest_pose": examination.rest_pose or None,
        "roles": examination.roles,
        "findings": [_finding(finding) for finding in examination.findings],
    }


def _finding(finding: core.Finding) -> Finding:
    return {
        "code": finding.code,
        "severity": finding.severity,
        "frames": list(finding.frames),
        "text": finding.text,
        "mended": finding.safe,
    }


def _unreadable(path: Path, why: str) -> File:
    finding: Finding = {"code": "unreadable", "severity": "error", "frames": [0, 0], "text": why, "mended": False}
    return {**_empty(path), "findings": [finding]}


def _empty(path: Path) -> File:
    return {
        "path": str(path),
        "take": None,
        "format": _FORMATS.get(path.suffix.lower(), path.suffix.lstrip(".").upper()),
        "unit_m": None,
        "stature_m": None,
        "up": None,
        "facing": None,
        "rate": None,
        "root_motion": None,
        "rest_pose": None,
        "roles": {},
        "findings": [],
    }
