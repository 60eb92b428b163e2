# SPDX-License-Identifier: MIT
"""`dev.py test`: the stages, the order in which they run, and the summary."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass

from tools.setup import machine
from tools.shell import Failure, say
from tools.testing import stages
from tools.testing.counts import Counts, Skip
from tools.testing.stages import Part, Skipped


@dataclass(frozen=True)
class Stage:
    """One stage: what it does of a part of its tests, what it needs of the machine, the stages that must have passed
    before where they run as well, and the parts that it has: one without parts runs when it is named, or with all."""

    run: Callable[[str | None, Part], Counts]
    needs: Callable[[], machine.Needs]
    after: tuple[str, ...] = ()
    parts: tuple[Part, ...] = ()

    def has(self, part: Part) -> bool:
        """Whether there are tests of that part in it."""
        return part is Part.ALL or part in self.parts


def _whole(run: Callable[[str | None], Counts]) -> Callable[[str | None, Part], Counts]:
    """A stage that does the same whatever the part."""
    return lambda expression, part: run(expression)


_BOTH, _REST = (Part.QUICK, Part.REST), (Part.REST,)


# Those that take longest before others that need the same, so that none is left to run alone.
STAGES = {
    "cpp": Stage(stages.cpp, lambda: machine.CPP_TESTS, parts=_BOTH),
    "style": Stage(_whole(stages.style_checks), lambda: machine.STYLE, parts=(Part.QUICK,)),
    "python": Stage(stages.python, lambda: machine.PYTHON_TESTS, parts=_BOTH),
    "package": Stage(_whole(stages.package), lambda: machine.PACKAGE_TESTS),
    "sanitize": Stage(stages.sanitize, lambda: machine.SANITIZED_TESTS, parts=_REST),
    "gui": Stage(stages.gui, lambda: machine.GUI if stages.gui_tests() else machine.Needs(), ("package",), _REST),
    "windows": Stage(_whole(stages.windows_python), lambda: machine.WINDOWS_45, ("package",)),
    "windows-4.5": Stage(_whole(stages.windows_45), lambda: machine.WINDOWS_45, ("package",)),
    "windows-5.2": Stage(_whole(stages.windows_52), lambda: machine.WINDOWS_52, ("package",)),
    "blender-4.5": Stage(_whole(stages.blender_45), lambda: machine.BLENDER_45, ("package",)),
    "blender-5.2": Stage(_whole(stages.blender_52), lambda: machine.BLENDER_52, ("package",)),
    "blender-debian": Stage(stages.blender_debian, lambda: machine.BLENDER_DEBIAN, ("package",), _BOTH),
    "game": Stage(_whole(stages.game), lambda: machine.GAME_TESTS, parts=_REST),
    "threads": Stage(_whole(stages.threads), lambda: machine.SANITIZED_TESTS),
    "same-bits": Stage(_whole(stages.same_bits), lambda: machine.SAME_BITS),
    "engines": Stage(_whole(stages.engines), lambda: machine.ENGINES),
    "tidy": Stage(_whole(stages.tidy), lambda: machine.TIDY),
    "fuzz": Stage(_whole(stages.fuzz), lambda: machine.FUZZ),
}

EXPECTED_SKIPS = (
    "this Blender",  # what a version or a kind of Blender lacks
    "Debian unstable",  # several gigabytes, and root
    "Windows",  # what a file cannot be there
    "no motion capture beside the project",  # takes that are not ours to pass on; the sample's test the same code
)
"""How the reasons begin for which tests may be skipped where FRAGMOTION_NO_SKIPS is set, as in CI."""

WHOLE, REST = "all", "rest"
"""What stands for all stages, and for what CI runs besides what runs when none is named."""


@dataclass(frozen=True)
class Result:
    """How a stage ended."""

    state: str  # "passed", "failed" or "skipped"
    counts: Counts
    seconds: float
    remark: str = ""


def run_tests(names: list[str], expression: str | None) -> int:
    """Run the named stages and those they build on; `all` of them, the quick ones when none is named, or the `rest`;
    non-zero when any failed."""
    start = time.monotonic()
    part = {(): Part.QUICK, (REST,): Part.REST}.get(tuple(names), Part.ALL)
    selected = _selected(names, part)
    needs = machine.Needs()
    for name in selected:
        needs = needs | STAGES[name].needs()
    machine.set_up(needs)
    say(f"set-up: ready after {time.monotonic() - start:.0f} s")
    results = _run_side_by_side(selected, part, expression)
    failed = _summarise({name: results[name] for name in selected}, time.monotonic() - start)
    if part is Part.QUICK:
        say("these are the quick ones; `python3 dev.py test rest` runs what CI does besides, `test all` every one")
    return failed


def _selected(names: list[str], part: Part) -> list[str]:
    unknown = [name for name in names if name not in STAGES]
    if unknown and names not in ([WHOLE], [REST]):
        raise Failure(
            f"there is no stage {', '.join(unknown)}; the stages are {', '.join(STAGES)}; or: {WHOLE}, {REST}"
        )
    in_part = [name for name, stage in STAGES.items() if stage.has(part)]
    return in_part if unknown or not names else _with_prerequisites(names)


def _with_prerequisites(names: list[str]) -> list[str]:
    wanted = set(names)
    for name in reversed(STAGES):
        if name in wanted:
            wanted.update(STAGES[name].after)
    return [name for name in STAGES if name in wanted]


def _run_side_by_side(selected: list[str], part: Part, expression: str | None) -> dict[str, Result]:
    """As many stages at a time as there are processors, since most of Blender's tests keep but one of them busy."""
    lanes = os.cpu_count() or 1
    results: dict[str, Result] = {}
    waiting, running = list(selected), dict[Future[Result], str]()
    with ThreadPoolExecutor(lanes) as pool:
        while waiting or running:
            ready = [name for name in waiting if results.keys() >= set(STAGES[name].after) & set(selected)]
            for name in ready[: lanes - len(running)]:
                waiting.remove(name)
                running[pool.submit(_run_stage, name, part, expression, dict(results))] = name
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                results[running.pop(future)] = future.result()
    return results


def _run_stage(name: str, part: Part, expression: str | None, results: dict[str, Result]) -> Result:
    say(f"\n=== {name}")
    start = time.monotonic()
    blockers = [before for before in STAGES[name].after if before in results and results[before].state == "failed"]
    try:
        if blockers:
            raise Failure(f"not run, as {', '.join(blockers)} failed")
        counts = STAGES[name].run(expression, part)
        state, remark = ("failed" if counts.failed else "passed"), ""
    except Skipped as skipped:
        counts, state, remark = Counts(skipped=1, skips=(Skip("all of it", str(skipped)),)), "skipped", str(skipped)
    except Failure as failure:
        counts, state, remark = Counts(failed=1), "failed", str(failure)
    seconds = time.monotonic() - start
    say(f"=== {name}: {state} in {seconds:.0f} s{': ' if remark else ''}{remark}")
    return Result(state, counts, seconds, remark.splitlines()[0] if remark else "")


def _summarise(results: dict[str, Result], seconds: float) -> int:
    say(f"\n{'stage':<14} {'result':<8} {'passed':>6} {'failed':>6} {'skipped':>7} {'seconds':>7}")
    for name, result in results.items():
        counts = result.counts
        figures = f"{counts.passed:>6} {counts.failed:>6} {counts.skipped:>7} {result.seconds:>7.0f}"
        say(f"{name:<14} {result.state:<8} {figures}  {result.remark}".rstrip())
    for name, result in results.items():
        _say_skips(name, result.counts.skips)
    total = Counts()
    for result in results.values():
        total = total + result.counts
    unexpected = [skip for skip in total.skips if not skip.reason.startswith(EXPECTED_SKIPS)]
    if unexpected and os.environ.get("FRAGMOTION_NO_SKIPS"):
        say(f"\nfailed: {len(unexpected)} skipped for a reason that is not on the list of EXPECTED_SKIPS")
        total = total + Counts(failed=len(unexpected))
    say(f"\nin {seconds:.0f} s with the set-up\n{total.passed} passed, {total.failed} failed, {total.skipped} skipped")
    return 1 if total.failed or not total.passed else 0


def _say_skips(stage: str, skips: tuple[Skip, ...]) -> None:
    """Name the tests that were skipped, by their reasons."""
    for reason in dict.fromkeys(skip.reason for skip in skips):
        tests = [skip.test for skip in skips if skip.reason == reason]
        say(f"\n{stage}: {len(tests)} skipped: {reason}")
        for test in tests:
            say(f"  {test}")
