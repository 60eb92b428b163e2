# SPDX-License-Identifier: MIT
"""Takes and rigs in files that Blender's importers read, through bpy where that is installed. What the add-on reads
them with does it: of the add-on that this package is part of, or of the wheel, as `fragmotion_blender`."""

from __future__ import annotations

import ctypes
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from .core import BESIDE, core
from .files import BY_BLENDER

RIGS = (*BY_BLENDER, ".blend")
"""Endings of files that hold rigs."""

_RESOURCES = "BLENDER_USER_RESOURCES"  # where Blender looks for what is the user's
_VERSIONS = {(3, 11): "4.5", (3, 13): "5.2"}  # of Blender that pip installs for a Python


def needs_blender(path: Path) -> bool:
    """Whether takes in a file are read by Blender."""
    return path.suffix.lower() in BY_BLENDER


def read_takes(path: Path) -> list[core.Take]:
    """All takes of a file; ValueError where there are none, where it cannot be read, and where bpy is missing."""
    reader = _reader()
    with _said_aside():
        takes: list[core.Take] = reader.read_takes(path)
    return takes


def read_rig(path: Path, armature: str | None) -> tuple[core.Skeleton, core.Skin]:
    """The skeleton and the skin of the armature of that name in a file, or of its only one; ValueError as above."""
    reader = _reader()
    with _said_aside():
        rig: tuple[core.Skeleton, core.Skin] = reader.read_rig(path, armature)
    return rig


def check() -> None:
    """ValueError where bpy is missing, with what to do."""
    _reader()


def _reader() -> Any:
    if sys.modules.get("bpy") is None:
        _import_bpy()
    return import_module(f"{BESIDE or 'fragmotion_blender'}.mocap.alone")


def _import_bpy() -> None:
    """Without the user's settings, startup file and add-ons, which stay as they are."""
    with TemporaryDirectory() as folder:
        kept = os.environ.get(_RESOURCES)
        os.environ[_RESOURCES] = folder
        try:
            import_module("bpy")
        except ImportError as error:
            raise ValueError(_advice()) from error
        finally:
            os.environ.pop(_RESOURCES)
            if kept is not None:
                os.environ[_RESOURCES] = kept


def _advice() -> str:
    version = _VERSIONS.get(sys.version_info[:2])
    if version:
        return f"Blender reads such files, and its module bpy is not installed: pip install 'bpy=={version}.*'"
    there = " or ".join(f"{major}.{minor} (bpy {version})" for (major, minor), version in _VERSIONS.items())
    major, minor, *_ = sys.version_info
    return (
        f"Blender reads such files, and its module bpy is not there for Python {major}.{minor}: install this for "
        f"Python {there} together with bpy, or use `blender -c fragmotion`"
    )


@contextmanager
def _said_aside() -> Iterator[None]:
    """What importers print goes to stderr: a command's figures are alone on stdout."""
    sys.stdout.flush()
    kept = os.dup(1)
    os.dup2(2, 1)
    try:
        yield
    finally:
        sys.stdout.flush()
        ctypes.CDLL("ucrtbase" if sys.platform == "win32" else None).fflush(None)  # C's own, which importers print to
        os.dup2(kept, 1)
        os.close(kept)
