# SPDX-License-Identifier: GPL-3.0-or-later
"""Where an armature's policy is kept: inside the .blend, or in a file beside it that is written when it is saved.

Until then, and where the file cannot be written, it stays inside: nothing is lost. A .blend may come from a stranger:
what it says of its policy is not believed. A file that is written is new, is in the folder that the user saves to, and
has a name made here; its content was built or loaded in this session, or the core reads it as a policy. A file that is
read is a regular one beside the .blend, with the digest that the .blend was saved with.
"""

from __future__ import annotations

import hashlib
import os
import re
from collections import Counter
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any, NamedTuple

import bpy
from bpy.app.handlers import persistent

from ..compat.core import core
from ..errors import UserError, core_errors
from ..files import read_regular, write_new

BESIDE = "BESIDE"
troubles: dict[str, str] = {}
"""Why the policy of an armature, by name, could not be moved when the file was saved last."""

_DIGITS = 16  # of the digest that a policy file's name ends in
_NAME_DIGITS = 8  # of the digest of an armature's name
_PLAIN = re.compile(r"[^/\\:\x00-\x1f]+\.policy")  # a file's name, whatever the system, and nothing of a path
_OWN = re.compile(rf"(?P<blend>.+)\.(?P<armature>[^.]*)\.(?P<digest>[0-9a-f]{{{_DIGITS}}})\.policy")
_Kept = tuple[bytes, str, str]  # policy, policy_file, policy_digest


class _Save(NamedTuple):
    """A save that is under way: what it will write, as far as Blender tells, and what to put back if it does not."""

    target: Path
    told: bool
    """Whether Blender said where it saves; else it is taken to be where the open file is."""
    stamp: tuple[int, int] | None
    """What tells whether the target was written: it is not where the startup file or, in 3.4, a copy is saved."""
    before: dict[str, _Kept]
    made: list[Path]


_save: _Save | None = None
_sound: set[str] = set()  # digests of the policies that this session built or loaded, or that the core has read
_held: dict[str, bytes] = {}  # by digest: policies that saves moved or let go of, for undo and saves that fail


def key_of(obj: bpy.types.Object) -> str:
    """A digest of the armature's policy, which tells it from all others; empty where there is none."""
    data = obj.fragmotion.policy
    return _digest(data) if data else str(obj.fragmotion.policy_digest)


def read_policy(obj: bpy.types.Object) -> bytes:
    """The policy file's bytes, from inside the .blend or from beside it; UserError where they are missing."""
    return _read(obj, _open_file())


def keep_policy(obj: bpy.types.Object, data: bytes) -> None:
    """Keep a policy that was built or loaded with the armature, inside the .blend until it is saved."""
    _sound.add(_digest(data))
    _keep_inside(obj, data)


def register() -> None:
    """Begin to move policies when the file is saved."""
    for name, handler in _handlers():
        getattr(bpy.app.handlers, name).append(handler)


def unregister() -> None:
    """Stop it."""
    for name, handler in _handlers():
        getattr(bpy.app.handlers, name).remove(handler)
    troubles.clear()
    _forget()


def _handlers() -> Iterator[tuple[str, Any]]:
    handlers = {"save_pre": _before_saving, "save_post": _after_saving, "load_post": _forget}
    if hasattr(bpy.app.handlers, "save_post_fail"):  # 3.4 does not tell
        handlers["save_post_fail"] = _after_failing
    return iter(handlers.items())


@persistent  # type: ignore[untyped-decorator]
def _before_saving(path: object, *_: object) -> None:
    """Bring where the policies are in line with where they should be. Blender 3.4 does not tell the path."""
    global _save
    told = isinstance(path, str) and bool(path)
    name = str(path) if told else bpy.data.filepath
    troubles.clear()
    _save = None
    if not name:
        return
    # Blender puts a new file in the place of a link: the policy goes beside that, not beside what the link leads to.
    target = Path(name).parent.resolve() / Path(name).name
    _save = _Save(target, told, _stamp(target), {}, [])
    for obj in _local_objects():
        try:
            _save.before[obj.name] = _kept(obj)
            _settle(obj, _save)
        except Exception as error:  # whatever it is, the file is to be saved
            troubles[obj.name] = _sentence(error)
            print(f"Fragmotion: the policy of armature '{obj.name}' stays where it is: {troubles[obj.name]}")


@persistent  # type: ignore[untyped-decorator]
def _after_saving(*_: object) -> None:
    """Let go of files that are of no use any more; where a copy was saved, the open file has its policies as before."""
    global _save
    save, _save = _save, None
    if save is None:
        return
    try:
        _settle_saved(save)
    except Exception as error:  # the file is saved: its handlers are not to end Blender
        print(f"Fragmotion: the policy files beside '{save.target}' stay as they are: {_sentence(error)}")


def _settle_saved(save: _Save) -> None:
    blend = _open_file()
    if save.target == blend and _stamp(blend) != save.stamp:
        with suppress(OSError, UnicodeDecodeError):  # files that stay do no harm
            _let_go(save)
    elif save.target == blend or save.told or blend is None:
        _put_back(save)
    else:
        _follow(save, blend)


@persistent  # type: ignore[untyped-decorator]
def _after_failing(*_: object) -> None:
    """The .blend is as it was: so are its policies."""
    global _save
    save, _save = _save, None
    if save is not None:
        _put_back(save)
        for path in save.made:
            path.unlink(missing_ok=True)


@persistent  # type: ignore[untyped-decorator]
def _forget(*_: object) -> None:
    """Another file is open, which no undo leaves."""
    _sound.clear()
    _held.clear()


def _sentence(error: Exception) -> str:
    if isinstance(error, MemoryError):
        return "there is not enough memory for it: close other files or programs, and save again"
    return str(error) or f"an unexpected error came up ({type(error).__name__})"


def _local_objects() -> Iterator[Any]:
    return (obj for obj in bpy.data.objects if obj.type == "ARMATURE" and obj.library is None)


def _open_file() -> Path | None:
    return Path(bpy.data.filepath).resolve() if bpy.data.filepath else None


def _stamp(path: Path) -> tuple[int, int] | None:
    """What differs each time that Blender writes the file, which is in a new one; None where there is none."""
    try:
        status = path.lstat()
    except OSError:
        return None
    return status.st_ino, status.st_mtime_ns


def _digest(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


def _kept(obj: Any) -> _Kept:
    settings = obj.fragmotion
    return settings.policy, settings.policy_file, settings.policy_digest


def _keep_inside(obj: Any, data: bytes) -> None:
    obj.fragmotion.policy, obj.fragmotion.policy_digest = data, ""


def _put_back(save: _Save) -> None:
    for obj in _local_objects():
        settings = obj.fragmotion
        settings.policy, settings.policy_file, settings.policy_digest = save.before.get(obj.name, _kept(obj))


def _settle(obj: Any, save: _Save) -> None:
    """Move one policy to where it should be in the file that is saved; where that fails it is inside."""
    settings = obj.fragmotion
    if not settings.policy and not settings.policy_digest:
        return
    if settings.keep_policy == BESIDE and not settings.policy and _is_there(obj, save.target):
        return
    data = read_policy(obj)
    _keep_inside(obj, data)
    if settings.keep_policy == BESIDE:
        digest = _digest(data)
        path = save.target.with_name(_name_for(obj, digest, save.target))
        _put(path, data, save)
        settings.policy, settings.policy_file, settings.policy_digest = b"", f"//{path.name}", digest
        _held[digest] = data


def _is_there(obj: Any, blend: Path) -> bool:
    """Whether the armature's policy file is where a .blend of this path needs it, under its right name."""
    settings = obj.fragmotion
    if blend != _open_file() or settings.policy_file != f"//{_name_for(obj, settings.policy_digest, blend)}":
        return False
    path = _named_file(obj, blend)
    return path.is_file() and not path.is_symlink()


def _name_for(obj: Any, digest: str, blend: Path) -> str:
    """The policy's file beside a .blend: another for each content, so that none is ever written over."""
    return f"{_stem(blend)}.{_plain(obj.name)}.{digest[:_DIGITS]}.policy"


def _plain(name: str) -> str:
    """An armature's name as a file's may have it, another for each: the backups of each armature are counted alone."""
    plain = str(bpy.path.clean_name(name))
    return plain if plain == name else f"{plain}-{_digest(name.encode())[:_NAME_DIGITS]}"


def _stem(blend: Path) -> str:
    """Its name as Blender can keep it, which knows UTF-8 only, and as _PLAIN reads it. A backup has one of its own."""
    name = blend.name[: -len(".blend")] if blend.name.endswith(".blend") else blend.name
    return re.sub(r"[/\\:\x00-\x1f]", "_", name).encode(errors="replace").decode()


def _put(path: Path, data: bytes, save: _Save) -> None:
    """Have the policy in a file of that name; UserError where something else is there or the core does not read it."""
    digest = _digest(data)
    if os.path.lexists(path):
        if _digest(read_regular(path, follow=False)) != digest:
            raise UserError(f"'{path}' is there already and holds something else: move it away, and save again")
        return
    if digest not in _sound:
        with core_errors("It is not written to a file, as it is no policy"):
            core.Character.from_bytes(data)
        _sound.add(digest)
    write_new(path, data)
    save.made.append(path)


def _read(obj: bpy.types.Object, blend: Path | None) -> bytes:
    """The policy's bytes where the armature is in that .blend."""
    settings = obj.fragmotion
    if settings.policy:
        return bytes(settings.policy)
    if not settings.policy_digest:
        raise UserError(f"Armature '{obj.name}' has no character yet: press Build first")
    if settings.policy_digest in _held:
        return _held[settings.policy_digest]
    path = _named_file(obj, blend)
    try:
        data = read_regular(path, follow=False)
    except UserError as error:
        raise UserError(
            f"The policy of armature '{obj.name}' is kept in a file beside the .blend, but {error}: put the file back "
            "there, or press Build again"
        ) from error
    if _digest(data) != settings.policy_digest:
        raise UserError(
            f"'{path}' is not the policy that armature '{obj.name}' was saved with: put that file back, or press Build "
            "again"
        )
    return data


def _named_file(obj: bpy.types.Object, blend: Path | None) -> Path:
    """The file that the armature names; UserError where that is not just the name of a file beside the .blend."""
    stored = obj.fragmotion.policy_file
    name = stored[2:] if stored.startswith("//") else ""
    if blend is None or not _PLAIN.fullmatch(name):
        raise UserError(
            f"Armature '{obj.name}' names '{stored}' as its policy, but only a policy file in the folder of its own "
            ".blend is read by itself: choose the file with Load under Policy File, or press Build again"
        )
    return blend.with_name(name)


def _follow(save: _Save, blend: Path) -> None:
    """Blender 3.4 has saved the file under another name: its policies come, too, by the names that it has for them."""
    for obj in _local_objects():
        if obj.fragmotion.policy or not obj.fragmotion.policy_digest:
            continue
        try:
            data = _read(obj, save.target)
            name = _name_for(obj, _digest(data), save.target)
            if obj.fragmotion.policy_file == f"//{name}":
                _held[_digest(data)] = data
                _put(blend.with_name(name), data, save)
        except Exception as error:  # the others are to come all the same
            troubles[obj.name] = _sentence(error)


def _let_go(save: _Save) -> None:
    """Delete the policy files of the .blend that it does not use any more, but for as many as Blender keeps backups."""
    used = {obj.fragmotion.policy_file for obj in _local_objects() if not obj.fragmotion.policy}
    if not any(used) and not any(digest for _, _, digest in save.before.values()):
        return  # none was ever beside it
    backups: Counter[str] = Counter()
    for path, armature in _files_of(save.target):
        if f"//{path.name}" in used:
            os.utime(path)  # used last, not just written
        else:
            backups[armature] += 1
            if backups[armature] > bpy.context.preferences.filepaths.save_version:
                _delete(path)


def _files_of(blend: Path) -> list[tuple[Path, str]]:
    """The policy files that were written for a .blend of this path, each with its armature's name, newest first."""
    stem = _stem(blend)
    matches = [(path, _OWN.fullmatch(path.name)) for path in blend.parent.iterdir()]
    files = [(path, match["armature"]) for path, match in matches if match and match["blend"] == stem]
    return sorted(files, key=lambda file: file[0].lstat().st_mtime_ns, reverse=True)


def _delete(path: Path) -> None:
    """Delete a policy file that is what its name says; undo may still ask for it."""
    with suppress(UserError):
        data = read_regular(path, follow=False)
        digest = _digest(data)
        if path.name.endswith(f".{digest[:_DIGITS]}.policy"):
            _held[digest] = data
            path.unlink()
