# SPDX-License-Identifier: MIT
"""The project's goals beside what was measured.

Those of frames are ratios to ozz-animation's frame, or of two of ours, from one run in which they took turns. Those of
takes are told for 159 takes of 23,197 frames, and are the smaller the fewer frames there are.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from tools.measuring.bench.blender import InBlender
from tools.measuring.bench.measured import Measured
from tools.measuring.bench.stages import Row
from tools.measuring.bench.stored import Stored
from tools.measuring.bench.units import duration, megabytes

CHARACTERS = {"small": "benchmark's character", "large": "character of takes"}

_OVER_OZZ = {"free": 1.0, "locked": 1.8}
_RESTLESS = 1.3  # times a frame under a stick that is held
_ASKED = 8  # times that a player's step asks for the ground at most
_FRAMES = 23197  # of the takes that goals are told for


@dataclass(frozen=True)
class Goal:
    """A figure, if it was measured, and what it is to be: at most `limit`, or at least where `more` is better."""

    name: str
    figure: float | None
    limit: float
    shown: Callable[[float], str]
    more: bool = False

    @property
    def met(self) -> bool | None:
        """None where nothing was measured."""
        if self.figure is None:
            return None
        return self.figure >= self.limit if self.more else self.figure <= self.limit


def goals(rows: Sequence[Row], measured: Measured, stored: Stored, in_blender: InBlender) -> list[Goal]:
    """All of them, for two cores."""
    return [
        *(goal for character in CHARACTERS for goal in _character_goals(character, measured)),
        *_build_goals({row.name: row for row in rows}, measured),
        *_takes_goals(stored, in_blender),
    ]


def _character_goals(character: str, measured: Measured) -> list[Goal]:
    called, ozz = CHARACTERS[character], measured.seconds.get(f"{character} frame, ozz")
    held = {feet: measured.seconds[f"{character} frame, {feet}, held"] for feet in _OVER_OZZ}
    restless = measured.seconds[f"{character} frame, locked, restless"]
    near, far = (measured.cpu_seconds[f"{character} {crowd}"] for crowd in ("crowd step", "far crowd step"))
    gain = measured.seconds[f"{character} crowd step"] / measured.seconds[f"{character} crowd step, two threads"]
    return [
        *(
            Goal(f"{called}: frame, feet {feet}, held, over ozz's", ozz and held[feet] / ozz, limit, _times)
            for feet, limit in _OVER_OZZ.items()
        ),
        Goal(f"{called}: the same, restless over held", restless / held["locked"], _RESTLESS, _times),
        Goal(f"{called}: 10,000, feet locked, one core", near, 1 / 60, duration),
        Goal(f"{called}: 50,000, level of detail, one core", far, 1 / 60, duration),
        Goal(f"{called}: a crowd's gain by a second core", gain, 1.8, _times, more=True),
        Goal(
            f"{called}: calls of the ground a step on stairs", measured.asked[f"{character} on stairs"], _ASKED, _count
        ),
    ]


def _build_goals(core: dict[str, Row], measured: Measured) -> list[Goal]:
    growth = measured.growth
    largest = f"{growth.fragments[-1]:,} fragments"
    return [
        Goal("whole build", core["whole build"].seconds, 0.12, duration),
        Goal("whole build, NumPy + scikit-learn's over it", core["whole build"].ratio, 30, _times, more=True),
        Goal("Iterate", core["iterate"].seconds, 0.01, duration),
        Goal("Optimal", core["optimal"].seconds, 0.0005, duration),
        Goal("decision", core["decision"].seconds, 50e-9, duration),
        Goal(largest, growth.seconds[-1], 6, duration),
        Goal(f"{largest}: memory", growth.peak_bytes[-1], 480e6, megabytes),
        Goal("exponent of CPU time over fragments", growth.exponent, 1.1, "{:.2f}".format),
    ]


def _takes_goals(stored: Stored, in_blender: InBlender) -> list[Goal]:
    share, takes = stored.frames / _FRAMES, f"{stored.takes} takes"
    return [
        Goal("motion data, bytes a joint and sample", stored.bytes_a_rotation, 2, "{:.2f}".format),
        Goal("motion data, largest error at bones' ends", 1e3 * stored.off, 0.1, "{:.3f} mm".format),
        Goal(f"policy file of {takes}", stored.file_bytes / 1e6, share * 2.6, "{:.2f} MB".format),
        Goal(f"policy file of {takes}: load", stored.load_seconds, share * 5e-3, duration),
        Goal(f"import of {takes} in Blender", in_blender.importing, share * 5.5 / 2, duration),
        Goal(f"Build of {takes} in Blender", in_blender.building, share * 4.7 / 2, duration),
    ]


def show_goals(listed: Sequence[Goal]) -> None:
    """Print each goal beside its figure."""
    wide = max(len(goal.name) for goal in listed)
    print(f"\n{'goal':<{wide}} {'measured':>10}")
    for goal in listed:
        limit = f"at {'least' if goal.more else 'most'} {goal.shown(goal.limit)}"
        figure = "-" if goal.figure is None else goal.shown(goal.figure)
        print(f"{goal.name:<{wide}} {figure:>10}  {limit:<18} {_WORDS[goal.met]}")


_WORDS = {True: "met", False: "NOT MET", None: "not measured: --peers DIR"}


def _times(ratio: float) -> str:
    return f"{ratio:.2f}x"


def _count(times: float) -> str:
    return f"{times:.0f}"
