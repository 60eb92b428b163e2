# SPDX-License-Identifier: MIT
"""Make the pictures and the tables of docs/directing.md, on the sample character; it takes a minute:

python3 docs/make_directing_pictures.py

All between <!-- made: NAME --> and <!-- end --> is written anew.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

DOCS = Path(__file__).resolve().parent
sys.path[:0] = [str(DOCS.parent), str(DOCS.parent / "cpp" / "bindings")]

from fragmotion_command.evaluate.report import Table  # noqa: E402

from tools.measuring.directing.table import tables  # noqa: E402

PAGE, FOLDER = DOCS / "directing.md", DOCS / "directing"
_BLOCK = re.compile(r"(<!-- made: (\S+) -->\n).*?(<!-- end -->)", re.DOTALL)


def measure() -> dict[str, Any]:
    """Run `dev.py directing`, which draws the pictures; its figures."""
    target = FOLDER / "directing.json"
    FOLDER.mkdir(exist_ok=True)
    command = [sys.executable, str(DOCS.parent / "dev.py"), "directing", "--figures", FOLDER, "--json", target]
    subprocess.run(command, check=True)
    result: dict[str, Any] = json.loads(target.read_text())
    return result


def markdown(table: Table) -> str:
    """A table as the page has it."""
    rows = [table.header, ["---", *["---:"] * (len(table.header) - 1)], *table.rows]
    return "".join(f"| {' | '.join(row)} |\n" for row in rows)


def fill(page: str, result: Mapping[str, Any]) -> str:
    """The page with the figures of a run."""
    made = tables(result)
    return _BLOCK.sub(lambda block: block[1] + markdown(made[block[2]]) + block[3], page)


if __name__ == "__main__":
    PAGE.write_text(fill(PAGE.read_text(), measure()))
