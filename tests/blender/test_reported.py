# SPDX-License-Identifier: MIT
"""What the user can put right is said by the operator, whichever of its methods finds it."""

from __future__ import annotations

from collections.abc import Iterator
from types import ModuleType
from typing import Any

import bpy
import making
import numpy as np
import pytest


def methods(addon: ModuleType) -> Iterator[tuple[str, Any]]:
    """The add-on's own methods by which Blender begins any of its operators."""
    for name in dir(bpy.ops.fragmotion):
        operator = getattr(bpy.types, f"FRAGMOTION_OT_{name}")
        for each in ("execute", "invoke"):
            method = getattr(operator, each, None)
            owner = next((base for base in operator.__mro__ if each in vars(base)), None)
            if method is not None and owner is not None and owner.__module__.startswith(addon.__name__):
                yield f"{operator.__name__}.{each}", method


def test_every_operator_reports_what_the_user_can_put_right(addon: ModuleType) -> None:
    known = dict(methods(addon))
    handlers = {addon.errors.reported(made).__code__ for made in (_execute, _invoke)}
    assert len(known) > 50, "the add-on's operators are found"
    assert [name for name, method in known.items() if method.__code__ not in handlers] == []


def _execute(self: Any, context: Any) -> set[str]:
    raise NotImplementedError


_execute.__name__ = "execute"


def _invoke(self: Any, context: Any, event: Any) -> set[str]:
    raise NotImplementedError


def test_a_damaged_recording_has_no_curves_and_that_is_one_sentence(addon: ModuleType) -> None:
    obj = making.add_armature()
    recordings = addon.recordings.recordings
    recordings.add_recording(obj, np.zeros((20, 4)), seed=1, policy="", start=(0, 0, 0), quality=0.0)
    obj.fragmotion.recordings[0].controls = b"damaged"
    with pytest.raises(RuntimeError, match="damaged") as failure:
        bpy.ops.fragmotion.edit_curves()
    assert "Traceback" not in str(failure.value)
