# SPDX-License-Identifier: MIT
"""What each command needs of the machine, and setting it up, once."""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field

from tools import apt, environments
from tools.paths import BUILD

PYTEST_FOLDER = BUILD / "pytest-3.11"

_BUILD_PACKAGES = ("g++", "cmake", "ninja-build", "ccache", "libeigen3-dev", "python3-dev", "python3-venv")
_CPP_TEST_PACKAGES = ("libgtest-dev", "libbenchmark-dev")
_CLANG_PACKAGES = ("clang", "libclang-rt-dev")  # the second brings libFuzzer and the sanitizers of that clang
_BLENDER_PACKAGES = ("blender", "python3-numpy")
_WINDOW_PACKAGES = ("xvfb", "xauth", "libgl1-mesa-dri")
_BPY_PACKAGES = (
    "libegl1",
    "libgl1",
    "libsm6",
    "libxext6",
    "libxfixes3",
    "libxi6",
    "libxkbcommon0",
    "libxrender1",
    "libxt6",
    "libxxf86vm1",
)
_BUILD_REQUIREMENTS = ("pybind11", "scikit-build-core", "wheel")


@dataclass(frozen=True)
class Needs:
    """Debian packages, Python packages by Python version, and pytest for Debian's Blender."""

    packages: tuple[str, ...] = ()
    requirements: dict[str, tuple[str, ...]] = field(default_factory=dict)
    pytest_folder: bool = False

    def __or__(self, other: Needs) -> Needs:
        """Both needs together."""
        versions = sorted({*self.requirements, *other.requirements})
        return Needs(
            tuple(dict.fromkeys(self.packages + other.packages)),
            {v: self.requirements.get(v, ()) + other.requirements.get(v, ()) for v in versions},
            self.pytest_folder or other.pytest_folder,
        )


BUILD_311 = Needs(_BUILD_PACKAGES, {"3.11": _BUILD_REQUIREMENTS})
BUILD_313 = Needs(_BUILD_PACKAGES, {"3.13": _BUILD_REQUIREMENTS})
STYLE = Needs(("python3-venv",), {"3.11": ("clang-format==14.0.6", "mypy==2.4.1", "numpy", "ruff==0.17.6")})
CPP_TESTS = BUILD_311 | Needs(_CPP_TEST_PACKAGES)
SANITIZED_TESTS = CPP_TESTS | Needs(_CLANG_PACKAGES)
FUZZ = BUILD_311 | Needs(_CLANG_PACKAGES)
PYTHON_TESTS = BUILD_311 | Needs((), {"3.11": ("numpy", "pytest", "scikit-learn", "scipy", "matplotlib")})
BLENDER_45 = BUILD_311 | Needs(_BPY_PACKAGES, {"3.11": ("bpy==4.5.*", "numpy", "pytest")})
BLENDER_52 = BUILD_313 | Needs(_BPY_PACKAGES, {"3.13": ("bpy==5.2.*", "numpy", "pytest")})
DEMO = BUILD_311 | Needs(_BLENDER_PACKAGES)
BLENDER_34 = DEMO | Needs(pytest_folder=True)
WINDOWS = BLENDER_34 | PYTHON_TESTS | Needs(_WINDOW_PACKAGES)
BENCH = CPP_TESTS | PYTHON_TESTS
EVALUATE = BUILD_311 | Needs((), {"3.11": ("numpy", "matplotlib")})
EVALUATE_BLEND = EVALUATE | BLENDER_45
DOCTOR = BUILD_311 | Needs((), {"3.11": ("numpy",)})
BESIDE = EVALUATE | Needs((), {"3.11": ("scipy",)})


def has_python_313() -> bool:
    """Whether Blender 5.2's Python is on this machine."""
    return environments.find_python("3.13") is not None


def package_pythons() -> list[str]:
    """The Pythons that the zips hold a core for: Blender's, as far as they are here."""
    return ["3.11", "3.13"] if has_python_313() else ["3.11"]


def package_needs() -> Needs:
    """What building the zips takes: the wheel of each of these Pythons."""
    return BUILD_311 | BUILD_313 if has_python_313() else BUILD_311


def in_ci() -> bool:
    """Whether this is a CI run, where nothing may be left out."""
    return bool(os.environ.get("CI"))


def set_up(needs: Needs) -> None:
    """Install what is missing; costs next to nothing when nothing is. Needs root or sudo for Debian packages only."""
    apt.check_permission(needs.packages)
    first = [package for package in needs.packages if package in _BUILD_PACKAGES]
    apt.install(first, "apt-build")
    jobs: list[Callable[[], None]] = [
        lambda: apt.install(needs.packages, "apt"),
        lambda: _set_up_python_311(needs),
    ]
    if "3.13" in needs.requirements:
        jobs.append(lambda: environments.ensure("3.13", needs.requirements["3.13"]))
    with ThreadPoolExecutor() as pool:
        for job in [pool.submit(job) for job in jobs]:
            job.result()


def _set_up_python_311(needs: Needs) -> None:
    environments.ensure("3.11", needs.requirements["3.11"])
    environments.ensure_libsvm()
    environments.ensure_sdl()
    if needs.pytest_folder:
        environments.ensure_folder(PYTEST_FOLDER, "3.11", "pytest")
