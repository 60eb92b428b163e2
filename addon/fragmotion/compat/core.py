# SPDX-License-Identifier: GPL-3.0-or-later
"""The compiled core as `core`: the one inside the add-on (legacy zip), else the extension's installed wheel."""

from __future__ import annotations

from importlib import import_module, util
from pathlib import Path
from types import ModuleType

from .missing import CoreMissing, explain

ADDON = __package__.rpartition(".")[0]
"""The add-on's package, by which Blender knows it."""

_NAME = "fragmotion_core"


def _load() -> ModuleType:
    try:
        return import_module(f".{_NAME}", ADDON) if _is_bundled() else import_module(_NAME)
    except ImportError as error:
        raise CoreMissing(explain(error, Path(__file__).parents[1])) from error


def _is_bundled() -> bool:
    return util.find_spec(f".{_NAME}", ADDON) is not None


core = _load()


def command(name: str) -> ModuleType:
    """A module of the command that comes with the core."""
    path = f"fragmotion_command.{name}"
    return import_module(f".{path}", ADDON) if _is_bundled() else import_module(path)
