# SPDX-License-Identifier: GPL-3.0-or-later
"""Ticked Actions to a character, and the character kept in the .blend."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import bpy
import numpy as np

from ..compat.core import core
from ..errors import SinglePose, UserError, core_errors
from ..files import read_regular
from ..jobs import Report
from ..mocap import actions
from ..mocap.curve_points import read_once
from ..mocap.doctor import say_bobbing, say_lying, tell_ground, tell_size
from ..mocap.hands import hand_pose, with_hands
from ..mocap.on_the_spot import lead_by_feet, say_untold
from ..mocap.other_bodies import keep_legs, tell_smaller
from ..mocap.sampling import rig_as_posed, sample_parts
from ..mocap.styles import grouped, style_of
from ..recordings.traces import make_traces
from ..rig.bodies import keep_legs_of_skin
from ..rig.external_motion import external_motion
from ..rig.hanging import find_hanging
from ..rig.held import keep_held
from ..rig.rigs import carriers, make_rig
from ..rig.scaled import say_scaled
from ..rig.skeletons import difference
from . import classes
from .abilities import say_abilities
from .control_layout import keep_layout, layout_of
from .coverage import Row, makes_its_jumps, measure_coverage
from .staleness import digest_of, sources_of
from .storing import keep_policy, key_of, read_policy
from .stretched import StretchedPlayer

if TYPE_CHECKING:
    from fragmotion_core import BuildOptions, Character, Clip, Doubles, Player, Rig, Skeleton

_EXAM_SECONDS = 60.0
_EXAM_SEED = 7_001
_EXAMINERS = ("explorer", "runner")
_FROM_TAKES = ("captured", "mirrored")
_BUILD_SHARE = 0.95  # of the progress; the exam has the rest
_cache: dict[tuple[str, tuple[Any, ...]], Character] = {}  # by the policy's digest and classes.all_excluded()


class Built(NamedTuple):
    """A finished build: the character and how its policies did on a player that they did not learn from."""

    character: Character
    qualities: list[dict[str, float]]  # of each style: percent of Optimal; the first is of the policy that drives
    examiner: str
    done: list[list[bool]]  # of each style: whether each control is done as it is asked for
    sources: str = ""  # what it was built from, as staleness.sources_of tells it; empty where that is unknown


class Prepared(NamedTuple):
    """What a build has read of the file: the task that does the rest, and what the user should know of it."""

    task: Callable[[Report], Built]
    warnings: list[str]


class Material(NamedTuple):
    """What a build has read of the file to learn from, and what the user should know of it."""

    rig: Rig
    styles: list[tuple[str, list[Clip]]]  # as mocap.styles.grouped tells them
    traces: list[Doubles]
    options: BuildOptions
    warnings: list[str]

    @property
    def clips(self) -> list[Clip]:
        """Those of the first style."""
        return self.styles[0][1]

    def build(self, report: Report) -> Character:
        """The character in all styles."""
        rest = self.traces, self.options, report
        if not self.styles[0][0]:
            alone: Character = core.build(self.rig.skeleton, self.clips, *rest)
            return alone
        styled: Character = core.build_styles(self.rig.skeleton, self.styles, *rest)
        return styled


def gather(context: bpy.types.Context, obj: bpy.types.Object, settings: Any) -> Material:
    """Sample the ticked Actions; UserError on what cannot be built from."""
    takes = _ticked(obj)
    context.view_layer.update()
    keep_held(obj, actions.with_own_bones(obj))
    keep_legs_of_skin(obj, make_rig(obj))
    found = find_hanging(context, obj, takes)
    rig = make_rig(obj)
    carriers(obj, rig)
    other_bodies = keep_legs(obj, takes, rig)
    options = make_options(settings)
    traces = make_traces(obj, settings, options.usual_space)
    styled, warnings = _sample_all(context, obj, takes, rig)
    return Material(
        rig,
        grouped(styled),
        traces,
        options,
        [
            *say_lying([clip for _, clip in styled], rig.skeleton),
            *say_bobbing([clip for _, clip in styled], rig.skeleton),
            *found,
            *say_scaled(obj, takes),
            *say_feet(rig.skeleton),
            *tell_size(takes, rig.skeleton),
            *other_bodies,
            *warnings,
        ],
    )


def say_feet(skeleton: Skeleton) -> list[str]:
    """Which feet are not held, where it has more of them than those that are; or that none is known."""
    others = skeleton.other_feet()
    held = [bone for role, bone in skeleton.roles.items() if role.endswith("foot")]
    if not held:
        return [
            "No feet are known: none is held where it stands, and what is shown on the spot stays there. Choose a "
            "thigh and a foot on each side in Bones (Find Bones), of a leg without a foot its last bone, or key the "
            "root's way in the takes; then Build again"
        ]
    if not others:
        return []
    return [f"Held where they stand are {' and '.join(held)} alone; {', '.join(others)} go as in the takes"]


def prepare(context: bpy.types.Context, obj: bpy.types.Object, settings: Any) -> Prepared:
    """Sample the ticked Actions for a build; UserError on what cannot be built from."""
    material = gather(context, obj, settings)
    sources = sources_of(obj)
    teacher = settings.player if settings.trace_source == "PLAYER" else ""

    def task(report: Report) -> Built:
        character = material.build(lambda fraction, stage: report(_BUILD_SHARE * fraction, stage))
        report(_BUILD_SHARE, "Examining")
        return examine(character, teacher)._replace(sources=sources)

    return Prepared(task, material.warnings)


def examine(character: Character, teacher: str) -> Built:
    """Measure the character's policies, in each of its styles, on a simulated player who is not the teacher."""
    examiner = next(name for name in _EXAMINERS if name != teacher)
    qualities, done = [], []
    for styled in in_styles(character):
        exam = core.simulate_trace(examiner, _EXAM_SECONDS, _EXAM_SEED, styled.space)
        qualities.append({name: styled.percent_of_optimal(exam, name) for name in styled.policies})
        done.append(core.abilities(styled))
    return Built(character, qualities, examiner, done)


def in_styles(character: Character) -> list[Character]:
    """The character in each of its styles."""
    return [character.in_style(style) for style in range(max(len(character.style_names), 1))]


def _sample_all(
    context: bpy.types.Context, obj: bpy.types.Object, takes: list[bpy.types.Action], rig: Rig
) -> tuple[list[tuple[str, Clip]], list[str]]:
    """The takes as clips with the style of each, and what to warn of. Takes of a single pose are left out where there
    are others."""
    clips: list[tuple[str, Clip]] = []
    poses, warnings, hovering, smaller = [], [], [], []
    hands = hand_pose(context, obj, rig)
    for action in takes:
        try:
            with read_once():
                sampled = sample_parts(context, obj, action, rig)
                parts = lead_by_feet(context.scene, obj, action, sampled, rig.skeleton)
                ground = tell_ground(action, parts, rig.skeleton)
                hovering.extend([f"'{action.name}': {ground}"] if ground else [])
                small = tell_smaller(action, parts, rig.skeleton)
                smaller.extend([f"'{action.name}': {small}"] if small else [])
                clips.extend((style_of(action), with_hands(clip, rig, hands)) for clip in parts)
                digest_of(action)  # kept for sources_of
        except SinglePose:
            poses.append(action.name)
            if len(poses) == len(takes):
                raise
    if poses:
        warnings.append(f"Left out, as they hold a single pose: {', '.join(poses)}")
    if hovering:
        more = f" ({len(hovering) - 1} more do, too)" if len(hovering) > 1 else ""
        warnings.append(f"In {hovering[0]}, as Mend does in Doctor, or it is learned so{more}")
    if smaller:
        warnings.append(smaller[0] + (f" ({len(smaller) - 1} more like it)" if len(smaller) > 1 else ""))
    warnings.extend(say_untold(takes))
    others = external_motion(obj)
    if others:
        warnings.append(f"The takes were learned as Blender shows them, moved also by {'; '.join(others)}")
    return clips, warnings


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
    options.find_controls = settings.controls == "FOUND"
    if settings.controls == "TOLD":
        options.speeds, options.directions = settings.speeds, int(settings.directions)
        options.turn, options.jump = settings.turn, settings.jump
    return options


def keep(obj: bpy.types.Object, built: Built) -> None:
    """Store the character and its figures with the armature."""
    character, figures = _with_listed_moves(obj, built.character), obj.fragmotion.figures
    replace(obj, character)
    words = classes.words_of(obj)
    classes.keep_rows(obj.fragmotion.classes, character, words)
    figures.captured = sum(origin in _FROM_TAKES for origin in character.fragment_origins)
    figures.fragments = len(character.labels)
    figures.classes, figures.controls = character.table.shape
    figures.seconds = sum(styled.report.get("seconds", 0) for styled in in_styles(character))
    figures.stature = character.skeleton.stature
    figures.quality = next(iter(built.qualities[0].values()))
    figures.policies.clear()
    for policy, quality in built.qualities[0].items():
        row = figures.policies.add()
        row.name, row.quality = policy, quality
    _keep_styles(figures, built, words)
    figures.examiner, figures.sources = built.examiner, built.sources
    figures.abilities = say_abilities(built.done[0], layout_of(character.space))
    _keep_coverage(figures, character, built.done[0])


def coverage_by_style(built: Built) -> dict[str, list[Row]]:
    """How many controls are done in each style; empty where there are no styles."""
    styles = zip(built.character.style_names, in_styles(built.character), built.done)
    return {name: measure_coverage(done, layout_of(styled.space)) for name, styled, done in styles}


def _keep_styles(figures: Any, built: Built, words: dict[str, tuple[str, bool]]) -> None:
    figures.styles.clear()
    styles = zip(built.character.style_names, in_styles(built.character), built.qualities, built.done)
    for name, styled, qualities, done in styles:
        row = figures.styles.add()
        row.name, row.fragments, row.classes = name, len(styled.labels), len(styled.table)
        row.quality = next(iter(qualities.values()))
        _keep_coverage(row, styled, done)
        if len(figures.styles) > 1:  # the first style's are the armature's own
            classes.keep_rows(row.rows, styled, words)


def replace(obj: bpy.types.Object, character: Character) -> None:
    """Store a character with the same classes and figures in place of the armature's. Its moves may be others than the
    list's."""
    with core_errors():
        data = character.to_bytes()
    keep_policy(obj, data)
    obj.fragmotion.digest, obj.fragmotion.moves_told = key_of(obj), ""
    _cache.clear()
    _cache[obj.fragmotion.digest, ()] = character


def _with_listed_moves(obj: bpy.types.Object, character: Character) -> Character:
    """The character with the moves that the armature's former one has and the list knows, where it can have them: their
    Actions may be gone."""
    listed = {row.kept for row in obj.fragmotion.moves}
    if character.move_names or not listed or not has_character(obj):
        return character
    with suppress(UserError, ValueError):
        kept = [move for move in load_whole(obj).moves if move.name in listed]
        moved: Character = character.with_moves(kept)
        return moved
    return character


def _keep_coverage(figures: Any, character: Character, done: Sequence[bool]) -> None:
    figures.distances = np.asarray(character.coverage_distances, np.float32).tobytes()
    figures.makes_jumps = makes_its_jumps(character)
    figures.coverage.clear()
    keep_layout(figures, character.space)
    for name, performed, total in measure_coverage(done, layout_of(character.space)):
        row = figures.coverage.add()
        row.name, row.performed, row.total = name, performed, total
    figures.performed = sum(sum(row.performed) for row in figures.coverage)


def save_policy(obj: bpy.types.Object, path: Path) -> None:
    """Write the armature's character to a policy file; UserError where the file cannot be written."""
    character = load(obj)
    with core_errors():
        character.save(path)


def load_policy(context: bpy.types.Context, obj: bpy.types.Object, path: Path) -> None:
    """Give the armature the character of a policy file; UserError where it is damaged or of another skeleton."""
    character = _decode(read_regular(path, follow=True), f"'{path}'")
    context.view_layer.update()
    other = difference(character.skeleton, rig_as_posed(obj).skeleton, obj.data.bones.keys())
    if other:
        raise UserError(f"'{path}' was built for another skeleton than armature '{obj.name}' has: here {other}")
    keep(obj, examine(character, ""))


def has_character(obj: bpy.types.Object) -> bool:
    """Whether Build has been done for this armature."""
    return bool(obj.fragmotion.figures.classes > 0)


def load(obj: bpy.types.Object) -> Character:
    """The armature's character as it drives: never sent to the classes that are left out. Made once for each choice."""
    whole, excluded = load_whole(obj), classes.all_excluded(obj)
    classes.check_rows(obj, whole)
    if not excluded:
        return whole
    key = (next(digest for digest, left in _cache if not left), excluded)
    if key not in _cache:
        left = whole
        with core_errors(f"Armature '{obj.name}'"):
            for style, numbers in excluded:
                left = left.without(numbers, style)
        forget()
        _cache[key[0], ()], _cache[key] = whole, left
    return _cache[key]


def check_skeleton(obj: bpy.types.Object, character: Character, rig: Rig) -> None:
    """UserError where the armature's bones are not those that the character was built on."""
    changed = difference(character.skeleton, rig.skeleton, obj.data.bones.keys())
    if changed:
        raise UserError(f"Armature '{obj.name}' has changed since Build: {changed}. Undo that, or press Build again")


def player_options(obj: bpy.types.Object) -> dict[str, Any]:
    """What a player is told of how the armature is set to move."""
    feel = obj.fragmotion.feel
    return {"responsiveness": feel.responsiveness, "root_adjustment": feel.root_adjustment, "lock_feet": feel.lock_feet}


def make_player(obj: bpy.types.Object, character: Character, seed: int, policy: str = "") -> Player:
    """What plays the character, with the armature's settings of how it moves, and shown as its object shows it."""
    options, rise = {"seed": seed, "policy": policy, **player_options(obj)}, make_rig(obj).rise
    player: Player = core.Player(character, **options) if rise == 1 else StretchedPlayer(character, rise, **options)
    return player


def load_to_draw(obj: bpy.types.Object) -> Character:
    """As `load`, quick enough for drawing: it takes Build's word for what the policy holds."""
    character = _cache.get((obj.fragmotion.digest, classes.all_excluded(obj)))
    if character is None:
        return load(obj)
    classes.check_rows(obj, character)
    return character


def load_whole(obj: bpy.types.Object) -> Character:
    """The armature's character with all its classes; decoded once for each content."""
    key = (key_of(obj), ())
    if key not in _cache:
        character = _decode(read_policy(obj), f"The policy kept in armature '{obj.name}'")
        _cache.clear()
        _cache[key] = character
    return _cache[key]


def _decode(data: bytes, place: str) -> Character:
    """The character of a policy file's bytes; a UserError begins with the place."""
    with core_errors(place):
        character: Character = core.Character.from_bytes(data)
    return character


def forget() -> None:
    """Let go of all decoded characters."""
    _cache.clear()
