# SPDX-License-Identifier: MIT
"""No figure of the sample's takes may get worse than tests/quality/baseline.json allows; and what keeps that gate."""

from __future__ import annotations

import json

import numpy as np
import pytest
from fragmotion_command.evaluate.likeness.reenacting import OF_THE_TAKES
from fragmotion_command.evaluate.measures import weight
from test_sample_takes import gait, takes

from tools.measuring.quality import gate
from tools.measuring.quality.__main__ import lowering
from tools.measuring.quality.gate import WORSE, Change, Spread
from tools.measuring.quality.measured import measure_now
from tools.measuring.quality.sample import sample_recordings
from tools.measuring.tuning import objective
from tools.shell import Failure


@pytest.mark.thorough
def test_no_figure_is_worse_than_the_baseline_allows() -> None:
    before, _ = gate.read_baseline(gate.BASELINE.read_text())
    failing = [change for change in gate.changes(before, measure_now()) if change.fails]
    assert not failing, (
        f"worse than {gate.BASELINE.name} allows:\n{gate.table(failing)}\n"
        'where that is on purpose: python3 -m tools.measuring.quality --write "why"'
    )


def test_the_baseline_has_every_figure_and_says_why_a_bar_was_lowered() -> None:
    text = gate.BASELINE.read_text()
    before, lowered = gate.read_baseline(text)
    assert set(before) == set(WORSE)
    assert gate.written(before, lowered) == text, "written by the command alone"
    assert all(row["figure"] in WORSE and row["why"].strip() for row in lowered)


def test_worse_is_more_or_less_or_further_away() -> None:
    def fails(name: str, mean: float, spread: float, now: float) -> bool:
        return Change(name, Spread(mean, spread), Spread(now, 0)).fails

    assert WORSE["frechet"] == gate.LESS and WORSE["successors"] == gate.MORE and WORSE["ball_under"] == 0.0
    assert fails("frechet", 0.3, 0.1, 0.41) and not fails("frechet", 0.3, 0.1, 0.39)
    assert not fails("frechet", 0.3, 0.1, 0.05)
    assert fails("successors", 0.5, 0.1, 0.39) and not fails("successors", 0.5, 0.1, 0.41)
    assert not fails("successors", 0.5, 0.1, 0.9)
    assert fails("ball_under", -3, 1, -4.1) and fails("ball_under", -3, 1, 4.1) and not fails("ball_under", -3, 1, 3.9)
    assert not fails("response_p50_s", 0.5, 0, 0.516) and fails("response_p50_s", 0.5, 0, 0.517), "a frame"
    assert not fails("whips", 0, 0, 0.2) and fails("whips", 0, 0, 0.21), "one in five minutes"
    assert not fails("left_right", 1, 0, 1.033) and fails("left_right", 1, 0, 1.034), "a frame of a step"


@pytest.mark.parametrize("name", [name for name, better in WORSE.items() if better == gate.LIKE])
def test_a_ratio_over_the_takes_is_the_worse_the_further_it_is_from_1(name: str) -> None:
    def change(mean: float, now: float) -> Change:
        return Change(name, Spread(mean, 0.1), Spread(now, 0.1))

    assert change(0.8, 0.71).fails and not change(0.8, 0.72).fails, "1 / 1.125 of it"
    assert change(1.25, 1.36).fails and not change(1.25, 1.34).fails
    assert change(0.8, 1.42).fails and not change(0.8, 1.4).fails, "as far above 1 as below"
    assert change(0.96, 0.85).fails and change(0.96, 0.85).worse > 0 > change(0.85, 0.96).worse
    assert change(0.8, 1).worse == pytest.approx(change(1.25, 1).worse) == pytest.approx(-np.log(1.25))
    assert change(0.8, 0).fails


def test_whoever_judges_takes_the_same_figures_for_best_at_1() -> None:
    likes = {name for name, better in WORSE.items() if better == gate.LIKE}
    assert likes >= {*OF_THE_TAKES, *weight.RATIOS, *objective.AT_ONE}
    assert not likes & objective.AT_MOST.keys()


def test_a_spread_is_of_all_seeds() -> None:
    assert Spread.of([1.0, 4.0, 2.0, 3.0]) == (2.5, 3.0)


def test_a_table_marks_what_fails() -> None:
    lines = gate.table(
        [Change("auc", Spread(0.7, 0.1), Spread(0.9, 0)), Change("sway", Spread(0.7, 0.1), Spread(0.9, 0))]
    ).splitlines()
    assert lines[0].split() == ["figure", "baseline", "spread", "now", "worse", "by"]
    assert lines[1].split() == ["!", "auc", "0.7", "0.1", "0.9", "0.2"]
    assert lines[2].split() == ["sway", "0.7", "0.1", "0.9", "-0.2513"]


def test_a_bar_that_holds_is_not_lowered() -> None:
    before = Spread(1.0, 0.1)
    within, beyond, better = (Change("auc", before, now) for now in (Spread(1.05, 0.2), Spread(1.2, 0), Spread(0.9, 0)))
    assert within.kept.now == before
    assert beyond.kept == beyond
    assert better.kept == better


def test_a_bar_is_lowered_only_with_a_reason() -> None:
    better = [Change("auc", Spread(0.9, 0.1), Spread(0.7, 0.1))]
    assert lowering(better, "") == []
    worse = [*better, Change("auc", Spread(0.7, 0.1), Spread(0.7, 0.2)), Change("sway", Spread(1, 0.1), Spread(0.8, 0))]
    with pytest.raises(Failure, match="lowers the bar of auc, sway: say why"):
        lowering(worse, "")
    assert lowering(worse, "as a test") == [
        {"figure": "auc", "from": 0.8, "to": 0.9, "why": "as a test"},
        {"figure": "sway", "from": 0.0953102, "to": 0.223144, "why": "as a test"},
    ]


def test_what_is_written_is_read_again() -> None:
    now = {name: Spread(1 / 3, i) for i, name in enumerate(WORSE)}
    rows = [{"figure": "auc", "from": 0.8, "to": 0.9, "why": 'a "reason"'}]
    text = gate.written(now, rows)
    assert json.loads(text)["about"] and len(text.splitlines()) == len(WORSE) + 8
    read, lowered = gate.read_baseline(text)
    assert lowered == rows
    assert all(read[name] == pytest.approx(spread, rel=1e-5) for name, spread in now.items())


def test_the_samples_takes_are_what_its_makers_make() -> None:
    skeleton, clips = sample_recordings()
    usual = {take.name: take for take in takes.all_takes() if not take.manner}
    assert [clip.name for clip in clips] == list(usual)
    assert skeleton.roles["left_toe"] == "toe.L" and skeleton.roles["hips"] == "hips"
    for clip in clips[::10]:
        motion = gait.synthesize(usual[clip.name])
        heads, rotations = clip.world_transforms(skeleton)
        for name in ("hips", "head", "hand.L", "toe.R"):
            bone = skeleton.names.index(name)
            w, x, y, z = np.moveaxis(rotations[:, bone], -1, 0)
            up = np.stack([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)], 1)
            np.testing.assert_allclose(up, motion.world[name][:, :, 2], atol=1e-9)
        np.testing.assert_allclose(heads[:, skeleton.names.index("hips")], motion.hips, atol=1e-9)
