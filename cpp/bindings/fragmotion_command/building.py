# SPDX-License-Identifier: MIT
"""`fragmotion build` and `info`: a character of takes, and what one is."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

from .core import core
from .files import BY_BLENDER, find_takes
from .running import Done, listed
from .takes import led_by_feet, on_one_body, read_mended

CONTROLS = ("paper", "found", "told")
_NEUTRAL = "neutral"  # the style of takes that tell none, where others do


def build(options: argparse.Namespace) -> Done:
    """Build a character, and write its policy file."""
    if not options.policy:
        raise ValueError("nothing would be kept: say where to, by --policy")
    paths = find_takes(options.takes, BY_BLENDER)
    _styles_of(paths, options)
    settings = _settings(options)
    takes = read_mended(paths, options.unit)
    styles = _styles_of([each.path for each in takes], options)
    skeleton, clips = on_one_body(takes)
    parts = [[led.clip for led in led_by_feet(clip, skeleton)] for clip in clips]
    styles = [style for style, some in zip(styles, parts) for _ in some]
    clips = [clip for some in parts for clip in some]
    teacher = core.simulate_trace("explorer", 60, settings.seed, settings.usual_space)
    if any(styles):
        named = {name: [clip for clip, own in zip(clips, styles) if own == name] for name in sorted(set(styles))}
        styled = [(name or _NEUTRAL, some) for name, some in named.items()]
        character = core.build_styles(skeleton, styled, [teacher], settings)
    else:
        character = core.build(skeleton, clips, [teacher], settings)
    character.save(options.policy)
    return _described(character)


def _settings(options: argparse.Namespace) -> core.BuildOptions:
    settings = core.BuildOptions()
    tell_controls(settings, options)
    _tell(settings, options, "classes", "seed")
    return settings


def tell_controls(settings: core.BuildOptions, options: argparse.Namespace) -> None:
    """Tell a build which controls the options ask for."""
    settings.find_controls = controls_of(options) == "found"
    _tell(settings, options, "speeds", "directions", "turn", "jump")


def _tell(settings: core.BuildOptions, options: argparse.Namespace, *names: str) -> None:
    for name in names:
        if getattr(options, name) is not None:
            setattr(settings, name, getattr(options, name))


def controls_of(options: argparse.Namespace) -> str | None:
    """Which of CONTROLS a build is asked for, None where nothing says; ValueError where two things are said."""
    told = [name for name in ("directions", "jump", "speeds", "turn") if getattr(options, name) is not None]
    if options.controls not in (None, "told") and told:
        name = told[0] if told[0] in ("directions", "speeds") else f"no-{told[0]}"
        raise ValueError(f"--controls {options.controls} and --{name} say two different things: leave one out")
    return "told" if told else options.controls


def style_of(text: str) -> tuple[str, str]:
    """The name and the pattern of a --style; ValueError where there is none."""
    name, _, pattern = text.partition("=")
    if not (name and pattern):
        raise ValueError(f"--style {text} tells no name or no pattern, as in tired=*_tired_*")
    return name, pattern


def _styles_of(paths: Sequence[Path], options: argparse.Namespace) -> list[str]:
    """The style of each take, empty where it is of none: the last that fits of those that are told, else its folder's
    where that is to tell it."""
    styles = [path.parent.name if options.folder_styles else "" for path in paths]
    for text in options.style:
        name, pattern = style_of(text)
        fitting = [i for i, path in enumerate(paths) if fnmatchcase(path.stem.lower(), pattern.lower())]
        if not fitting:
            raise ValueError(f"--style {text}: no take's name fits; the first is called '{paths[0].stem}'")
        for i in fitting:
            styles[i] = name
    return ["" if style == _NEUTRAL else style for style in styles]


def info(options: argparse.Namespace) -> Done:
    """Tell what a policy file holds."""
    return _described(core.Character.load(options.character))


def _described(character: core.Character) -> Done:
    undone = core.undone_controls(character.space, core.abilities(character))
    figures: dict[str, Any] = {
        "bones": len(character.skeleton.names),
        "fragments": len(character.fragment_durations),
        "classes": len(character.class_names),
        "policies": character.policies,
        **({"styles": character.style_names} if character.style_names else {}),
        **({"moves": character.move_names} if character.move_names else {}),
        **dict(zip(character.space.gaits, character.space.speeds)),
        "directions": character.space.directions,
        "controls": len(character.space.points),
        **({"undone": undone} if undone else {}),
    }
    return Done(figures, listed(figures))
