# SPDX-License-Identifier: MIT
"""The two zips that Blender installs: the extension (4.2 and later) and the legacy add-on (3.4 to 4.1)."""

from __future__ import annotations

import os
import re
import shutil
import zipfile
from functools import cache
from pathlib import Path

from tools import environments
from tools.compiling import build_wheel
from tools.machine import package_pythons
from tools.paths import ADDON, BUILD, PACKAGES, SDL, TOP, version
from tools.shell import Failure, run

_MANIFEST = "blender_manifest.toml"
_SDL_FILES = re.compile(r"sdl2/\w+\.py$|sdl2dll/dll/libSDL2-2")
_BLENDER_MACHINES = {"x86_64": "x64", "aarch64": "arm64"}


@cache
def wheel(python: str) -> Path:
    """The wheel of the core for one Python, built once a run."""
    return build_wheel(python)


def build_all() -> list[Path]:
    """Build both zips with the wheels of all Pythons that are here."""
    return [build_extension([wheel(python) for python in package_pythons()]), build_legacy(wheel("3.11"))]


def extension_path() -> Path:
    """Where the extension's zip is."""
    return PACKAGES / f"fragmotion-{version()}-linux_{os.uname().machine}.zip"


def legacy_path() -> Path:
    """Where the legacy add-on's zip is."""
    return PACKAGES / f"fragmotion-{version()}-legacy-linux_{os.uname().machine}.zip"


def pythons_inside(package: Path) -> list[str]:
    """The Pythons ("3.11") that a zip holds a compiled core for."""
    with zipfile.ZipFile(package) as archive:
        tags = re.findall(r"fragmotion_core\S*?\bcp(?:ython-)?3(\d+)\b", "\n".join(archive.namelist()))
    return [f"3.{minor}" for minor in sorted(set(tags), key=int)]


def build_extension(wheels: list[Path]) -> Path:
    """Zip the add-on with its manifest and wheels, and let Blender's own tool validate it if a bpy is here."""
    folder = _staged_addon("extension")
    wheels = [*wheels, *sdl_wheels()]
    (folder / "wheels").mkdir()
    for path in wheels:
        shutil.copy(path, folder / "wheels")
    (folder / _MANIFEST).write_text(_manifest(wheels))
    target = _zip(folder, extension_path(), prefix="")
    for tool in _blender_extension_tools():
        run([environments.environment_python("3.11"), tool, "validate", target], "validate-extension")
    return target


def build_legacy(wheel_311: Path) -> Path:
    """Zip the add-on as the folder `fragmotion`, the compiled core of the Python 3.11 wheel and SDL inside."""
    folder = _staged_addon("legacy")
    (folder / _MANIFEST).unlink()
    with zipfile.ZipFile(wheel_311) as archive:
        for name in archive.namelist():
            if name.endswith(".so"):
                archive.extract(name, folder)
    for path in sdl_wheels():
        _unpack_sdl(path, folder)
    return _zip(folder, legacy_path(), prefix="fragmotion/")


def sdl_wheels() -> list[Path]:
    """The wheels of SDL and of its Python module."""
    return sorted(SDL.glob("*.whl"))


def _unpack_sdl(path: Path, folder: Path) -> None:
    """Take the Python module and the library out of a wheel of SDL; the pads need none of the rest."""
    with zipfile.ZipFile(path) as archive:
        archive.extractall(folder, [name for name in archive.namelist() if _SDL_FILES.match(name)])


def _staged_addon(name: str) -> Path:
    folder = BUILD / "staging" / name
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(ADDON, folder, ignore=shutil.ignore_patterns("__pycache__", "*.pyc"))
    shutil.copy(TOP / "LICENSE", folder / "LICENSE-core")
    shutil.copy(TOP / "LICENSE-third-party", folder)
    return folder


def _manifest(wheels: list[Path]) -> str:
    text = (ADDON / _MANIFEST).read_text()
    if f'version = "{version()}"' not in text:
        raise Failure(f"{ADDON / _MANIFEST} and CMakeLists.txt give different versions")
    # Top-level keys: they must stand before the first table, [permissions].
    head, table, tail = text.partition("\n[permissions]")
    names = ", ".join(f'"./wheels/{path.name}"' for path in wheels)
    platform = f"linux-{_BLENDER_MACHINES[os.uname().machine]}"
    return f'{head}platforms = ["{platform}"]\nwheels = [{names}]\n{table}{tail}'


def _zip(folder: Path, target: Path, prefix: str) -> Path:
    target.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in sorted(folder.rglob("*")):
            if path.is_file():
                archive.write(path, f"{prefix}{path.relative_to(folder)}")
    return target


def _blender_extension_tools() -> list[Path]:
    site_packages = environments.environment("3.11") / "lib" / "python3.11" / "site-packages"
    return list(site_packages.glob("bpy/*/scripts/addons_core/bl_pkg/cli/blender_ext.py"))
