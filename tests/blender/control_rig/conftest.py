# SPDX-License-Identifier: MIT
"""Control rigs to bind."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import bpy
import layouts
import making
import pytest

_status: list[int] = []

# Each look at Rigify's 700 bones takes seconds.
RIGS = [pytest.param("rigify", marks=pytest.mark.thorough), "FK", "IK"]


@pytest.fixture(scope="session")
def rigify_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A file with the rig that Rigify generates from its human meta-rig."""
    if sys.platform == "win32":
        pytest.skip("Windows: Rigify and what binds its rig are the same Python there")
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    rig = layouts.rigify_human()
    making.activate(rig)
    path = tmp_path_factory.mktemp("rigify") / "rigify.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


@pytest.fixture(scope="session")
def bound_file(rigify_file: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A file with Rigify's human rig, bound."""
    bpy.ops.wm.open_mainfile(filepath=str(rigify_file))
    assert bpy.ops.fragmotion.bind_rig() == {"FINISHED"}
    path = tmp_path_factory.mktemp("bound") / "bound.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


@pytest.fixture
def rigify(addon: object, rigify_file: Path) -> bpy.types.Object:
    """Rigify's human rig, active."""
    bpy.ops.wm.open_mainfile(filepath=str(rigify_file))
    return bpy.context.view_layer.objects.active


@pytest.fixture(params=RIGS)
def rig(request: pytest.FixtureRequest) -> bpy.types.Object:
    """Rigify's human rig, and another one with legs by FK and IK, or by IK alone; active."""
    if request.param == "rigify":
        return request.getfixturevalue("rigify")
    return layouts.add_layout(fk_legs=request.param == "FK")


@pytest.fixture(params=RIGS)
def bound(request: pytest.FixtureRequest, addon: object) -> bpy.types.Object:
    """One of these rigs, bound."""
    if request.param == "rigify":
        bpy.ops.wm.open_mainfile(filepath=str(request.getfixturevalue("bound_file")))
    else:
        layouts.add_layout(fk_legs=request.param == "FK")
        assert bpy.ops.fragmotion.bind_rig() == {"FINISHED"}
    return bpy.context.view_layer.objects.active


def pytest_sessionfinish(exitstatus: int) -> None:
    """Note how the tests went."""
    _status.append(int(exitstatus))


@pytest.hookimpl(trylast=True)
def pytest_unconfigure() -> None:
    """End here: bpy 4.5 hangs at exit where Rigify has generated a rig."""
    if bpy.app.version[:2] == (4, 5) and _status:
        sys.stdout.flush()
        os._exit(_status[-1])
