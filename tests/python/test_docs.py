# SPDX-License-Identifier: MIT
"""What a reader may expect of the pages: nothing said twice, links that lead somewhere, a README that is short."""

from __future__ import annotations

import argparse
import re
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from layers import TOP

from tools.docs import directing, evaluation, pages
from tools.docs.filling import filled
from tools.shell import Failure

PAGES = sorted([*TOP.glob("*.md"), *(TOP / "docs").glob("*.md")])
NAMES = [path.relative_to(TOP).as_posix() for path in PAGES]
CORE = [TOP / "cpp" / "src" / half for half in ("play", "make")]
LINES = 120  # of the README
WORDS = 8  # of a sentence that is as good as any other
_CODE = re.compile(r"^```.*?^```|<!--.*?-->", re.DOTALL | re.MULTILINE)
_LINK = re.compile(r"\[(?:!\[[^]]*\]\([^)]*\)|[^]])*\]\(([^)\s]+)\)")


def text_of(path: Path) -> str:
    """A page without what is quoted from programs."""
    return _CODE.sub("", path.read_text(encoding="utf-8"))


def sentences(path: Path) -> Iterator[str]:
    """Those of a page that are longer than a remark, as they sound."""
    text = re.sub(r"!?\[([^]]*)\]\([^)]*\)", r"\1", text_of(path))
    for paragraph in re.split(r"\n\s*\n|\n\s*(?:[-*]|\d+\.) |\n(?=#)|\|", text):
        for sentence in re.split(r"(?<=[.!?:;])\s+", paragraph):
            words = re.findall(r"[\w']+", sentence.lower())
            if len(words) > WORDS:
                yield " ".join(words)


def anchors(path: Path) -> set[str]:
    """What a link can name of a page: its headings."""
    headings = re.findall(r"^#+ (.+)$", text_of(path), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def test_no_sentence_stands_twice() -> None:
    places = defaultdict(list)
    for path, name in zip(PAGES, NAMES):
        for sentence in sentences(path):
            places[sentence].append(name)
    assert {sentence: found for sentence, found in places.items() if len(found) > 1} == {}


def test_the_readme_is_short() -> None:
    assert len((TOP / "README.md").read_text(encoding="utf-8").splitlines()) <= LINES


@pytest.mark.parametrize("name", NAMES)
def test_every_link_leads_somewhere(name: str) -> None:
    path = TOP / name
    for link in _LINK.findall(text_of(path)):
        if "://" in link:
            continue
        file, _, anchor = link.partition("#")
        target = (path.parent / file).resolve() if file else path
        assert target.exists(), link
        assert not anchor or anchor in anchors(target), link


@pytest.mark.parametrize("page", [directing, evaluation], ids=["directing", "evaluation"])
def test_tables_hold_the_figures_that_were_measured(page: Any) -> None:
    text = page.PAGE.read_text(encoding="utf-8")
    assert filled(text, page.made()) == text


def test_pages_are_made_by_their_names() -> None:
    page = text_of(TOP / "docs" / "developing.md")
    assert [name for name in pages.PAGES if f"`{name}`" not in page] == []
    with pytest.raises(Failure, match="there is no page manual; the pages are readme, guide"):
        pages.make_docs(argparse.Namespace(pages=["guide", "manual"]))


def test_the_paper_is_found_in_the_code() -> None:
    """Each row of the table says what is meant, and in which files it is."""
    page = text_of(TOP / "docs" / "developing.md")
    section = page[page.index("## The paper, line by line") :].split("\n## ")[0]
    rows = [row.split("|")[1:3] for row in section.splitlines() if row.startswith("|")][2:]
    named = " ".join(meant for meant, _ in rows)
    for number in range(1, 7):
        assert f"Eq. {number}" in named
    for word in ("Dis ", "Ev(f)", "ControlDis", "foot lock", "inertialization"):
        assert word in named, word
    for meant, where in rows:
        headers = re.findall(r"`([\w/]+)`", where)
        assert headers, meant
        assert [header for header in headers if not any((half / f"{header}.hpp").exists() for half in CORE)] == []
