# SPDX-License-Identifier: MIT
"""The ES module `fragmotion` in Node, and the live page in Chromium: keys in; places, texts and pictures out."""

from __future__ import annotations

import gzip
import json
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import BUILD, Poses, Run

from tools.games import web

SCRIPTS = Path(__file__).parent / "web"
PICTURES = BUILD / "pictures"
FRAME = 20.0  # us, at most
SMALL = 220_000  # bytes of WebAssembly as a server sends it


@pytest.fixture(scope="session")
def module() -> Path:
    """The module's folder."""
    return web.module()


@pytest.fixture(scope="session")
def played(in_unstable: Run, module: Path, sample: Path) -> dict[str, Any]:
    """What play.mjs tells, and the poses that it wrote."""
    BUILD.mkdir(parents=True, exist_ok=True)
    policy, poses = BUILD / "sample.policy", BUILD / "web.poses"
    shutil.copy(sample / "sample.policy", policy)
    told: dict[str, Any] = json.loads(in_unstable("node", SCRIPTS / "play.mjs", module, policy, poses))
    return {**told, "poses": np.fromfile(poses, np.float32)}


def test_node_shows_this_machines_poses(played: dict[str, Any], poses: Poses) -> None:
    theirs = played["poses"].reshape(poses.shape)
    np.testing.assert_allclose(theirs, poses, rtol=0, atol=1e-5)
    assert np.ptp(poses[..., :3]) > 0.5 and np.ptp(poses[..., 3:]) > 1


def test_a_frame_in_node_takes_some_microseconds(played: dict[str, Any]) -> None:
    print(f"{played['frame']:.1f} us")
    assert played["frame"] < FRAME


def test_it_tells_what_a_character_has(played: dict[str, Any]) -> None:
    assert [move["name"] for move in played["moves"]] == ["wave", "kick", "sit"]
    assert {style["name"] for style in played["styles"]} >= {"proud", "tired"}
    assert all(style["walk"] > 0.5 and len(style["classes"]) > 5 for style in played["styles"])
    assert played["moves"][2]["loops"] and played["moves"][0]["upperBody"] and not played["moves"][1]["upperBody"]


def test_it_goes_back_stands_on_ground_follows_a_path_and_is_many(played: dict[str, Any]) -> None:
    assert played["isBack"] and played["isOnSlope"] and played["isAlone"] and played["pathArrived"] == 1
    np.testing.assert_allclose(played["position"], [2, 0, -5], atol=0.3)
    assert {"foot down", "foot up", "take-off", "landing", "move begins"} <= set(played["events"])


def test_its_head_turns_to_what_it_looks_at(played: dict[str, Any]) -> None:
    gaze = played["gaze"]
    left, right = (np.angle(np.exp(1j * (gaze[way] - gaze["ahead"]))) for way in ("left", "right"))
    assert left > 0.4 and right < -0.4, gaze


def test_what_fails_says_why(played: dict[str, Any]) -> None:
    expected = {
        "noPolicy": "it is no Fragmotion policy file",
        "cutShort": "",
        "noMove": "99",
        "notANumber": "not a number",
        "noLook": "where it looks is 'down'; it can be as captured, ahead, at",
        "noSteer": "steer is 'wheel'; it can be character, world, camera, path",
        "fadesLater": "make another",
    }
    for name, part in expected.items():
        assert part in played["failures"][name] and len(played["failures"][name]) > 20, played["failures"]


def test_the_module_is_small_and_has_the_projects_version(module: Path, played: dict[str, Any]) -> None:
    package = json.loads((module / "package.json").read_text(encoding="utf-8"))
    assert package["version"] == played["version"]
    size = len(gzip.compress((module / "wasm.wasm").read_bytes()))
    print(f"{size} bytes of {(module / 'wasm.wasm').stat().st_size}")
    assert size < SMALL


def test_every_member_of_the_classes_is_in_the_types(module: Path) -> None:
    code, types = ((module / f"fragmotion.{end}").read_text(encoding="utf-8") for end in ("js", "d.ts"))
    player = code[code.index("class Player extends") : code.index("function writeInput")]
    names = {line.split("(")[0].strip() for line in player.splitlines() if line[:2] == "  " and line[2:3].isalpha()}
    names = {name.removeprefix("get ") for name in names if name.replace("get ", "").isidentifier()}
    assert {"step", "state", "save", "setGround"} <= names
    assert {
        name for name in names - {"constructor", "forget"} if f"{name}(" not in types and f"{name}:" not in types
    } == set()


@pytest.fixture(scope="session")
def page(in_unstable: Run, sample: Path) -> dict[str, Any]:
    """What page.mjs tells of the live page; its pictures are in build/engines/pictures."""
    folder = BUILD / "page"
    web.make(folder)
    (folder / "broken.policy").write_bytes((sample / "sample.policy").read_bytes()[:5000])
    PICTURES.mkdir(parents=True, exist_ok=True)
    told: dict[str, Any] = json.loads(in_unstable("node", SCRIPTS / "page.mjs", folder, PICTURES, seconds=900))
    return told


def test_keys_walk_run_and_jump(page: dict[str, Any]) -> None:
    start, forward, right = (page[name]["position"] for name in ("start", "forward", "right"))
    assert np.hypot(start[0], start[2]) < 0.1
    assert abs(forward[0]) < 0.7, "W goes where the camera looks"
    assert right[0] > 3 and np.hypot(*np.array(page["right"]["velocity"])[[0, 2]]) > 2, "Shift and D run to the right"
    assert page["walkErrors"] == []


def test_moves_styles_and_texts(page: dict[str, Any]) -> None:
    assert page["moves"] == ["wave", "kick", "sit"] and page["waved"]["upperBodyMove"] == 0
    assert all(word in page["text"] for word in ("plays", "m/s", "left", "right", "µs"))


def test_it_climbs_the_stairs(page: dict[str, Any]) -> None:
    assert 0.7 < page["up"]["position"][1] <= 1.25


def test_it_walks_the_path_that_the_mouse_drew(page: dict[str, Any]) -> None:
    assert page["drawn"] > 5
    np.testing.assert_allclose(page["arrived"]["position"], page["end"], atol=0.4)


def test_files_that_are_dropped_are_shown_or_said_to_be_wrong(page: dict[str, Any]) -> None:
    assert "Drop a .policy" in page["dropped"]["nothing"]
    assert "together with the .glb" in page["dropped"]["mesh"]
    assert len(page["dropped"]["broken"]) > 20
    assert page["dropped"]["both"] == ""


def test_what_is_missing_is_said(page: dict[str, Any]) -> None:
    assert "WebGL 2" in page["noWebGL"] and "WebAssembly" in page["noWasm"]


def test_a_frame_in_chromium_takes_twenty_microseconds_at_most(page: dict[str, Any]) -> None:
    print(f"{page['cost']:.1f} us")
    assert page["cost"] < FRAME


def test_a_crowd_of_five_hundred_is_shown_sixty_times_a_second_by_two_cores(page: dict[str, Any]) -> None:
    """By what all of the browser takes of the cores for a picture, as other programs run beside it here."""
    print(f"{page['crowdTakes']:.1f} ms, {page['seen']} seen, {page['crowdRate']:.0f} pictures a second")
    assert page["isPlain"], "it draws by the cores"
    assert page["seen"] > 100
    assert page["crowdTakes"] < 2 * 1000 / 60


def test_its_head_follows_the_pointer(page: dict[str, Any]) -> None:
    assert abs(np.angle(np.exp(1j * (page["heads"][0] - page["heads"][1])))) > 0.4
