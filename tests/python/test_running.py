# SPDX-License-Identifier: MIT
"""A program that `dev.py` runs has a time, and nothing of what it started outlives it."""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

import pytest

from tools import processes, shell
from tools.shell import Failure

# Writes its number and waits in a session of its own, as Wine's server does, the output open.
DAEMON = """
import os, sys, time
if os.fork() == 0:
    os.setsid()
    if os.fork() == 0:
        open(sys.argv[1], "w").write(f"{os.getpid()}")
        time.sleep(3600)
    os._exit(0)
while not (os.path.exists(sys.argv[1]) and open(sys.argv[1]).read()):
    time.sleep(0.01)
print("started", flush=True)
"""
HANGS = DAEMON + "time.sleep(3600)\n"
DIES = DAEMON + "sys.exit(3)\n"
CHATS = DAEMON + "while True: print('more')\n"


@pytest.fixture(autouse=True)
def logs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(shell, "LOGS", tmp_path / "logs")
    return tmp_path / "logs"


def is_running(number: Path) -> bool:
    """Whether a program goes on, given the second that a loaded machine may take to end what was killed."""
    stat, deadline = Path(f"/proc/{number.read_text()}/stat"), time.monotonic() + 1.0
    while time.monotonic() < deadline:
        try:
            if stat.read_text().split()[2] in "ZX":
                return False
        except (FileNotFoundError, ProcessLookupError):
            return False
        time.sleep(0.01)
    return True


@pytest.mark.parametrize("script", [HANGS, CHATS], ids=["hangs", "chats"])
def test_a_program_out_of_time_fails_with_all_that_it_started_ended(tmp_path: Path, script: str) -> None:
    number, start = tmp_path / "number", time.monotonic()
    with pytest.raises(Failure, match="was stopped after 3 s, with all that it started"):
        shell.run([sys.executable, "-c", script, number], "hangs", timeout=3.0)
    assert time.monotonic() - start < 3.0 + processes.LINGER / 2
    assert not is_running(number)
    assert "started" in (tmp_path / "logs" / "hangs.log").read_text()


def test_what_holds_the_output_after_the_program_is_ended(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(processes, "LINGER", 0.5)
    with pytest.raises(Failure, match="failed with exit code 3"):
        shell.run([sys.executable, "-c", DIES, tmp_path / "number"], "dies")
    assert not is_running(tmp_path / "number")


def test_what_is_interrupted_leaves_nothing_running(tmp_path: Path) -> None:
    def interrupt(line: str) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        shell.run([sys.executable, "-c", HANGS, tmp_path / "number"], "interrupted", hear=interrupt)
    assert not is_running(tmp_path / "number")


def test_other_programs_go_on(tmp_path: Path) -> None:
    other = os.spawnv(os.P_NOWAIT, sys.executable, [sys.executable, "-c", "import time; time.sleep(3600)"])
    try:
        with pytest.raises(Failure, match="was stopped"):
            shell.run([sys.executable, "-c", HANGS, tmp_path / "number"], "hangs", timeout=1.0)
        assert os.waitpid(other, os.WNOHANG) == (0, 0)
    finally:
        os.kill(other, 9)
        os.waitpid(other, 0)


def test_a_program_that_ends_in_time_is_heard_whole() -> None:
    lines: list[str] = []
    shell.run([sys.executable, "-c", "for i in range(1000): print(i)"], "counts", hear=lines.append)
    assert lines == [f"{i}\n" for i in range(1000)]
