# SPDX-License-Identifier: MIT
"""`dev.py test`: the stages, the order in which they run, and the summary."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass

from tools import machine, stages
from tools.shell import Failure, say
from tools.stages import Counts, Skipped


@dataclass(frozen=True)
class Stage:
    """One stage: what it does, what it needs of the machine, and the stages that must have passed before."""

    run: Callable[[str | None], Counts]
    needs: Callable[[], machine.Needs]
    after: tuple[str, ...] = ()


# Those that take longest before others that need the same, so that none is left to run alone.
STAGES = {
    "cpp": Stage(stages.cpp, lambda: machine.CPP_TESTS),
    "style": Stage(stages.style_checks, lambda: machine.STYLE),
    "python": Stage(stages.python, lambda: machine.PYTHON_TESTS),
    "package": Stage(stages.package, lambda: machine.PACKAGE_TESTS),
    "sanitize": Stage(stages.sanitize, lambda: machine.SANITIZED_TESTS),
    "gui": Stage(stages.gui, lambda: machine.GUI if stages.gui_tests() else machine.Needs(), ("package",)),
    "windows": Stage(stages.windows_python, lambda: machine.WINDOWS_45, ("package",)),
    "windows-4.5": Stage(stages.windows_45, lambda: machine.WINDOWS_45, ("package",)),
    "windows-5.2": Stage(stages.windows_52, lambda: machine.WINDOWS_52, ("package",)),
    "blender-4.5": Stage(stages.blender_45, lambda: machine.BLENDER_45, ("package",)),
    "blender-5.2": Stage(stages.blender_52, lambda: machine.BLENDER_52, ("package",)),
    "blender-debian": Stage(stages.blender_debian, lambda: machine.BLENDER_DEBIAN, ("package",)),
    "threads": Stage(stages.threads, lambda: machine.SANITIZED_TESTS),
    "tidy": Stage(stages.tidy, lambda: machine.TIDY),
    "fuzz": Stage(stages.fuzz, lambda: machine.FUZZ),
}


@dataclass(frozen=True)
class Result:
    """How a stage ended."""

    state: str  # "passed", "failed" or "skipped"
    counts: Counts
    seconds: float
    remark: str = ""


def run_tests(names: list[str], expression: str | None) -> int:
    """Run the named stages and those they build on, all when none is named; non-zero when any failed."""
    start = time.monotonic()
    unknown = [name for name in names if name not in STAGES]
    if unknown:
        raise Failure(f"there is no stage {', '.join(unknown)}; the stages are {', '.join(STAGES)}")
    selected = _with_prerequisites(names or list(STAGES))
    needs = machine.Needs()
    for name in selected:
        needs = needs | STAGES[name].needs()
    machine.set_up(needs)
    say(f"set-up: ready after {time.monotonic() - start:.0f} s")
    results = _run_side_by_side(selected, expression)
    return _summarise({name: results[name] for name in selected}, time.monotonic() - start)


def _with_prerequisites(names: list[str]) -> list[str]:
    wanted = set(names)
    for name in reversed(STAGES):
        if name in wanted:
            wanted.update(STAGES[name].after)
    return [name for name in STAGES if name in wanted]


def _run_side_by_side(selected: list[str], expression: str | None) -> dict[str, Result]:
    """As many stages at a time as there are processors, since most of Blender's tests keep but one of them busy."""
    lanes = os.cpu_count() or 1
    results: dict[str, Result] = {}
    waiting, running = list(selected), dict[Future[Result], str]()
    with ThreadPoolExecutor(lanes) as pool:
        while waiting or running:
            ready = [name for name in waiting if results.keys() >= set(STAGES[name].after)]
            for name in ready[: lanes - len(running)]:
                waiting.remove(name)
                running[pool.submit(_run_stage, name, expression, dict(results))] = name
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                results[running.pop(future)] = future.result()
    return results


def _run_stage(name: str, expression: str | None, results: dict[str, Result]) -> Result:
    say(f"\n=== {name}")
    start = time.monotonic()
    blockers = [before for before in STAGES[name].after if results[before].state == "failed"]
    try:
        if blockers:
            raise Failure(f"not run, as {', '.join(blockers)} failed")
        counts = STAGES[name].run(expression)
        state, remark = ("failed" if counts.failed else "passed"), ""
    except Skipped as skipped:
        counts, state, remark = Counts(skipped=1), "skipped", str(skipped)
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
    total = Counts()
    for result in results.values():
        total = total + result.counts
    say(f"\nin {seconds:.0f} s with the set-up\n{total.passed} passed, {total.failed} failed, {total.skipped} skipped")
    return 1 if total.failed or not total.passed else 0
