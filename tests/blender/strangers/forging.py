# SPDX-License-Identifier: MIT
"""Files of strangers: how they are made, opened and refused."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import pytest

EVIL = b"#!/bin/sh\nharm\n"


@contextmanager
def forging(addon: ModuleType) -> Iterator[None]:
    """Files are saved as by a program that is not ours."""
    addon.character.storing.unregister()
    yield
    addon.character.storing.register()


def opened(addon: ModuleType, path: Path) -> Any:
    addon.character.building.forget()
    bpy.ops.wm.open_mainfile(filepath=str(path))
    return bpy.context.view_layer.objects.active


def files_in(folder: Path) -> dict[str, bytes]:
    """All files but the .blends."""
    paths = (path for path in folder.rglob("*") if path.is_file() and ".blend" not in path.name)
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in paths}


def refused(operator: Callable[..., set[str]], message: str, **fields: Any) -> None:
    with pytest.raises(RuntimeError, match=message) as failure:
        operator("EXEC_DEFAULT", **fields)
    assert str(failure.value).count("Error") == 1 and "Traceback" not in str(failure.value)
