# SPDX-License-Identifier: MIT
"""`fragmotion evaluate`: how a character follows traces; or how good the policies are that are learned from takes."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from importlib.util import find_spec

from .. import playing
from ..running import Done, say
from . import inputs, report
from .loading import Recordings, make_sessions, read_recordings, save_sessions
from .measuring import measure, measure_quickly


def evaluate(options: argparse.Namespace) -> Done:
    """Measure the character of a policy file, or one that is built of takes."""
    if inputs.is_character(options):
        return playing.evaluate(options)
    inputs.check(options)
    return evaluate_takes(options, read_recordings(options.sources, options.unit))


def evaluate_takes(options: argparse.Namespace, recordings: Recordings) -> Done:
    """Build a character of takes, measure it, and draw and save what is asked for; the options are checked."""
    if options.figures and not find_spec("matplotlib"):
        raise ValueError("--figures draws with matplotlib, which is not installed: python -m pip install matplotlib")
    sessions = make_sessions(options, recordings)
    if options.quick:
        result = measure_quickly(recordings, sessions, options)
        return Done(result, _text(report.quick_tables(result)))
    result = measure(recordings, sessions, options)
    if options.figures:
        from . import figures  # what it draws with need not be there

        save_sessions(sessions, options.figures / "traces")
        say(f"pictures: {', '.join(str(path) for path in figures.draw_all(result, options.figures))}")
        say(f"traces: {options.figures / 'traces'}")
    return Done(result, f"{report.summary(result)}\n\n{_text(report.tables(result))}")


def _text(tables: Iterable[report.Table]) -> str:
    return "\n\n".join(report.text(table) for table in tables)
