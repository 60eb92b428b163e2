# SPDX-License-Identifier: MIT
"""What each stage of `dev.py test` does; each returns how many tests passed, failed and were skipped."""

from __future__ import annotations

import os
import re
import subprocess
import xml.etree.ElementTree as ElementTree
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from tools import blender, environments, fuzzing, machine, packages, style
from tools.compiling import compile_preset, installed_core
from tools.paths import LOGS, TOP
from tools.shell import Failure, run, say

_BLENDER_TESTS = TOP / "tests" / "blender"
_THREADED_TESTS = "Thread|ParallelFor|Crowd"
_FUZZ_RUNS = 20000  # of each fuzzer: a minute together


class Skipped(Exception):
    """Why a stage cannot run on this machine."""


@dataclass(frozen=True)
class Counts:
    """Numbers of tests."""

    passed: int = 0
    failed: int = 0
    skipped: int = 0

    def __add__(self, other: Counts) -> Counts:
        """Both together."""
        return Counts(self.passed + other.passed, self.failed + other.failed, self.skipped + other.skipped)


def style_checks(expression: str | None) -> Counts:
    """How the code is written; `expression` selects nothing."""
    passed, failures = style.check()
    for failure in failures:
        say(failure)
    return Counts(passed, len(failures))


def cpp(expression: str | None) -> Counts:
    """GoogleTest through ctest; `expression` is a regular expression here."""
    folder = compile_preset("release")
    selection = ["--tests-regex", expression] if expression else []
    report = _fresh_report("cpp")
    options = ["--output-on-failure", "--output-junit", str(report), "--parallel", str(os.cpu_count() or 1)]
    return _counted(["ctest", "--test-dir", folder, *options, *selection], "cpp", {}, expression)


def sanitize(expression: str | None) -> Counts:
    """The tests of cpp under the address and undefined-behaviour sanitizers; `expression` as there."""
    return _googletest("sanitize", "sanitize", expression)


def threads(expression: str | None) -> Counts:
    """The tests that start threads, under the thread sanitizer; `expression` as in cpp."""
    return _googletest("threads", "thread", expression or _THREADED_TESTS)


def fuzz(expression: str | None) -> Counts:
    """The fuzzers, the same inputs every time; `expression` is a part of their names."""
    names = [name for name in fuzzing.names() if (expression or "") in name]
    result = fuzzing.fuzz_alike(_FUZZ_RUNS, names)
    return Counts(len(names) - len(result.findings), len(result.findings))


def wheels(expression: str | None) -> Counts:
    """Build the wheel of each Python that is here; no test."""
    for python in machine.package_pythons():
        say(packages.wheel(python).name)
    return Counts()


def python(expression: str | None) -> Counts:
    """The binding's tests in Python 3.11."""
    core = installed_core("3.11", packages.wheel("3.11"))
    return _pytest("python", "3.11", TOP / "tests" / "python", {"PYTHONPATH": str(core)}, expression)


def package(expression: str | None) -> Counts:
    """Build both zips; no test."""
    for path in packages.build_all():
        say(path.name)
    return Counts()


def blender_45(expression: str | None) -> Counts:
    """The add-on's tests in Blender 4.5 LTS, a Python 3.11 module."""
    return _pytest("blender-4.5", "3.11", _BLENDER_TESTS, _extension("blender-4.5"), expression)


def blender_52(expression: str | None) -> Counts:
    """The add-on's tests in Blender 5.2 LTS, a Python 3.13 module."""
    if not machine.has_python_313():
        reason = "Blender 5.2's tests do not run: there is no Python 3.13 on the PATH or under ~/.pyenv/versions"
        if machine.in_ci() and environments.pyenv_pythons("3.13"):
            raise Failure(f"{reason} that works")
        raise Skipped(reason)
    return _pytest("blender-5.2", "3.13", _BLENDER_TESTS, _extension("blender-5.2"), expression)


def blender_34(expression: str | None) -> Counts:
    """The add-on's tests in Debian's Blender 3.4.1, with pytest inside it."""
    arguments = [machine.PYTEST_FOLDER, *_pytest_arguments("blender-3.4", _BLENDER_TESTS, expression)]
    command = blender.background_command(_BLENDER_TESTS / "run_in_blender.py", *arguments)
    return _counted(command, "blender-3.4", _legacy("blender-3.4"), expression)


def gui(expression: str | None) -> Counts:
    """Window tests: pytest on a screen of its own; the tests start Blender's windows themselves."""
    if not gui_tests():
        raise Skipped("tests/gui holds no test yet")
    environment = {**_legacy("gui"), "LIBGL_ALWAYS_SOFTWARE": "1"}
    screen = ("xvfb-run", "--auto-servernum", "--server-args", "-screen 0 1600x900x24")
    arguments = _pytest_arguments("gui", TOP / "tests" / "gui", expression)
    command = [*screen, environments.environment_python("3.11"), "-m", "pytest", *arguments]
    return _counted(command, "gui", environment, expression)


def gui_tests() -> list[Path]:
    """The window tests there are."""
    return list((TOP / "tests" / "gui").glob("test_*.py"))


def _googletest(stage: str, preset: str, expression: str | None) -> Counts:
    """The C++ tests in one process a processor, since sanitized ones take long to build the characters they share."""
    program = compile_preset(preset, "fragmotion_tests") / "fragmotion_tests"
    selection = [f"--gtest_filter={':'.join(_tests_that_match(program, expression))}"] if expression else []
    shards = os.cpu_count() or 1

    def run_shard(shard: int) -> Counts:
        name = f"{stage}-{shard}"
        options = ["--gtest_brief=1", f"--gtest_output=xml:{_fresh_report(name)}", *selection]
        environment = {"GTEST_TOTAL_SHARDS": str(shards), "GTEST_SHARD_INDEX": str(shard)}
        return _counted([program, *options], name, environment, expression)

    with ThreadPoolExecutor(shards) as pool:
        return sum(pool.map(run_shard, range(shards)), Counts())


def _tests_that_match(program: Path, expression: str) -> list[str]:
    answer = subprocess.run([program, "--gtest_list_tests"], capture_output=True, text=True, check=True, cwd=TOP)
    suite, names = "", []
    for line in answer.stdout.splitlines():
        word = line.split("#")[0].strip()
        if line.startswith(" "):
            names.append(suite + word)
        else:
            suite = word
    return [name for name in names if re.search(expression, name)]


def _extension(sandbox: str) -> dict[str, str]:
    return {**blender.sandbox(sandbox), "FRAGMOTION_ADDON_ZIP": str(packages.extension_path())}


def _legacy(sandbox: str) -> dict[str, str]:
    return {**blender.debian_environment(sandbox), "FRAGMOTION_ADDON_ZIP": str(packages.legacy_path())}


def _pytest(stage: str, version: str, folder: Path, environment: Mapping[str, str], expression: str | None) -> Counts:
    command = [environments.environment_python(version), "-m", "pytest", *_pytest_arguments(stage, folder, expression)]
    return _counted(command, stage, environment, expression)


def _pytest_arguments(stage: str, folder: Path, expression: str | None) -> list[str | Path]:
    selection = ["-k", expression] if expression else []
    return ["-q", f"--junitxml={_fresh_report(stage)}", *selection, folder]


def _fresh_report(stage: str) -> Path:
    report = LOGS / f"{stage}.xml"
    report.unlink(missing_ok=True)
    return report


def _counted(command: list[str | Path], stage: str, environment: Mapping[str, str], expression: str | None) -> Counts:
    """Run a test program and count by its JUnit report; it must have run a test, unless a selection left none."""
    failure = None
    try:
        run(command, stage, environment, echo=True)
    except Failure as raised:
        failure = raised
    counts = _read_report(LOGS / f"{stage}.xml")
    if failure and not counts.failed and not (expression and counts == Counts()):
        raise failure
    if counts.passed + counts.failed == 0 and not expression:
        raise Failure("no test ran")
    return counts


def _read_report(report: Path) -> Counts:
    if not report.exists():
        return Counts()
    suites = list(ElementTree.parse(report).getroot().iter("testsuite"))
    total, failures, errors, skipped = (
        sum(int(suite.get(name, 0)) for suite in suites) for name in ("tests", "failures", "errors", "skipped")
    )
    disabled = sum(int(suite.get("disabled", 0)) for suite in suites)
    return Counts(total - failures - errors - skipped - disabled, failures + errors, skipped + disabled)
