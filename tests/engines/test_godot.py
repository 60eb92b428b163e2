# SPDX-License-Identifier: MIT
"""games/godot in Godot: poses on the imported mesh that are the C library's, the node's promises, a picture."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import numpy as np
import pytest
from conftest import BUILD, TOP, Poses, Run, finished

from tools.games.godot import WEB, library_name
from tools.platforms import PLATFORMS

OURS = TOP / "games" / "godot"
TESTS = Path(__file__).parent / "godot"
FOLDER = BUILD / "godot"
SCREEN = ("xvfb-run", "--auto-servernum", "--server-args", "-screen 0 1280x720x24")
WINDOW = ("--rendering-driver", "opengl3", "--audio-driver", "Dummy", "--resolution", "640x360", "--fixed-fps", "60")


class Project:
    """A project as a user's: the add-on and the demo with the sample character, imported."""

    def __init__(self, run: Run, sample: Path) -> None:
        self.run, self.folder = run, FOLDER / "project"
        shutil.rmtree(self.folder, ignore_errors=True)
        for name in ("addons", "demo"):
            shutil.copytree(OURS / name, self.folder / name)
        for path in (OURS / "project.godot", *TESTS.glob("*.gd")):
            shutil.copy(path, self.folder)
        for name in ("sample.policy", "sample.glb"):
            shutil.copy(sample / name, self.folder / "demo")
        self._know_the_extension()
        assert "ERROR" not in self.run("godot", "--headless", "--import", folder=self.folder)

    def _know_the_extension(self) -> None:
        """Godot that meets one in its first headless import may crash as it ends (its issue 111048)."""
        known = self.folder / ".godot" / "extension_list.cfg"
        known.parent.mkdir()
        known.write_text("res://addons/fragmotion/fragmotion.gdextension\n")

    def play(self, script: str) -> str:
        """What a script prints, errors too."""
        return self.run("sh", "-c", f"godot --headless --script {script} 2>&1", folder=self.folder)


@pytest.fixture(scope="module")
def project(in_unstable: Run, sample: Path) -> Project:
    interface = FOLDER / "interface"
    interface.mkdir(parents=True, exist_ok=True)
    in_unstable("godot", "--headless", "--dump-gdextension-interface", folder=interface)
    launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
    options = ["-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", f"-DGODOT_INTERFACE={interface}", *launcher]
    finished(["cmake", "-S", str(OURS), "-B", str(FOLDER / "native"), *options], 600)
    finished(["cmake", "--build", str(FOLDER / "native")], 1800)
    return Project(in_unstable, sample)


def test_the_imported_mesh_stands_as_the_library_says(project: Project, poses: Poses) -> None:
    lines = [line.split() for line in project.play("poses.gd").splitlines() if re.match(r"\d+ ", line)]
    shown = np.array([line[2:] for line in lines], dtype=float).reshape(*poses.shape)
    turned = np.sum(shown[..., 3:] * poses[..., 3:], axis=-1, keepdims=True)
    shown[..., 3:] *= np.sign(turned)  # q and -q are one rotation
    assert np.abs(shown - poses).max() < 1e-5


def test_the_node_holds_its_promises(project: Project) -> None:
    printed = project.play("promises.gd")
    assert not re.findall(r"^failed .*", printed, re.MULTILINE), printed
    assert len(re.findall(r"^passed ", printed, re.MULTILINE)) == 14
    assert "SCRIPT ERROR" not in printed
    assert "it is no Fragmotion policy file" in printed
    assert "there is no move 'fly'; there are" in printed


def test_the_demo_is_seen_on_its_stairs(project: Project) -> None:
    picture = project.folder / "stairs.png"
    command = ["godot", *WINDOW, "--script", "picture.gd", "--", picture, "3.5", "5", "-3", "0", "0.5"]
    printed = project.run(*SCREEN, *command, folder=project.folder)
    x, y, z = map(float, re.findall(r"hero at \((.*), (.*), (.*)\)", printed)[0])
    assert abs(x - 5) < 0.5
    assert y > 0.3
    assert z < -5
    assert int(re.findall(r"orange in the middle: (\d+)", printed)[0]) > 20
    assert picture.stat().st_size > 10_000


def test_help_and_icons_are_there() -> None:
    script = (OURS / "addons" / "fragmotion" / "character.gd").read_text(encoding="utf-8")
    told = (OURS / "addons" / "fragmotion" / "fragmotion.gdextension").read_text(encoding="utf-8")
    for name in re.findall(r"^(?:signal|func|enum|var) ([a-z]\w+)", script, re.MULTILINE):
        assert re.search(rf"^## .*\n(?:signal|func|enum|var) {name}\b", script, re.MULTILINE), name
    for icon in re.findall(r'"(icons/\w+\.svg)"', script + told):
        assert (OURS / "addons" / "fragmotion" / icon).exists()


def test_the_native_part_has_the_name_of_its_platform() -> None:
    told = (OURS / "addons" / "fragmotion" / "fragmotion.gdextension").read_text(encoding="utf-8")
    for platform in PLATFORMS:
        assert f'"bin/{library_name(platform)}"' in told, platform.name
    assert f'"bin/{WEB}"' in told
