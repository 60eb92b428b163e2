# SPDX-License-Identifier: MIT
"""games/csharp under Mono: what each of its promises holds, and poses that are the C library's to the bit."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

import playing
import pytest

OURS = playing.GAMES / "csharp"
TESTS = Path(__file__).parent / "csharp"
STRICT = ("-warnaserror", "-warn:4", "-r:System.Numerics.dll", "-r:System.Core.dll")
UNITY = (OURS / "Unity" / "FragmotionCharacter.cs", TESTS / "UnityEngine.cs", TESTS / "UnityTests.cs")


def compile_program(name: str, sources: Sequence[Path], *options: str) -> Path:
    program = playing.FOLDER / "csharp" / f"{name}.exe"
    program.parent.mkdir(parents=True, exist_ok=True)
    playing.run_inside(["mcs", *STRICT, *options, f"-out:{program}", OURS / "Fragmotion.cs", *sources])
    return program


def play(program: Path, *arguments: Path) -> str:
    found = f"LD_LIBRARY_PATH={playing.library()}"
    return playing.run_inside(["env", found, "mono", "--debug", program, *arguments])


def promises(printed: str) -> tuple[list[str], list[str]]:
    return re.findall(r"^passed (\w+)", printed, re.MULTILINE), re.findall(r"^failed .*", printed, re.MULTILINE)


@pytest.fixture(scope="module")
def program() -> Path:
    return compile_program("tests", [TESTS / "Tests.cs"], "-unsafe")


def test_its_poses_are_those_of_c_to_the_bit(program: Path) -> None:
    game = playing.FOLDER / "consumer"
    source = playing.TOP / "tests" / "game" / "consumer.c"
    link = ["-L", playing.library(), "-lfragmotion", f"-Wl,-rpath,{playing.library()}"]
    playing.run(["gcc", "-std=c99", source, "-I", playing.TOP / "cpp" / "include", "-o", game, *link])
    assert play(program, playing.WALKING) == playing.run([game, playing.WALKING])


def test_it_holds_its_promises(program: Path) -> None:
    passed, failed = promises(play(program, playing.WALKING, playing.sample("sample.policy")))
    assert not failed
    assert len(passed) == 13


def test_every_function_of_the_header_is_there() -> None:
    header = (playing.TOP / "cpp" / "include" / "fragmotion" / "fragmotion.h").read_text(encoding="utf-8")
    declared = set(re.findall(r"^FRAGMOTION_EXPORT [^(;]*?(fragmotion_\w+)\(", header, re.MULTILINE))
    left_out = {
        "fragmotion_result_text",
        "fragmotion_check_handles",
        "fragmotion_crowd_count",
        "fragmotion_crowd_parts",
    }
    imported = re.findall(r"extern \w+ (fragmotion_\w+)\(", (OURS / "Fragmotion.cs").read_text(encoding="utf-8"))
    assert len(declared) > 40
    assert set(imported) == declared - left_out


def test_the_example_walks_and_says_what_a_file_is_not() -> None:
    program = compile_program("example", [OURS / "example" / "Example.cs"])
    printed = play(program, playing.WALKING)
    assert printed.count("FootDown") > 5
    assert "Landing" in printed
    told = playing.run_inside(
        ["sh", "-c", f"LD_LIBRARY_PATH={playing.library()} mono {program} {__file__}; test $? = 1"]
    )
    assert "it is no Fragmotion policy file" in told


def test_unitys_component_plays_with_a_stand_in_for_unity() -> None:
    passed, failed = promises(play(compile_program("unity", UNITY), playing.WALKING))
    assert not failed
    assert len(passed) == 3
