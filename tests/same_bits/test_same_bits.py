# SPDX-License-Identifier: MIT
"""Ten minutes of a wild stick with moves, styles and stairs are the same to the bit on all that libfragmotion is
compiled for and in the add-on's core; and what is saved on one goes on alike on every other."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import pytest

from tools.packaging import compiling, cross
from tools.paths import BUILD, TOP

HERE = Path(__file__).parent
FOLDER = BUILD / "same-bits"
POLICY = TOP / "tests" / "data" / "styles.policy"
GAME_LIBRARY, ADDON_LIBRARY = "fragmotion_static", "fragmotion_runtime"


@dataclass(frozen=True)
class Machine:
    """What the game is compiled for, by zig unless it has no target, and what runs it."""

    name: str
    library: str
    target: str = ""
    runner: tuple[str, ...] = ()


MACHINES = (
    Machine("gcc-glibc", GAME_LIBRARY),
    Machine("addon", ADDON_LIBRARY),
    Machine("clang-musl", GAME_LIBRARY, "x86_64-linux-musl"),
    Machine("arm64", GAME_LIBRARY, "aarch64-linux-musl", ("qemu-aarch64",)),
)


@dataclass(frozen=True)
class Played:
    """What the game printed on a machine, and where its state between the two halves is."""

    machine: Machine
    halves: list[str]
    state: Path


def run(command: Sequence[str | Path], environment: dict[str, str]) -> str:
    """What a command prints; it must succeed."""
    words = [str(word) for word in command]
    done = subprocess.run(words, capture_output=True, text=True, env={**os.environ, **environment}, check=False)
    assert done.returncode == 0, f"{words}\n{done.stdout}{done.stderr}"
    return done.stdout


def program(machine: Machine) -> Path:
    """The game, compiled for a machine."""
    folder, target = FOLDER / machine.name, f"{machine.library}_game"
    if machine.target:
        environment = cross.environment()
        options = cross.toolchain(machine.name, machine.target, "Linux")
    else:
        environment = compiling.compiler_environment()
        options = {"CMAKE_BUILD_TYPE": "Release", "CMAKE_CXX_COMPILER_LAUNCHER": "ccache"}
    variables = [f"-D{name}={value}" for name, value in options.items()]
    run(["cmake", "-S", HERE, "-B", folder, "-G", "Ninja", *variables], environment)
    run(["cmake", "--build", folder, "--target", target], environment)
    return folder / target


def play(machine: Machine, what: str, state: Path) -> list[str]:
    """The sums of the poses that the compiled game prints."""
    game = FOLDER / machine.name / f"{machine.library}_game"
    return run([*machine.runner, game, what, POLICY, state], {}).split()


@pytest.fixture(scope="session")
def everywhere() -> list[Played]:
    """The game, compiled and played on all machines."""
    played = []
    for machine in MACHINES:
        state = program(machine).with_name("half.state")
        played.append(Played(machine, play(machine, "play", state), state))
    return played


def test_every_pose_of_ten_minutes_is_the_same_everywhere(everywhere: list[Played]) -> None:
    sums = {played.machine.name: played.halves for played in everywhere}
    first = everywhere[0].halves
    assert len(set(first)) == 2
    assert all(halves == first for halves in sums.values()), sums


def test_states_are_the_same_everywhere(everywhere: list[Played]) -> None:
    assert len({played.state.read_bytes() for played in everywhere}) == 1


def test_what_is_saved_on_one_goes_on_alike_on_another(everywhere: list[Played]) -> None:
    for saved, goes_on in zip(everywhere, everywhere[1:] + everywhere[:1]):
        replayed = play(goes_on.machine, "replay", saved.state)
        assert replayed == saved.halves[1:], f"{saved.machine.name}, then {goes_on.machine.name}"
