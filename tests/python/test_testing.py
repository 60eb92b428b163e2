# SPDX-License-Identifier: MIT
"""Which tests each form of `dev.py test` runs, and what it says of those that were skipped."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from tools.setup import machine
from tools.shell import Failure
from tools.testing import counts, stages, testing
from tools.testing.counts import Counts, Skip
from tools.testing.stages import Part

REPORT = """<testsuites><testsuite tests="5" failures="1" errors="0" skipped="2" disabled="0">
<testcase classname="tests.python.test_mocap" name="test_reads"><skipped message="no takes here"/></testcase>
<testcase classname="tests.python.test_mocap" name="test_builds">
<skipped message="a.cpp:7&#10;no takes here"/></testcase>
<testcase classname="tests.python.test_bake" name="test_bakes"/><testcase name="test_more"/>
<testcase name="test_fails"><failure message="1 != 2"/></testcase></testsuite></testsuites>"""


@pytest.fixture
def ran(monkeypatch: pytest.MonkeyPatch) -> list[tuple[str, Part]]:
    """Each stage that ran, and which part of it; none does anything, nor is anything set up."""
    found: list[tuple[str, Part]] = []

    def without_work(name: str, stage: testing.Stage) -> testing.Stage:
        def run(expression: str | None, part: Part) -> Counts:
            found.append((name, part))
            return Counts(passed=1)

        return testing.Stage(run, machine.Needs, stage.after, stage.parts)

    stubs = {name: without_work(name, stage) for name, stage in testing.STAGES.items()}
    monkeypatch.setattr(testing, "STAGES", stubs)
    monkeypatch.setattr(machine, "set_up", lambda needs: None)
    return found


def test_without_a_name_the_quick_tests_run_and_need_no_other_stage(ran: list[tuple[str, Part]]) -> None:
    assert testing.run_tests([], None) == 0
    assert sorted(ran) == [(name, Part.QUICK) for name in ("blender-debian", "cpp", "python", "style")]


def test_all_runs_every_stage_whole(ran: list[tuple[str, Part]]) -> None:
    assert testing.run_tests(["all"], None) == 0
    assert sorted(ran) == sorted((name, Part.ALL) for name in testing.STAGES)


def test_the_rest_has_what_the_quick_tests_leave_out_of_their_stages(ran: list[tuple[str, Part]]) -> None:
    assert testing.run_tests(["rest"], None) == 0
    assert {"cpp", "python", "blender-debian", "sanitize", "gui", "game"} <= {name for name, _ in ran}
    assert {part for _, part in ran} == {Part.REST}


def test_a_stage_that_is_named_runs_whole_with_those_it_builds_on(ran: list[tuple[str, Part]]) -> None:
    assert testing.run_tests(["blender-debian"], None) == 0
    assert ran == [("package", Part.ALL), ("blender-debian", Part.ALL)]


@pytest.mark.parametrize("names", [["beos"], ["all", "cpp"]])
def test_an_unknown_stage_is_told_with_those_there_are(names: list[str]) -> None:
    with pytest.raises(Failure, match=f"no stage {names[0]}; the stages are cpp, style, .*; or: all, rest"):
        testing.run_tests(names, None)


@pytest.mark.parametrize("expression", [None, "Build|Bvh"])
def test_every_c_test_is_in_one_part_of_two(monkeypatch: pytest.MonkeyPatch, expression: str | None) -> None:
    filters: list[str] = []

    def count(command: list[Any], *_: object) -> Counts:
        filters.extend(word.partition("=")[2] for word in command if str(word).startswith("--gtest_filter"))
        return Counts(passed=1)

    names = ["Build.IsCancelledAtEveryReport", "Bvh.ReadsATake", "Pin.IsReached"]
    monkeypatch.setattr(stages, "compile_preset", lambda *_: Path("folder"))
    monkeypatch.setattr(stages, "_counted", count)
    monkeypatch.setattr(stages, "_tests_that_match", lambda program, pattern: names[:2])
    for part in (Part.QUICK, Part.REST):
        stages.cpp(expression, part)
    quick, thorough = sorted({text.removesuffix("*.DISABLED_*") for text in filters}, key=lambda text: text[-1] == "-")
    assert quick.startswith("Build.IsCancelledAtEveryReport:Bvh.ReadsATake-" if expression else "*-")
    assert thorough == ("Build.IsCancelledAtEveryReport-" if expression else f"{quick.partition('-')[2][:-1]}-")


def test_what_was_skipped_is_counted_and_named_with_the_reason(tmp_path: Path, capsys: Any) -> None:
    (tmp_path / "report.xml").write_text(REPORT)
    found = counts.read_report(tmp_path / "report.xml")
    skips = tuple(Skip(f"tests.python.test_mocap.{name}", "no takes here") for name in ("test_reads", "test_builds"))
    assert found == Counts(passed=2, failed=1, skipped=2, skips=skips)
    testing._summarise({"python": testing.Result("failed", found, 1.0)}, 2.0)
    told = ["python: 2 skipped: no takes here", *(f"  {skip.test}" for skip in skips)]
    assert "\n".join(told) in capsys.readouterr().out


@pytest.mark.parametrize("reason", [*testing.EXPECTED_SKIPS, "no takes here"])
def test_in_ci_only_what_is_on_the_list_may_be_skipped(monkeypatch: pytest.MonkeyPatch, reason: str) -> None:
    results = {"python": testing.Result("passed", Counts(1, 0, 1, (Skip("test_reads", reason),)), 1.0)}
    monkeypatch.delenv("FRAGMOTION_NO_SKIPS", raising=False)
    assert testing._summarise(results, 2.0) == 0
    monkeypatch.setenv("FRAGMOTION_NO_SKIPS", "true")
    assert testing._summarise(results, 2.0) == (reason == "no takes here")


def test_a_program_that_ends_without_a_report_fails_whatever_was_selected(tmp_path: Path) -> None:
    stage = "ends-without-a-report"
    for expression in (None, "something"):
        with pytest.raises(Failure, match="this failed"):
            stages._counted(["false"], stage, {}, expression)
