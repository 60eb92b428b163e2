# SPDX-License-Identifier: MIT
"""Names of bones and files that are not UTF-8, as those of old files from Japan and western Europe."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import fragmotion_core as core
import pytest
from conftest import make_skeleton, walking_arrays
from policy_reader import checksum

NAMES = {"latin-1": ["Hüfte", "Rücken"], "shift_jis": ["腰", "ポンチ"], "utf-8": ["腰", "Rücken"]}


def bvh_of(encoding: str) -> bytes:
    hips, spine = NAMES[encoding]
    text = (
        f"HIERARCHY\nROOT {hips}\n{{\nOFFSET 0 90 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n"
        f"JOINT {spine}\n{{\nOFFSET 0 20 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n"
        "End Site\n{\nOFFSET 0 20 0\n}\n}\n}\nMOTION\nFrames: 2\nFrame Time: 0.01\n0 0 5 0 0 0\n0 0 6 0 0 0\n"
    )
    return text.encode(encoding)


@pytest.mark.parametrize("encoding", NAMES)
def test_takes_of_any_encoding_are_read(tmp_path: Path, encoding: str) -> None:
    path = tmp_path / "take.bvh"
    path.write_bytes(bvh_of(encoding))
    take = core.read_bvh(path)
    expected = [name if encoding == "utf-8" else name.encode(encoding).decode("latin-1") for name in NAMES[encoding]]
    assert take.skeleton.names == expected
    assert core.Clip.from_take(take).root_positions.shape == (2, 3)


def test_acclaim_files_find_each_others_bones(tmp_path: Path) -> None:
    asf = (
        ":bonedata\nbegin\nname Rücken\ndirection 0 1 0\nlength 3\naxis 0 0 0 XYZ\ndof rx\nend\n"
        ":hierarchy\nbegin\nroot Rücken\nend\n"
    )
    (tmp_path / "take.asf").write_bytes(asf.encode("latin-1"))
    (tmp_path / "take.amc").write_bytes("1\nRücken 5\n2\nRücken 6\n".encode("latin-1"))
    take = core.read_asf_amc(tmp_path / "take.asf", tmp_path / "take.amc")
    assert take.skeleton.names == ["root", "Rücken"]


def test_a_files_name_may_be_any_text(tmp_path: Path, character: core.Character) -> None:
    path = tmp_path / "tänze 舞 и.bvh"
    path.write_bytes(bvh_of("utf-8"))
    assert core.read_bvh(path).name == path.stem
    path.write_bytes(b"nonsense")
    with pytest.raises(ValueError, match=rf"{path.name}:1: 'HIERARCHY' expected"):
        core.read_bvh(path)
    character.save(path.with_suffix(".policy"))
    assert core.Character.load(path.with_suffix(".policy")).to_bytes() == character.to_bytes()


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has text for the names of files, not bytes")
def test_a_files_name_may_be_any_bytes(tmp_path: Path) -> None:
    path = os.fsencode(tmp_path / "tanz") + b"\xe9.bvh"
    Path(os.fsdecode(path)).write_bytes(bvh_of("utf-8"))
    assert core.read_bvh(os.fsdecode(path)).name == "tanzé"
    Path(os.fsdecode(path)).write_bytes(b"nonsense")
    with pytest.raises(ValueError, match="HIERARCHY") as refusal:
        core.read_bvh(os.fsdecode(path))
    assert type(refusal.value) is ValueError


def test_errors_that_cut_a_letter_are_read(tmp_path: Path) -> None:
    path = tmp_path / "take.bvh"
    path.write_text("HIERARCHY\nROOT hips\n{\n" + "x" * 39 + "ü\n", encoding="utf-8")
    with pytest.raises(ValueError, match=r"take\.bvh:4: OFFSET.* expected, found 'xxx") as refusal:
        core.read_bvh(path)
    assert type(refusal.value) is ValueError


def test_a_policy_files_names_may_be_any_bytes(character: core.Character) -> None:
    data = character.to_bytes()
    payload = data[20:-8].replace(b"spine", b"sp\xefne", 1)
    forged = core.Character.from_bytes(data[:20] + payload + checksum(payload, 4).to_bytes(8, "little"))
    assert forged.skeleton.names[1] == "spïne"
    assert core.Character.from_bytes(forged.to_bytes()).skeleton.names == forged.skeleton.names


def test_bytes_that_are_no_text_are_no_names() -> None:
    with pytest.raises(ValueError, match="not UTF-8"):
        make_skeleton(names=[b"\xff", *make_skeleton().names[1:]])
    with pytest.raises(ValueError, match="not UTF-8"):
        core.Clip(make_skeleton(), b"\xff", 30, *walking_arrays())  # type: ignore[arg-type]
