# SPDX-License-Identifier: MIT
"""games/csharp under Mono: what each of its promises holds, and poses that are the C library's to the bit."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

import pytest
from conftest import BUILD, TOP, Run, finished
from native import Library

OURS = TOP / "games" / "csharp"
TESTS = Path(__file__).parent / "csharp"
STRICT = ("-warnaserror", "-warn:4", "-r:System.Numerics.dll", "-r:System.Core.dll")
UNITY = (OURS / "Unity" / "FragmotionCharacter.cs", TESTS / "UnityEngine.cs", TESTS / "UnityTests.cs")
WALKING = TOP / "tests" / "data" / "version-3.policy"


class Mono:
    """Mono in Debian unstable, with this machine's libfragmotion."""

    def __init__(self, run: Run, library: Library) -> None:
        self.run, self.folder = run, library.path.parent

    def compile(self, name: str, sources: Sequence[Path], *options: str) -> Path:
        program = BUILD / "csharp" / f"{name}.exe"
        program.parent.mkdir(parents=True, exist_ok=True)
        self.run("mcs", *STRICT, *options, f"-out:{program}", OURS / "Fragmotion.cs", *sources)
        return program

    def play(self, program: Path, *arguments: Path) -> str:
        return self.run("env", f"LD_LIBRARY_PATH={self.folder}", "mono", "--debug", program, *arguments)


@pytest.fixture(scope="module")
def mono(in_unstable: Run, library: Library) -> Mono:
    return Mono(in_unstable, library)


@pytest.fixture(scope="module")
def program(mono: Mono) -> Path:
    return mono.compile("tests", [TESTS / "Tests.cs"], "-unsafe")


def promises(printed: str) -> tuple[list[str], list[str]]:
    return re.findall(r"^passed (\w+)", printed, re.MULTILINE), re.findall(r"^failed .*", printed, re.MULTILINE)


def test_its_poses_are_those_of_c_to_the_bit(mono: Mono, program: Path, library: Library) -> None:
    game, source = BUILD / "csharp" / "consumer", TOP / "tests" / "game" / "consumer.c"
    link = [library.path, f"-Wl,-rpath,{library.path.parent}"]
    words = ["gcc", "-std=c99", source, "-I", TOP / "cpp" / "include", "-o", game, *link]
    finished([str(word) for word in words], 60)
    assert mono.play(program, WALKING) == finished([str(game), str(WALKING)], 60)


def test_it_holds_its_promises(mono: Mono, program: Path, sample: Path) -> None:
    passed, failed = promises(mono.play(program, WALKING, sample / "sample.policy"))
    assert not failed
    assert len(passed) == 14


def test_every_function_of_the_header_is_there() -> None:
    header = (TOP / "cpp" / "include" / "fragmotion" / "fragmotion.h").read_text(encoding="utf-8")
    declared = set(re.findall(r"^FRAGMOTION_EXPORT [^(;]*?(fragmotion_\w+)\(", header, re.MULTILINE))
    left_out = {f"fragmotion_{name}" for name in ("result_text", "check_handles", "crowd_count", "crowd_parts")}
    imported = re.findall(r"extern \w+ (fragmotion_\w+)\(", (OURS / "Fragmotion.cs").read_text(encoding="utf-8"))
    assert len(declared) > 40
    assert set(imported) == declared - left_out


def test_the_example_walks(mono: Mono) -> None:
    printed = mono.play(mono.compile("example", [OURS / "example" / "Example.cs"]), WALKING)
    assert printed.count("FootDown") > 5
    assert "Landing" in printed


def test_the_example_says_what_a_file_is_not(mono: Mono) -> None:
    program = mono.compile("example", [OURS / "example" / "Example.cs"])
    script = f"LD_LIBRARY_PATH={mono.folder} mono {program} {__file__} 2>&1; test $? = 1"
    assert "it is no Fragmotion policy file" in mono.run("sh", "-c", script)


def test_unitys_component_plays_with_a_stand_in_for_unity(mono: Mono) -> None:
    passed, failed = promises(mono.play(mono.compile("unity", UNITY), WALKING))
    assert not failed
    assert len(passed) == 3
