# SPDX-License-Identifier: MIT
"""Ten minutes of a wild stick with moves, styles and stairs are the same to the bit on all that libfragmotion is
compiled for and in the add-on's core; and what is saved on one goes on alike on another."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import pytest

from tools.games import web
from tools.packaging import compiling, cross
from tools.paths import BUILD, TOP
from tools.platforms import WINDOWS
from tools.setup import unstable, windows
from tools.testing import engines

GAME = Path(__file__).with_name("wild_game.c")
INCLUDE = f"-I{TOP / 'cpp' / 'include'}"
FOLDER = BUILD / "same-bits"
POLICY = TOP / "tests" / "data" / "styles.policy"
LIBRARY = ("fragmotion_static", "game/libfragmotion.a")
DLL = ("fragmotion_shared", "game/libfragmotion.dll.a")
# What the add-on's module is linked from, and the mathematics' objects: compiled with the flags that the module has, as
# everything else here.
ADDON = (
    "fragmotion_runtime fragmotion_math_objects",
    "libfragmotion_runtime.a",
    "CMakeFiles/fragmotion_math_objects.dir/**/*.c.o*",
)


def run(command: Sequence[str | Path], environment: dict[str, str] | None = None) -> str:
    """What a command prints; it must succeed."""
    words = [str(word) for word in command]
    done = subprocess.run(words, capture_output=True, text=True, env={**os.environ, **(environment or {})}, check=False)
    assert done.returncode == 0, f"{words}\n{done.stdout}{done.stderr}"
    return done.stdout


def link(
    folder: Path, cc: Sequence[str | Path], cxx: Sequence[str | Path], libraries: Sequence[Path], name: str
) -> Path:
    """The game in C, linked with the libraries as C++ is."""
    run([*cc, "-std=c99", "-O1", INCLUDE, "-c", GAME, "-o", folder / "game.o"])
    run([*cxx, folder / "game.o", *libraries, "-o", folder / name])
    return folder / name


def built(
    folder: Path, wanted: tuple[str, ...], options: dict[str, str | Path], environment: dict[str, str]
) -> list[Path]:
    """The libraries and objects, compiled in a folder."""
    targets, *files = wanted
    variables = [f"-D{name}={value}" for name, value in {**options, "FRAGMOTION_RUNTIME_ONLY": "ON"}.items()]
    run(["cmake", "-S", TOP, "-B", folder, "-G", "Ninja", *variables], environment)
    run(["cmake", "--build", folder, "--target", *targets.split()], environment)
    return [path for name in files for path in sorted(folder.glob(name))]


def by_this_machine(folder: Path, wanted: tuple[str, ...]) -> list[str | Path]:
    """Compiled by this machine's own compiler, with its own C library."""
    options: dict[str, str | Path] = {"CMAKE_BUILD_TYPE": "Release", "CMAKE_CXX_COMPILER_LAUNCHER": "ccache"}
    libraries = built(folder, wanted, options, compiling.compiler_environment())
    return [link(folder, ["cc"], ["c++"], libraries, "wild_game")]


def by_zig(
    target: str, system: str, runner: Sequence[str | Path], folder: Path, wanted: tuple[str, ...]
) -> list[str | Path]:
    """Compiled by zig for a target, and run by what plays that here."""
    options = cross.toolchain(folder.name, target, system)
    libraries = built(folder, wanted, options, cross.environment())
    compilers = [cross.zig(), "cc", "-target", target], [cross.zig(), "c++", "-target", target]
    game = "wild_game.exe" if system == "Windows" else "wild_game"
    return [*runner, link(folder / "game", *compilers, libraries, game)]


def by_wine(folder: Path, wanted: tuple[str, ...]) -> list[str | Path]:
    """For Windows, compiled as the add-on's core for it is; the game stands beside the library."""
    return by_zig(WINDOWS.target, WINDOWS.system, [windows.loader()], folder, wanted)


def by_emscripten(folder: Path, wanted: tuple[str, ...]) -> list[str | Path]:
    """As WebAssembly, in Debian unstable's Node, with its Eigen: what the web page's module is made of."""
    if reason := engines.absent().get("web"):
        pytest.skip(reason)
    web.module()
    library = BUILD / "web" / "wasm" / "fragmotion" / wanted[1]
    flags = ["-fwasm-exceptions", "-O2", "-sNODERAWFS", "-sALLOW_MEMORY_GROWTH"]
    folder.mkdir(parents=True, exist_ok=True)
    compilers = unstable.command(["emcc"]), unstable.command(["em++", *flags])
    return unstable.command(["node", link(folder, *compilers, [library], "wild_game.js")])


@dataclass(frozen=True)
class Machine:
    """What the game is compiled for, with which library, and what makes the command that plays it."""

    name: str
    make: Callable[[Path, tuple[str, ...]], Sequence[str | Path]]
    library: tuple[str, ...] = LIBRARY


MACHINES = (
    Machine("gcc-glibc", by_this_machine),
    Machine("addon", by_this_machine, ADDON),
    Machine("clang-musl", partial(by_zig, "x86_64-linux-musl", "Linux", ())),
    Machine("arm64", partial(by_zig, "aarch64-linux-musl", "Linux", ("qemu-aarch64",))),
    Machine("windows", by_wine, DLL),
    Machine("windows-addon", by_wine, ADDON),
    Machine("web", by_emscripten),
)


class Played:
    """The game on a machine: the sums of the poses of its two halves, and its state between them."""

    def __init__(self, machine: Machine) -> None:
        folder = FOLDER / machine.name
        self.command = machine.make(folder, machine.library)
        self.state = folder / "half.state"
        self.halves = self.play("play", self.state)

    def play(self, what: str, state: Path) -> list[str]:
        """The sums that the game prints."""
        return run([*self.command, what, POLICY, state], windows.environment("same-bits")).split()


@pytest.fixture(scope="session")
def first() -> Played:
    """What all others are compared with."""
    return Played(MACHINES[0])


@pytest.fixture(scope="session", params=MACHINES[1:], ids=lambda machine: machine.name)
def other(request: pytest.FixtureRequest) -> Played:
    """Each of the others."""
    return Played(request.param)


def test_every_pose_of_ten_minutes_is_the_same(first: Played, other: Played) -> None:
    assert len(set(first.halves)) == 2
    assert other.halves == first.halves


def test_states_are_the_same(first: Played, other: Played) -> None:
    assert other.state.read_bytes() == first.state.read_bytes()


def test_what_is_saved_on_one_goes_on_alike_on_the_other(first: Played, other: Played) -> None:
    assert other.play("replay", first.state) == first.halves[1:]
    assert first.play("replay", other.state) == first.halves[1:]
