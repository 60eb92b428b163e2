# SPDX-License-Identifier: MIT
"""`dev.py fuzz`: libFuzzer on the readers of files, each from its committed corpus and what earlier runs found."""

from __future__ import annotations

import os
import re
import shutil
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from tools.packaging.compiling import compile_preset
from tools.paths import BUILD, LOGS, TOP
from tools.shell import Failure, run, say

_FUZZERS = TOP / "tests" / "fuzz"
_INPUTS = BUILD / "fuzz-inputs"
_FINDINGS = BUILD / "fuzz-findings"
_JOBS = os.cpu_count() or 1

# No input may take a second. The sanitizers make it some ten times slower, and a busy machine a few times more; a
# reader that hangs takes more than any of these.
_SECONDS_AN_INPUT = 20
# Readers may take 50 MB and 20 times the input's size; the rest is the sanitizers', which keep what was freed.
_MEGABYTES, _MEGABYTES_AT_ONCE = 1024, 51
_LONGEST = 86400.0  # seconds
_LONGEST_INPUT = 32768  # bytes: enough for any structure, and for thousands of runs a second


@dataclass(frozen=True)
class Result:
    """What the fuzzers did, and the inputs that they found to break a promise."""

    executions: int
    findings: list[str]


def names() -> list[str]:
    """The fuzzers there are."""
    return sorted(path.stem.removeprefix("fuzz_") for path in _FUZZERS.glob("fuzz_*.cpp"))


def fuzz_for(seconds: float, selected: list[str]) -> Result:
    """Run the fuzzers for `seconds` in all, going on from what earlier runs found to be worth keeping."""
    share = max(1, round(seconds * min(_JOBS, len(selected)) / len(selected)))
    return _fuzz(selected, [f"-max_total_time={share}"], _INPUTS)


def fuzz_alike(runs: int, selected: list[str]) -> Result:
    """Run each fuzzer `runs` times from the committed corpus alone: the same inputs in every run of a build."""
    inputs = BUILD / "fuzz-inputs-alike"
    shutil.rmtree(inputs, ignore_errors=True)
    return _fuzz(selected, [f"-runs={runs}", "-seed=1"], inputs)


def _fuzz(selected: list[str], limits: list[str], inputs: Path) -> Result:
    """Run the fuzzers, as many at a time as there are processors; what they find is kept and told."""
    unknown = sorted(set(selected) - set(names()))
    if unknown:
        raise Failure(f"there is no fuzzer {', '.join(unknown)}; the fuzzers are {', '.join(names())}")
    folder = compile_preset("sanitize", *(f"fuzz_{name}" for name in selected))
    with ThreadPoolExecutor(_JOBS) as pool:
        results = list(pool.map(lambda name: _fuzz_one(folder, name, limits, inputs / name), selected))
    total = Result(sum(r.executions for r in results), [finding for r in results for finding in r.findings])
    say(f"{total.executions} executions, {len(total.findings)} findings")
    return total


def _fuzz_one(folder: Path, name: str, limits: list[str], inputs: Path) -> Result:
    for path in (inputs, _FINDINGS):
        path.mkdir(parents=True, exist_ok=True)
    dictionary = _FUZZERS / "dictionaries" / name
    options = [
        *limits,
        f"-timeout={_SECONDS_AN_INPUT}",
        f"-rss_limit_mb={_MEGABYTES}",
        f"-malloc_limit_mb={_MEGABYTES_AT_ONCE}",
        f"-max_len={_LONGEST_INPUT}",
        f"-artifact_prefix={_FINDINGS}/{name}-",
        "-print_final_stats=1",
        *([f"-dict={dictionary}"] if dictionary.exists() else []),
    ]
    log = f"fuzz-{name}"
    try:
        run(
            [folder / f"fuzz_{name}", *options, inputs, _FUZZERS / "corpus" / name],
            log,
            {"UBSAN_OPTIONS": "print_stacktrace=1"},
            timeout=_LONGEST,
        )
        finding = []
    except Failure as failure:
        finding = [str(failure)]
    text = (LOGS / f"{log}.log").read_text(errors="replace")
    told = re.findall(r"stat::number_of_executed_units: *(\d+)|^#(\d+)", text, re.MULTILINE)
    executions = max((int(a or b) for a, b in told), default=0)
    played = re.search(r"^stat::played_policies: *(\d+)", text, re.MULTILINE)
    of_which = f", {played[1]} of policies that were read and played" if played else ""
    say(f"{name}: {executions} executions{of_which}" + "".join(f"\n{cause}" for cause in finding))
    return Result(executions, finding)
