# SPDX-License-Identifier: MIT
"""Filling a page: all between <!-- made: NAME --> and <!-- end --> is written anew."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

from fragmotion_command.evaluate.report import Table

from tools.shell import say

_BLOCK = re.compile(r"(<!-- made: (\S+) -->\n).*?(<!-- end -->)", re.DOTALL)


def markdown(table: Table) -> str:
    """The table, numbers to the right."""
    rule = ["---", *["---:"] * (len(table.header) - 1)]
    return "\n".join(f"| {' | '.join(line)} |" for line in (table.header, rule, *table.rows))


def filled(text: str, made: Callable[[str], str]) -> str:
    """A page with what is made for each name."""
    return _BLOCK.sub(lambda block: f"{block[1]}\n{made(block[2])}\n\n{block[3]}", text)


def fill(page: Path, made: Callable[[str], str]) -> None:
    """Write a page likewise."""
    page.write_text(filled(page.read_text(), made))
    say(f"{page}: filled")
