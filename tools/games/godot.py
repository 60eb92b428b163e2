# SPDX-License-Identifier: MIT
"""`dev.py godot`: the add-on for Godot with its native part for every platform, each compiled here by zig, and for the
web by Debian unstable's Emscripten."""

from __future__ import annotations

import shutil
from pathlib import Path

from tools.packaging import cross
from tools.packaging.compiling import COMPILING
from tools.paths import BUILD, TOP
from tools.platforms import PLATFORMS, Platform
from tools.setup import unstable
from tools.shell import Failure, run, say, steps_of

_GODOT = TOP / "games" / "godot"
_BUILT = BUILD / "godot"
WEB = "fragmotion.web.wasm32.wasm"
"""What the native part of the web is called."""
_RUN_TIME = ("libc++-legacyexcept", "libc++abi-legacyexcept", "libunwind-legacyexcept")
_NAMES = {"Linux": "linux.{}.so", "Windows": "windows.{}.dll", "Darwin": "macos.{}.dylib"}


def library_name(platform: Platform) -> str:
    """What the native part of a platform is called, as fragmotion.gdextension lists it."""
    return f"fragmotion.{_NAMES[platform.system].format(platform.target.partition('-')[0])}"


def make(folder: Path) -> None:
    """Write the add-on into a folder `fragmotion`, which is new or an add-on that was made before."""
    addon = folder / "fragmotion"
    if addon.exists() and not (addon / "fragmotion.gdextension").exists():
        raise Failure(f"{addon} holds something else than the add-on: name another folder")
    header = interface()
    libraries = [*(library(platform, header) for platform in PLATFORMS), web_library(header)]
    shutil.rmtree(addon, ignore_errors=True)
    shutil.copytree(_GODOT / "addons" / "fragmotion", addon, ignore=shutil.ignore_patterns("bin"))
    (addon / "bin").mkdir()
    for path in libraries:
        shutil.copy(path, addon / "bin")
        say(f"{addon / 'bin' / path.name}: {path.stat().st_size / 1e3:.0f} kB")


def interface() -> Path:
    """The folder of the header that Debian unstable's Godot writes of itself."""
    folder = _BUILT / "interface"
    folder.mkdir(parents=True, exist_ok=True)
    run(unstable.command(["godot", "--headless", "--dump-gdextension-interface"], folder), "godot-interface")
    return folder


def library(platform: Platform, header: Path) -> Path:
    """The native part for a platform, compiled with what is in interface()."""
    folder = _BUILT / platform.name
    variables = {
        **cross.toolchain(platform.name, platform.target, platform.system),
        "GODOT_INTERFACE": header,
        "FRAGMOTION_GODOT_BIN": folder / "bin",
    }
    options = ["-G", "Ninja", *(f"-D{name}={value}" for name, value in variables.items())]
    with COMPILING:
        run(["cmake", "-S", _GODOT, "-B", folder, *options], f"cmake-godot-{platform.name}", cross.environment())
        hear = steps_of(f"build: Godot's add-on for {platform.name}")
        build: list[str | Path] = ["cmake", "--build", folder, "--target", "fragmotion_godot"]
        run(build, f"build-godot-{platform.name}", cross.environment(), timeout=7200.0, hear=hear)
    return folder / "bin" / library_name(platform)


def web_library(header: Path) -> Path:
    """The native part for the web, compiled with what is in interface()."""
    folder = _BUILT / "web"
    variables = {"CMAKE_BUILD_TYPE": "Release", "GODOT_INTERFACE": header, "FRAGMOTION_GODOT_BIN": folder / "bin"}
    options = ["-G", "Ninja", *(f"-D{name}={value}" for name, value in variables.items())]
    with COMPILING:
        run(unstable.command(["embuilder", "build", "--pic", *_RUN_TIME]), "emscripten-run-time", timeout=3600.0)
        configure: list[str | Path] = ["emcmake", "cmake", "-S", _GODOT, "-B", folder, *options]
        run(unstable.command(configure), "cmake-godot-web")
        build: list[str | Path] = ["cmake", "--build", folder, "--target", "fragmotion_godot"]
        run(unstable.command(build), "build-godot-web", timeout=7200.0)
    return folder / "bin" / WEB
