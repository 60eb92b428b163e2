# SPDX-License-Identifier: MIT
"""What `fragmotion evaluate` reads: takes and their skeletons, and bad input."""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path

import fragmotion_core as core
import numpy as np
import pytest
from conftest import NAMES, walking_arrays
from evaluated import command, write_bvh
from fragmotion_command.evaluate import loading
from fragmotion_command.files import find_takes
from fragmotion_command.takes import read_take

from tools.paths import TOP

pytest_plugins = ["evaluated"]


@pytest.mark.thorough
@pytest.mark.bpy
def test_the_sample_rigs_actions_are_takes() -> None:
    """In a process of its own: bpy is no neighbour for other tests."""
    if find_spec("bpy") is None:
        pytest.skip("Blender's module bpy is not installed here")
    code = (
        "import sys; from pathlib import Path; from tools.measuring.blend import read_recordings as read;"
        "r = read([Path(sys.argv[1])], 0.01); print('read:', len(r.clips), len(r.skeleton.names), r.skeleton.stature)"
    )
    command = [sys.executable, "-c", code, str(TOP / "sample_rigs" / "fragmotion_sample.blend")]
    answer = subprocess.run(command, cwd=TOP, capture_output=True, text=True, check=True)
    said = next(line for line in answer.stdout.splitlines() if line.startswith("read:"))  # Blender speaks, too
    takes, bones, stature = said.split()[1:]
    assert int(takes) >= 20 and int(bones) >= 15 and 1.5 < float(stature) < 2.1


def empty_folder(folder: Path) -> list[str | Path]:
    (folder / "empty").mkdir()
    return [folder / "empty"]


def other_skeleton(folder: Path) -> list[str | Path]:
    names = [name.replace("spine", "back") for name in NAMES]
    write_bvh(folder / "other.bvh", names, *walking_arrays())
    return [folder / "take.bvh", folder / "other.bvh"]


def broken_trace(folder: Path) -> list[str | Path]:
    (folder / "bad.csv").write_text("velocity_x,velocity_y,turn,jump\n0,1,0,0\n0,fast,0,0\n")
    return [folder / "take.bvh", "--train", folder / "bad.csv"]


def short_trace(folder: Path) -> list[str | Path]:
    (folder / "short.csv").write_text("velocity_x,velocity_y,turn,jump\n0,1,0,0\n")
    return [folder / "take.bvh", "--test", folder / "short.csv"]


def namesakes(folder: Path) -> list[str | Path]:
    (folder / "a").mkdir()
    for path in (folder / "p.csv", folder / "a" / "p.csv"):
        core.write_trace(path, core.simulate_trace("walker", 5))
    return [folder / "take.bvh", "--test", folder / "p.csv", folder / "a" / "p.csv"]


def broken_take(folder: Path) -> list[str | Path]:
    (folder / "broken.bvh").write_text("HIERARCHY\nROOT hips\n")
    return [folder / "broken.bvh"]


BAD: list[tuple[Callable[[Path], list[str | Path]], str]] = [
    (lambda folder: [folder / "nowhere"], "nowhere: there is no such file or folder"),
    (empty_folder, "empty: no takes here"),
    (lambda folder: [folder / "take.bvh", TOP / "dev.py"], "dev.py: not motion capture"),
    (broken_take, "broken.bvh:"),
    (other_skeleton, "other.bvh: its skeleton is not that of take.bvh: bone 'back'"),
    (lambda folder: [folder / "take.bvh", "--train", folder / "none.csv"], "none.csv: there is no such trace file"),
    (broken_trace, "bad.csv:3:"),
    (short_trace, "short.csv"),
    (namesakes, "2 traces are called p"),
    (lambda folder: [folder / "take.bvh", "--responsiveness", "1.5"], "--responsiveness is 1.5"),
    (
        lambda folder: [folder / "take.bvh", "--quick", "--figures", folder / "f"],
        "--figures draws what --quick does not",
    ),
    (lambda folder: [folder / "take.bvh", "--json", folder / "take.bvh" / "x.json"], "take.bvh: not a folder"),
    (lambda folder: [folder / "take.bvh", "--player", "walker"], "--player is for characters, and"),
    (lambda folder: [folder / "hero.policy", "--no-turn"], "hero.policy is a character: leave it out"),
]


@pytest.mark.parametrize(("prepare", "cause"), BAD)
def test_bad_input_is_one_line_and_exit_code_1(
    prepare: Callable[[Path], list[str | Path]],
    cause: str,
    takes: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    shutil.copy(takes / "gait_1.bvh", tmp_path / "take.bvh")
    (tmp_path / "hero.policy").touch()
    assert command(*prepare(tmp_path)) == 1
    message = capsys.readouterr().err.splitlines(keepends=True)[-1]
    assert cause in message and message.count("\n") == 1 and message.startswith("fragmotion: ")


@pytest.mark.parametrize(
    ("name", "start", "advice"),
    [
        ("walk.txt", b"HIERARCHY\nROOT hips", "it is a BVH file, so call it walk.bvh"),
        ("walk.txt", "\ufeffHierarchy".encode("utf-16-le"), "it is a BVH file, so call it walk.bvh"),
        ("walk.bvh.gz", b"\x1f\x8b\x08", "it is an archive, so unpack it first"),
        ("notes.txt", b"Walks of Monday", ""),
    ],
)
def test_a_take_by_another_name_is_told(tmp_path: Path, name: str, start: bytes, advice: str) -> None:
    (tmp_path / name).write_bytes(start)
    with pytest.raises(ValueError, match=rf"{name}: not motion capture that is read \(.*\)(: )?{advice}$"):
        find_takes([tmp_path / name])


def test_pictures_say_what_to_install(
    takes: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)  # as where it is not installed
    assert command(takes, "--figures", tmp_path / "figures") == 1
    assert "matplotlib, which is not installed: python -m pip install matplotlib" in capsys.readouterr().err


def test_an_amc_goes_with_its_asf(tmp_path: Path) -> None:
    for name in ("02.asf", "07.asf", "02_01.amc", "._02_01.amc"):
        (tmp_path / name).touch()
    assert [path.name for path in find_takes([tmp_path])] == ["02_01.amc"]
    assert core.find_asf(tmp_path / "02_01.amc") == tmp_path / "02.asf"
    (tmp_path / "09_01.amc").touch()
    with pytest.raises(ValueError, match=r"09_01\.amc: its skeleton 09\.asf is not in the folder"):
        read_take(tmp_path / "09_01.amc")


def test_takes_are_mended_before_they_are_measured(takes: Path, tmp_path: Path) -> None:
    core.write_bvh(core.read_bvh(takes / "gait_1.bvh"), tmp_path / "metres.bvh", 1.0)
    told, plain = (loading.read_recordings([path], None) for path in (tmp_path / "metres.bvh", takes / "gait_1.bvh"))
    assert told.skeleton.stature == pytest.approx(plain.skeleton.stature)


def test_takes_in_a_file_are_those_that_were_written(takes: Path) -> None:
    """The oracle of this file's own writer: the walk goes forward as far as it was made to."""
    clip = loading.read_recordings([takes / "gait_1.bvh"], 0.01).clips[0]
    roots, _ = walking_arrays(1.2)
    np.testing.assert_allclose(clip.root_positions - clip.root_positions[0], roots - roots[0], atol=1e-4)
