# SPDX-License-Identifier: MIT
"""How the sample character carries itself in each of its styles: what differs from its usual gait."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Manner:
    """Speeds as a part of the usual ones; each gait parameter (footsteps.STYLE) times a factor, and more by so much;
    degrees by which the chest is further forward than the hips, the head further down and the arms further out."""

    pace: float = 1.0
    gait: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    hunch: float = 0.0
    nod: float = 0.0
    out: float = 0.0

    def changed(self, name: str) -> tuple[float, float]:
        """The factor of a gait parameter, and what is added to it."""
        return self.gait.get(name, (1.0, 0.0))


MANNERS: Mapping[str, Manner] = {
    "": Manner(),
    "tired": Manner(
        pace=0.75,
        gait={
            "period": (1.2, 0.0),
            "duty": (1.05, 0.0),
            "clearance": (0.55, 0.0),
            "strike": (0.6, 0.0),
            "push": (0.8, 0.0),
            "bob": (0.6, 0.0),
            "drop": (1.0, 0.02),
            "sway": (1.6, 0.0),
            "chest_yaw": (0.5, 0.0),
            "lean": (1.0, 4.0),
            "arm_swing": (0.45, 0.0),
            "arm_back": (0.5, 24.0),
            "elbow": (0.6, 0.0),
        },
        hunch=20.0,
        nod=24.0,
    ),
    "proud": Manner(
        gait={
            "clearance": (1.3, 0.0),
            "bob": (1.3, 0.0),
            "pelvis_yaw": (1.2, 0.0),
            "chest_yaw": (1.3, 0.0),
            "lean": (0.7, -2.0),
            "arm_swing": (1.35, 0.0),
            "arm_back": (1.0, -8.0),
            "elbow": (1.0, 8.0),
        },
        hunch=-9.0,
        nod=-8.0,
        out=7.0,
    ),
}
