# SPDX-License-Identifier: MIT
"""The classes of a character: their names, those that are left out, and those that are forced."""

from __future__ import annotations

import fragmotion_core as core
import numpy as np
import pytest
from conftest import Array


def test_classes_have_the_names_of_what_they_do(character: core.Character) -> None:
    names = character.class_names
    assert len(names) == len(set(names)) == len(character.representatives)
    still = character.space.nearest([[0, 0, 0, 0]])[0]
    for name, representative in zip(names, character.representatives):
        performed = character.space.nearest(character.evident[[representative]])[0]
        assert name.startswith("stand") == (performed == still), name


def test_excluded_classes_are_not_played(character: core.Character, traces: list[Array]) -> None:
    often = [int(k) for k in np.argsort(np.bincount(character.table.ravel()))[-4:]]
    left = character.without(often)
    assert np.isin(character.table, often).any() and not np.isin(left.table, often).any()
    assert not left.match[often].any() and (left.evident == character.evident).all()
    assert not np.isin(core.Player(left).run(traces[0], 30).classes, often).any()
    with pytest.raises(ValueError, match="class 30 does not exist"):
        character.without([30])
    with pytest.raises(ValueError, match="all classes are excluded"):
        character.without(range(30))


def test_a_forced_class_plays(character: core.Character) -> None:
    excluded = int(character.table[0, 0])
    player = core.Player(character.without([excluded]))
    player.force(excluded)
    player.step([0, 1.2, 0, 0], 0.01)
    assert player.playing[0] == excluded
    player.step([0, 1.2, 0, 0], 1.0)
    assert player.playing[0] != excluded
    with pytest.raises(ValueError, match="class -1 does not exist"):
        player.force(-1)
