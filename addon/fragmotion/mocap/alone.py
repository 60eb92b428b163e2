# SPDX-License-Identifier: GPL-3.0-or-later
"""What the core's command reads by Blender's importers, in a Blender that has nothing else to do."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import bpy

from ..errors import UserError
from ..rig.skins import make_skin
from . import by_blender
from .sampling import rig_as_posed
from .scratch import scratch_scene
from .target_rigs import open_rig

if TYPE_CHECKING:
    from fragmotion_core import Skeleton, Skin, Take


def read_takes(path: Path) -> list[Take]:
    """Each Action of each armature in a file; ValueError where there are none, and where it cannot be read."""
    with _as_the_core_says(), scratch_scene(bpy.context):
        return by_blender.read_takes(bpy.context, path, "")


def read_rig(path: Path, armature: str | None) -> tuple[Skeleton, Skin]:
    """The skeleton and the skin of the armature of that name, or of the file's only one; ValueError where there is
    none."""
    with _as_the_core_says():
        obj = open_rig(path, armature)
        rig = rig_as_posed(obj)
        return rig.skeleton, make_skin(obj, rig)


@contextmanager
def _as_the_core_says() -> Iterator[None]:
    try:
        yield
    except UserError as error:
        raise ValueError(str(error)) from error
