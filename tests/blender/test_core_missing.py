# SPDX-License-Identifier: MIT
"""The add-on without its compiled core: one panel that says why, and nothing else."""

from __future__ import annotations

import importlib
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType, SimpleNamespace

import bpy
import pytest

CORELESS = "fragmotion_coreless"


@pytest.fixture
def coreless(addon: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[ModuleType]:
    """A copy of the installed add-on whose core is nowhere to be found."""
    assert addon.__file__
    ignored = shutil.ignore_patterns("fragmotion_core*", "__pycache__")
    shutil.copytree(Path(addon.__file__).parent, tmp_path / CORELESS, ignore=ignored)
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.setitem(sys.modules, "fragmotion_core", None)
    yield importlib.import_module(CORELESS)
    for name in [name for name in sys.modules if name.partition(".")[0] == CORELESS]:
        del sys.modules[name]


def lines(panel: type) -> list[str]:
    """What the panel shows."""
    shown: list[str] = []
    column = SimpleNamespace(label=lambda text, icon: shown.append(text))
    layout = SimpleNamespace(column=lambda align: column)
    panel.draw(SimpleNamespace(layout=layout, cause=panel.cause), None)  # type: ignore[attr-defined]
    return shown


def test_a_panel_says_what_is_missing_and_what_to_do(coreless: ModuleType) -> None:
    operators = set(dir(bpy.ops.fragmotion))
    coreless.register()
    try:
        panel = bpy.types.FRAGMOTION_PT_missing
        text = " ".join(lines(panel))
        assert f"Python {sys.version_info.major}.{sys.version_info.minor}" in text
        assert "is missing" in text and "install the zip made for this Blender" in text
        assert max(map(len, lines(panel))) <= 44
        assert set(dir(bpy.ops.fragmotion)) == operators
    finally:
        coreless.unregister()
    assert not hasattr(bpy.types, "FRAGMOTION_PT_missing")


def test_another_systems_zip_says_so(addon: ModuleType, tmp_path: Path) -> None:
    explain, error = addon.compat.missing.explain, ModuleNotFoundError("No module named 'fragmotion_core'")
    stranger = "fragmotion_core.cp311-win_amd64.pyd" if sys.platform != "win32" else "fragmotion_core.cpython-311.so"
    (tmp_path / stranger).touch()
    text = explain(error, tmp_path)
    assert text.startswith("This is Fragmotion for ") and text.count(".") == 2


def test_a_mac_that_locks_the_core_is_told_how_to_unlock_it(
    addon: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    error = ImportError("dlopen(core.so): code signature not valid for use in process", path="/Users/me/core.so")
    monkeypatch.setattr(addon.compat.missing.sys, "platform", "darwin")
    text = addon.compat.missing.explain(error, tmp_path)
    assert "xattr -dr com.apple.quarantine '/Users/me/core.so'" in text


def test_what_else_the_system_says_is_passed_on(addon: ModuleType, tmp_path: Path) -> None:
    text = addon.compat.missing.explain(ImportError("GLIBC_2.28 not found"), tmp_path)
    assert "GLIBC_2.28 not found" in text and "install the zip" in text
