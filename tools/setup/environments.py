# SPDX-License-Identifier: MIT
"""Python: finding the versions that Blender runs, and a virtual environment for each under build/."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tarfile
import zipfile
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path

from tools.paths import BUILD, LIBSVM, MUSL, SDL
from tools.platforms import Platform
from tools.setup import maven
from tools.shell import run, step


def _version_of(python: str) -> str | None:
    # A pyenv shim lies on the PATH for versions that are not activated, and fails: only running it tells.
    code = "import sys; print('%d.%d' % sys.version_info[:2])"
    try:
        answer = subprocess.run([python, "-c", code], capture_output=True, text=True, check=False)
    except OSError:
        return None
    return answer.stdout.strip() or None


HOST = f"{sys.version_info.major}.{sys.version_info.minor}"
"""The Python that runs this: the one for tools, and for what needs no certain Python."""

SYSTEM = _version_of("/usr/bin/python3") or HOST
"""The Python of the system, which Debian's Blender runs."""

BPY_PYTHON = "3.11"
"""The Python of Blender 4.5's module."""

ZIG = "ziglang==0.15.2"
"""What compiles for other platforms, and brings musl's sources along."""

_LIBSVM = "libsvm-official==3.37.0"
_MUSL = re.compile(
    r"ziglang/lib/libc/(musl/(COPYRIGHT|arch/generic/.*|include/.*|src/(include|internal|math)/.*\.[ch])"
    r"|include/(arm-linux|generic)-musl/.*)"
)
_SDL = ("PySDL2==0.9.17", "pysdl2-dll==2.32.0")
_PIP = ("-m", "pip", "--disable-pip-version-check", "--retries", "5", "--timeout", "60")


@cache
def find_python(version: str) -> Path | None:
    """An interpreter of this version ("3.11") that runs: this one, one on the PATH or one of pyenv's; else None."""
    candidates = [sys.executable, shutil.which(f"python{version}")]
    candidates += sorted(str(path) for path in pyenv_pythons(version))
    return next((Path(path) for path in candidates if path and _version_of(path) == version), None)


def pyenv_pythons(version: str) -> list[Path]:
    """The interpreters of this version that lie under ~/.pyenv, whether or not they are activated."""
    return list((Path.home() / ".pyenv" / "versions").glob(f"{version}.*/bin/python{version}"))


def environment(version: str) -> Path:
    """The folder of this version's virtual environment."""
    return BUILD / f"env-{version}"


def site_packages(version: str) -> Path:
    """Where this version's virtual environment keeps its packages."""
    return environment(version) / "lib" / f"python{version}" / "site-packages"


def environment_python(version: str) -> Path:
    """The interpreter of this version's virtual environment."""
    return environment(version) / "bin" / "python"


def has_base(version: str) -> bool:
    """Whether there is a virtual environment of this version, or an interpreter to make it from."""
    return environment_python(version).exists() or find_python(version) is not None


def ensure(version: str, requirements: Iterable[str]) -> None:
    """Make the virtual environment hold the requirements, unless its stamp says that it does."""
    stamp = environment(version) / "requirements.txt"
    installed = set(stamp.read_text().splitlines()) if stamp.exists() else set()
    wanted = sorted(installed | set(requirements))
    if set(wanted) == installed:
        return
    with step(f"Python {version} environment", f"with {' '.join(wanted)}"):
        if not installed:
            base = find_python(version) or maven.ensure_python(version)
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


def install_for_windows(folder: Path, version: str, requirements: Iterable[str]) -> None:
    """Install Windows' wheels for a Python into a folder, by this machine's of that version: pip compares its own with
    what packages require."""
    options = ("--platform", "win_amd64", "--python-version", version, "--only-binary", ":all:", "--upgrade")
    run(
        [environment_python(version), *_PIP, "install", "--target", folder, *options, *requirements],
        f"pip-windows-{version}",
    )


@contextmanager
def filled(folder: Path, requirements: Iterable[str], label: str) -> Iterator[bool]:
    """Whether a folder is to be filled with the requirements, as its stamp does not say that it holds just these: then
    it is empty, and stamped when all went well."""
    stamp = folder / "requirements.txt"
    wanted = "".join(f"{line}\n" for line in requirements)
    if stamp.exists() and stamp.read_text() == wanted:
        yield False
        return
    with step(label):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        yield True
        stamp.write_text(wanted)


def ensure_folder(folder: Path, version: str, requirement: str) -> None:
    """Install a package into a folder of its own, unless the folder is complete."""
    with filled(folder, [requirement], f"{requirement} in {folder.name}") as is_needed:
        if is_needed:
            install_into(folder, version, requirement)


def ensure_libsvm() -> None:
    """Put svm.cpp and svm.h of PyPI's source distribution into build/libsvm, where CMake looks for them."""
    with filled(LIBSVM, [_LIBSVM], f"sources of {_LIBSVM}") as is_needed:
        if is_needed:
            _download_libsvm()


def _download_libsvm() -> None:
    options = ("--no-deps", "--no-binary", "libsvm-official", "--dest", str(LIBSVM))
    run([environment_python(HOST), *_PIP, "download", *options, _LIBSVM], "pip-libsvm")
    with tarfile.open(next(LIBSVM.glob("*.tar.gz"))) as archive:
        for member in archive.getmembers():
            name = Path(member.name).name
            source = archive.extractfile(member) if name in ("svm.cpp", "svm.h", "LICENSE") else None
            if source:
                (LIBSVM / name).write_bytes(source.read())


def ensure_musl() -> None:
    """Put musl's mathematics and what it includes, as zig has them, into build/musl, where CMake looks for them."""
    with filled(MUSL, [ZIG], f"musl's mathematics of {ZIG}") as is_needed:
        if is_needed:
            _download_musl()


def _download_musl() -> None:
    run([environment_python(HOST), *_PIP, "download", "--no-deps", "--dest", MUSL, ZIG], "pip-musl")
    wheel = next(MUSL.glob("*.whl"))
    with zipfile.ZipFile(wheel) as archive:
        for member in archive.infolist():
            if match := _MUSL.fullmatch(member.filename):
                target = MUSL / match[1]
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_bytes(archive.read(member))
    wheel.unlink()


def sdl_wheels(platform: Platform) -> list[Path]:
    """The wheels of SDL and of its Python module."""
    return sorted((SDL / platform.name).glob("*.whl"))


def ensure_sdl(platform: Platform) -> None:
    """Put the wheels of SDL for a platform, which the add-on brings along, into build/sdl/PLATFORM."""
    folder = SDL / platform.name
    options = ("--no-deps", "--only-binary", ":all:", "--platform", platform.sdl_tag, "--dest", str(folder))
    with filled(folder, _SDL, f"{' '.join(_SDL)} for {platform.name}") as is_needed:
        if is_needed:
            run([environment_python(HOST), *_PIP, "download", *options, *_SDL], f"pip-sdl-{platform.name}")
