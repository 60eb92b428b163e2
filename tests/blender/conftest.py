# SPDX-License-Identifier: MIT
"""Fixtures of the tests inside Blender; `dev.py test blender-4.5` (or -5.2, -debian) gives the environment."""

from __future__ import annotations

import importlib
import os
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import bpy
import making
import pytest

_ZIP = "FRAGMOTION_ADDON_ZIP"


@pytest.fixture(scope="session")
def addon() -> Iterator[ModuleType]:
    """The add-on's package as it runs in this Blender: installed from the zip, and enabled."""
    if _ZIP not in os.environ:
        pytest.exit(f"{_ZIP} is not set: run these tests by `python3 dev.py test`", returncode=1)
    name = making.install(os.environ[_ZIP])
    assert name in bpy.context.preferences.addons, f"{name} was installed but is not enabled"
    module = importlib.import_module(name)
    assert module.__file__ and Path(os.environ["BLENDER_USER_RESOURCES"]) in Path(module.__file__).parents
    yield module
    bpy.ops.preferences.addon_disable(module=name)


@pytest.fixture(autouse=True)
def empty_file(addon: ModuleType, request: pytest.FixtureRequest) -> None:
    """Each test starts from an empty file, or from the built armature's, with the add-on enabled."""
    if "built" not in request.fixturenames:
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)


@pytest.fixture(scope="session")
def built(addon: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The sample file after Build, without its moves, saved."""
    making.open_sample().fragmotion.moves.clear()
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    path = tmp_path_factory.mktemp("built") / "built.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


@pytest.fixture
def obj(addon: ModuleType, built: Path) -> bpy.types.Object:
    """The built armature, active, after loading the file."""
    addon.character.building.forget()
    bpy.ops.wm.open_mainfile(filepath=str(built))
    return bpy.context.view_layer.objects.active


@pytest.fixture
def session(addon: ModuleType) -> Iterator[ModuleType]:
    """The add-on's module of drives; nothing is driven afterwards."""
    module = importlib.import_module(f"{addon.__name__}.drive.session")
    yield module
    module.stop()
