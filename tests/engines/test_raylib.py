# SPDX-License-Identifier: MIT
"""games/raylib, played by a script on a screen of its own: two machines stay equal over a bad line, and it is seen."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from conftest import BUILD, TOP, Run

FOLDER = BUILD / "raylib"
OTHER = TOP / "tests" / "data" / "version-3.policy"
SCREEN = ("xvfb-run", "--auto-servernum", "--server-args", "-screen 0 1280x720x24")
FRAMES = 1200
NEAREST = 0.4  # m; heedless they come as near as 0.1 m


@pytest.fixture(scope="module")
def game(in_unstable: Run) -> Path:
    options = ("-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release")
    in_unstable("cmake", "-S", TOP / "games" / "raylib", "-B", FOLDER, *options)
    in_unstable("cmake", "--build", FOLDER, "--target", "game", seconds=3600)
    return FOLDER / "game"


def test_two_machines_stay_equal_over_a_bad_line(game: Path, sample: Path, in_unstable: Run) -> None:
    picture = FOLDER / "game.png"
    picture.unlink(missing_ok=True)
    files = (sample / "sample.policy", sample / "sample.glb", OTHER)
    printed = in_unstable(*SCREEN, game, *files, "--script", str(FRAMES), picture)
    told = re.search(r"^frames (.*)\nnobody nearer than (.*) m$", printed, re.MULTILINE)
    assert told, printed
    numbers = [int(number) for number in re.findall(r"\d+", told[1])]
    first, second, *rollbacks, longest, equal, unequal = numbers
    assert first == second == FRAMES
    assert min(rollbacks) >= 3
    assert 6 <= longest <= 12
    assert equal >= FRAMES - longest - 6
    assert unequal == 0
    assert float(told[2]) > NEAREST, "the others make way"
    assert picture.stat().st_size > 50_000


def test_it_says_what_a_file_is_not(game: Path, sample: Path, in_unstable: Run) -> None:
    script = f"xvfb-run -a {game} {sample / 'sample.glb'} 2>&1; test $? = 1"
    assert "it is no Fragmotion policy file" in in_unstable("sh", "-c", script)
