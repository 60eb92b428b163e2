# SPDX-License-Identifier: MIT
"""Takes of bodies of several proportions in one folder: on the first one's body, their feet stand where its own do."""

from __future__ import annotations

import fragmotion_core as core
import numpy as np
import pytest
from fragmotion_command.takes import FileTake, on_one_body
from sample_motions import write_sample


@pytest.fixture(scope="module")
def takes(tmp_path_factory: pytest.TempPathFactory) -> list[FileTake]:
    """Two walks of a body, and between them one of a body that is a tenth taller."""
    paths = write_sample(tmp_path_factory.mktemp("takes"))[:3]
    return [FileTake(path, core.read_bvh(path, unit)) for path, unit in zip(paths, (0.01, 0.011, 0.01))]


def lowest(clip: core.Clip, skeleton: core.Skeleton) -> float:
    """How low a foot gets, m."""
    heads, _ = clip.world_transforms(skeleton)
    feet = [skeleton.names.index(skeleton.roles[role]) for role in ("left_foot", "right_foot")]
    return float(heads[:, feet, 2].min())


def test_feet_of_other_bodies_stand(takes: list[FileTake], capsys: pytest.CaptureFixture[str]) -> None:
    skeleton, clips = on_one_body(takes)
    assert [clip.name for clip in clips] == [each.take.name for each in takes]
    assert np.array_equal(skeleton.offsets, takes[0].take.skeleton.offsets)
    own = lowest(clips[0], skeleton)
    assert lowest(core.Clip.from_take(takes[1].take, skeleton), skeleton) > own + 0.05
    assert lowest(clips[1], skeleton) == pytest.approx(own, abs=0.01)
    for index in (0, 2):
        as_it_is = core.Clip.from_take(takes[index].take, skeleton)
        assert np.array_equal(clips[index].root_positions, as_it_is.root_positions)
    said = capsys.readouterr().err
    assert f"{takes[1].path.name}: of a body of other proportions, " in said and takes[2].path.name not in said


def test_takes_that_cannot_be_brought_over_are_kept_and_said(
    takes: list[FileTake], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def refuse(*_: object) -> None:
        raise ValueError("it has no legs")

    monkeypatch.setattr(core, "Retarget", refuse)
    skeleton, clips = on_one_body(takes)
    as_it_is = core.Clip.from_take(takes[1].take, skeleton)
    assert np.array_equal(clips[1].root_positions, as_it_is.root_positions)
    assert "so that feet may float or sink: it has no legs" in capsys.readouterr().err
