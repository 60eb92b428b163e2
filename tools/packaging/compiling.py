# SPDX-License-Identifier: MIT
"""Compiling: the C++ programs by CMake preset, and the wheel of fragmotion_core for one Python."""

from __future__ import annotations

import os
import shutil
import threading
from pathlib import Path

from tools.paths import BUILD, TOP
from tools.platforms import Platform
from tools.setup.environments import environment_python, install_into
from tools.shell import run

COMPILING = threading.Lock()
"""One compilation keeps all processors busy, and what the next one shares with it then comes out of the cache."""


def compile_preset(preset: str, *targets: str) -> Path:
    """Configure and build a preset of CMakePresets.json (all of it, or the targets); return its folder."""
    folder = BUILD / preset
    selection = ["--target", *targets] if targets else []
    with COMPILING:
        configure_preset(preset)
        run(["cmake", "--build", folder, *selection], f"build-{preset}", compiler_environment())
    return folder


def configure_preset(preset: str) -> Path:
    """Configure a preset of CMakePresets.json, which also says how each file is compiled; return its folder."""
    run(["cmake", "--preset", preset], f"cmake-{preset}", compiler_environment())
    return BUILD / preset


def build_wheel(python: str) -> Path:
    """Build the wheel for one Python ("3.11") of this machine, tagged with the oldest glibc that it runs on."""
    folder = BUILD / "wheels" / f"native-{python}"
    shutil.rmtree(folder, ignore_errors=True)
    built = folder / "built"
    options = ("--disable-pip-version-check", "--no-deps", "--no-build-isolation", "--wheel-dir", str(built))
    interpreter = environment_python(python)
    with COMPILING:
        run([interpreter, "-m", "pip", "wheel", *options, TOP], f"wheel-{python}", compiler_environment())
    wheel, programs = next(built.glob("*.whl")), {"PATH": f"{interpreter.parent}:{os.environ['PATH']}"}
    run([interpreter, "-m", "auditwheel", "repair", "--wheel-dir", folder, wheel], f"auditwheel-{python}", programs)
    return next(folder.glob("*.whl"))


def installed_core(python: str, wheel: Path) -> Path:
    """Install a wheel into a folder of its own for PYTHONPATH, so that no Blender finds it by chance."""
    folder = BUILD / f"core-{python}"
    install_into(folder, python, "--no-deps", wheel)
    return folder


def unpacked_core(wheel: Path, platform: Platform) -> Path:
    """Unpack a platform's wheel into a folder of its own for PYTHONPATH: pip installs no other platform's."""
    folder = BUILD / f"core-{platform.name}"
    shutil.rmtree(folder, ignore_errors=True)
    shutil.unpack_archive(wheel, folder, "zip")
    return folder


def compiler_environment() -> dict[str, str]:
    # The same sources are compiled for the tests and for the wheel of each Python: by one compiler name, ccache does it
    # once (CMake alone says c++, scikit-build-core g++); what CMake writes in their folders it tells by relative paths.
    return {
        "CXX": os.environ.get("CXX", "g++"),
        "CMAKE_CXX_COMPILER_LAUNCHER": "ccache",
        "CCACHE_DIR": os.environ.get("CCACHE_DIR", str(BUILD / "ccache")),  # one for several checkouts, where it is set
        "CCACHE_BASEDIR": os.environ.get("CCACHE_BASEDIR", str(BUILD)),
        "CMAKE_BUILD_PARALLEL_LEVEL": str(os.cpu_count() or 1),
    }
