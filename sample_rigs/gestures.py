# SPDX-License-Identifier: MIT
"""What the sample character does beside walking: curves over a standing body. Metres, seconds, degrees."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

Knots = tuple[tuple[float, float], ...]


@dataclass(frozen=True)
class Gesture:
    """Knots (second, value), flat at each, by what they add to; before and after a curve's knots its end values hold.

    hips_left, hips_back, hips_down: where the hips are; lean: the body, forward. With a side's ending .L or .R: swing,
    elbow, out, twist: the arm, forward, bent, up sideways and about its length; ahead, up, pitch: the foot, which is
    in the air while it has curves.

    upper_body: only what is above the legs is meant. loop: the seconds that go round while it is held.
    """

    curves: Mapping[str, Knots]
    upper_body: bool = False
    loop: tuple[float, float] | None = None

    def value(self, name: str, time: np.ndarray) -> np.ndarray:
        """A curve at moments [N]; 0 where there is none."""
        knots = self.curves.get(name, ((0.0, 0.0),))
        seconds, values = np.transpose(knots)
        after = np.clip(np.searchsorted(seconds, time), 1, max(len(seconds) - 1, 1))
        if len(seconds) == 1:
            return np.full_like(time, values[0])
        share = np.clip((time - seconds[after - 1]) / (seconds[after] - seconds[after - 1]), 0, 1)
        return values[after - 1] + share * share * (3 - 2 * share) * (values[after] - values[after - 1])

    def lifts(self, side: str, time: np.ndarray) -> np.ndarray:
        """Whether the foot is in the air [N]."""
        seconds = [second for second, _ in self.curves.get(f"up{side}", ())]
        return (time > seconds[0]) & (time < seconds[-1]) if seconds else np.zeros(len(time), bool)


def _to_and_fro(begin: float, end: float, apart: float, low: float, high: float) -> Knots:
    """0 at the begin and the end, and in between low and high in turn."""
    turns = np.arange(begin + 2 * apart, end - 2 * apart + 1e-9, apart)
    return ((begin, 0.0), *((float(t), high if k % 2 else low) for k, t in enumerate(turns)), (end, 0.0))


GESTURES: Mapping[str, Gesture] = {
    "wave": Gesture(
        {
            "out.R": ((0.1, 0), (0.6, 78), (2.2, 78), (2.8, 0)),
            "twist.R": ((0.1, 0), (0.55, 92), (2.25, 92), (2.7, 0)),
            "swing.R": ((0.1, 0), (0.6, 14), (2.2, 14), (2.8, 0)),
            "elbow.R": _to_and_fro(0.1, 2.8, 0.22, 48, 92),
            "lean": ((0.1, 0), (0.7, -2), (2.2, -2), (2.8, 0)),
        },
        upper_body=True,
    ),
    "kick": Gesture(
        {
            "hips_left": ((0.0, 0), (0.45, 0.085), (1.5, 0.085), (1.95, 0)),
            "hips_back": ((0.3, 0), (0.7, -0.02), (0.95, -0.04), (1.3, 0.01), (1.7, 0)),
            "hips_down": ((0.1, 0), (0.5, 0.03), (0.9, 0.02), (1.4, 0.03), (1.9, 0)),
            "lean": ((0.3, 0), (0.65, 6), (0.95, -12), (1.35, 2), (1.8, 0)),
            "ahead.R": ((0.4, 0), (0.72, -0.30), (0.95, 0.62), (1.4, 0.05), (1.7, 0)),
            "up.R": ((0.4, 0), (0.72, 0.24), (0.95, 0.55), (1.35, 0.12), (1.7, 0)),
            "pitch.R": ((0.4, 0), (0.72, -35), (0.95, 8), (1.35, 5), (1.7, 0)),
            "swing.L": ((0.3, 0), (0.72, -18), (0.97, 42), (1.45, 0)),
            "swing.R": ((0.3, 0), (0.72, 18), (0.97, -34), (1.45, 0)),
            "out.L": ((0.3, 0), (0.9, 24), (1.6, 0)),
            "out.R": ((0.3, 0), (0.9, 24), (1.6, 0)),
            "elbow.L": ((0.3, 0), (0.9, 30), (1.6, 0)),
            "elbow.R": ((0.3, 0), (0.9, 22), (1.6, 0)),
        }
    ),
    "sit": Gesture(
        {
            "hips_down": ((0.1, 0), (1.2, 0.42), (2.6, 0.42), (3.7, 0)),
            "hips_back": ((0.1, 0), (1.1, 0.34), (2.7, 0.34), (3.6, 0)),
            "lean": ((0.1, 0), (0.7, 38), (1.4, 2), (2.4, 2), (3.0, 40), (3.7, 0)),
            "swing.L": ((0.1, 0), (0.7, 30), (1.4, 32), (2.4, 32), (3.0, 30), (3.7, 0)),
            "swing.R": ((0.1, 0), (0.7, 30), (1.4, 32), (2.4, 32), (3.0, 30), (3.7, 0)),
            "elbow.L": ((0.3, 0), (1.4, 38), (2.4, 38), (3.5, 0)),
            "elbow.R": ((0.3, 0), (1.4, 38), (2.4, 38), (3.5, 0)),
        },
        loop=(1.5, 2.3),
    ),
}
