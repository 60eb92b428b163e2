# SPDX-License-Identifier: GPL-3.0-or-later
"""SDL as a Python module: the one inside the add-on (legacy zip), else the extension's installed wheels."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module, util
from pathlib import Path
from typing import Any

from ..compat.core import ADDON

_LIBRARY = "PYSDL2_DLL_PATH"  # environment variable that tells sdl2 where to look


class SdlMissing(Exception):
    """Why there is no SDL."""


def load() -> Any:
    """The module sdl2 with the library that comes with the add-on; SdlMissing where it cannot be loaded."""
    bundled = util.find_spec(".sdl2", ADDON) is not None
    try:
        with _library_in(_library_folder(bundled)):
            return import_module(".sdl2", ADDON) if bundled else import_module("sdl2")
    except (ImportError, OSError, RuntimeError) as error:
        raise SdlMissing(f"Gamepads cannot be used, as SDL cannot be loaded: {error}") from error


def _library_folder(bundled: bool) -> Path | None:
    spec = util.find_spec(".sdl2dll", ADDON) if bundled else util.find_spec("sdl2dll")
    places = list(spec.submodule_search_locations or ()) if spec else []
    return Path(places[0]) / "dll" if places else None


@contextmanager
def _library_in(folder: Path | None) -> Iterator[None]:
    """Tell sdl2 where the library is, only for now: other add-ons may have SDLs of their own."""
    former = os.environ.get(_LIBRARY)
    if folder is not None:
        os.environ[_LIBRARY] = str(folder)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    finally:
        os.environ.pop(_LIBRARY, None)
        if former is not None:
            os.environ[_LIBRARY] = former
