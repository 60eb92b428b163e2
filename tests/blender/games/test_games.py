# SPDX-License-Identifier: MIT
"""A character leaves Blender with its mesh: as two files, and to a browser on this machine."""

from __future__ import annotations

import json
import struct
import urllib.error
import urllib.request
import webbrowser
from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import pytest


def gltf(data: bytes) -> Any:
    """What a .glb says in JSON."""
    magic, _, _, length = struct.unpack("<4sIII", data[:16])
    assert magic == b"glTF"
    return json.loads(data[20 : 20 + length])


def asked(address: str, **headers: str) -> Any:
    return urllib.request.urlopen(urllib.request.Request(address, headers=headers), timeout=20)


@pytest.fixture
def page(addon: ModuleType, tmp_path: Path) -> Path:
    """A folder that looks like the live page, named in the preferences."""
    folder = tmp_path / "page"
    (folder / "fragmotion").mkdir(parents=True)
    (folder / "index.html").write_text("the page")
    (folder / "fragmotion" / "fragmotion.js").write_text("export {}")
    bpy.context.preferences.addons[addon.__name__].preferences.live_page = str(folder)
    return folder


def test_the_policy_and_the_mesh_with_its_bones_are_saved_side_by_side(
    addon: ModuleType, obj: bpy.types.Object, tmp_path: Path
) -> None:
    selected, mode = list(bpy.context.selected_objects), obj.data.pose_position
    assert bpy.ops.fragmotion.export_to_game(filepath=str(tmp_path / "hero.policy")) == {"FINISHED"}
    assert sorted(path.name for path in tmp_path.iterdir()) == ["hero.glb", "hero.policy"]
    assert (tmp_path / "hero.policy").read_bytes() == addon.character.building.load(obj).to_bytes()
    told = gltf((tmp_path / "hero.glb").read_bytes())
    (skin,) = told["skins"]
    bones = {told["nodes"][joint]["name"] for joint in skin["joints"]}
    assert set(addon.character.building.load(obj).skeleton.names) <= bones
    assert len(told["meshes"]) >= 1 and "animations" not in told
    assert (list(bpy.context.selected_objects), obj.data.pose_position) == (selected, mode)


def test_without_a_mesh_nothing_is_saved(addon: ModuleType, obj: bpy.types.Object, tmp_path: Path) -> None:
    for mesh in [thing for thing in bpy.data.objects if thing.type == "MESH"]:
        bpy.data.objects.remove(mesh)
    with pytest.raises(RuntimeError, match="No mesh in sight is moved by armature 'Fragmotion Sample'"):
        bpy.ops.fragmotion.export_to_game(filepath=str(tmp_path / "hero"))
    with pytest.raises(RuntimeError, match="No mesh in sight"):
        bpy.ops.fragmotion.export_to_game(filepath=str(tmp_path / "no folder" / "hero"))
    assert list(tmp_path.iterdir()) == []


def test_a_body_that_a_bone_makes_larger_is_not_saved_smaller(
    addon: ModuleType, obj: bpy.types.Object, tmp_path: Path
) -> None:
    obj.pose.bones["root"].scale = (2, 2, 2)
    addon.mocap.sampling.rig_as_posed(obj)
    with pytest.raises(RuntimeError, match=r"Bone 'root' .* 2 times as large as it rests"):
        bpy.ops.fragmotion.export_to_game("EXEC_DEFAULT", filepath=str(tmp_path / "large"))
    assert not list(tmp_path.iterdir())


def test_a_folder_that_is_not_there_is_said(obj: bpy.types.Object, tmp_path: Path) -> None:
    with pytest.raises(RuntimeError, match=r"no folder' takes no files \(No such file.*\): choose another folder"):
        bpy.ops.fragmotion.export_to_game(filepath=str(tmp_path / "no folder" / "hero"))


def test_the_browser_is_opened_on_the_page_with_the_character(
    addon: ModuleType, obj: bpy.types.Object, page: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened: list[str] = []
    monkeypatch.setattr(webbrowser, "open", opened.append)
    assert bpy.ops.fragmotion.open_in_browser() == {"FINISHED"}
    (address,) = opened
    root, query = address.split("?")
    assert query == "policy=own.policy&glb=own.glb"
    assert asked(root).read() == b"the page"
    assert asked(f"{root}own.policy").read() == addon.character.building.load(obj).to_bytes()
    assert gltf(asked(f"{root}own.glb").read())["skins"]
    assert asked(f"{root}fragmotion/fragmotion.js").headers["Content-Type"] == "text/javascript"
    with pytest.raises(urllib.error.HTTPError, match="403"):
        asked(f"{root}own.policy", Host="elsewhere.example")
    addon.games.serving.stop()
    with pytest.raises(urllib.error.URLError):
        asked(root)


def test_a_page_that_is_not_there_is_said(addon: ModuleType, obj: bpy.types.Object, page: Path) -> None:
    (page / "fragmotion" / "fragmotion.js").unlink()
    with pytest.raises(RuntimeError, match=r"is not the live page: make it by `dev\.py web FOLDER`"):
        bpy.ops.fragmotion.open_in_browser()
    bpy.context.preferences.addons[addon.__name__].preferences.live_page = ""
    with pytest.raises(RuntimeError, match="The live page is not on this machine"):
        bpy.ops.fragmotion.open_in_browser()
