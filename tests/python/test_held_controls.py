# SPDX-License-Identifier: MIT
"""A control that asks for motion and is held is answered with motion, whatever takes were learned."""

from __future__ import annotations

from pathlib import Path
from random import Random

import fragmotion_core as core
import numpy as np
import pytest
from conftest import BANDAI, Array, build_options
from sample_motions import write_sample

RATE = 30.0
POLICIES = ["anticipate", "svm", "greedy"]  # first the one that a build has unless told
HELD, JUMPED = 3.0, 6.0  # s; a jump that is asked for with motion comes first
SETS = {"all": 6, "five": 5, "one": 1}


def learn(files: list[Path]) -> core.Character:
    takes = [core.read_bvh(path) for path in files]
    skeleton = takes[0].skeleton
    clips = [core.Clip.from_take(take, skeleton) for take in takes]
    return core.build(
        skeleton, clips, [core.simulate_trace("explorer", 60, 1)], build_options(policies=POLICIES, classes=60)
    )


def velocities(character: core.Character, policy: str, control: Array, seconds: float) -> Array:
    """[classes,2]: right and forward, m/s, in the last third of what is shown while a control is held from each class
    on."""
    count = len(character.table)
    crowd = core.Crowd(character, count, policy=policy, lock_feet=False)
    for k in range(count):
        crowd.force(k, k)
    asked, since, gone = np.zeros((count, 4)), np.full(count, -1), np.zeros((count, 2))
    frames, last = round(seconds * RATE), round(seconds * RATE / 3)
    before = np.array(crowd.character_frames)
    while (since < frames).any():
        crowd.step_many(asked, 1 / RATE)
        now = np.array(crowd.character_frames)
        began = (since < 0) & (crowd.playing[:, 0] == np.arange(count))
        since[began], asked[began] = 0, control
        heading = (now[:, 2] + before[:, 2]) / 2
        sine, cosine = np.sin(heading), np.cos(heading)
        x, y = (now - before)[:, :2].T
        counted = (since >= frames - last) & (since < frames)
        gone += np.where(counted[:, None], np.stack([x * cosine + y * sine, y * cosine - x * sine], 1), 0)
        since[since >= 0] += 1
        before = now
    return gone * RATE / last


def dead(character: core.Character, policy: str) -> list[tuple[str, int]]:
    """The controls that ask for motion, as fast as the character goes, and the class from which each is not answered
    with half of it, within 45 degrees."""
    found = []
    for wanted in character.able(character.space.points):
        speed = np.hypot(*wanted[:2])
        if speed == 0:
            continue
        shown = velocities(character, policy, wanted, JUMPED if wanted[3] else HELD)
        along = shown @ wanted[:2] / speed
        goes = np.hypot(*shown.T)
        bad = (goes < speed / 2) | (along < np.cos(np.pi / 4) * goes)
        found += [(str(wanted.round(2)), int(k)) for k in np.flatnonzero(bad)]
    return found


def undone(character: core.Character) -> list[str]:
    """The ways to go that a player does not do as it is asked to."""
    return core.undone_controls(character.space, core.abilities(character))


@pytest.fixture(scope="module", params=["all", pytest.param("five", marks=pytest.mark.thorough), "one"])
def learned(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> core.Character:
    """A character of some of the sample's takes."""
    files = write_sample(tmp_path_factory.mktemp("takes"))
    return learn(Random(SETS[request.param]).sample(files, SETS[request.param]))


@pytest.mark.parametrize(
    "policy", [POLICIES[0], *(pytest.param(policy, marks=pytest.mark.thorough) for policy in POLICIES[1:])]
)
def test_every_control_that_asks_for_motion_is_answered_with_it(learned: core.Character, policy: str) -> None:
    assert [name for name in undone(learned) if not name.startswith("run ")] == []
    assert "run forward" not in undone(learned)
    assert dead(learned, policy) == []


@pytest.mark.thorough
def test_one_style_of_takes_answers_every_control() -> None:
    files = sorted(BANDAI.glob("dataset-1_*_active_*.bvh"))
    if not files:
        pytest.skip("no motion capture beside the project")
    character = learn(files)
    assert [dead(character, policy) for policy in POLICIES] == [[]] * len(POLICIES)


def test_what_no_class_does_is_named(tmp_path: Path) -> None:
    take = core.read_bvh(write_sample(tmp_path)[0])
    options = build_options(classes=8, mirror=False, synthesize=False, policies=["greedy"])
    clip = core.Clip.from_take(take)
    character = core.build(take.skeleton, [clip], [core.simulate_trace("explorer", 60, 1)], options)
    assert "walk forward" not in undone(character)
    assert {"walk back", "sidestep left", "run back"} <= set(undone(character))
    assert core.undone_controls(character.space, [False] * len(character.space.points))[0] == "stand"
