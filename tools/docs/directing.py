# SPDX-License-Identifier: MIT
"""The tables of docs/directing.md, from the figures of a run of `dev.py directing`."""

from __future__ import annotations

import json
from collections.abc import Callable

from tools.docs.filling import fill, markdown
from tools.measuring.directing.table import tables
from tools.paths import TOP

PAGE = TOP / "docs" / "directing.md"
FIGURES = TOP / "docs" / "directing"


def made() -> Callable[[str], str]:
    """What is made for each name, from the figures in docs/directing."""
    found = tables(json.loads((FIGURES / "directing.json").read_text()))
    return lambda name: markdown(found[name])


if __name__ == "__main__":
    fill(PAGE, made())
