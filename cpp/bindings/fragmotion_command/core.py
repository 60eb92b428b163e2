# SPDX-License-Identifier: MIT
"""The core as `core`: beside this package where an add-on holds both, else a module of its own."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import fragmotion_core as core
else:
    _BESIDE = __package__.rpartition(".")[0]
    core = import_module(f"{_BESIDE}.fragmotion_core" if _BESIDE else "fragmotion_core")

__all__ = ["core"]
