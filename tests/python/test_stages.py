# SPDX-License-Identifier: MIT
"""The stages of a build against NumPy, scikit-learn and plain counting."""

from __future__ import annotations

import itertools
from typing import Any

import fragmotion_core as core
import numpy as np
import pytest
from conftest import Array
from sklearn.cluster import KMeans
from sklearn.svm import SVC

POINTS = 102


def dis(a: Array, b: Array) -> Any:
    """Dis (Sec. 3.1) of points [..., K, 3]: the sum of Euclidean distances."""
    return np.linalg.norm(a.astype(float) - b.astype(float), axis=-1).sum(-1)


def random_factors(random: np.random.Generator, classes: int) -> tuple[Array, Array]:
    """Factors of Eq. 2 in (0, 1]."""
    return 1 / (1 + 3 * random.random((classes, classes))), 1 / (1 + 3 * random.random((classes, POINTS)))


def random_trace(random: np.random.Generator, steps: int, different: int = 12) -> Array:
    return random.choice(random.choice(POINTS, different, replace=False), steps).astype(np.int32)


# --- Dis and quality -------------------------------------------------------------------------------------------------


def test_trajectories_begin_and_end_with_the_end_poses(character: core.Character) -> None:
    walks = character.evident[:, 3] == 0  # a jump is played with the crouch before it and the landing after it
    assert len(walks) == len(character.labels) and not walks.all()
    whole, first, last = (poses[walks] for poses in core.trajectories(character, 5))
    count, tips = first.shape[:2]
    assert whole.shape == (count, 5 * tips, 3) and last.shape == first.shape == (count, tips, 3)
    assert count == walks.sum()
    poses = whole.reshape(count, 5, tips, 3)
    # Trajectories are kept in 16 bits: half a unit off, the least power of two by which a fragment's coordinates fit.
    off = 2.0 ** np.ceil(np.log2(np.abs(whole).max((1, 2)) / 32767))[:, None, None] / 2
    assert (np.abs(poses[:, 0] - first) <= off + 1e-6).all()
    # The last pose in its own character frame is the trajectory's last one moved and turned on the ground.
    assert (np.abs(poses[:, -1, :, 2] - last[:, :, 2]) <= off[:, 0] + 1e-5).all()
    one, other = (np.linalg.norm(p[:, :, None] - p[:, None], axis=-1) for p in (poses[:, -1], last))
    assert (np.abs(one - other) <= 2 * np.sqrt(3) * off + 1e-5).all()


def test_quality_equals_numpy(character: core.Character) -> None:
    _, first, last = core.trajectories(character)
    medoids = character.representatives
    weights = np.array([character.space.weights[i] for i in (0, 0, 1, 2)])
    weights[:2] *= character.space.scale
    smoothness = 1 / (1 + dis(last[medoids][:, None], first[medoids][None]))
    difference = weights * (character.evident[medoids][:, None] - character.space.points[None])
    match = 1 / (1 + np.linalg.norm(difference, axis=-1))
    # The character's poses are packed, those that the build measured were not.
    np.testing.assert_allclose(character.smoothness, smoothness, atol=2e-3)
    np.testing.assert_allclose(character.match, match, rtol=1e-12)
    quality = character.smoothness[:, :, None] * character.match[None]
    assert quality.min() > 0 and quality.max() <= 1


# --- clustering ------------------------------------------------------------------------------------------------------


def inertia_of(points: Array, labels: Array) -> float:
    """Sum over points of Dis to the class's mean squared."""
    total = 0.0
    for k in np.unique(labels):
        members = points[labels == k].astype(float)
        total += float((dis(members, members.mean(0)) ** 2).sum())
    return total


def test_inertia_is_that_of_the_labels(character: core.Character) -> None:
    points, _, _ = core.trajectories(character)
    labels, representatives, inertia = core.cluster(points, 20, seed=3)
    assert inertia == pytest.approx(inertia_of(points, labels), rel=1e-4)
    assert set(labels) == set(range(20))
    for k, medoid in enumerate(representatives):
        members = np.flatnonzero(labels == k)
        distances = dis(points[members], points[members].astype(float).mean(0))
        assert labels[medoid] == k
        assert dis(points[medoid], points[members].astype(float).mean(0)) <= distances.min() * (1 + 1e-4) + 1e-4


@pytest.mark.parametrize("classes", [5, 20, 60])
def test_inertia_is_not_worse_than_that_of_scikit_learns_labels(character: core.Character, classes: int) -> None:
    points, _, _ = core.trajectories(character)
    ours = core.cluster(points, classes, restarts=8)[2]
    theirs = KMeans(classes, n_init=8, random_state=0).fit(points.reshape(len(points), -1)).labels_
    assert ours <= 1.04 * inertia_of(points, theirs)  # the best of 8 varies by 2 % from seed to seed


def test_clusters_are_the_same_bits_for_any_number_of_threads() -> None:
    points = np.random.default_rng(1).random((300, 20, 3), dtype=np.float32)
    results = [core.cluster(points, 15, seed=4, threads=threads) for threads in (1, 2, 2, 5)]
    for labels, representatives, inertia in results[1:]:
        np.testing.assert_array_equal(labels, results[0][0])
        np.testing.assert_array_equal(representatives, results[0][1])
        assert inertia == results[0][2]


@pytest.mark.parametrize(
    ("points", "classes", "message"),
    [
        (np.zeros((5, 2, 3)), 6, "only 5"),
        (np.zeros((5, 2, 3)), 2, "distinct"),
        (np.ones((5, 2, 3)) * np.nan, 2, "not a number"),
        (np.zeros((5, 2, 2)), 2, "shape"),
        (np.zeros((5, 2, 3)), 0, "must be 1 to"),
        (np.arange(30).reshape((5, 2, 3)) * 1e25, 2, "fragment 0: a coordinate"),
    ],
)
def test_clusters_refuse_what_cannot_be_clustered(points: Array, classes: int, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        core.cluster(points, classes)


@pytest.mark.parametrize("weight", [0, -1, np.nan, np.inf])
def test_clusters_refuse_weights_that_do_not_count(weight: float) -> None:
    points = np.random.default_rng(1).random((5, 2, 3), dtype=np.float32)
    with pytest.raises(ValueError, match="weight"):
        core.cluster(points, 2, [1, 1, weight, 1, 1])


@pytest.mark.parametrize("restarts", [0, -1])
def test_clusters_without_restarts_tell_a_progress_that_is_a_number(restarts: int) -> None:
    points = np.random.default_rng(1).random((20, 2, 3), dtype=np.float32)
    told: list[float] = []
    labels = core.cluster(points, 3, restarts=restarts, progress=lambda part, _: told.append(part) or True)[0]
    assert set(labels) == {0, 1, 2}
    assert told and all(0 <= part <= 1 for part in told)


# --- Optimal, Greedy, Iterate ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(10))
def test_optimal_is_the_best_of_all_paths(seed: int) -> None:
    random = np.random.default_rng(seed)
    smoothness, match = random_factors(random, 4)
    trace = random_trace(random, 5)
    path, quality = core.optimal_path(smoothness, match, trace)
    paths = np.array(list(itertools.product(range(4), repeat=6)))
    totals = (smoothness[paths[:, :-1], paths[:, 1:]] * match[paths[:, 1:], trace]).sum(1)
    np.testing.assert_array_equal(path, paths[totals.argmax()])
    assert quality == pytest.approx(totals.max(), abs=1e-12)


def test_greedy_is_the_argmax() -> None:
    smoothness, match = random_factors(np.random.default_rng(1), 9)
    expected = (smoothness[:, :, None] * match[None]).argmax(1)
    np.testing.assert_array_equal(core.greedy_table(smoothness, match), expected)


def numpy_value_iteration(smoothness: Array, match: Array, model: Array, discount: float) -> tuple[Array, Array]:
    """The value of each choice [from, to, control] and its maximum, by iteration to the end."""
    quality = smoothness[:, :, None] * match[None]
    value = np.zeros((len(smoothness), POINTS))
    for _ in range(2000):
        choices = quality + discount * (value @ model.T)[None]
        better = choices.max(1)
        if np.abs(better - value).max() < 1e-13:
            break
        value = better
    return choices, value


def test_iterate_is_value_iteration() -> None:
    random = np.random.default_rng(2)
    smoothness, match = random_factors(random, 8)
    traces = [random_trace(random, 300), random_trace(random, 100, 40)]
    model = core.control_model(traces, 0.5, 0)
    counts = 0.5 * np.eye(POINTS)
    for trace in traces:
        np.add.at(counts, (trace[:-1], trace[1:]), 1)
    np.testing.assert_allclose(model, counts / counts.sum(1, keepdims=True), atol=1e-12)
    choices, _ = numpy_value_iteration(smoothness, match, model, 0.8)
    table = core.iterate_table(smoothness, match, traces, discount=0.8, tolerance=1e-10)
    chosen = np.take_along_axis(choices, table[:, None, :], 1)[:, 0]
    np.testing.assert_allclose(chosen, choices.max(1), atol=1e-8)
    assert (table == choices.argmax(1)).mean() > 0.999


def test_anticipate_is_value_iteration_with_a_prior_of_any_player() -> None:
    random = np.random.default_rng(6)
    smoothness, match = random_factors(random, 8)
    traces = [random_trace(random, 300)]
    counts = 8.5 * np.eye(POINTS) + 1.5 / POINTS
    np.add.at(counts, (traces[0][:-1], traces[0][1:]), 1)
    model = core.control_model(traces)
    np.testing.assert_allclose(model, counts / counts.sum(1, keepdims=True), atol=1e-12)
    choices, _ = numpy_value_iteration(smoothness, match, model, 0.9)
    table = core.anticipate_table(smoothness, match, traces)
    chosen = np.take_along_axis(choices, table[:, None, :], 1)[:, 0]
    np.testing.assert_allclose(chosen, choices.max(1), atol=2e-3)
    assert (table == choices.argmax(1)).mean() > 0.99


@pytest.mark.parametrize("options", [{"discount": 1}, {"discount": np.nan}, {"tolerance": 0}, {"tolerance": np.nan}])
def test_iterate_refuses_options_without_an_end(options: dict[str, float]) -> None:
    smoothness, match = random_factors(np.random.default_rng(9), 3)
    with pytest.raises(ValueError, match=next(iter(options))):
        core.iterate_table(smoothness, match, [[1, 2]], **options)


def test_no_table_is_better_than_optimal() -> None:
    random = np.random.default_rng(3)
    for _ in range(30):
        smoothness, match = random_factors(random, 6)
        trace = random_trace(random, 50)
        table = random.integers(0, 6, (6, POINTS), dtype=np.int32)
        for candidate in (table, core.greedy_table(smoothness, match), core.iterate_table(smoothness, match, [trace])):
            assert 0 < core.percent_of_optimal(smoothness, match, candidate, trace) <= 100 + 1e-9


def test_percent_of_optimal_is_the_ratio_of_both_paths() -> None:
    random = np.random.default_rng(4)
    smoothness, match = random_factors(random, 5)
    trace = random_trace(random, 40)
    table = core.greedy_table(smoothness, match)
    path, best = core.optimal_path(smoothness, match, trace)
    now, total = path[0], 0.0
    for control in trace:
        following = table[now, control]
        total += smoothness[now, following] * match[following, control]
        now = following
    assert core.percent_of_optimal(smoothness, match, table, trace) == pytest.approx(100 * total / best)


@pytest.mark.parametrize("trace", [[], [0, 102], [-1]])
def test_paths_refuse_bad_traces(trace: list[int]) -> None:
    smoothness, match = random_factors(np.random.default_rng(5), 3)
    with pytest.raises(ValueError, match="control"):
        core.optimal_path(smoothness, match, np.array(trace, np.int32))


def test_stages_refuse_wrong_shapes() -> None:
    smoothness, match = random_factors(np.random.default_rng(6), 3)
    with pytest.raises(ValueError, match="smoothness"):
        core.greedy_table(smoothness[:2], match)
    with pytest.raises(ValueError, match="match"):
        core.greedy_table(smoothness, match[:2])
    with pytest.raises(ValueError, match="table"):
        core.percent_of_optimal(smoothness, match, np.zeros((2, POINTS), np.int32), [0])
    with pytest.raises(ValueError, match="from 0 to 2, not 3"):
        core.percent_of_optimal(smoothness, match, np.full((3, POINTS), 3, np.int32), [0])


# --- SVM -------------------------------------------------------------------------------------------------------------


def compare_with_scikit_learn(
    smoothness: Array,
    match: Array,
    traces: list[Array],
    features: Array,
    space: core.ControlSpace,
    c: float,
    gamma: float,
) -> tuple[float, float]:
    """Shares of equal decisions over the table and over the training samples.

    Both train to a tolerance of 1e-3 of the dual, so decisions with a smaller margin may fall either way. Votes of the
    pairs of classes tie often; libsvm then takes the class that appeared first in training, scikit-learn the lowest:
    it is given the classes numbered by appearance.
    """
    table = core.svm_table(smoothness, match, traces, features, space, c=c, gamma=gamma)[0]
    inputs, labels = core.svm_samples(smoothness, match, traces, features, space)
    appeared = np.array(list(dict.fromkeys(labels.tolist())))
    numbered = {label: number for number, label in enumerate(appeared)}
    model = SVC(kernel="rbf", C=c, gamma=gamma, tol=1e-3).fit(inputs, [numbered[label] for label in labels.tolist()])
    n = len(features)
    weights = np.array([space.weights[i] for i in (0, 0, 1, 2)])
    weights[:2] *= space.scale
    controls = np.tile(weights * space.points, (n, 1))
    everything = np.column_stack([np.repeat(features, POINTS, 0), controls])
    theirs = appeared[model.predict(everything)].reshape(n, POINTS)
    rows = [(k, c) for trace in traces for k, c in zip(core.optimal_path(smoothness, match, trace)[0], trace)]
    ours = np.array([table[k, c] for k, c in rows])
    return float((table == theirs).mean()), float((ours == appeared[model.predict(inputs)]).mean())


def numbers(character: core.Character, traces: list[Array]) -> list[Array]:
    return [character.space.nearest(trace) for trace in traces]


@pytest.mark.parametrize(("c", "gamma"), [(1, 0.0625), (8, 0.25), (64, 1), (512, 0.015625)])
def test_svm_decides_as_scikit_learns(character: core.Character, traces: list[Array], c: float, gamma: float) -> None:
    arguments = (character.smoothness, character.match, numbers(character, traces), core.class_features(character))
    of_table, of_samples = compare_with_scikit_learn(*arguments, character.space, c, gamma)
    print(f"C {c}, gamma {gamma}: {100 * of_table:.2f} % of the table, {100 * of_samples:.2f} % of the samples agree")
    assert of_table >= 0.995
    assert of_samples >= 0.995


def test_svm_chooses_its_parameters_alike_for_any_number_of_threads(
    character: core.Character, traces: list[Array]
) -> None:
    arguments = (character.smoothness, character.match, numbers(character, traces), core.class_features(character))
    results = [core.svm_table(*arguments, character.space, threads=threads) for threads in (1, 2, 1)]
    for table, c, gamma, accuracy in results[1:]:
        np.testing.assert_array_equal(table, results[0][0])
        assert (c, gamma, accuracy) == results[0][1:]
    assert results[0][1] > 0 and results[0][2] > 0 and 0 <= results[0][3] <= 1
    np.testing.assert_array_equal(results[0][0], svm_of(character))


def svm_of(character: core.Character) -> Array:
    """The svm policy's table as the build made it, told by what it plays."""
    loaded = core.Character.from_bytes(character.to_bytes())
    assert loaded.policies == character.policies
    return core.svm_table(
        loaded.smoothness,
        loaded.match,
        numbers(loaded, [core.simulate_trace("explorer", 60, 1), core.simulate_trace("walker", 30, 2)]),
        core.class_features(loaded),
        loaded.space,
    )[0]


def test_svm_learns_a_single_class() -> None:
    smoothness = np.full((3, 3), 0.1)
    smoothness[:, 1] = 1
    match = np.ones((3, POINTS))
    features = np.random.default_rng(7).random((3, 2))
    table = core.svm_table(smoothness, match, [[0, 5, 9, 5, 0]], features, core.ControlSpace())[0]
    assert (table == 1).all()


def test_svm_refuses_to_learn_from_nothing() -> None:
    smoothness, match = random_factors(np.random.default_rng(8), 3)
    with pytest.raises(ValueError, match="trace"):
        core.svm_table(smoothness, match, [], np.zeros((3, 2)), core.ControlSpace())
    with pytest.raises(ValueError, match="features"):
        core.svm_table(smoothness, match, [[1, 2]], np.zeros((2, 2)), core.ControlSpace())
