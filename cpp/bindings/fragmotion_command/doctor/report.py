# SPDX-License-Identifier: MIT
"""What was found, as a text for the terminal."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from .examining import File, Result, is_readable

_POSES = {"T": "T pose", "A": "A pose", "down": "arms down", "other": "another rest pose", None: "no arms told"}


def lines(result: Result) -> Iterator[str]:
    """A line for each file and for each of its findings, and what they come to."""
    for file in result["files"]:
        yield f"{file['path']}: {_facts(file) if is_readable(file) else 'cannot be read'}"
        for finding in file["findings"]:
            mended = " (safe to mend)" if finding["mended"] else ""
            yield f"  {finding['severity']}, {finding['code']}: {finding['text']}{mended}"
    yield _summary(result)


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
            _POSES[file["rest_pose"]],
        )
    )


def _summary(result: Result) -> str:
    files = result["files"]
    clean = sum(not file["findings"] for file in files)
    codes = Counter(finding["code"] for file in files for finding in file["findings"])
    found = ", ".join(f"{count} {code}" for code, count in codes.most_common())
    return f"\n{len(files)} files, {clean} without findings" + (f"; {found}" if found else "")
