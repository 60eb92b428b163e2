# SPDX-License-Identifier: MIT
"""Policy files come back as they were written; damaged ones are refused."""

from __future__ import annotations

from pathlib import Path

import fragmotion_core as core
import numpy as np
import pytest


def test_policy_files_come_back_bit_for_bit(character: core.Character, tmp_path: Path) -> None:
    data = character.to_bytes()
    assert core.Character.from_bytes(data).to_bytes() == data
    character.save(tmp_path / "a.policy")
    assert (tmp_path / "a.policy").read_bytes() == data
    loaded = core.Character.load(str(tmp_path / "a.policy"))
    trace = core.simulate_trace("explorer", 10, 3)
    one, two = (core.Player(c, seed=4).run(trace, 29.97) for c in (character, loaded))
    np.testing.assert_array_equal(one.rotations, two.rotations)
    np.testing.assert_array_equal(one.root_positions, two.root_positions)


def test_damaged_policy_files_are_refused(character: core.Character, tmp_path: Path) -> None:
    data = character.to_bytes()
    for damaged, message in (
        (data[:1000], "cut short"),
        (b"X" + data[1:], "no Fragmotion"),
        (data[:500] + bytes([data[500] ^ 1]) + data[501:], "damaged"),
        (data[:8] + b"\x63" + data[9:], "version"),
        (b"", "no Fragmotion"),
    ):
        (tmp_path / "bad.policy").write_bytes(damaged)
        with pytest.raises(ValueError, match=message):
            core.Character.from_bytes(damaged)
        with pytest.raises(ValueError, match=f"bad.policy.*{message}"):
            core.Character.load(tmp_path / "bad.policy")
