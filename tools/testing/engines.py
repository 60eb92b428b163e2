# SPDX-License-Identifier: MIT
"""`dev.py test engines`: a character in each engine, in Debian unstable; and what each takes of it."""

from __future__ import annotations

from tools.games import sample
from tools.paths import TOP
from tools.setup import apt, unstable
from tools.testing.counts import Counts, Skip

TESTS = TOP / "tests" / "engines"

ENGINES: dict[str, tuple[str, ...]] = {
    "web": ("chromium", "cmake", "emscripten", "libeigen3-dev", "ninja-build", "nodejs", "npm"),
    "godot": ("godot", "libgl1-mesa-dri", "xauth", "xvfb"),
    "csharp": ("mono-devel",),
    "farm": ("nodejs",),
    "raylib": ("cmake", "g++", "libeigen3-dev", "libgl1-mesa-dri", "libraylib-dev", "ninja-build", "xauth", "xvfb"),
}
"""The Debian packages of each engine that tests/engines/test_NAME.py plays in."""


def packages() -> list[str]:
    """What all of them take, once each."""
    return sorted({package for packages in ENGINES.values() for package in packages})


def absent() -> dict[str, str]:
    """The engines whose tests cannot run here, and why."""
    if reason := unstable.why_not():
        return dict.fromkeys(ENGINES, reason)
    lacks = {name: apt.missing(needed, unstable.ROOT) for name, needed in ENGINES.items()}
    tell = "Debian unstable lacks {}: sudo python3 dev.py unstable"
    return {name: tell.format(" ".join(packages)) for name, packages in lacks.items() if packages}


def environment() -> dict[str, str]:
    """What the tests are told: where the sample character is, made for them."""
    return {"PYTHONPATH": str(TOP), "FRAGMOTION_SAMPLE": str(sample.make())}


def skipped(reasons: dict[str, str]) -> Counts:
    """Engines that were left out, as the summary names them."""
    return Counts(skipped=len(reasons), skips=tuple(Skip(f"engines.{name}", why) for name, why in reasons.items()))
