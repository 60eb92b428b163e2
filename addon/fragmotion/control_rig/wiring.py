# SPDX-License-Identifier: GPL-3.0-or-later
"""How the bones of a rig depend on each other, and on the rig's switches."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

import bpy

_INFLUENCE = re.compile(r'pose\.bones\["(.+?)"\]\.constraints\[.+\]\.(?:influence|mute|enabled)$')
_PROPERTY = re.compile(r'(?:pose\.bones\["(.+?)"\])?\["(.+?)"\]$')


class Switch(NamedTuple):
    """A custom property, of a bone or with `bone` empty of the object, by which constraints have their say."""

    bone: str
    name: str

    @property
    def path(self) -> str:
        """Its data path from the object."""
        names = [bpy.utils.escape_identifier(name) for name in self]
        return f'pose.bones["{names[0]}"]["{names[1]}"]' if self.bone else f'["{names[1]}"]'


def read_switch(obj: bpy.types.Object, switch: Switch) -> float | None:
    """The value of a switch; None where it is not there or no number."""
    owner = obj.pose.bones.get(switch.bone) if switch.bone else obj
    value = owner.get(switch.name) if owner is not None else None
    return float(value) if isinstance(value, (bool, int, float)) else None


def set_switch(obj: bpy.types.Object, switch: Switch, value: float) -> None:
    """Set a switch that is there; it stays of its type."""
    owner = obj.pose.bones[switch.bone] if switch.bone else obj
    owner[switch.name] = type(owner[switch.name])(value)
    obj.update_tag()


def above(obj: bpy.types.Object, bone: str) -> set[str]:
    """The bone, and all that it depends on by parents and constraints."""
    found: set[str] = set()
    waiting = [bone]
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.add(name)
            waiting += _sources(obj, obj.pose.bones[name])
    return found


def first_of_chain(bone: bpy.types.PoseBone, solver: bpy.types.KinematicConstraint) -> bpy.types.PoseBone:
    """The bone of a solver's chain that is nearest to the trunk."""
    chain = [bone, *bone.parent_recursive] if solver.use_tail else bone.parent_recursive or [bone]
    return chain[min(solver.chain_count or len(chain), len(chain)) - 1]


def find_circle(obj: bpy.types.Object) -> list[str]:
    """Bones of which each depends on the next and the last on the first; empty where there are none."""
    done: set[str] = set()
    for bone in obj.pose.bones:
        way: list[tuple[str, Iterator[str]]] = [(bone.name, iter((bone.name,)))]
        path: list[str] = []
        while way:
            name = next(way[-1][1], None)
            if name is None:
                way.pop()
                if path:
                    done.add(path.pop())
            elif name in path:
                return path[path.index(name) :]
            elif name not in done:
                path.append(name)
                way.append((name, _sources(obj, obj.pose.bones[name], muted=False)))
    return []


def heeded_switches(obj: bpy.types.Object) -> dict[str, set[Switch]]:
    """Bone -> the switches that drive whether its constraints act."""
    found: dict[str, set[Switch]] = {}
    for driver in obj.animation_data.drivers if obj.animation_data else ():
        match = _INFLUENCE.match(driver.data_path)
        if match:
            found.setdefault(match[1], set()).update(_switches(obj, driver))
    return found


def _switches(obj: bpy.types.Object, driver: bpy.types.FCurve) -> Iterator[Switch]:
    for variable in driver.driver.variables:
        for target in variable.targets:
            match = _PROPERTY.fullmatch(target.data_path) if target.id == obj else None
            if match:
                yield Switch(match[1] or "", match[2])


def _sources(obj: bpy.types.Object, bone: bpy.types.PoseBone, muted: bool = True) -> Iterator[str]:
    """The bones that a bone depends on itself, by its `muted` constraints, too, as a switch may drive that."""
    if bone.parent is not None:
        yield bone.parent.name
    for constraint in bone.constraints:
        if constraint.mute and not muted:
            continue
        targets = constraint.targets if constraint.type == "ARMATURE" else [constraint]
        for target in targets:
            for kind in ("target", "pole_target"):
                name = getattr(target, kind.replace("target", "subtarget"), "")
                if getattr(target, kind, None) == obj and name in obj.pose.bones and name != bone.name:
                    yield name
