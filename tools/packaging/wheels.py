# SPDX-License-Identifier: MIT
"""Packing the compiled core as a wheel, the same bytes from the same files."""

from __future__ import annotations

import base64
import hashlib
import zipfile
from pathlib import Path
from typing import Any

import tomllib

from tools.paths import ADDON, TOP, version

_BINDINGS = TOP / "cpp" / "bindings"
_MOMENT = (1980, 1, 1, 0, 0, 0)  # the first that a zip can tell
_MODE = 0o100644


def pack(module: Path, python: str, platform_tag: str, folder: Path) -> Path:
    """The wheel of a compiled module for one Python and platform, in `folder`."""
    project = _project()
    name = f"{project['name']}-{version()}"
    tag = f"cp{python.replace('.', '')}"
    info = f"{name}.dist-info"
    files = {
        module.name: module.read_bytes(),
        **{path.relative_to(_BINDINGS).as_posix(): path.read_bytes() for path in _beside()},
        **{f"fragmotion_blender/{name}": (ADDON / name).read_bytes() for name in _readers()},
        f"{info}/METADATA": _metadata(project).encode(),
        f"{info}/entry_points.txt": _entry_points(project).encode(),
        f"{info}/WHEEL": _wheel(f"{tag}-{tag}-{platform_tag}").encode(),
        **{f"{info}/licenses/{licence}": (TOP / licence).read_bytes() for licence in project["license-files"]},
    }
    files[f"{info}/RECORD"] = _record(files, f"{info}/RECORD").encode()
    target = folder / f"{name}-{tag}-{tag}-{platform_tag}.whl"
    write_zip(target, files)
    return target


def write_zip(target: Path, files: dict[str, bytes]) -> None:
    """Write a zip of these files: the same files, the same bytes."""
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, _MOMENT)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = _MODE << 16
            entry.create_system = 3  # Unix, wherever it is written
            archive.writestr(entry, data)


def _beside() -> list[Path]:
    """What lies beside the module: its stub and the command."""
    return [_BINDINGS / "fragmotion_core.pyi", *sorted((_BINDINGS / "fragmotion_command").rglob("*.py"))]


def _readers() -> list[str]:
    """What of the add-on reads files by Blender's importers, for the command where bpy is installed."""
    return (TOP / "cmake" / "fragmotion_blender.txt").read_text().split()


def _project() -> dict[str, Any]:
    project: dict[str, Any] = tomllib.loads((TOP / "pyproject.toml").read_text())["project"]
    return project


def _metadata(project: dict[str, Any]) -> str:
    lines = [
        "Metadata-Version: 2.4",
        f"Name: {project['name']}",
        f"Version: {version()}",
        f"Summary: {project['description']}",
        *(f"Author: {author['name']}" for author in project["authors"]),
        f"License-Expression: {project['license']}",
        *(f"License-File: {name}" for name in project["license-files"]),
        *(f"Classifier: {classifier}" for classifier in project["classifiers"]),
        f"Requires-Python: {project['requires-python']}",
        *(f"Requires-Dist: {requirement}" for requirement in project["dependencies"]),
        "Description-Content-Type: text/markdown",
    ]
    description: str = (TOP / project["readme"]).read_text()
    return "\n".join(lines) + "\n\n" + description


def _entry_points(project: dict[str, Any]) -> str:
    return "[console_scripts]\n" + "".join(f"{name} = {place}\n" for name, place in project["scripts"].items())


def _wheel(tag: str) -> str:
    return f"Wheel-Version: 1.0\nGenerator: fragmotion\nRoot-Is-Purelib: false\nTag: {tag}\n"


def _record(files: dict[str, bytes], record: str) -> str:
    rows = [f"{name},sha256={_digest(data)},{len(data)}\n" for name, data in files.items()]
    return "".join(rows) + f"{record},,\n"


def _digest(data: bytes) -> str:
    return base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
