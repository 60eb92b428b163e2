# SPDX-License-Identifier: MIT
"""The add-on's folders have an order: none needs one further down, and no two modules need each other."""

from __future__ import annotations

import ast
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest
from layers import TOP, assert_in_order

ADDON = TOP / "addon" / "fragmotion"
FOLDERS = [
    "compat",
    "",  # what all others use: errors, files and jobs
    "rig",
    "mocap",
    "control_rig",
    "ground",
    "recordings",
    "character",
    "games",
    "paths",
    "input",
    "settings",
    "bake",
    "edits",
    "preview",
    "drive/acting",
    "drive/hud",
    "drive",
    "operators/base",
    "operators/character",
    "operators/mocap",
    "operators/directing",
    "operators/games",
    "operators",
    "panels",
]
ENTRIES = [ADDON / name for name in ("__init__.py", "registering.py", "command_line.py")]  # where all of it begins


def modules(folder: str) -> list[Path]:
    """A folder's own modules."""
    return [path for path in sorted((ADDON / folder).glob("*.py")) if path not in ENTRIES]


def needed_by(path: Path) -> set[Path]:
    """The add-on's modules that a module imports, be it for its types alone or inside a function."""
    nodes = ast.walk(ast.parse(path.read_text()))
    return {each for node in nodes if isinstance(node, ast.ImportFrom) and node.level for each in _targets(path, node)}


def _targets(path: Path, node: ast.ImportFrom) -> set[Path]:
    """What a relative import names: a module, or those that it takes out of a folder."""
    place = path.parents[node.level - 1].joinpath(*(node.module or "").split("."))
    if place.with_suffix(".py").exists():
        return {place.with_suffix(".py")}
    found = {_module(place / name.name) for name in node.names}
    assert all(target.exists() for target in found), f"{path}: line {node.lineno}"
    return found


def _module(place: Path) -> Path:
    return place / "__init__.py" if place.is_dir() else place.with_suffix(".py")


def folder_of(path: Path) -> str:
    """The folder of a module, as FOLDERS has it."""
    return path.parent.relative_to(ADDON).as_posix().removeprefix(".")


def test_every_folder_has_its_place() -> None:
    assert {folder_of(path) for path in ADDON.rglob("*.py")} == set(FOLDERS)


@pytest.mark.parametrize("folder", FOLDERS)
def test_a_folder_needs_none_further_down(folder: str) -> None:
    needed = {path: {folder_of(other) for other in needed_by(path)} for path in modules(folder)}
    assert_in_order(FOLDERS, folder, needed)


def test_nothing_needs_the_entry() -> None:
    assert not [path for folder in FOLDERS for path in modules(folder) if needed_by(path) & set(ENTRIES)]


def test_no_modules_need_each_other() -> None:
    graph = {path: needed_by(path) for folder in FOLDERS for path in modules(folder)}
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        names = [path.relative_to(ADDON).as_posix() for path in error.args[1]]
        pytest.fail(f"a circle: {' - '.join(names)}")
