# SPDX-License-Identifier: GPL-3.0-or-later
"""Which control of a rig moves which part of its body."""

from __future__ import annotations

import re
from collections.abc import Collection, Generator, Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple, TypeVar

import bpy
from mathutils import Matrix

from ..errors import UserError
from .detecting import is_moved
from .joints import Joint
from .planes import Limb, Plane, find_plane
from .probing import Prober
from .wiring import Switch, above, first_of_chain, heeded_switches, read_switch, set_switch

_TRUNK = re.compile(r"hips|spine_\d+")  # these may turn about another place than their joint
_LIMBS: list[Limb] = [
    (f"{side}_{upper}", f"{side}_{lower}", f"{side}_{end}")
    for upper, lower, end in (("upper_arm", "lower_arm", "hand"), ("thigh", "shin", "foot"))
    for side in ("left", "right")
]

T = TypeVar("T")
Trying = Generator[float, None, T]
"""Tells what share is done, and returns what was found."""

ROOT = "root"
"""The role of the motion skeleton's bone on the ground, which the rig's outermost control follows."""


class Follower(NamedTuple):
    """A control that is to follow a part of the body, in its turns, its place or both; with `plane` that in which the
    limb bends. `rest` is where it is in the armature's space while the rig rests."""

    control: str
    role: str
    turns: bool
    moves: bool
    rest: Matrix
    plane: Plane | None = None


class Controls(NamedTuple):
    """What is to follow what, the body's control the hips; the roles that do follow then; the controls that carry the
    body and, where there is one, all; the values of switches by which this is so. Limbs that follow by a control for
    each of their parts do so by their ends, too, where a switch has them moved so."""

    followers: list[Follower]
    followed: set[str]
    body: str
    root: str
    switches: dict[Switch, float]


def find_controls(context: bpy.types.Context, obj: bpy.types.Object, joints: Mapping[str, Joint]) -> Trying[Controls]:
    """Try the rig's controls, which rests and plays nothing, telling what share is done; its switches stay as they are
    told."""
    return _Search(context, obj, joints).run()


def _other(value: float) -> float:
    """The other value of a switch."""
    return 0.0 if value > 1 / 2 else 1.0


class _Search:
    def __init__(self, context: bpy.types.Context, obj: bpy.types.Object, joints: Mapping[str, Joint]) -> None:
        self._obj, self._joints = obj, joints
        self._limbs = [limb for limb in _LIMBS if set(limb) <= set(joints)]
        self._prober = Prober(context, obj, joints)
        self._has_shapes = any(bone.custom_shape is not None for bone in obj.pose.bones)
        self._above = {role: above(obj, joint.bone) for role, joint in joints.items()}
        self._heeded = heeded_switches(obj)

    def run(self) -> Trying[Controls]:
        switches = yield from self._flip()
        carriers = self._carriers()
        if not carriers:
            raise UserError(
                f"Armature '{self._obj.name}': no control moves the whole body; its hips are bone "
                f"'{self._joints['hips'].bone}'"
            )
        body, root = carriers[-1], carriers[0] if len(carriers) > 1 else ""
        turning = self._assign(self._joints, set(carriers))
        carried = [self._follower(name, role, True, True) for name, role in ((root, ROOT), (body, "hips")) if name]
        turned = [self._follower(control, role, True, False) for role, control in turning.items()]
        by_end = [limb for limb in self._limbs if not set(limb[:2]) & set(turning)]
        reached = {follower.control: follower for limb in by_end for follower in self._reaching(limb, turning)}
        placed = {follower.role for follower in reached.values()}
        reached.update((yield from self._otherwise([limb for limb in self._limbs if limb not in by_end], turning)))
        followers = [reached.pop(follower.control, follower) for follower in (*carried, *turned)]
        followed = {*turning, "hips", *(role for limb in by_end if limb[2] in placed for role in limb)}
        return Controls([*followers, *reached.values()], followed, body, root, switches)

    def _follower(self, control: str, role: str, turns: bool, moves: bool, plane: Plane | None = None) -> Follower:
        return Follower(control, role, turns, moves, self._prober.rest(control), plane)

    def _flip(self) -> Trying[dict[Switch, float]]:
        """Flip the switches without which parts of limbs have no control of their own; how they stand now."""
        limbs = [role for limb in _LIMBS for role in limb if role in self._joints]
        found, flipped = self._assign(limbs), {}
        for index, switch in enumerate(switches := self._switches()):
            yield index / len(switches) / 2
            before = read_switch(self._obj, switch)
            if before is None or not any(self._heeds(role, switch) for role in limbs if role not in found):
                continue
            other = _other(before)
            self._set(switch, other)
            now = self._assign(limbs)
            if len(now) > len(found):
                found, flipped[switch] = now, other
            else:
                self._set(switch, before)
        return flipped

    def _set(self, switch: Switch, value: float) -> None:
        set_switch(self._obj, switch, value)
        self._prober.forget()

    def _switches(self) -> list[Switch]:
        """Those that constraints heed, the likeliest first."""
        switches = sorted({switch for switches in self._heeded.values() for switch in switches})
        known = (switch for switch in switches if 0 <= (read_switch(self._obj, switch) or 0) <= 1)
        return sorted(known, key=lambda switch: "fk" not in switch.name.lower())

    def _heeds(self, role: str, switch: Switch) -> bool:
        return any(switch in self._heeded.get(bone, ()) for bone in self._above[role])

    def _carriers(self) -> list[str]:
        """The controls with which the whole trunk goes, the outermost first."""
        trunk = {role for role in self._joints if _TRUNK.fullmatch(role)} | ({"head"} & set(self._joints))
        carriers = [control for control in self._candidates(["hips"]) if trunk <= self._prober.shifted(control)]
        return sorted(carriers, key=lambda control: len(above(self._obj, control) & set(carriers)))

    def _otherwise(self, limbs: Sequence[Limb], turning: Mapping[str, str]) -> Trying[dict[str, Follower]]:
        """By their controls, those of limbs whose parts are turned that would move them by their ends if a switch were
        set otherwise; all switches stay as they are."""
        reached: dict[Limb, list[Follower]] = {}
        for index, switch in enumerate(switches := self._switches()):
            yield (1 + index / len(switches)) / 2
            before = read_switch(self._obj, switch)
            waiting = [limb for limb in limbs if limb not in reached and self._heeds(limb[-1], switch)]
            if before is None or not waiting:
                continue
            self._set(switch, _other(before))
            for limb in waiting:
                found = self._assign({*limb, limb[-1].replace("foot", "toe")} & set(self._joints))
                if not set(limb[:2]) & set(found) and (followers := list(self._reaching(limb, found))):
                    reached[limb] = [follower for follower in followers if follower.control not in turning.values()]
            self._set(switch, before)
        return {follower.control: follower for followers in reached.values() for follower in followers}

    def _reaching(self, limb: Limb, turning: Mapping[str, str]) -> Iterator[Follower]:
        """The controls of a limb that is moved by its end: that which places the end, what turns the toes, and what
        tells the plane in which it bends."""
        upper, _, end = limb
        if end not in turning or end not in self._prober.shifted(turning[end]):
            return
        yield self._follower(turning[end], end, True, True)
        toe = end.replace("foot", "toe")
        if toe != end and toe in turning:
            yield self._follower(turning[toe], toe, True, False)
        poles, bases = self._solved_by(limb)
        plane = find_plane(self._joints, limb, [self._prober.rest(pole).translation for pole in poles])
        if plane is not None:
            yield from (self._follower(pole, upper, False, True, plane) for pole in poles)
            yield from (self._follower(base, upper, True, False, plane) for base in bases)

    def _solved_by(self, limb: Limb) -> tuple[list[str], list[str]]:
        """The controls that tell a limb's solvers of IK the plane: poles, and where these have none what they turn."""
        upper, lower, _ = limb
        bones = [self._obj.pose.bones[name] for name in self._above[lower]]
        solvers = [(bone, solver) for bone in bones for solver in bone.constraints if solver.type == "IK"]
        controls, joint = self._candidates([lower]), self._joints[upper].head
        poles = {solver.pole_subtarget for _, solver in solvers}
        bases = {first_of_chain(bone, solver) for bone, solver in solvers if not solver.pole_subtarget}
        at_joint = {base.name for base in bases if self._prober.is_near(base.bone.head_local, joint)}
        return sorted(poles & set(controls)), sorted(at_joint & set(controls))

    def _assign(self, roles: Iterable[str], taken: Collection[str] = ()) -> dict[str, str]:
        """Role -> the control that turns it, no control for two, none of those taken."""
        pairs = sorted(pair for role in roles for pair in self._pairs(role) if pair[-1] not in taken)
        found: dict[str, str] = {}
        for *_, role, control in pairs:
            if role not in found and control not in found.values():
                found[role] = control
        return found

    def _pairs(self, role: str) -> Iterator[tuple[bool, int, float, str, str]]:
        """The controls that turn a part, the best least: that which turns the most with it about its joint, or the
        trunk's parts about another place and the least."""
        head = self._joints[role].head
        for control in self._candidates([role]):
            along, stay = self._prober.turned(control)
            apart = (self._obj.data.bones[control].head_local - head).length
            if role in along and {role, self._joints[role].parent or role} <= stay:
                yield False, -len(along), apart, role, control
            elif role in along and _TRUNK.fullmatch(role):
                yield True, len(along), apart, role, control

    def _candidates(self, roles: Iterable[str]) -> list[str]:
        """What may be a control of these parts: it can be turned, and where the rig gives controls shapes has one."""
        bones = {bone for role in roles for bone in self._above[role]}
        return sorted(bone for bone in bones if self._is_control(self._obj.pose.bones[bone]))

    def _is_control(self, bone: bpy.types.PoseBone) -> bool:
        shaped = bone.custom_shape is not None or not self._has_shapes
        return shaped and not is_moved(bone) and not all(bone.lock_rotation)
