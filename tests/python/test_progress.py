# SPDX-License-Identifier: MIT
"""What a long call tells of its progress, and how it is cancelled."""

from __future__ import annotations

import fragmotion_core as core
import numpy as np
import pytest
from conftest import Array, small_build


def test_progress_tells_growing_fractions_and_stages(
    skeleton: core.Skeleton, clips: list[core.Clip], traces: list[Array]
) -> None:
    told: list[tuple[float, str]] = []

    def tell(fraction: float, stage: str) -> bool:
        told.append((fraction, stage))
        return True

    small_build(skeleton, clips, traces, tell)
    fractions = [fraction for fraction, _ in told]
    assert fractions == sorted(fractions) and len(set(fractions)) > 5
    assert fractions[0] >= 0 and fractions[-1] == 1
    assert len({stage for _, stage in told}) >= 4 and all(stage for _, stage in told)


def test_progress_goes_on_where_nothing_is_returned(
    skeleton: core.Skeleton, clips: list[core.Clip], traces: list[Array], character: core.Character
) -> None:
    told: list[float] = []
    small_build(skeleton, clips, traces, lambda fraction, _: told.append(fraction))
    assert told[-1] == 1
    core.Player(character).run(np.zeros((60, 4)), 60, lambda *_: None)


@pytest.mark.parametrize("calls", [1, 3, 6])
def test_progress_cancels(skeleton: core.Skeleton, clips: list[core.Clip], traces: list[Array], calls: int) -> None:
    left = iter(range(calls - 1, -1, -1))
    with pytest.raises(core.Cancelled):
        small_build(skeleton, clips, traces, lambda *_: next(left) > 0)
    assert next(left, None) is None
    assert issubclass(core.Cancelled, RuntimeError)


def test_player_is_cancelled(character: core.Character) -> None:
    with pytest.raises(core.Cancelled):
        core.Player(character).run(np.zeros((600, 4)), 60, lambda fraction, _: fraction < 0.5)


def test_what_the_callback_raises_comes_through(
    skeleton: core.Skeleton, clips: list[core.Clip], traces: list[Array], character: core.Character
) -> None:
    class Odd(Exception):
        pass

    def fail(*_: object) -> bool:
        raise Odd("as it was")

    with pytest.raises(Odd, match="as it was"):
        small_build(skeleton, clips, traces, fail)
    with pytest.raises(Odd, match="as it was"):
        core.Player(character).run(np.zeros((60, 4)), 60, fail)
    with pytest.raises(Odd, match="as it was"):
        core.cluster(np.random.default_rng(1).random((20, 2, 3)), 3, progress=fail)


def test_progress_must_return_a_truth(skeleton: core.Skeleton, clips: list[core.Clip], traces: list[Array]) -> None:
    with pytest.raises((RuntimeError, TypeError, ValueError)):
        small_build(skeleton, clips, traces, lambda *_: "yes")  # type: ignore[arg-type]
