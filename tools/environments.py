# SPDX-License-Identifier: MIT
"""Python: finding the versions that Blender runs, and a virtual environment for each under build/."""

from __future__ import annotations

import shutil
import subprocess
import sys
import tarfile
from collections.abc import Iterable
from functools import cache
from pathlib import Path

from tools.paths import BUILD, LIBSVM, SDL
from tools.shell import Failure, run, say

_LIBSVM = "libsvm-official==3.37.0"
_SDL = ("PySDL2==0.9.17", "pysdl2-dll==2.32.0")
_PIP = ("-m", "pip", "--disable-pip-version-check", "--retries", "5", "--timeout", "60")


@cache
def find_python(version: str) -> Path | None:
    """An interpreter of this version ("3.11") that runs: this one, one on the PATH or one of pyenv's; else None."""
    candidates = [sys.executable, shutil.which(f"python{version}")]
    candidates += sorted(str(path) for path in pyenv_pythons(version))
    return next((Path(path) for path in candidates if path and _runs_as(path, version)), None)


def pyenv_pythons(version: str) -> list[Path]:
    """The interpreters of this version that lie under ~/.pyenv, whether or not they are activated."""
    return list((Path.home() / ".pyenv" / "versions").glob(f"{version}.*/bin/python{version}"))


def _runs_as(python: str, version: str) -> bool:
    # A pyenv shim lies on the PATH for versions that are not activated, and fails: only running it tells.
    code = "import sys; print('%d.%d' % sys.version_info[:2])"
    answer = subprocess.run([python, "-c", code], capture_output=True, text=True, check=False)
    return answer.stdout.strip() == version


def environment(version: str) -> Path:
    """The folder of this version's virtual environment."""
    return BUILD / f"env-{version}"


def environment_python(version: str) -> Path:
    """The interpreter of this version's virtual environment."""
    return environment(version) / "bin" / "python"


def ensure(version: str, requirements: Iterable[str]) -> None:
    """Make the virtual environment hold the requirements, unless its stamp says that it does."""
    stamp = environment(version) / "requirements.txt"
    installed = set(stamp.read_text().splitlines()) if stamp.exists() else set()
    wanted = sorted(installed | set(requirements))
    if set(wanted) == installed:
        return
    say(f"set-up: Python {version} environment with {' '.join(wanted)}")
    if not installed:
        base = find_python(version)
        if not base:
            raise Failure(f"Python {version} is needed, and there is none on the PATH or under ~/.pyenv/versions")
        run([base, "-m", "venv", "--clear", environment(version)], f"venv-{version}")
    run([environment_python(version), *_PIP, "install", *wanted], f"pip-{version}")
    stamp.write_text("".join(f"{line}\n" for line in wanted))


def install_into(folder: Path, version: str, *requirements: str | Path) -> None:
    """Install packages into a folder of their own, replacing it, for an interpreter that is not ours to change."""
    shutil.rmtree(folder, ignore_errors=True)
    run(
        [environment_python(version), *_PIP, "install", "--target", folder, *requirements],
        f"pip-{folder.name}",
    )


def ensure_folder(folder: Path, version: str, requirement: str) -> None:
    """Install a package into a folder of its own, unless the folder is complete."""
    stamp = folder / "requirements.txt"
    if not stamp.exists():
        say(f"set-up: {requirement} in {folder.name}")
        install_into(folder, version, requirement)
        stamp.write_text(f"{requirement}\n")


def ensure_libsvm() -> None:
    """Put svm.cpp and svm.h of PyPI's source distribution into build/libsvm, where CMake looks for them."""
    stamp = LIBSVM / "requirements.txt"
    if stamp.exists() and stamp.read_text().strip() == _LIBSVM:
        return
    say(f"set-up: sources of {_LIBSVM}")
    shutil.rmtree(LIBSVM, ignore_errors=True)
    LIBSVM.mkdir(parents=True)
    options = ("--no-deps", "--no-binary", "libsvm-official", "--dest", str(LIBSVM))
    run([environment_python("3.11"), *_PIP, "download", *options, _LIBSVM], "pip-libsvm")
    with tarfile.open(next(LIBSVM.glob("*.tar.gz"))) as archive:
        for member in archive.getmembers():
            name = Path(member.name).name
            source = archive.extractfile(member) if name in ("svm.cpp", "svm.h", "LICENSE") else None
            if source:
                (LIBSVM / name).write_bytes(source.read())
    stamp.write_text(f"{_LIBSVM}\n")


def ensure_sdl() -> None:
    """Put the wheels of SDL for this machine, which the add-on brings along, into build/sdl."""
    stamp = SDL / "requirements.txt"
    wanted = "".join(f"{line}\n" for line in _SDL)
    if stamp.exists() and stamp.read_text() == wanted:
        return
    say(f"set-up: {' '.join(_SDL)}")
    shutil.rmtree(SDL, ignore_errors=True)
    SDL.mkdir(parents=True)
    options = ("--no-deps", "--only-binary", ":all:", "--dest", str(SDL))
    run([environment_python("3.11"), *_PIP, "download", *options, *_SDL], "pip-sdl")
    stamp.write_text(wanted)
