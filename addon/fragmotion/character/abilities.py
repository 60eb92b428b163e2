# SPDX-License-Identifier: GPL-3.0-or-later
"""What a character can do, in words."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ..compat.core import core
from ..mocap.left_out import source_of
from ..recordings.recordings import TRACE_RATE
from .control_layout import ControlLayout, layout_of

if TYPE_CHECKING:
    from fragmotion_core import Character, ControlSpace
    from numpy.typing import NDArray

NOTHING = "Hardly moves: none of its takes goes anywhere, as far as can be told"
_VERBS = {"stroll": "strolls", "walk": "walks", "jog": "jogs", "run": "runs", "sprint": "sprints"}
_MOST = 3 / 4  # of so many: as good as all
_MADE = "standing"  # what the core names a stand that no take shows
_SAID = 4  # takes, by their names
_STANDS = 20, 10.0  # s that it is looked at, frames a second


def say_abilities(done: Sequence[bool], layout: ControlLayout) -> str:
    """A sentence of what is done of the controls [controls]; NOTHING where it goes nowhere."""
    table = np.asarray(done, bool).reshape(layout.shape)
    middle = layout.shape[1] // 2  # of the turns: none
    going = {
        gait: table[1 + i * layout.directions : 1 + (i + 1) * layout.directions] for i, gait in enumerate(layout.gaits)
    }
    ways = {gait: _ways(some[:, middle, 0], layout) for gait, some in going.items()}
    if not any(ways.values()):
        return NOTHING
    clauses = [" and ".join(_phrases(ways))]
    if layout.turn:
        clauses += _turns({gait: np.delete(some, middle, 1)[:, :, 0] for gait, some in going.items() if ways[gait]})
    clauses += [f"no {gait}" for gait in layout.gaits if not ways[gait]]
    if layout.jump:
        clauses.append("jumps" if table[:, :, 1].any() else "no jumps")
    told = "; ".join(clauses)
    return told[0].upper() + told[1:]


def say_undone(done: Sequence[bool], space: ControlSpace) -> str:
    """Which ways to go are not done as they are asked for, and what is done instead; empty where all are, or none."""
    undone = core.undone_controls(space, done)
    if not undone or say_abilities(done, layout_of(space)) == NOTHING:
        return ""
    return (
        f"Cannot {', '.join(undone)} as it is asked to: no take shows how, and none could be made that does. "
        "What comes nearest is done instead"
    )


def say_stand(character: Character) -> str:
    """What it stands as, where that is not what its takes name an idle; empty where it is, and where they name none."""
    takes = (_take_of(character.clip_names[clip]) for clip in np.unique(character.fragment_clips))
    named = list(dict.fromkeys(filter(core.names_idle, takes)))
    seconds, rate = _STANDS
    shown = core.Player(character, 1).run(np.zeros((seconds * TRACE_RATE, 4)), rate).fragments
    counts = Counter(_take_of(character.clip_names[clip]) for clip in character.fragment_clips[shown])
    others = [take for take, _ in counts.most_common() if take not in named]
    if not named or 2 * sum(counts[take] for take in others) <= len(shown):
        return ""
    what = f"as in '{others[0]}'" if others[0] != _MADE else "in a pose that is made"
    return (
        f"Who is not asked to go stands {what}, not as in '{named[0]}': untick what is neither a gait nor a stand, and "
        "Build again; it may be a move"
    )


def say_acts(character: Character) -> str:
    """Which takes nothing is learned from, as others show how it stands, or as they are T poses or too short; empty
    where there are none."""
    takes, shown = map(_take_of, character.clip_names), np.bincount(character.fragment_clips)
    learned: dict[str, bool] = {}
    for clip, take in enumerate(takes):
        learned[take] = learned.get(take, False) or (clip < len(shown) and shown[clip] > 0)
    idle = next((take for take, is_learned in learned.items() if is_learned and core.names_idle(take)), "")
    acts = [f"'{take}'" for take, is_learned in learned.items() if not is_learned]
    if not acts:
        return ""
    more = f" and {len(acts) - _SAID} more" if len(acts) > _SAID else ""
    why = (
        f"'{idle}' is how it stands; what does nothing but stand besides is left out"
        if idle
        else "Nothing is learned from what only stands while what goes shows how it stands, or is too short"
    )
    return f"{why}: {', '.join(acts[:_SAID])}{more}. It may be a move, or is a stand if its name says idle"


def _take_of(clip: str) -> str:
    """The take that a clip of a character is, or is made of."""
    while (name := clip.removesuffix(" transformed").removesuffix(" mirrored")) != clip:
        clip = name
    return source_of(clip)[0]


def _phrases(ways: dict[str, str]) -> list[str]:
    """As 'walks and runs in all directions': what goes the same ways is said together."""
    phrases = []
    for way in dict.fromkeys(filter(None, ways.values())):
        phrases.append(f"{' and '.join(_VERBS[gait] for gait in ways if ways[gait] == way)} {way}")
    return phrases


def _ways(done: NDArray[np.bool_], layout: ControlLayout) -> str:
    if done.all():
        return "in all directions"
    if done.sum() >= _MOST * len(done):
        lacking = [name for name, is_done in zip(layout.direction_names, done) if not is_done]
        return f"in all directions but {' and '.join(lacking)}"
    return ", ".join(name for name, is_done in zip(layout.direction_names, done) if is_done)


def _turns(done: dict[str, NDArray[np.bool_]]) -> list[str]:
    """What is lacking of the turns of each gait."""
    none = [gait for gait, some in done.items() if not some.any()]
    few = [gait for gait, some in done.items() if some.any() and some.mean() < _MOST]
    return [f"{much} turns at a {' or a '.join(gaits)}" for much, gaits in (("no", none), ("few", few)) if gaits]
