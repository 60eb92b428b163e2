# SPDX-License-Identifier: GPL-3.0-or-later
"""What the user can put right is a UserError: raised where it is found, reported once by the operator."""

from __future__ import annotations

import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
from typing import Any


class UserError(Exception):
    """What was wrong, where, and what to do about it."""


class SinglePose(UserError):
    """An Action that lasts one frame only, so that there is no motion to learn from."""


@contextmanager
def core_errors(place: str = "") -> Iterator[None]:
    """Turn the core's ValueError into a UserError that begins with the place."""
    try:
        yield
    except ValueError as error:
        raise UserError(f"{place}: {error}" if place else str(error)) from error


def reported(method: Callable[..., set[str]]) -> Callable[..., set[str]]:
    """Make an operator's method report a UserError as its one message, and end as cancelled."""

    def run(self: Any, *arguments: Any) -> set[str]:
        try:
            return method(self, *arguments)
        except UserError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}

    return _as_operator(method, run)


def ends_on_error(method: Callable[..., set[str]]) -> Callable[..., set[str]]:
    """Make a method of an operator that holds something open (a drive, a preview, a job) let go of it by the operator's
    `abandon(context)` on any error, and report that as its one message; what a UserError says is said as it is. An
    `invoke` adds its modal handler last of all: Blender frees an operator that then ends as cancelled."""

    def run(self: Any, context: Any, *arguments: Any) -> set[str]:
        try:
            return method(self, context, *arguments)
        except Exception as error:
            if not isinstance(error, UserError):
                traceback.print_exc()
            words = str(error) if isinstance(error, UserError) else f"{self.bl_label} has ended: {error}"
            try:
                self.abandon(context)
            except Exception:  # the first error is the one to be told
                traceback.print_exc()
            self.report({"ERROR"}, words)
            return {"CANCELLED"}

    held = _as_operator(method, run)
    held.ends_on_error = True  # type: ignore[attr-defined]
    return held


def _as_operator(method: Callable[..., set[str]], run: Callable[..., set[str]]) -> Callable[..., set[str]]:
    """Have `run` in the method's place. Blender counts a method's parameters, so each must be written out."""

    def execute(self: Any, context: Any) -> set[str]:
        return run(self, context)

    def handle(self: Any, context: Any, event: Any) -> set[str]:
        return run(self, context, event)

    return wraps(method)(execute if method.__name__ == "execute" else handle)
