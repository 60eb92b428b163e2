# SPDX-License-Identifier: MIT
"""Rotations of many frames at once: arrays [N, 3, 3], angles in radians, quaternions (w, x, y, z)."""

from __future__ import annotations

import numpy as np

Array = np.ndarray


def about(axis: Array, angle: Array) -> Array:
    """Rotations [N, 3, 3] by angle [N] about one axis [3] or an axis a frame [N, 3] (Rodrigues)."""
    angle = np.atleast_1d(np.asarray(angle, float))
    axis = np.broadcast_to(axis, (len(angle), 3))
    x, y, z = (axis / np.linalg.norm(axis, axis=1, keepdims=True)).T
    zero = np.zeros_like(x)
    cross = np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=1).reshape(-1, 3, 3)
    sine, versine = np.sin(angle)[:, None, None], (1 - np.cos(angle))[:, None, None]
    return np.eye(3) + sine * cross + versine * cross @ cross


def about_x(angle: Array) -> Array:
    """Positive leans the body forward (up towards -y)."""
    return about(np.array([1.0, 0, 0]), angle)


def about_y(angle: Array) -> Array:
    """Positive leans the body to its left (up towards +x)."""
    return about(np.array([0, 1.0, 0]), angle)


def about_z(angle: Array) -> Array:
    """Positive turns left, counter-clockwise from above."""
    return about(np.array([0, 0, 1.0]), angle)


def apply(rotation: Array, vector: Array) -> Array:
    """Rotate one vector [3] or a vector a frame [N, 3] by [N, 3, 3]."""
    return np.einsum("nij,nj->ni", rotation, np.broadcast_to(vector, (len(rotation), 3)))


def transpose(rotation: Array) -> Array:
    """The inverse rotations."""
    return np.swapaxes(rotation, 1, 2)


def frame_of(direction: Array, hinge: Array) -> Array:
    """Orthonormal frames [N, 3, 3] with columns direction, hinge (made perpendicular) and their cross product."""
    first = direction / np.linalg.norm(direction, axis=1, keepdims=True)
    second = hinge - first * np.sum(hinge * first, axis=1, keepdims=True)
    second /= np.linalg.norm(second, axis=1, keepdims=True)
    return np.stack([first, second, np.cross(first, second)], axis=2)


def between(first: Array, second: Array, weight: float) -> Array:
    """The rotation at a fixed weight in [0, 1] of the way from first to second, both [N, 3, 3]."""
    quaternion = to_quaternions(transpose(first) @ second)
    sine = np.linalg.norm(quaternion[:, 1:], axis=1)
    angle = 2 * np.arctan2(sine, quaternion[:, 0])
    axis = np.where(sine[:, None] > 1e-9, quaternion[:, 1:], np.array([0, 0, 1.0]))
    wrapped = (angle + np.pi) % (2 * np.pi) - np.pi
    return first @ about(axis, wrapped * weight)


def to_quaternions(rotation: Array) -> Array:
    """Unit quaternions [N, 4] whose sign does not jump from frame to frame."""
    m = rotation
    trace = np.einsum("nii->n", m)
    diagonal = np.stack([m[:, 0, 0], m[:, 1, 1], m[:, 2, 2]], axis=1)
    squares = np.concatenate([(1 + trace)[:, None], 1 + 2 * diagonal - trace[:, None]], axis=1)
    size = np.sqrt(np.maximum(squares, 0)) / 2
    products = _products(m)
    best = np.argmax(size, axis=1)
    row = products[np.arange(len(m)), best]
    quaternion = row / (4 * size[np.arange(len(m)), best])[:, None]
    return continuous(quaternion)


def _products(m: Array) -> Array:
    """Four times the outer product q q^T [N, 4, 4] of each rotation's quaternion."""

    def pair(i: int, j: int) -> Array:
        return m[:, i, j] + m[:, j, i]

    def skew(i: int, j: int) -> Array:
        return m[:, i, j] - m[:, j, i]

    trace = np.einsum("nii->n", m)
    w, x, y, z = 1 + trace, *(1 + 2 * m[:, k, k] - trace for k in range(3))
    rows = [
        [w, skew(2, 1), skew(0, 2), skew(1, 0)],
        [skew(2, 1), x, pair(0, 1), pair(0, 2)],
        [skew(0, 2), pair(0, 1), y, pair(1, 2)],
        [skew(1, 0), pair(0, 2), pair(1, 2), z],
    ]
    return np.stack([np.stack(row, axis=1) for row in rows], axis=1)


def continuous(quaternion: Array) -> Array:
    """The same rotations with the first w >= 0 and no sign change between neighbouring frames."""
    dots = np.sum(quaternion[1:] * quaternion[:-1], axis=1)
    first = 1.0 if quaternion[0, 0] >= 0 else -1.0
    sign = first * np.concatenate([[1.0], np.cumprod(np.where(dots < 0, -1.0, 1.0))])
    return quaternion * sign[:, None]
