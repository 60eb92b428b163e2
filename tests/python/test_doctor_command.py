# SPDX-License-Identifier: MIT
"""`fragmotion doctor`: what its JSON file says, folders at any depth, and files that cannot be read."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import pytest
from conftest import BANDAI, CMU
from fragmotion_command import main

FIELDS = [
    "path",
    "take",
    "format",
    "unit_m",
    "stature_m",
    "up",
    "facing",
    "rate",
    "root_motion",
    "rest_pose",
    "roles",
    "findings",
]
BVH = """HIERARCHY
ROOT hips
{
OFFSET 0 0 0
CHANNELS 3 Xposition Yposition Zposition
End Site
{
OFFSET 0 10 0
}
}
MOTION
Frames: 2
Frame Time: 0.01
0 0 0
0 0 1
"""


def examined(folder: Path, *files: Path) -> tuple[int, list[dict[str, Any]]]:
    """The exit code, and the files of the JSON file."""
    target = folder / "doctor.json"
    code = main(["doctor", *map(str, files), "--json", str(target)])
    return code, json.loads(target.read_text())["files"]


def test_a_plain_file_has_every_field(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "bone.bvh"
    path.write_text(BVH)
    code, files = examined(tmp_path, path)
    assert code == 0
    assert [list(file) for file in files] == [FIELDS]
    (finding,) = [f for f in files[0]["findings"] if f["code"] == "body"]
    assert list(finding) == ["code", "severity", "frames", "text", "mended"]
    assert (finding["severity"], finding["frames"], finding["mended"]) == ("error", [0, 1], False)
    assert finding["text"] in capsys.readouterr().out


def test_a_file_that_cannot_be_read_is_told_with_its_line(tmp_path: Path) -> None:
    broken, other, lonely = tmp_path / "broken.bvh", tmp_path / "deep" / "good.bvh", tmp_path / "take.amc"
    other.parent.mkdir()
    broken.write_text(BVH.replace("0 0 1", "0 nan 1"))
    other.write_text(BVH)
    lonely.write_text("1\nroot 0 0 0\n")
    code, files = examined(tmp_path, tmp_path)
    assert code == 1
    told = {Path(file["path"]).name: file["findings"][0] for file in files}
    assert told["broken.bvh"]["code"] == told["take.amc"]["code"] == "unreadable"
    assert "broken.bvh:15" in told["broken.bvh"]["text"]
    assert "take.asf" in told["take.amc"]["text"]
    assert told["good.bvh"]["code"] != "unreadable"


def test_hidden_files_do_not_count_and_nothing_is_an_error(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "._take.bvh").write_text("x")
    assert main(["doctor", str(tmp_path)]) == 1
    assert "no takes here" in capsys.readouterr().err
    assert main(["doctor", str(tmp_path / "nothing.bvh")]) == 1
    assert "no such file" in capsys.readouterr().err


def test_real_files_tell_their_units_and_axes(tmp_path: Path) -> None:
    if not BANDAI.is_dir() or not CMU.is_dir():
        pytest.skip("no motion capture beside the project")
    shutil.copy(sorted(BANDAI.glob("*.bvh"))[0], tmp_path / "bandai.bvh")
    code, files = examined(tmp_path, tmp_path, CMU)
    assert code == 0
    assert [file["format"] for file in files] == ["BVH", "ASF/AMC", "BVH", *["ASF/AMC"] * 4]
    told = [(file["up"], file["facing"], file["rest_pose"], file["root_motion"]) for file in files]
    assert told == [("+Y", None, "other", True), *[("+Y", "+Z", "T", True)] * 6]
    assert [file["unit_m"] for file in files] == pytest.approx([0.01, *[0.0254 / 0.45] * 6])
    assert all(1.4 < file["stature_m"] < 2.1 for file in files)
    assert files[0]["roles"]["left_foot"] == "Foot_L"
    assert [f["code"] for f in files[2]["findings"] if f["mended"]] == ["unit", "calibration"]
