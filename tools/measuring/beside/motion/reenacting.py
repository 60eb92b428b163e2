# SPDX-License-Identifier: MIT
"""How like the takes each system looks that knows half of them and re-enacts the others, as `evaluate` tells of one."""

from __future__ import annotations

from typing import Any

from fragmotion_command.evaluate.likeness.reenacting import Figures, Likeness
from fragmotion_command.evaluate.loading import Recordings

from tools.measuring.beside.comparing import every_system
from tools.measuring.beside.setting import CLASSES, SECONDS, make_setting
from tools.measuring.peers.motion_matching.constants import Constants
from tools.shell import say

FIGURES = ("frechet", "nearest", "auc", "head_jerk", "ball_travel", "ball_under", "stances", "sway", "ripple", "whips")


def add_likeness(
    result: dict[str, Any],
    recordings: Recordings,
    tuned: Constants,
    seed: int,
    seconds: float = SECONDS,
    classes: int = CLASSES,
) -> None:
    """To a comparison's figures; says why where the takes cannot be halved."""
    say("likeness: re-enacting half of the takes")
    try:
        likeness = Likeness(recordings)
        setting = make_setting(likeness.seen, seed, seconds, classes)
    except ValueError as failure:
        say(f"likeness to unseen takes: not measured: {failure}")
        return
    traces = likeness.traces(setting.space)
    result["takes"].update(_known(likeness.takes))
    for name, make in every_system(setting, tuned).items():
        shown = make().play(traces, range(seed, seed + len(traces)))
        clips = [setting.body.clip(each.motion) for each in shown]
        result["systems"][name].update(_known(likeness.of(clips)))


def _known(figures: Figures) -> dict[str, float]:
    """Those of FIGURES that are numbers."""
    return {name: figure for name in FIGURES if (figure := figures[name]) is not None}
