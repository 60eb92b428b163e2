# SPDX-License-Identifier: MIT
"""What `dev.py directing` says of pins."""

from __future__ import annotations

import sys
from pathlib import Path

import fragmotion_core as core
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from tools.measuring.directing.measures.pins import pins


@pytest.mark.thorough
def test_figures_of_pins_are_what_was_left(character: core.Character, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tools.measuring.directing.measures.pins._PLAYERS", ("explorer",))
    figures, again = pins(character), pins(character)
    assert {tuple(figure) for figure in figures} == {("asked_m", "left_m", "left_degrees", "tries", "seconds")}
    for one, other in zip(figures, again, strict=True):
        assert {**one, "seconds": 0} == {**other, "seconds": 0}
        assert one["tries"] == 1 or one["left_m"] < one["asked_m"] + 0.02
    assert {figure["asked_m"] for figure in figures} == {0.1, 0.3, 0.6}
