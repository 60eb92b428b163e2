# SPDX-License-Identifier: GPL-3.0-or-later
"""What the controls of a rig do to its body, found by trying each."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import lru_cache
from math import pi
from typing import NamedTuple

import bpy
from mathutils import Matrix, Vector

from .joints import Joint, height_of

_TURN = Matrix.Rotation(0.3, 4, Vector((1, 2, 3)).normalized())
_SHIFT = 0.05  # of the body's height
_ASIDE = Vector((0.1, 0.2, 0.3))  # for a control that is at the hips
_SAME_WAY = 1e-3  # rad, of the turn
_SAME_PLACE = 1e-3  # of the body's height


class Turned(NamedTuple):
    """Of the parts of a body, by their roles: which turn just as a control does, and whose joint stays in its place."""

    along: frozenset[str]
    stay: frozenset[str]


class Prober:
    """Tries the controls of a rig that rests and plays nothing; the rig is at rest again after each trial."""

    def __init__(self, context: bpy.types.Context, obj: bpy.types.Object, joints: Mapping[str, Joint]) -> None:
        self._context, self._obj, self._joints = context, obj, joints
        self._height = height_of(joints)
        self._bones = [joint.bone for joint in joints.values()]
        self.turned = lru_cache(maxsize=None)(self._turned)
        self.shifted = lru_cache(maxsize=None)(self._shifted)
        self._rest = self._pose(self._obj.pose.bones.keys())

    def forget(self) -> None:
        """A switch was flipped: what was found out before need not hold."""
        self._rest = self._pose(self._obj.pose.bones.keys())
        self.turned.cache_clear()
        self.shifted.cache_clear()

    def rest(self, control: str) -> Matrix:
        """Where a control is in the armature's space while it rests itself, whatever a solver makes of it then."""
        return self._converted(control, Matrix(), "LOCAL", "POSE")

    def is_near(self, one: Vector, other: Vector) -> bool:
        """Whether two places are one, by the body's size."""
        return bool((one - other).length < _SAME_PLACE * self._height)

    def _turned(self, control: str) -> Turned:
        posed = self._trial(control, self._rest[control] @ _TURN)
        if posed is None:
            return Turned(frozenset(), frozenset())
        turn = (posed[control] @ self._rest[control].inverted()).to_3x3().normalized()
        along = [
            role
            for role, joint in self._joints.items()
            if (turn @ _way(self._rest[joint.bone])).angle(_way(posed[joint.bone]), pi) < _SAME_WAY
        ]
        ways = {role: self._went(posed, joint.bone) for role, joint in self._joints.items()}
        return Turned(frozenset(along), frozenset(role for role, gone in ways.items() if self.is_near(gone, Vector())))

    def _shifted(self, control: str) -> frozenset[str]:
        """The roles whose joint goes just as far as the control when that is moved towards the hips."""
        rest = self._rest[control]
        way = (self._joints["hips"].head - rest.translation).normalized() + _ASIDE
        posed = self._trial(control, Matrix.Translation(_SHIFT * self._height * way) @ rest)
        if posed is None:
            return frozenset()
        ways = {role: self._went(posed, joint.bone) for role, joint in self._joints.items()}
        return frozenset(role for role, gone in ways.items() if self.is_near(gone, self._went(posed, control)))

    def _trial(self, control: str, wanted: Matrix) -> dict[str, Matrix] | None:
        """The pose with the control there, in the armature's space; None where the control itself does not obey."""
        bone = self._obj.pose.bones[control]
        former = bone.matrix_basis.copy()
        bone.matrix_basis = self._converted(control, wanted, "POSE", "LOCAL")
        posed = self._pose({control, *self._bones})
        bone.matrix_basis = former
        obeys = self.is_near(posed[control].translation, wanted.translation)
        return posed if obeys and _way(posed[control]).angle(_way(wanted), pi) < _SAME_WAY else None

    def _converted(self, control: str, matrix: Matrix, source: str, target: str) -> Matrix:
        posed = self._evaluated()
        return posed.convert_space(
            pose_bone=posed.pose.bones[control], matrix=matrix, from_space=source, to_space=target
        )

    def _evaluated(self) -> bpy.types.Object:
        return self._obj.evaluated_get(self._context.evaluated_depsgraph_get())

    def _pose(self, names: Iterable[str]) -> dict[str, Matrix]:
        self._context.view_layer.update()
        bones = self._evaluated().pose.bones
        return {name: bones[name].matrix.copy() for name in names}

    def _went(self, posed: Mapping[str, Matrix], bone: str) -> Vector:
        return posed[bone].translation - self._rest[bone].translation


def _way(matrix: Matrix) -> Vector:
    return matrix.col[1].to_3d()
