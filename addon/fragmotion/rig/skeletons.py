# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether two skeletons are the same, and if not, where they differ."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from fragmotion_core import Doubles, Skeleton

_LENGTH = 1e-3  # of the stature: what a bone may differ in place and length
_ANGLE = math.radians(0.2)


def difference(built: Skeleton, now: Skeleton, armature: Collection[str]) -> str:
    """How `now` differs from the skeleton that a character was built on, in words; empty where it does not.

    The place of the whole in the world does not count, its size does. `armature` names all the armature's bones: where
    several have no parent, the skeleton is what hangs on one of them.
    """
    return (
        _other_tree(built, now, armature)
        or _other_bones(built.names, now.names)
        or _other_parent(built, now)
        or _other_size(built, now)
    )


def _other_tree(built: Skeleton, now: Skeleton, armature: Collection[str]) -> str:
    apart = [name for name in built.names if name not in now.names and name in armature]
    if not apart:
        return ""
    return (
        f"bone '{apart[0]}' does not hang on '{now.names[0]}', which is taken for the root of the body, as several "
        "bones have no parent: parent it there, or separate what is not the body into an armature of its own (Edit "
        "Mode, Armature > Separate)"
    )


def _other_bones(built: Sequence[str], now: Sequence[str]) -> str:
    missing = [name for name in built if name not in now]
    new = [name for name in now if name not in built]
    if missing:
        return f"bone '{missing[0]}' is missing"
    if new:
        return f"bone '{new[0]}' is new"
    return "" if list(built) == list(now) else "its bones are in another order"


def _other_parent(built: Skeleton, now: Skeleton) -> str:
    for name, before, after in zip(built.names, built.parents, now.parents):
        if before != after:
            return f"bone '{name}' hangs on '{now.names[after]}', not on '{built.names[before]}'"
    return ""


def _other_size(built: Skeleton, now: Skeleton) -> str:
    """The first bone at rest that differs, or the size of the whole where all differ by the same factor."""
    found = _other_rest(built, now, 1)
    factor = _size(now) / _size(built)
    if found and not _other_rest(built, now, factor):
        return f"it is {factor:.3g} times as large (its scale or its bones)"
    return found


def _size(skeleton: Skeleton) -> float:
    return float(np.linalg.norm((*skeleton.tips, *skeleton.offsets[1:]), axis=1).sum())


def _other_rest(built: Skeleton, now: Skeleton, factor: float) -> str:
    """The first bone that differs from the built one enlarged by the factor."""
    tolerance = _LENGTH * now.stature
    moved = np.linalg.norm(now.offsets - factor * built.offsets, axis=1)
    turned = _angles(built.rest_rotations, now.rest_rotations)
    moved[0] = turned[0] = 0  # the place in the world
    before, after = (factor * np.linalg.norm(built.tips, axis=1), np.linalg.norm(now.tips, axis=1))
    for role in (name for name in now.roles if name.endswith("foot")):  # how long a foot is may be guessed
        after[now.names.index(now.roles[role])] = before[now.names.index(now.roles[role])]
    for bone, name in enumerate(now.names):
        if moved[bone] > tolerance:
            return f"bone '{name}' begins {moved[bone]:.3f} m from where it did on '{now.names[now.parents[bone]]}'"
        if turned[bone] > _ANGLE:
            return f"bone '{name}' is turned by {math.degrees(turned[bone]):.1f} degrees at rest"
        if abs(after[bone] - before[bone]) > tolerance:
            return f"bone '{name}' is {after[bone]:.3f} m long, not {before[bone]:.3f} m"
    return ""


def _angles(first: Doubles, second: Doubles) -> Doubles:
    """Angles [B] between rotations [B,4], radians."""
    chords = np.minimum(np.linalg.norm(first - second, axis=1), np.linalg.norm(first + second, axis=1))
    angles: Doubles = 4 * np.arcsin(np.minimum(chords / 2, 1))
    return angles
