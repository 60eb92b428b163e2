# SPDX-License-Identifier: MIT
"""The core as `core`: beside this package where an add-on holds both, else a module of its own."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

BESIDE = __package__.rpartition(".")[0]
"""The add-on that holds this package; empty where it is one of its own."""

if TYPE_CHECKING:
    import fragmotion_core as core
else:
    core = import_module(f"{BESIDE}.fragmotion_core" if BESIDE else "fragmotion_core")

__all__ = ["BESIDE", "core"]
