# SPDX-License-Identifier: MIT
"""The platforms that zips are made for: what compiles for them, and how Blender, wheels and Pythons name them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from tools.shell import Failure

EXTENSION_PYTHONS = ("3.11", "3.13")
"""The Pythons of Blender 4.2 and later."""

LEGACY_PYTHONS = ("3.10", "3.11")
"""The Pythons of Blender 3.4 to 4.1: up to 4.0 as blender.org ships it, 3.10."""


@dataclass(frozen=True)
class Platform:
    """One platform, by the name that Blender's manifests have for it."""

    name: str
    target: str
    """What zig compiles for: the processor, the system, and the oldest version of it."""
    wheel_tag: str
    sdl_tag: str
    """The tag of SDL's wheel."""
    system: str
    """What CMake calls the system."""
    artifact: str
    """The ending of the artifact that holds its Pythons' headers: those of both Macs differ in nothing that matters."""
    module_suffix: str
    """What Python adds to a module's name, with `{}` for the digits of its version."""
    legacy: bool
    """Whether there is a legacy zip."""
    more_pythons: tuple[str, ...] = ()
    """Those of other Blenders, asked for: the extension holds a core for them, too."""

    @property
    def label(self) -> str:
        """The end of a zip's name, as Blender's --split-platforms writes it."""
        return self.name.replace("-", "_")

    @property
    def extension_pythons(self) -> tuple[str, ...]:
        """The Pythons that its extension holds a core for."""
        return _in_order({*EXTENSION_PYTHONS, *self.more_pythons})

    @property
    def pythons(self) -> tuple[str, ...]:
        """The Pythons that its zips hold a core for."""
        return _in_order({*self.extension_pythons, *(LEGACY_PYTHONS if self.legacy else ())})

    def module_name(self, python: str) -> str:
        """The file name of the compiled core for one Python."""
        return f"fragmotion_core{self.module_suffix.format(python.replace('.', ''))}"


def _in_order(versions: Iterable[str]) -> tuple[str, ...]:
    return tuple(sorted(versions, key=lambda version: int(version.partition(".")[2])))


PLATFORMS = (
    Platform(
        "linux-x64",
        "x86_64-linux-gnu.2.28",
        "manylinux_2_28_x86_64",
        "manylinux2014_x86_64",
        "Linux",
        "linux-x86_64",
        ".cpython-{}-x86_64-linux-gnu.so",
        legacy=True,
    ),
    Platform(
        "windows-x64",
        "x86_64-windows-gnu",
        "win_amd64",
        "win_amd64",
        "Windows",
        "windows-x86_64",
        ".cp{}-win_amd64.pyd",
        legacy=True,
    ),
    Platform(
        "macos-arm64",
        "aarch64-macos.11.0",
        "macosx_11_0_arm64",
        "macosx_11_0_universal2",
        "Darwin",
        "macosx-x86_64",
        ".cpython-{}-darwin.so",
        legacy=False,
    ),
    Platform(
        "macos-x64",
        "x86_64-macos.11.0",
        "macosx_11_0_x86_64",
        "macosx_11_0_x86_64",
        "Darwin",
        "macosx-x86_64",
        ".cpython-{}-darwin.so",
        legacy=False,
    ),
)
LINUX = PLATFORMS[0]
WINDOWS = PLATFORMS[1]
TESTED_PLATFORMS = (LINUX, WINDOWS)
"""Those whose zips are run here."""


def named(name: str) -> Platform:
    """The platform of that name; Failure lists the names there are."""
    for platform in PLATFORMS:
        if platform.name == name:
            return platform
    raise Failure(f"there is no platform {name}; the platforms are {', '.join(p.name for p in PLATFORMS)}")
