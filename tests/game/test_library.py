# SPDX-License-Identifier: MIT
"""libfragmotion as games get it: built, installed, found, linked by games of any standard and flags, which all show the
same bits; and what it exports."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

TOP = Path(__file__).parents[2]
HEADER = TOP / "cpp" / "include" / "fragmotion" / "fragmotion.h"
POLICY = TOP / "tests" / "data" / "version-3.policy"
FOLDER = TOP / "build" / "game"
COMPILERS = [(c, cpp) for c, cpp in (("gcc", "g++"), ("clang", "clang++")) if shutil.which(c) and shutil.which(cpp)]
ROLLED_BACK = TOP / "tests" / "data" / "styles.policy"
KILOBYTES = 500
ROLLBACK = 100.0  # us


def run(*command: str | Path, **more: str) -> str:
    """What a command prints; it must succeed."""
    done = subprocess.run(
        [str(word) for word in command], capture_output=True, text=True, env={**os.environ, **more}, check=False
    )
    assert done.returncode == 0, f"{command}\n{done.stdout}{done.stderr}"
    return done.stdout


def configure(source: Path, folder: Path, *options: str) -> None:
    """Configure and build a CMake project."""
    run("cmake", "-S", source, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", *options)
    run("cmake", "--build", folder)


@pytest.fixture(scope="session")
def prefix() -> Path:
    """Where the library is installed."""
    launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
    configure(TOP, FOLDER, "-DFRAGMOTION_RUNTIME_ONLY=ON", *launcher)
    installed = FOLDER / "installed"
    shutil.rmtree(installed, ignore_errors=True)
    run("cmake", "--install", FOLDER, "--component", "game", "--prefix", installed)
    return installed


@pytest.fixture(scope="session")
def libraries(prefix: Path) -> Path:
    """The folder of the installed libraries."""
    (found,) = prefix.rglob("libfragmotion.a")
    return found.parent


def declared() -> set[str]:
    """The functions that the header declares for export."""
    return set(re.findall(r"^FRAGMOTION_EXPORT [^(]*?(\w+)\(", HEADER.read_text(encoding="utf-8"), re.MULTILINE))


def exported(*options: str | Path) -> set[str]:
    """The names that nm tells as defined and seen from outside."""
    lines = run("nm", "--defined-only", "--extern-only", *options).splitlines()
    return {line.split()[-1] for line in lines if " " in line}


def test_exported_is_what_the_header_declares_and_no_more(libraries: Path) -> None:
    assert len(declared()) > 40
    assert exported("--dynamic", libraries / "libfragmotion.so") == declared()
    assert exported(libraries / "libfragmotion.a") == declared()


def test_it_starts_no_thread_reads_no_file_and_prints_nothing(libraries: Path) -> None:
    needed = run("nm", "--dynamic", "--undefined-only", libraries / "libfragmotion.so")
    unwanted = r"pthread|St6thread|fopen|\bopen|printf_chk|\bprintf|puts|basic_[io]?fstream|_ZSt4cout"
    assert not re.search(unwanted, needed)


def test_what_is_not_exact_of_mathematics_is_its_own(libraries: Path) -> None:
    inexact = "a?(sin|cos|tan)h?|atan2|sincos|hypot|cbrt|pow|fma|(exp|log)(2|10|m1|1p)?"
    needed = run("nm", "--dynamic", "--undefined-only", libraries / "libfragmotion.so")
    assert not re.findall(rf" U ((?:{inexact})f?)(?:@|$)", needed, re.MULTILINE)


def test_it_is_small(libraries: Path) -> None:
    assert (libraries / "libfragmotion.so").stat().st_size < KILOBYTES * 1000


def test_the_versions_are_the_projects() -> None:
    cmake = (TOP / "CMakeLists.txt").read_text(encoding="utf-8")
    (version,) = re.findall(r"project\(fragmotion VERSION ([\d.]+)", cmake)
    text = HEADER.read_text(encoding="utf-8")
    parts = [re.findall(rf"FRAGMOTION_VERSION_{part} (\d+)", text)[0] for part in ("MAJOR", "MINOR", "PATCH")]
    assert ".".join(parts) == version
    assert f'FRAGMOTION_VERSION_STRING "{version}"' in text


def test_what_is_installed_is_the_libraries_and_two_headers(prefix: Path) -> None:
    headers = {path.name for path in prefix.rglob("*.h*")}
    assert headers == {"fragmotion.h", "fragmotion.hpp"}
    assert (prefix.rglob("fragmotion.pc")) and list(prefix.rglob("fragmotionConfig.cmake"))


@pytest.mark.parametrize("standard", ["c99", "c17", "c++17", "c++20", "c++2b"])
@pytest.mark.parametrize("c", [c for c, _ in COMPILERS] + ["zig"])
def test_no_compiler_finds_fault_with_the_headers(c: str, standard: str, tmp_path: Path) -> None:
    is_cpp = standard.startswith("c++")
    zig = [sys.executable, "-m", "ziglang", "c++" if is_cpp else "cc"]
    command = zig if c == "zig" else [dict(COMPILERS)[c] if is_cpp else c]
    source = tmp_path / ("game.cpp" if is_cpp else "game.c")
    source.write_text(f"#include <fragmotion/fragmotion.h{'pp' if is_cpp else ''}>\n")
    strict = ["-Wall", "-Wextra", "-Wconversion", "-Wpedantic", "-Werror"]
    caches = {"ZIG_GLOBAL_CACHE_DIR": str(TOP / "build" / "zig" / "cache"), "ZIG_LOCAL_CACHE_DIR": str(tmp_path)}
    options = [f"-std={standard}", *strict, f"-I{HEADER.parents[1]}", "-c", source, "-o", tmp_path / "game.o"]
    run(*command, *options, **caches)


@pytest.fixture(scope="session")
def sums() -> Iterator[dict[str, str]]:
    """What each game has printed."""
    printed: dict[str, str] = {}
    yield printed


@pytest.mark.parametrize(("c", "cpp"), COMPILERS)
def test_games_of_all_standards_and_flags_find_it_and_show_the_same_bits(
    prefix: Path, sums: dict[str, str], c: str, cpp: str
) -> None:
    folder = FOLDER / f"consumers-{c}"
    shutil.rmtree(folder, ignore_errors=True)
    compilers = (f"-DCMAKE_C_COMPILER={c}", f"-DCMAKE_CXX_COMPILER={cpp}")
    configure(TOP / "tests" / "game", folder, f"-DCMAKE_PREFIX_PATH={prefix}", *compilers)
    games = [path for path in folder.iterdir() if re.fullmatch(r"(c99|cpp\d+|bare|avx2)-(shared|static)", path.name)]
    assert len(games) >= 10
    for game in games:
        if game.name.startswith("avx2") and "avx2" not in Path("/proc/cpuinfo").read_text(encoding="utf-8"):
            continue
        sums[f"{c} {game.name}"] = run(game, POLICY).strip()
    assert len(set(sums.values())) == 1, sums


def test_pkg_config_says_how_to_link_it(prefix: Path, libraries: Path, sums: dict[str, str], tmp_path: Path) -> None:
    if not shutil.which("pkg-config"):
        pytest.skip("no pkg-config")
    where = {"PKG_CONFIG_PATH": str(libraries / "pkgconfig")}
    for name, options in (("shared", ()), ("static", ("--static",))):
        flags: Sequence[str] = run("pkg-config", "--cflags", "--libs", *options, "fragmotion", **where).split()
        if name == "static":
            flags = [str(libraries / "libfragmotion.a") if flag == "-lfragmotion" else flag for flag in flags]
        program = tmp_path / name
        run("gcc", "-std=c99", TOP / "tests" / "game" / "consumer.c", "-o", program, *flags)
        sums[f"pkg-config {name}"] = run(program, POLICY, LD_LIBRARY_PATH=str(libraries)).strip()
    assert len(set(sums.values())) == 1, sums


def test_a_file_that_is_none_ends_no_game(prefix: Path) -> None:
    del prefix
    game = next(FOLDER.glob("consumers-*/bare-static"))
    done = subprocess.run([game, Path(__file__)], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "it is no Fragmotion policy file" in done.stderr or "character is null" in done.stderr


def test_a_rollback_of_eight_frames_takes_a_hundred_microseconds_at_most(prefix: Path) -> None:
    del prefix
    took = [float(run(game, ROLLED_BACK)) for game in FOLDER.glob("consumers-*/rollback")]
    print(f"restored and 8 frames played again: {min(took):.0f} us")
    assert min(took) <= ROLLBACK
