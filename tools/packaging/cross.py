# SPDX-License-Identifier: MIT
"""Compiling for a platform with zig's clang: the core once, and its module for each Python, as wheels."""

from __future__ import annotations

import shlex
import shutil
from collections.abc import Iterable
from pathlib import Path

from tools.packaging import compiling, wheels
from tools.paths import BUILD, TOP
from tools.platforms import Platform
from tools.setup import environments, maven
from tools.shell import run, steps_of

REQUIREMENTS = (environments.ZIG,)

_TOOLS = {
    "c++": "c++ -target {target}",
    "cc": "cc -target {target}",
    "ar": "ar",
    "ranlib": "ranlib",
    "rc": "rc",
    "none": "version",
}
_CACHE = BUILD / "zig" / "cache"


def build_wheels(platform: Platform, pythons: Iterable[str]) -> dict[str, Path]:
    """The wheel of the core for each of these Pythons; what is built already is not built again."""
    folder = build_folder(platform)
    targets = [f"fragmotion_core_{python.replace('.', '')}" for python in pythons]
    with compiling.COMPILING:
        run(["cmake", *_options(platform, folder)], f"cmake-{platform.name}", environment())
        run(
            ["cmake", "--build", folder, "--target", *targets],
            f"build-{platform.name}",
            environment(),
            timeout=7200.0,
            hear=steps_of(f"build: {platform.name}"),
        )
    target = BUILD / "wheels" / platform.name
    shutil.rmtree(target, ignore_errors=True)
    target.mkdir(parents=True)
    return {
        python: wheels.pack(folder / python / platform.module_name(python), python, platform.wheel_tag, target)
        for python in pythons
    }


def build_folder(platform: Platform) -> Path:
    """Where a platform's modules are built, each in a folder named after its Python."""
    return BUILD / "cross" / platform.name


def _options(platform: Platform, folder: Path) -> list[str | Path]:
    variables = {
        **toolchain(platform.name, platform.target, platform.system),
        "FRAGMOTION_PYTHONS": ";".join(platform.pythons),
        "FRAGMOTION_PYTHONS_DIR": maven.ensure_headers(platform),
        "FRAGMOTION_PYBIND11_INCLUDE": environments.site_packages(environments.HOST) / "pybind11" / "include",
        "FRAGMOTION_MODULE_SUFFIX": platform.module_suffix.format("@"),
    }
    return ["-S", TOP, "-B", folder, "-G", "Ninja", *(f"-D{name}={value}" for name, value in variables.items())]


def toolchain(name: str, target: str, system: str) -> dict[str, str | Path]:
    """CMake's variables for compiling for a target of zig's ("aarch64-linux-musl") and what CMake calls its system."""
    return {
        "CMAKE_TOOLCHAIN_FILE": TOP / "cmake" / "zig.cmake",
        "CMAKE_BUILD_TYPE": "Release",
        "CMAKE_CXX_COMPILER_LAUNCHER": "ccache",
        # Nothing of where it is built is in what is built.
        "CMAKE_CXX_FLAGS": f"-ffile-prefix-map={TOP}=.",
        "FRAGMOTION_ZIG_DIR": _write_tools(name, target),
        "FRAGMOTION_SYSTEM": system,
        "FRAGMOTION_PROCESSOR": target.partition("-")[0],
    }


def _write_tools(name: str, target: str) -> Path:
    """The folder of zig's programs for a target, each as CMake and ccache expect one: a file without arguments."""
    folder = BUILD / "zig" / name
    folder.mkdir(parents=True, exist_ok=True)
    for tool, arguments in _TOOLS.items():
        words = arguments.format(target=target)
        text = f'#!/bin/sh\n# {environments.ZIG}\nexec {shlex.quote(str(zig()))} {words} "$@"\n'
        path = folder / tool
        if not path.exists() or path.read_text() != text:
            path.write_text(text)
            path.chmod(0o755)
    return folder


def zig() -> Path:
    """The program that compiles for other platforms."""
    return environments.site_packages(environments.HOST) / "ziglang" / "zig"


def environment() -> dict[str, str]:
    """The environment variables that it is run with."""
    return {
        **compiling.compiler_environment(),
        "ZIG_GLOBAL_CACHE_DIR": str(_CACHE),
        "ZIG_LOCAL_CACHE_DIR": str(_CACHE),
        "CCACHE_COMPILERTYPE": "clang",
        "CCACHE_COMPILERCHECK": "content",
    }
