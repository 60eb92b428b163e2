# SPDX-License-Identifier: GPL-3.0-or-later
"""The compiled core as `core`: the one inside the add-on (legacy zip), else the extension's installed wheel."""

from __future__ import annotations

import sys
from importlib import import_module, util
from types import ModuleType

ADDON = __package__.rpartition(".")[0]
"""The add-on's package, by which Blender knows it."""

_NAME = "fragmotion_core"


def _load() -> ModuleType:
    bundled = util.find_spec(f".{_NAME}", ADDON) is not None
    try:
        return import_module(f".{_NAME}", ADDON) if bundled else import_module(_NAME)
    except ImportError as error:
        python = ".".join(str(part) for part in sys.version_info[:2])
        raise ImportError(
            f"Fragmotion's compiled core ({_NAME}) cannot be loaded in this Blender, which runs Python {python} on "
            f"{sys.platform}: {error}. Fragmotion's zips are built for Python 3.11 and 3.13 on Linux x86_64: install "
            "the one made for this Blender."
        ) from error


core = _load()
