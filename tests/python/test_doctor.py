# SPDX-License-Identifier: MIT
"""The import doctor on real motion capture: silent where nothing is wrong, and sure of what was damaged on purpose."""

from __future__ import annotations

import itertools
import os
from collections.abc import Callable
from pathlib import Path

import fragmotion_core as core
import numpy as np
import pytest
from bodies import times
from conftest import BANDAI, CMU, Array

# Bandai's takes of walking turns that begin or end in each other: their rotations are the same bits.
SHARED = {
    "left_normal_027": "left_normal_031",
    "left_normal_032": "left_normal_028",
    "left_normal_033": "left_normal_029",
    "left_normal_034": "left_normal_030",
    "right_normal_028": "right_normal_032",
    "right_normal_033": "right_normal_029",
    "right_normal_034": "right_normal_030",
    "right_normal_035": "right_normal_031",
}
WALK = "dataset-2_walk_normal_001"


@pytest.fixture(scope="module")
def takes() -> list[core.Take]:
    files = sorted(BANDAI.glob("*.bvh"))
    if not files:
        pytest.skip("no motion capture beside the project")
    return [core.read_bvh(path) for path in files]


@pytest.fixture(scope="module")
def walk(takes: list[core.Take]) -> core.Take:
    return next(take for take in takes if take.name == WALK)


def remade(
    take: core.Take, translations: Array | None = None, rotations: Array | None = None, rate: float | None = None
) -> core.Take:
    """The take with other numbers."""
    return core.Take(
        take.skeleton,
        take.name,
        rate or take.rate,
        take.translations if translations is None else translations,
        take.rotations if rotations is None else rotations,
        take.unit,
    )


def scaled(take: core.Take, scale: float) -> core.Take:
    old = take.skeleton
    skeleton = core.Skeleton(
        old.names, old.parents, old.rest_rotations, scale * old.offsets, scale * old.tips, old.roles
    )
    return core.Take(skeleton, take.name, take.rate, scale * take.translations, take.rotations, scale * take.unit)


def with_axes(take: core.Take, axes: Array) -> core.Take:
    """The take as a reader gives it that takes other axes: a permutation of them, with signs."""
    sign = np.linalg.det(axes)

    def turned(rotations: Array) -> Array:
        return np.concatenate([rotations[..., :1], sign * rotations[..., 1:] @ axes.T], -1)

    old = take.skeleton
    skeleton = core.Skeleton(
        old.names, old.parents, turned(old.rest_rotations), old.offsets @ axes.T, old.tips @ axes.T, old.roles
    )
    return core.Take(skeleton, take.name, take.rate, take.translations @ axes.T, turned(take.rotations), take.unit)


def findings_of(take: core.Take) -> list[core.Finding]:
    return core.examine([take])[0].findings


def assert_mended(damaged: core.Take, code: str, frames: tuple[int, int], clean: core.Take, tolerance: float) -> None:
    """Exactly one finding, of these frames; mended it is gone, and every joint is where it was, within m."""
    findings = findings_of(damaged)
    assert [(f.code, f.frames) for f in findings] == [(code, frames)]
    mended = core.mend(damaged, findings)
    assert findings_of(mended) == []
    ours, theirs = mended.world_transforms()[0], clean.world_transforms()[0]
    assert ours.shape == theirs.shape
    assert np.abs(ours - theirs).max() < tolerance


def test_clean_takes_stay_clean(takes: list[core.Take]) -> None:
    told = core.examine(takes)
    assert {(e.up, e.facing, e.rest_pose, e.root_motion, e.scale) for e in told} == {("+Z", "", "other", True, 1.0)}
    found = {take.name: [f.code for f in e.findings] for take, e in zip(takes, told) if e.findings}
    assert found == {f"dataset-2_walk-turn-{name}": ["duplicate"] for name in SHARED}
    for take, examination in zip(takes, told):
        mended = core.mend(take, examination.findings)
        np.testing.assert_array_equal(mended.translations, take.translations)
        np.testing.assert_array_equal(mended.rotations, take.rotations)


def test_duplicates_are_true(takes: list[core.Take]) -> None:
    """By brute force over all lags: most of the shorter take's local rotations are the other one's."""
    named = {take.name.removeprefix("dataset-2_walk-turn-"): take for take in takes}
    examinations = core.examine(takes)
    for shorter, longer in SHARED.items():
        told = examinations[takes.index(named[shorter])].findings[0].other
        assert told is not None and takes[told].name == named[longer].name
        a, b = named[shorter].rotations[:, 2:], named[longer].rotations[:, 2:]
        equal = [
            (a[max(0, -lag) : len(b) - lag] == b[max(0, lag) : len(a) + lag]).all(axis=(1, 2)).sum()
            for lag in range(10 - len(a), len(b) - 10)
        ]
        assert max(equal) >= 0.6 * len(a)


def test_cmu_takes_tell_what_is_true_of_them() -> None:
    if not CMU.is_dir():
        pytest.skip("no motion capture beside the project")
    amc = {path.stem: core.read_asf_amc(CMU / f"{path.stem[:2]}.asf", path) for path in sorted(CMU.glob("*.amc"))}
    codes = {name: [f.code for f in findings_of(take)] for name, take in amc.items()}
    # The studio's floor rises by a degree, by 8 cm along 02_02: Build puts that level.
    assert codes == {"01_01": [], "02_01": [], "02_02": [], "02_03": [], "02_04": []}
    bvh = core.read_bvh(CMU / "01_01.bvh")
    told = core.examine([bvh])[0]
    assert [f.code for f in told.findings] == ["unit", "calibration"]
    assert told.scale * bvh.unit == pytest.approx(0.0254 / 0.45)
    assert findings_of(core.mend(bvh, told.findings)) == []


@pytest.mark.parametrize("scale", [100, 0.01, 10, 0.001, 0.01 / 0.0254])
def test_units_are_put_right(walk: core.Take, scale: float) -> None:
    damaged = scaled(walk, scale)
    if scale != 100:  # what a reader takes for the unit is known
        damaged = core.Take(damaged.skeleton, walk.name, walk.rate, damaged.translations, damaged.rotations, 0.01)
    assert_mended(damaged, "unit", (0, len(walk.rotations) - 1), walk, 1e-6)


@pytest.mark.parametrize(
    "name", ["dataset-2_walk_normal_001", "dataset-2_run_normal_003", "dataset-1_walk-left_normal_001"]
)
def test_all_48_readings_of_the_axes_are_put_right(takes: list[core.Take], name: str) -> None:
    """Any axis up, turned and mirrored: heights above the ground and distances are the clean take's again."""
    clean = next(take for take in takes if take.name == name)
    bones = [clean.skeleton.names.index(bone) for bone in ("Hips", "Head", "Hand_L", "Toes_R")]
    joints = clean.world_transforms()[0][:, bones]
    for order, signs in itertools.product(itertools.permutations(range(3)), itertools.product((1, -1), repeat=3)):
        axes = np.eye(3)[list(order)] * signs
        damaged = with_axes(clean, axes)
        findings = findings_of(damaged)
        wrong_up, mirrored = int(axes[2, 2] != 1), int(np.linalg.det(axes) < 0)
        assert [f.code for f in findings] == ["up"] * wrong_up + ["mirrored"] * mirrored
        mended = core.mend(damaged, [f for f in findings if f.safe])
        assert findings_of(mended) == []
        ours = mended.world_transforms()[0][:, bones]
        np.testing.assert_allclose(ours[..., 2], joints[..., 2], atol=1e-9)
        for frame in (0, len(joints) // 2):
            np.testing.assert_allclose(volume(ours[frame]), volume(joints[frame]), atol=1e-9)


def test_what_is_wrong_all_at_once_is_put_right(walk: core.Take) -> None:
    translations = walk.translations.copy()
    translations[:, 0, 2] -= 0.1
    translations[150, 0] += 0.7
    translations[70, 5] = np.nan
    damaged = scaled(with_axes(remade(walk, translations), np.eye(3)[[0, 2, 1]] * [1, -1, 1]), 100)
    findings = findings_of(damaged)
    assert [(f.code, f.safe) for f in findings] == [(c, True) for c in ("missing", "unit", "up", "spike", "ground")]
    mended = core.mend(damaged, findings)
    assert findings_of(mended) == []
    np.testing.assert_allclose(mended.world_transforms()[0], walk.world_transforms()[0], atol=0.05)


def volume(points: Array) -> float:
    """Of the tetrahedron, with a sign that a mirror changes."""
    return float(np.linalg.det(points[1:] - points[0]))


def frozen(array: Array) -> Array:
    array[60:62] = array[59]
    return array


def cut(array: Array) -> Array:
    return np.delete(array, 60, 0)


@pytest.mark.parametrize(
    ("damage", "code", "frames", "tolerance"), [(frozen, "frozen", (60, 61), 0.05), (cut, "dropped", (59, 60), 0.05)]
)
def test_time_is_put_right(
    walk: core.Take, damage: Callable[[Array], Array], code: str, frames: tuple[int, int], tolerance: float
) -> None:
    damaged = remade(walk, damage(walk.translations.copy()), damage(walk.rotations.copy()))
    assert_mended(damaged, code, frames, walk, tolerance)


def test_doubled_frames_are_left_out(walk: core.Take) -> None:
    twice = remade(walk, walk.translations.repeat(2, 0), walk.rotations.repeat(2, 0), 2 * walk.rate)
    assert_mended(twice, "doubled", (0, 2 * len(walk.rotations) - 1), walk, 1e-12)


@pytest.mark.parametrize("axis", [1, 2, 3])
def test_flips_are_turned_back(walk: core.Take, axis: int) -> None:
    """About an axis of the bone's own: the product of quaternions by hand."""
    rotations = walk.rotations.copy()
    bone = walk.skeleton.names.index("LowerLeg_L")
    half_turn = np.eye(4)[axis]
    w, v, u = rotations[80, bone, 0], rotations[80, bone, 1:], half_turn[1:]
    rotations[80, bone] = np.concatenate([[-v @ u], w * u + np.cross(v, u)])
    assert_mended(remade(walk, rotations=rotations), "flip", (80, 80), walk, 0.05)


def test_spikes_and_missing_numbers_are_filled(walk: core.Take) -> None:
    translations = walk.translations.copy()
    translations[90:92, 0, 0] += 0.6
    assert_mended(remade(walk, translations), "spike", (90, 91), walk, 0.05)
    translations = walk.translations.copy()
    translations[90:92, 3] = np.nan
    assert_mended(remade(walk, translations), "missing", (90, 91), walk, 0.05)


def test_feet_stand_on_toes_that_no_name_tells(walk: core.Take) -> None:
    """As in files whose toes are called thumbs, and whose feet end anywhere."""
    old = walk.skeleton
    toes = {bone: f"thumb {side}" for side in ("left", "right") for bone in [old.role_map()[f"{side}_toe"][0]]}
    tips = np.array(old.tips)
    for side in ("left", "right"):
        tips[old.names.index(old.roles[f"{side}_foot"])] = [0, 0.01, 0]
    names = [toes.get(name, name) for name in old.names]
    skeleton = core.Skeleton(names, old.parents, old.rest_rotations, old.offsets, tips)
    take = core.Take(skeleton, walk.name, walk.rate, walk.translations, walk.rotations)
    assert "left_toe" not in skeleton.role_map()
    assert [f.text for f in core.examine([take])[0].findings if f.code == "ground"] == []


@pytest.mark.parametrize("height", [-0.08, 0.2])
def test_feet_are_put_on_the_ground(walk: core.Take, height: float) -> None:
    translations = walk.translations.copy()
    translations[:, 0, 2] += height
    assert_mended(remade(walk, translations), "ground", (0, len(walk.rotations) - 1), walk, 0.05)


def test_all_47_other_axes_of_the_root_are_told(takes: list[core.Take]) -> None:
    """Of a walk in a curve; in one straight ahead, the way to the side hardly matters."""
    walk = next(take for take in takes if take.name == "dataset-2_walk-turn-left_normal_003")
    hips = walk.skeleton.names.index(walk.skeleton.roles["hips"])
    way = walk.translations[:, hips] - walk.translations[0, hips]
    for order in itertools.permutations(range(3)):
        for signs in itertools.product((1, -1), repeat=3):
            as_written = {f"+{'XYZ'[o]} as {'-+'[signs[i] > 0]}{'XYZ'[i]}" for i, o in enumerate(order)}
            translations = walk.translations.copy()
            translations[:, hips] += (way[:, order] * signs) - way
            texts = [f.text for f in findings_of(remade(walk, translations)) if f.code == "axes"]
            told = {pair for text in texts for pair in text.split("(")[1].split(")")[0].split(", ")}
            assert told == as_written - {f"+{axis} as +{axis}" for axis in "XYZ"}


@pytest.mark.parametrize("speed", [0.3, 0.45, 1.0])
def test_a_drift_of_standing_feet_is_told(takes: list[core.Take], speed: float) -> None:
    """Across the way of walks that go far; one along it may leave them on the spot."""
    for take in [take for take in takes if "dataset-2_walk_normal" in take.name]:
        translations = take.translations.copy()
        translations[:, 0, 0] += speed * np.arange(len(translations)) / take.rate
        texts = [finding.text for finding in findings_of(remade(take, translations)) if finding.code == "drift"]
        assert len(texts) == 1, take.name
        assert float(texts[0].split(" m/s")[0].split()[-1]) == pytest.approx(speed, abs=0.1)


@pytest.mark.parametrize("degrees", [2, 4])
def test_noise_is_told(takes: list[core.Take], degrees: float) -> None:
    random = np.random.default_rng(1)
    for take in [take for take in takes if len(take.rotations) >= 30][::10]:
        turn = np.radians(degrees) / np.sqrt(3) / 2 * random.normal(size=(*take.rotations.shape[:2], 3))
        noise = np.concatenate([np.ones_like(turn[..., :1]), turn], -1)
        noise /= np.linalg.norm(noise, axis=-1, keepdims=True)
        noisy = remade(take, rotations=times(take.rotations, noise))
        assert "noise" in [finding.code for finding in findings_of(noisy)], take.name


@pytest.mark.parametrize("rate", [24, 30, 60, 240])
def test_a_jump_tells_the_true_rate(rate: float) -> None:
    if not (CMU / "02_04.amc").exists():
        pytest.skip("no motion capture beside the project")
    jump = core.read_asf_amc(CMU / "02.asf", CMU / "02_04.amc")
    assert jump.rate == 120 and findings_of(jump) == []
    (told,) = (finding for finding in findings_of(remade(jump, rate=rate)) if finding.code == "rate")
    assert float(told.text.split("some ")[1].split()[0]) == pytest.approx(120, rel=0.05)


@pytest.mark.parametrize("count", [1, 30])
@pytest.mark.parametrize("at_start", [True, False])
def test_a_rest_pose_is_cut_off(walk: core.Take, count: int, at_start: bool) -> None:
    """In Bandai's, bones lie along the axes: no pose of a body."""
    pose = walk.translations[:1].copy()
    pose[:, :2] = walk.translations[0 if at_start else -1, :2]
    rest = np.tile([1.0, 0, 0, 0], (count, len(walk.skeleton.names), 1))
    poses = pose.repeat(count, 0)
    order = (lambda a, b: np.concatenate([a, b])) if at_start else (lambda a, b: np.concatenate([b, a]))
    damaged = remade(walk, order(poses, walk.translations), order(rest, walk.rotations))
    begin = 0 if at_start else len(walk.rotations)
    assert_mended(damaged, "calibration", (begin, begin + count - 1), walk, 1e-12)


@pytest.mark.parametrize("rate", [30.0, 60.0])
def test_copies_are_found(takes: list[core.Take], walk: core.Take, rate: float) -> None:
    """Cut, turned, moved, and resampled to another rate."""
    frames = np.arange(20, 120, 30 / rate)
    whole = np.minimum(frames.astype(int), 118)
    share = (frames - whole)[:, None, None]
    translations = walk.translations[whole] * (1 - share) + walk.translations[whole + 1] * share
    a, b = walk.rotations[whole], walk.rotations[whole + 1]
    b = b * np.sign((a * b).sum(-1, keepdims=True))
    rotations = a * (1 - share) + b * share
    translations[:, 0] += [3, -2, 0]
    copy = core.Take(walk.skeleton, "copy", rate, translations, rotations, walk.unit)
    others = [take for take in takes if "_walk_" in take.name]
    told = core.examine([copy, *others])
    assert [(f.code, others[(f.other or 0) - 1].name) for f in told[0].findings] == [("duplicate", WALK)]
    assert not any(e.findings for e in told[1:])


def test_any_number_of_threads_says_the_same(takes: list[core.Take]) -> None:
    one, two = ([[f.text for f in e.findings] for e in core.examine(takes, threads)] for threads in (1, 3))
    assert one == two


@pytest.mark.thorough
@pytest.mark.skipif(os.name == "nt", reason="Windows tells in no file how much memory is used")
@pytest.mark.parametrize("fault", ["none", "flips and feet"])
def test_a_long_take_is_not_copied(walk: core.Take, fault: str) -> None:
    frames, there_and_back = 100_000, [*range(len(walk.rotations)), *range(len(walk.rotations) - 2, 0, -1)]
    order = np.resize(there_and_back, frames)
    translations, rotations = walk.translations[order], walk.rotations[order]
    if fault != "none":
        translations[:, 0, 2] += 0.3
        rotations[500::1000, 5] = (0, 1, 0, 0)
    take = remade(walk, translations, rotations)
    used = resident()
    most = 0

    def watch(_fraction: float, _stage: str) -> None:
        nonlocal most
        most = max(most, resident() - used)

    codes = {finding.code for finding in core.examine([take], 1, watch)[0].findings}
    assert codes == (set() if fault == "none" else {"flip", "ground"})
    assert most < 0.5 * (translations.nbytes + rotations.nbytes)


def resident() -> int:
    """Bytes of memory that the process uses."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def test_an_examination_is_stopped(walk: core.Take) -> None:
    with pytest.raises(core.Cancelled):
        core.examine([walk], progress=lambda _fraction, _stage: False)
    with pytest.raises(core.Cancelled):
        core.mend(walk, findings_of(walk), progress=lambda _fraction, _stage: False)

    def interrupted(_fraction: float, _stage: str) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        core.examine([walk], progress=interrupted)


def test_takes_need_their_shapes(walk: core.Take) -> None:
    with pytest.raises(ValueError, match="rotations"):
        remade(walk, walk.translations[:5])
    with pytest.raises(ValueError, match="no frames"):
        remade(walk, walk.translations[:0], walk.rotations[:0])
    with pytest.raises(ValueError, match="rate"):
        remade(walk, rate=-1)
