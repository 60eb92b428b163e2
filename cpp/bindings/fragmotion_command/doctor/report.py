# SPDX-License-Identifier: MIT
"""What was found, as a text for the terminal."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from ..takes import with_more
from .examining import File, Finding, Result, is_readable

_POSES = {"T": "T pose", "A": "A pose", "down": "arms down", "other": "another rest pose", None: "no arms told"}


def lines(result: Result) -> Iterator[str]:
    """A line for each file and for each of its findings, and what they come to."""
    takes = Counter(file["path"] for file in result["files"])
    for file in result["files"]:
        take = f", take '{file['take']}'" if takes[file["path"]] > 1 else ""
        yield f"{file['path']}{take}: {_facts(file) if is_readable(file) else 'cannot be read'}"
        for (severity, code, is_mended), alike in _grouped(file["findings"]):
            mended = " (safe to mend)" if is_mended else ""
            yield f"  {severity}, {code}: {with_more([finding['text'] for finding in alike])}{mended}"
    yield _summary(result)


def _grouped(findings: list[Finding]) -> Iterator[tuple[tuple[str, str, bool], list[Finding]]]:
    """Findings that differ by their frames alone, together."""
    groups: dict[tuple[str, str, bool], list[Finding]] = {}
    for finding in findings:
        groups.setdefault((finding["severity"], finding["code"], finding["mended"]), []).append(finding)
    yield from groups.items()


def _facts(file: File) -> str:
    return ", ".join(
        (
            file["format"],
            f"unit {file['unit_m']:.4g} m",
            f"{file['stature_m']:.2f} m tall",
            f"up {file['up'] or 'not told'}",
            f"facing {file['facing'] or 'not told'}",
            f"{file['rate']:.6g} frames/s{' (taken: AMC files hold none)' if file['format'] == 'ASF/AMC' else ''}",
            "root motion" if file["root_motion"] else "in place",
            "on four legs" if "left_fore_foot" in file["roles"] else _POSES[file["rest_pose"]],
        )
    )


def _summary(result: Result) -> str:
    files = result["files"]
    clean = sum(not file["findings"] for file in files)
    codes = Counter(finding["code"] for file in files for finding in file["findings"])
    found = ", ".join(f"{count} {code}" for code, count in codes.most_common())
    return f"\n{len(files)} takes, {clean} without findings" + (f"; {found}" if found else "")
