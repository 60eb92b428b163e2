# SPDX-License-Identifier: MIT
"""Files of takes, by the names of files and folders. Needs Python alone."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

ENDINGS = (".bvh", ".amc")
"""Of the takes that the core reads."""

BY_BLENDER = (".fbx", ".glb", ".gltf", ".vrm", ".usd", ".usda", ".usdc", ".usdz")
"""Of the files that Blender reads, whatever they hold."""

UNIT = 0.01
"""Metres in one unit of a BVH file, where nobody tells."""

_ARCHIVES = (b"PK\x03\x04", b"Rar!", b"7z\xbc\xaf", b"\x1f\x8b")  # as they begin


def find_takes(paths: Sequence[Path], others: Sequence[str] = ()) -> list[Path]:
    """The files of takes among files and folders, each once, but hidden ones in folders; ValueError names what is not
    there, and a file of another kind. `others`: endings that are looked for beside those that the core reads."""
    found = dict.fromkeys(file for path in paths for file in _files_of(path, (*ENDINGS, *others)))
    if not found:
        raise ValueError(
            f"{', '.join(map(str, paths))}: no takes here ({', '.join(('.bvh', *others))}, or .amc with its .asf)"
        )
    return list(found)


def _files_of(path: Path, endings: Sequence[str]) -> Iterator[Path]:
    if path.is_dir():
        yield from sorted(file for file in path.rglob("*") if _is_take(file, path, endings))
    elif not path.is_file():
        raise ValueError(f"{path}: there is no such file or folder")
    elif path.suffix.lower() not in (*endings, ".asf"):
        raise ValueError(f"{path}: not motion capture that is read ({', '.join(endings)}){by_another_name(path)}")
    elif path.suffix.lower() != ".asf":  # its motion is in .amc files
        yield path


def by_another_name(path: Path) -> str:
    """What to do about a file that is motion capture, or holds some, and is not called so; empty where it is none."""
    try:
        with path.open("rb") as file:
            start = file.read(32).replace(b"\0", b"").lstrip(b"\xef\xbb\xbf\xff\xfe \t\r\n")
    except OSError:
        return ""
    if start.upper().startswith(b"HIERARCHY"):
        return f": it is a BVH file, so call it {path.stem}.bvh"
    return ": it is an archive, so unpack it first" if start.startswith(_ARCHIVES) else ""


def _is_take(file: Path, folder: Path, endings: Sequence[str]) -> bool:
    hidden = any(part.startswith(".") for part in file.relative_to(folder).parts)
    return file.suffix.lower() in endings and not hidden and file.is_file()
