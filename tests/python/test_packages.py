# SPDX-License-Identifier: MIT
"""What `dev.py package` says of the zips, and while it makes them."""

from __future__ import annotations

import zipfile
from pathlib import Path

import pytest

import dev
from tools import platforms, shell
from tools.packaging import packages, wheels
from tools.setup import environments, machine
from tools.shell import Failure
from tools.testing import stages


@pytest.mark.parametrize(
    ("names", "pythons"),
    [
        (["fragmotion/core.py", "fragmotion/fragmotion_core.cpython-311-x86_64-linux-gnu.so"], ["3.11"]),
        (
            [
                "core.py",
                "wheels/fragmotion_core-0.1.0-cp313-cp313-manylinux_2_35_x86_64.whl",
                "wheels/fragmotion_core-0.1.0-cp39-cp39-manylinux_2_35_x86_64.whl",
            ],
            ["3.9", "3.13"],
        ),
        (["core.py"], []),
    ],
)
def test_a_zip_tells_which_pythons_it_is_for(tmp_path: Path, names: list[str], pythons: list[str]) -> None:
    with zipfile.ZipFile(tmp_path / "addon.zip", "w") as archive:
        for name in names:
            archive.writestr(name, "")
    assert packages.pythons_inside(tmp_path / "addon.zip") == pythons


def test_the_same_files_give_the_same_zip(tmp_path: Path) -> None:
    files = {"b/two.py": b"two" * 1000, "a.txt": b"one"}
    for name in ("first.zip", "second.zip"):
        wheels.write_zip(tmp_path / name, files)
    assert (tmp_path / "first.zip").read_bytes() == (tmp_path / "second.zip").read_bytes()
    with zipfile.ZipFile(tmp_path / "first.zip") as archive:
        assert {name: archive.read(name) for name in archive.namelist()} == files
        assert {entry.external_attr >> 16 for entry in archive.infolist()} == {0o100644}


@pytest.mark.parametrize("platform", platforms.PLATFORMS, ids=lambda platform: platform.name)
def test_a_module_is_packed_as_a_wheel_of_its_python_and_platform(tmp_path: Path, platform: platforms.Platform) -> None:
    module = tmp_path / platform.module_name("3.11")
    module.write_bytes(b"compiled")
    wheel = wheels.pack(module, "3.11", platform.wheel_tag, tmp_path)
    assert wheel.name.endswith(f"-cp311-cp311-{platform.wheel_tag}.whl")
    with zipfile.ZipFile(wheel) as archive:
        assert archive.read(module.name) == b"compiled"
        assert "fragmotion_core.pyi" in archive.namelist()
    assert packages.pythons_inside(wheel) == ["3.11"]


def test_an_unknown_platform_is_told_with_those_there_are() -> None:
    with pytest.raises(Failure, match="no platform beos; the platforms are linux-x64, windows-x64, macos-arm64"):
        platforms.named("beos")


@pytest.mark.parametrize(
    ("arguments", "made"),
    [
        ([], ["linux-x64", "windows-x64", "macos-arm64", "macos-x64"]),
        (["--platform", "macos-x64"], ["macos-x64"]),
        (["--platform", "windows-x64", "--platform", "linux-x64"], ["linux-x64", "windows-x64"]),
    ],
)
def test_the_zips_of_each_platform_that_is_named_are_made(
    monkeypatch: pytest.MonkeyPatch, arguments: list[str], made: list[str]
) -> None:
    seen: list[str] = []

    def make(chosen: tuple[platforms.Platform, ...]) -> stages.Counts:
        seen.extend(platform.name for platform in chosen)
        return stages.Counts(passed=1)

    monkeypatch.setattr(machine, "set_up", lambda needs: None)
    monkeypatch.setattr(stages, "packages_of", make)
    assert dev.main(["package", *arguments]) == 0
    assert seen == made


def test_needs_are_joined_without_repeats() -> None:
    both = machine.BLENDER_45 | machine.package_needs() | machine.package_needs((platforms.LINUX,))
    assert both.platforms == platforms.PLATFORMS
    assert len(both.packages) == len(set(both.packages))
    assert any(requirement.startswith("ziglang==") for requirement in both.requirements[environments.HOST])
    assert "bpy==4.5.*" in both.requirements["3.11"]


@pytest.mark.parametrize(("is_terminal", "end"), [(True, "\r"), (False, "\n")])
def test_how_far_ninja_is_is_told(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], is_terminal: bool, end: str
) -> None:
    monkeypatch.setattr(shell, "_STEPS_EVERY", 0.0)
    monkeypatch.setattr("sys.stdout.isatty", lambda: is_terminal)
    hear = shell.steps_of("build: linux-x64")
    hear("[3/57] Building CXX object here.o\n")
    hear("here.cpp: a warning\n")
    assert capsys.readouterr().out == f"build: linux-x64: [3/57]{end}"
