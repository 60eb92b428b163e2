# SPDX-License-Identifier: MIT
"""Engines that are not here are said to be skipped, with what to do."""

from __future__ import annotations

from pathlib import Path

import pytest

from tools.setup import apt, unstable
from tools.shell import Failure
from tools.testing import engines, stages


@pytest.fixture
def here(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """Debian unstable as root sees it: a folder that looks like it."""
    (tmp_path / "usr" / "bin").mkdir(parents=True)
    (tmp_path / "usr" / "bin" / "apt-get").touch()
    monkeypatch.setattr(unstable, "ROOT", tmp_path)
    monkeypatch.setattr("os.geteuid", lambda: 0)
    return tmp_path


def test_without_debian_unstable_all_engines_are_skipped(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(unstable, "ROOT", tmp_path)
    counts = stages.engines(None)
    assert counts.skipped == len(engines.ENGINES) and not counts.passed + counts.failed
    assert {skip.reason for skip in counts.skips} == {"Debian unstable is not set up: sudo python3 dev.py unstable"}
    with pytest.raises(Failure, match="not set up"):
        unstable.command(["true"])


def test_an_engine_that_lacks_a_package_is_skipped_and_says_which(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(apt, "missing", lambda packages, root: [each for each in packages if each == "mono-devel"])
    assert engines.absent() == {"csharp": "Debian unstable lacks mono-devel: sudo python3 dev.py unstable"}


def test_only_root_enters(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert unstable.why_not() is None
    monkeypatch.setattr("os.geteuid", lambda: 1000)
    assert unstable.why_not() == "Debian unstable takes root: run this with sudo"


def test_every_engine_has_its_tests() -> None:
    assert {path.stem.removeprefix("test_") for path in engines.TESTS.glob("test_*.py")} == set(engines.ENGINES)
