# SPDX-License-Identifier: MIT
"""Unit quaternions (w, x, y, z) and turns of the plane, on arrays of any leading shape."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]

_NEXT, _LAST = [1, 2, 0], [2, 0, 1]
_STILL = 1e-9  # rad under which a rotation's axis is not told


def multiply(a: Array, b: Array) -> Array:
    """b, and then a."""
    aw, av, bw, bv = a[..., :1], a[..., 1:], b[..., :1], b[..., 1:]
    scalar = aw * bw - np.sum(av * bv, -1, keepdims=True)
    return np.concatenate((scalar, aw * bv + bw * av + cross(av, bv)), -1)


def inverse(rotation: Array) -> Array:
    """The rotation back."""
    back: Array = rotation * np.array([1.0, -1.0, -1.0, -1.0])
    return back


def cross(a: Array, b: Array) -> Array:
    """The cross product; np.cross is several times as slow on few vectors."""
    product: Array = a[..., _NEXT] * b[..., _LAST] - a[..., _LAST] * b[..., _NEXT]
    return product


def rotate(rotation: Array, vector: Array) -> Array:
    """The vector, turned."""
    axis = rotation[..., 1:]
    across = 2 * cross(axis, vector)
    turned_vector: Array = vector + rotation[..., :1] * across + cross(axis, across)
    return turned_vector


def about(axis: Array, angle: Array) -> Array:
    """The rotation by an angle about a unit axis."""
    half = np.asarray(angle)[..., None] / 2
    return np.concatenate((np.cos(half), np.sin(half) * axis), -1)


def about_z(angle: Array) -> Array:
    """The rotation by an angle about the vertical."""
    return about(np.array([0.0, 0.0, 1.0]), angle)


def to_vector(rotation: Array) -> Array:
    """Axis times angle, the short way round."""
    rotation = np.where(rotation[..., :1] < 0, -rotation, rotation)
    sine = np.linalg.norm(rotation[..., 1:], axis=-1, keepdims=True)
    angle = 2 * np.arctan2(sine, rotation[..., :1])
    vector: Array = np.where(sine > _STILL, angle / np.maximum(sine, _STILL), 2.0) * rotation[..., 1:]
    return vector


def of_vector(vector: Array) -> Array:
    """The rotation whose axis times angle this is."""
    angle = np.linalg.norm(vector, axis=-1, keepdims=True)
    share = np.where(angle > _STILL, np.sin(angle / 2) / np.maximum(angle, _STILL), 0.5)
    return np.concatenate((np.cos(angle / 2), share * vector), -1)


def between(a: Array, b: Array) -> Array:
    """The least rotation from direction a to direction b, which are not opposite."""
    scalar = np.sqrt(np.sum(a * a, -1) * np.sum(b * b, -1)) + np.sum(a * b, -1)
    return unit(np.concatenate((scalar[..., None], cross(a, b)), -1))


def unit(values: Array) -> Array:
    """Of length 1 along the last axis."""
    scaled: Array = values / np.maximum(np.linalg.norm(values, axis=-1, keepdims=True), 1e-12)
    return scaled


def continuous(rotations: Array) -> Array:
    """Along axis 0, each on the side of the one before."""
    signs = np.where(np.sum(rotations[1:] * rotations[:-1], -1) < 0, -1.0, 1.0)
    signs = np.concatenate((np.ones((1, *signs.shape[1:])), np.cumprod(signs, 0)))
    sides: Array = rotations * signs[..., None]
    return sides


def turned(vectors: Array, angle: Array) -> Array:
    """Vectors of the plane, counter-clockwise by an angle."""
    cosine, sine, x, y = np.cos(angle), np.sin(angle), vectors[..., 0], vectors[..., 1]
    return np.stack((cosine * x - sine * y, sine * x + cosine * y), -1)


def turned_flat(vectors: Array, angle: Array) -> Array:
    """Vectors of space, about the vertical."""
    return np.concatenate((turned(vectors[..., :2], angle), vectors[..., 2:]), -1)


def wrapped(angle: Array) -> Array:
    """Within half a turn."""
    return (angle + np.pi) % (2 * np.pi) - np.pi
