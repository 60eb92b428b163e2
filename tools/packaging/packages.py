# SPDX-License-Identifier: MIT
"""The zips that Blender installs: the extension (4.2 and later) and the legacy add-on (3.4 to 4.1) of each platform."""

from __future__ import annotations

import re
import shutil
import threading
import zipfile
from collections.abc import Mapping
from functools import cache
from pathlib import Path

from tools.packaging import cross
from tools.packaging.compiling import build_wheel
from tools.packaging.wheels import write_zip
from tools.paths import ADDON, BUILD, PACKAGES, TOP, version
from tools.platforms import EXTENSION_PYTHONS, LEGACY_PYTHONS, LINUX, Platform
from tools.setup import blender, environments
from tools.shell import Failure, run

_MANIFEST = "blender_manifest.toml"
_SDL_FILES = re.compile(r"sdl2/\w+\.py$|sdl2dll/dll/(libSDL2-2|SDL2\.dll)")
_BUILDING = threading.RLock()
_HERE = BUILD / "packages-quick"
_MODULE = re.compile(r"fragmotion_core\.(cp|cpython-)\d+\S*\.(so|pyd)$|fragmotion_command/\S+\.py$")


def wheel(python: str) -> Path:
    """The wheel of the core for one Python of this machine, built here by its own compiler, once a run: stages that run
    side by side wait for the one that builds it."""
    with _BUILDING:
        return _built_wheel(python)


@cache
def _built_wheel(python: str) -> Path:
    return build_wheel(python)


@cache
def wheels_for(platform: Platform) -> Mapping[str, Path]:
    """The wheels of the core for the Pythons of a platform, cross-compiled once a run."""
    return cross.build_wheels(platform, platform.pythons)


@cache
def build(platform: Platform) -> tuple[Path, ...]:
    """Build a platform's zips: the extension, and the legacy add-on where there is one."""
    wheels = wheels_for(platform)
    extension = build_extension(platform, {python: wheels[python] for python in platform.extension_pythons}, PACKAGES)
    if not platform.legacy:
        return (extension,)
    return (extension, build_legacy(platform, {python: wheels[python] for python in LEGACY_PYTHONS}, PACKAGES))


def extension_path(platform: Platform, folder: Path = PACKAGES) -> Path:
    """Where a platform's extension is, named as by Blender's --split-platforms."""
    return folder / f"fragmotion-{version()}-{platform.label}.zip"


def legacy_path(platform: Platform, folder: Path = PACKAGES) -> Path:
    """Where a platform's legacy add-on is."""
    return folder / f"fragmotion-{version()}-legacy-{platform.label}.zip"


def build_for_debian(folder: Path = _HERE) -> Path:
    """The zip that Debian's Blender takes, its core built by this machine's compiler for the Python of that Blender."""
    with _BUILDING:
        return _built_for_debian(folder)


@cache
def _built_for_debian(folder: Path) -> Path:
    python = blender.debian_python()
    build_kind = build_extension if blender.takes_extensions() else build_legacy
    return build_kind(LINUX, {python: wheel(python)}, folder)


def debian_zip() -> Path:
    """The zip of build/packages that Debian's Blender takes; where none is for its Python, one made for it."""
    python = blender.debian_python()
    path, pythons = (extension_path, EXTENSION_PYTHONS) if blender.takes_extensions() else (legacy_path, LEGACY_PYTHONS)
    return path(LINUX) if python in pythons else build_for_debian(BUILD / "packages-debian")


def pythons_inside(package: Path) -> list[str]:
    """The Pythons ("3.11") that a zip holds a compiled core for."""
    with zipfile.ZipFile(package) as archive:
        tags = re.findall(r"fragmotion_core\S*?\bcp(?:ython-)?3(\d+)\b", "\n".join(archive.namelist()))
    return [f"3.{minor}" for minor in sorted(set(tags), key=int)]


def build_extension(platform: Platform, wheels: Mapping[str, Path], folder: Path) -> Path:
    """Zip the add-on with its manifest and wheels, and let Blender's own tool validate it if a bpy is here."""
    environments.ensure_sdl(platform)
    staged = _staged_addon(f"extension-{platform.name}")
    inside = [*wheels.values(), *environments.sdl_wheels(platform)]
    (staged / "wheels").mkdir()
    for path in inside:
        shutil.copy(path, staged / "wheels")
    (staged / _MANIFEST).write_text(_manifest(platform, inside))
    target = _zip(staged, extension_path(platform, folder), prefix="")
    for python, tool in blender.extension_tools().items():
        run([environments.environment_python(python), tool, "validate", target], f"validate-{platform.name}-{python}")
    return target


def build_legacy(platform: Platform, wheels: Mapping[str, Path], folder: Path) -> Path:
    """Zip the add-on as the folder `fragmotion`, the compiled core of each wheel, its command and SDL inside."""
    environments.ensure_sdl(platform)
    staged = _staged_addon(f"legacy-{platform.name}")
    (staged / _MANIFEST).unlink()
    for path in wheels.values():
        _unpack(path, staged, _MODULE)
    for path in environments.sdl_wheels(platform):
        _unpack(path, staged, _SDL_FILES)
    return _zip(staged, legacy_path(platform, folder), prefix="fragmotion/")


def _unpack(path: Path, folder: Path, wanted: re.Pattern[str]) -> None:
    """Take what is wanted out of a wheel: what Blender 4.1 and before need of it."""
    with zipfile.ZipFile(path) as archive:
        archive.extractall(folder, [name for name in archive.namelist() if wanted.match(name)])


def _staged_addon(name: str) -> Path:
    folder = BUILD / "staging" / name
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(ADDON, folder, ignore=shutil.ignore_patterns("__pycache__", "*.pyc"))
    shutil.copy(TOP / "LICENSE", folder / "LICENSE-core")
    shutil.copy(TOP / "LICENSE-third-party", folder)
    shutil.copy(TOP / "sample_rigs" / "fragmotion_sample.blend", folder / "sample_character.blend")
    return folder


def _manifest(platform: Platform, wheels: list[Path]) -> str:
    text = (ADDON / _MANIFEST).read_text()
    if f'version = "{version()}"' not in text:
        raise Failure(f"{ADDON / _MANIFEST} and CMakeLists.txt give different versions")
    # Top-level keys: they must stand before the first table, [permissions].
    head, table, tail = text.partition("\n[permissions]")
    names = ", ".join(f'"./wheels/{path.name}"' for path in wheels)
    return f'{head}platforms = ["{platform.name}"]\nwheels = [{names}]\n{table}{tail}'


def _zip(folder: Path, target: Path, prefix: str) -> Path:
    target.parent.mkdir(parents=True, exist_ok=True)
    paths = sorted(path for path in folder.rglob("*") if path.is_file())
    write_zip(target, {f"{prefix}{path.relative_to(folder)}": path.read_bytes() for path in paths})
    return target
