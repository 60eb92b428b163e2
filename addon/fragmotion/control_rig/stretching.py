# SPDX-License-Identifier: GPL-3.0-or-later
"""Solvers of IK that stretch a limb's bones a little instead of bending it, such as Rigify's: scales of the controls
that begin limbs, by which these bend as they should.

The square of how far a middle joint is beside the limb is nearly linear in the scale: the rule of the secant finds it
within a few steps from the scale of the frame before.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import bpy

from .following import constraints_of
from .planes import plane_of

_STEPS = 12
_CLOSE = 3e-4  # of the limb's first bone, how far the middle joint may be off to the side: 0.1 mm at a knee
_SLOPE, _LEAST_SLOPE = 1.0, 0.05  # of that square over the scale: a first guess, and what is no answer any more
_PACE = 0.02  # of the scale, for one step at most


class _Limb(NamedTuple):
    control: str
    plane: str
    first: str


class _Tried(NamedTuple):
    scale: float
    off: float


class Stretching:
    """The scales of a rig's controls that begin limbs, while it follows its motion skeleton."""

    def __init__(self, context: bpy.types.Context, obj: bpy.types.Object, motion: bpy.types.Object) -> None:
        self._context, self._rig, self._motion = context, obj, motion
        self._anchors = obj.fragmotion.control_rig.anchors
        self._limbs = list(_limbs(obj, self._anchors))
        self._former = {limb: obj.pose.bones[limb.control].scale.copy() for limb in self._limbs}
        self._slopes = dict.fromkeys(self._limbs, _SLOPE)

    @property
    def controls(self) -> list[str]:
        """Those that are scaled."""
        return [limb.control for limb in self._limbs]

    def settle(self) -> list[float]:
        """Scale the controls as the shown frame needs it; their scales."""
        last: dict[_Limb, _Tried] = {}
        for _ in range(_STEPS):
            off = self._off()
            if not off:
                break
            for limb, distance in off.items():
                self._step(limb, _Tried(self._scale(limb), distance), last)
            self._context.view_layer.update()
        return [self._scale(limb) for limb in self._limbs]

    def restore(self) -> None:
        """Let the controls have the scales that they had."""
        for limb, scale in self._former.items():
            self._rig.pose.bones[limb.control].scale = scale

    def _step(self, limb: _Limb, tried: _Tried, last: dict[_Limb, _Tried]) -> None:
        if limb in last and tried.scale != last[limb].scale:
            slope = (tried.off - last[limb].off) / (tried.scale - last[limb].scale)
            self._slopes[limb] = max(slope, _LEAST_SLOPE)
        last[limb] = tried
        step = -tried.off / self._slopes[limb]
        self._rig.pose.bones[limb.control].scale = 3 * [tried.scale + min(max(step, -_PACE), _PACE)]

    def _scale(self, limb: _Limb) -> float:
        return float(self._rig.pose.bones[limb.control].scale.y)

    def _off(self) -> dict[_Limb, float]:
        """Of the limbs that bend otherwise than they should: by how much, as a square."""
        graph = self._context.evaluated_depsgraph_get()
        posed = (each.evaluated_get(graph).pose.bones for each in (self._rig, self._anchors, self._motion))
        rig, anchors, motion = posed
        off = {}
        for limb in self._limbs:
            side = anchors[limb.plane].z_axis
            beside, should = (max(bone.y_axis.dot(side), 0.0) for bone in (rig[limb.control], motion[limb.first]))
            if abs(beside - should) > _CLOSE:
                off[limb] = beside**2 - should**2
        return off


def _limbs(obj: bpy.types.Object, anchors: bpy.types.Object) -> Iterator[_Limb]:
    for bone, constraint in constraints_of(obj):
        plane = plane_of(anchors, bone.name) if constraint.type == "COPY_ROTATION" else None
        if plane is not None:
            yield _Limb(bone.name, plane, anchors.pose.bones[plane].constraints[0].subtarget)
