# SPDX-License-Identifier: GPL-3.0-or-later
"""Ticked Actions to a character, and the character kept in the .blend."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import bpy

from . import actions
from .core import core
from .errors import UserError, core_errors
from .jobs import Report
from .rigs import carriers, make_rig
from .sampling import sample
from .traces import make_trace

if TYPE_CHECKING:
    from fragmotion_core import Character, Skeleton

_EXAM_SECONDS = 60.0
_EXAM_SEED = 7_001
_EXAMINERS = ("explorer", "runner")
_BUILD_SHARE = 0.95  # of the progress; the exam has the rest
_cache: dict[str, Character] = {}


class Built(NamedTuple):
    """A finished build: the character and how its policies did on a player that they did not learn from."""

    character: Character
    qualities: dict[str, float]  # percent of Optimal; the first is of the policy that drives
    examiner: str


def prepare(context: bpy.types.Context, obj: bpy.types.Object, settings: Any) -> Callable[[Report], Built]:
    """Sample the ticked Actions and return the task that builds from them; UserError on what cannot be built from."""
    takes = _ticked(obj)
    context.view_layer.update()
    rig = make_rig(obj)
    carriers(obj, rig)
    trace = make_trace(settings)
    clips = [sample(context, obj, action, rig) for action in takes]
    options = make_options(settings)
    examiner = next(name for name in _EXAMINERS if name != settings.player or settings.trace_source == "FILE")

    def task(report: Report) -> Built:
        character = core.build(
            rig.skeleton, clips, [trace], options, lambda fraction, stage: report(_BUILD_SHARE * fraction, stage)
        )
        report(_BUILD_SHARE, "Examining")
        exam = core.simulate_trace(examiner, _EXAM_SECONDS, _EXAM_SEED, character.space)
        qualities = {policy: character.percent_of_optimal(exam, policy) for policy in character.policies}
        return Built(character, qualities, examiner)

    return task


def _ticked(obj: bpy.types.Object) -> list[bpy.types.Action]:
    takes = actions.ticked(obj)
    if takes:
        return takes
    foreign = [action for action in bpy.data.actions if action.fragmotion.use]
    if foreign:
        bones = ", ".join(f"'{name}'" for name in sorted(actions.animated_bones(foreign[0], obj))[:3]) or "no bones"
        raise UserError(
            f"Action '{foreign[0].name}' is of another rig: it animates {bones}, few of which "
            f"armature '{obj.name}' has. Import takes onto this armature, or tick its own Actions"
        )
    raise UserError(f"No Action is ticked for armature '{obj.name}': import mocap, or tick its Actions")


def make_options(settings: Any) -> Any:
    """The core's options as BuildFields say."""
    options = core.BuildOptions()
    for name in ("longest", "cut", "classes", "seed", "mirror", "synthesize"):
        setattr(options, name, getattr(settings, name))
    options.policies = sorted(options.policies, key=lambda policy: policy != settings.policy)
    return options


def keep(obj: bpy.types.Object, built: Built) -> None:
    """Store the character and its figures with the armature."""
    character, figures = built.character, obj.fragmotion.figures
    data = character.to_bytes()
    obj.fragmotion.policy = data
    _cache.clear()
    _cache[_key(data)] = character
    figures.captured = int(character.report["captured"])
    figures.fragments = int(character.report["fragments"])
    figures.classes, figures.controls = character.table.shape
    figures.seconds = character.report["seconds"]
    figures.quality = next(iter(built.qualities.values()))
    figures.policies.clear()
    for policy, quality in built.qualities.items():
        row = figures.policies.add()
        row.name, row.quality = policy, quality
    figures.examiner = built.examiner


def has_character(obj: bpy.types.Object) -> bool:
    """Whether Build has been done for this armature."""
    return bool(obj.fragmotion.figures.classes > 0)


def load(obj: bpy.types.Object) -> Character:
    """The armature's character; decoded once for each content."""
    data = obj.fragmotion.policy
    if not data:
        raise UserError(f"Armature '{obj.name}' has no character yet: press Build first")
    key = _key(data)
    if key not in _cache:
        with core_errors(f"The policy kept in armature '{obj.name}'"):
            _cache.clear()
            _cache[key] = core.Character.from_bytes(data)
    return _cache[key]


def check_skeleton(obj: bpy.types.Object, built: Skeleton, now: Skeleton) -> None:
    """UserError where the armature's bones are not those that the character was built on."""
    if list(built.names) != list(now.names):
        changed = sorted(set(built.names) ^ set(now.names)) or ["(their order)"]
        raise UserError(f"Armature '{obj.name}' has changed since Build (bone '{changed[0]}'): press Build again")


def forget() -> None:
    """Let go of all decoded characters."""
    _cache.clear()


def _key(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()
