# SPDX-License-Identifier: MIT
"""`fragmotion play` and `evaluate`: what a character does under a trace."""

from __future__ import annotations

import argparse
from typing import Any

from .core import core
from .running import Done, listed

_SECONDS = 20.0  # that a simulated player plays
_EVALUATED_RATE = 60.0  # frames a second


def play(options: argparse.Namespace) -> Done:
    """Write the motion as a BVH file."""
    character = core.Character.load(options.character)
    player = core.Player(character, _seed(options))
    begin, asked = _asked(options, character)
    player.reset(style=begin)
    (trace,) = traces_of(options, character.in_style(begin)).values()
    performance = player.run(trace, options.rate, **{name: rows for name, rows in asked.items() if rows})
    clip = core.Clip(
        character.skeleton, options.bvh.stem, performance.rate, performance.root_positions, performance.rotations
    )
    core.write_bvh(core.Take.from_clip(clip, character.skeleton), options.bvh)
    figures = {"frames": len(performance.path), "rate": performance.rate}
    return Done(figures, listed(figures))


def _asked(options: argparse.Namespace, character: core.Character) -> tuple[int, dict[str, Any]]:
    """The style in which it begins, and what else the trace file asks for, as Player.run has it."""
    moves, styles, looks, reaches = core.read_asked(options.trace) if options.trace else ([], [], [], [])
    names = {"move": character.move_names, "style": character.style_names}
    changes = [(control, _number_of("style", name, names)) for control, name in styles]
    chosen = _number_of("style", options.style, names) if options.style else 0
    begin = changes[0][1] if changes and changes[0][0] == 0 else chosen
    numbered = [(control, _number_of("move", name, names), held) for control, name, held in moves]
    return begin, {"moves": numbered, "styles": changes, "looks": looks, "reaches": reaches}


def _number_of(what: str, name: str, names: dict[str, list[str]]) -> int:
    """The number of a move or a style; ValueError where the character does not have it."""
    known = names[what]
    if name not in known:
        raise ValueError(f"the character has no {what} '{name}': its {what}s are {', '.join(known) or 'none'}")
    return known.index(name)


def evaluate(options: argparse.Namespace) -> Done:
    """Measure how the character of a policy file follows traces."""
    character = core.Character.load(options.sources[0])
    traces = traces_of(options, character)
    return measured(
        character, {name: (trace, core.Player(character, _seed(options))) for name, trace in traces.items()}
    )


def measured(character: core.Character, played: dict[str, tuple[core.Doubles, core.Player]]) -> Done:
    """The figures of each trace as its player plays it."""
    rows = [{"trace": name, **_figures(character, *each)} for name, each in played.items()]
    text = "\n".join(f"{row['trace']}: {listed({k: v for k, v in row.items() if k != 'trace'})}" for row in rows)
    return Done({"traces": rows}, text)


def _figures(character: core.Character, trace: core.Doubles, player: core.Player) -> dict[str, Any]:
    performance = player.run(trace, _EVALUATED_RATE)
    return {
        "percent_of_optimal": character.percent_of_optimal(trace),
        "quality": performance.quality,
        "velocity_error": performance.velocity_error,
        "turn_error": performance.turn_error,
        "commanded_speed": performance.commanded_speed,
    }


def traces_of(options: argparse.Namespace, character: core.Character) -> dict[str, core.Doubles]:
    """The trace of the file or of the simulated player that is asked for, by what it is called; else all players'."""
    if options.trace:
        return {options.trace.stem: core.read_trace(options.trace)}
    seconds = _SECONDS if options.seconds is None else options.seconds
    players = [options.player] if options.player else core.PLAYERS
    return {name: core.simulate_trace(name, seconds, _seed(options), character.space) for name in players}


def _seed(options: argparse.Namespace) -> int:
    return 1 if options.seed is None else int(options.seed)
