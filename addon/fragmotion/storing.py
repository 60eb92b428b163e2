# SPDX-License-Identifier: GPL-3.0-or-later
"""Where an armature's policy is kept: inside the .blend, or in a file beside it that is written when it is saved.

Until then, and where the file cannot be written, it stays inside: nothing is lost.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import bpy
from bpy.app.handlers import persistent

from .errors import UserError

BESIDE = "BESIDE"
troubles: dict[str, str] = {}
"""Why the policy of an armature, by name, could not be moved when the file was saved last."""

_written_to: list[Path] = []  # the folder in which the last save was expected to end


def key_of(obj: bpy.types.Object) -> str:
    """A digest of the armature's policy, which tells it from all others; empty where there is none."""
    data = obj.fragmotion.policy
    return hashlib.sha256(data).hexdigest() if data else str(obj.fragmotion.policy_digest)


def read_policy(obj: bpy.types.Object) -> bytes:
    """The policy file's bytes, from inside the .blend or from beside it; UserError where they are missing."""
    settings = obj.fragmotion
    if settings.policy:
        return bytes(settings.policy)
    if not settings.policy_digest:
        raise UserError(f"Armature '{obj.name}' has no character yet: press Build first")
    path = _path(settings, _folder())
    try:
        data = path.read_bytes()
    except OSError as error:
        raise UserError(
            f"The policy of armature '{obj.name}' is kept in '{path}', which cannot be read ({error.strerror}): put "
            "the file back there, or press Build again"
        ) from error
    if hashlib.sha256(data).hexdigest() != settings.policy_digest:
        raise UserError(
            f"'{path}' is not the policy that armature '{obj.name}' was saved with: put that file back, or press Build "
            "again"
        )
    return data


def keep_policy(obj: bpy.types.Object, data: bytes) -> None:
    """Keep a new policy with the armature, inside the .blend until it is saved."""
    obj.fragmotion.policy = data
    obj.fragmotion.policy_digest = ""


def register() -> None:
    """Begin to move policies when the file is saved."""
    bpy.app.handlers.save_pre.append(_before_saving)
    bpy.app.handlers.save_post.append(_after_saving)


def unregister() -> None:
    """Stop it."""
    bpy.app.handlers.save_pre.remove(_before_saving)
    bpy.app.handlers.save_post.remove(_after_saving)
    troubles.clear()


@persistent  # type: ignore[untyped-decorator]
def _before_saving(path: object, *_: object) -> None:
    """Bring where the policies are in line with where they should be. Blender 3.4 does not tell the path."""
    target = path if isinstance(path, str) and path else bpy.data.filepath
    troubles.clear()
    _written_to.clear()
    if not target:
        return
    folder = Path(target).resolve().parent
    _written_to.append(folder)
    for obj in _local_objects():
        try:
            _settle(obj, folder)
        except (OSError, UserError) as error:
            troubles[obj.name] = str(error)
            print(f"Fragmotion: the policy of armature '{obj.name}' stays where it is: {error}")


@persistent  # type: ignore[untyped-decorator]
def _after_saving(*_: object) -> None:
    """Where the file that is open is not the one that was written, let it have the policies, too."""
    if not _written_to or (bpy.data.filepath and _written_to[0] == _folder()):
        return
    for obj in _local_objects():
        settings = obj.fragmotion
        if not settings.policy_digest or settings.policy:
            continue
        written = _path(settings, _written_to[0])
        if bpy.data.filepath:
            _copy(written, _path(settings, _folder()))
        else:
            keep_policy(obj, written.read_bytes())


def _local_objects() -> Iterator[Any]:
    return (obj for obj in bpy.data.objects if obj.type == "ARMATURE" and obj.library is None)


def _settle(obj: Any, folder: Path) -> None:
    settings = obj.fragmotion
    if settings.keep_policy != BESIDE:
        if settings.policy_digest and not settings.policy:
            keep_policy(obj, read_policy(obj))
        return
    if settings.policy:
        settings.policy_file = _free_name(obj, folder)
        _write(_path(settings, folder), bytes(settings.policy))
        settings.policy_digest, settings.policy = key_of(obj), b""
    elif settings.policy_digest and folder != _folder():
        _copy(_path(settings, _folder()), _path(settings, folder))


def _free_name(obj: Any, folder: Path) -> str:
    """The armature's own file where no other armature reads it, else one that is not there yet."""
    others = {other.fragmotion.policy_file for other in _local_objects() if other != obj}
    own = obj.fragmotion.policy_file
    if own and own not in others:
        return str(own)
    name, number = bpy.path.clean_name(obj.name), 0
    free = f"//{name}.policy"
    while free in others or (folder / free[2:]).exists():
        number += 1
        free = f"//{name}.{number:03}.policy"
    return free


def _path(settings: Any, folder: Path) -> Path:
    """Where the policy file is, for a .blend in the folder."""
    name: str = settings.policy_file
    return folder / name[2:] if name.startswith("//") else Path(name)


def _folder() -> Path:
    return Path(bpy.data.filepath).resolve().parent


def _copy(source: Path, target: Path) -> None:
    if source != target and source.exists():
        _write(target, source.read_bytes())


def _write(path: Path, data: bytes) -> None:
    """By way of a temporary file, so that a failure leaves the former one whole."""
    temporary = path.with_name(f"{path.name}.tmp")
    try:
        temporary.write_bytes(data)
        os.replace(temporary, path)
    except OSError:
        temporary.unlink(missing_ok=True)
        raise
