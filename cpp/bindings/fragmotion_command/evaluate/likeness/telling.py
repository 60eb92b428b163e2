# SPDX-License-Identifier: MIT
"""Whether a small classifier can tell windows that were played from the takes': a logistic regression on each value and
its square, which sees what differs in means and in spreads."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.special import expit
from scipy.stats import rankdata

from ..rotations import Array

_FOLDS = 4
_RIDGE = 1.0  # what the weights' squares cost, beside the samples' log-likelihood
_ROUNDS = 25  # of Newton's method at most


def told_apart(some: Sequence[Array], others: Sequence[Array]) -> float:
    """The area under the ROC curve: how often a sample of some is told from one of others. 0.5 is chance, 1 is always.
    What is told belongs to motions, whole, that were not learned from; `some` and `others` hold one [N,D] a motion."""
    motions = [*some, *others]
    labels = np.repeat([1.0] * len(some) + [0.0] * len(others), [len(motion) for motion in motions])
    folds = np.repeat([i % _FOLDS for part in (some, others) for i in range(len(part))], [len(m) for m in motions])
    values = np.concatenate(motions)
    areas = [_area_of_fold(values, labels, folds == fold) for fold in range(_FOLDS)]
    known = [area for area in areas if area is not None]
    return float(np.mean(known)) if known else float("nan")


def _area_of_fold(values: Array, labels: Array, test: Array) -> float | None:
    """None where one of both has no samples to learn from or to be told."""
    if any(len(set(labels[part])) < 2 for part in (test, ~test)):
        return None
    mean, spread = values[~test].mean(0), values[~test].std(0) + 1e-9
    scaled = (values - mean) / spread
    features = np.column_stack([np.ones(len(values)), scaled, scaled**2 - 1])
    return area_under_curve(features[test] @ fitted(features[~test], labels[~test]), labels[test])


def fitted(features: Array, labels: Array) -> Array:
    """The weights [D] of a logistic regression of labels 0 and 1; the first is not held small."""
    cost = np.full(features.shape[1], _RIDGE)
    cost[0] = 0
    weights = np.zeros(features.shape[1])
    for _ in range(_ROUNDS):
        chance = expit(features @ weights)
        slope = features.T @ (labels - chance) - cost * weights
        curvature = (features.T * (chance * (1 - chance))) @ features + np.diag(cost + 1e-9)
        step = np.linalg.solve(curvature, slope)
        weights = weights + step
        if np.abs(step).max() < 1e-6:
            break
    return weights


def area_under_curve(scores: Array, labels: Array) -> float:
    """How often a sample labelled 1 scores higher than one labelled 0."""
    ones = int(labels.sum())
    above = rankdata(scores)[labels == 1].sum() - ones * (ones + 1) / 2
    return float(above / (ones * (len(labels) - ones)))
