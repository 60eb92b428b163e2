# SPDX-License-Identifier: MIT
"""What `dev.py package` made: zips that fit their platforms, with nothing inside that a user's machine may lack."""

from __future__ import annotations

import base64
import csv
import fnmatch
import hashlib
import io
import os
import re
import shutil
import zipfile
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path

import lief
import pytest
import tomllib
from packaging.metadata import Metadata
from packaging.tags import Tag
from packaging.utils import parse_wheel_filename

from tools.packaging import cross, packages
from tools.platforms import LEGACY_PYTHONS, Platform, named

MEGABYTES_WITHOUT_SDL = 10
OLDEST_GLIBC = (2, 28)
OLDEST_MACOS = [11, 0, 0]
OLDEST_WINDOWS = 6

# What every system of the kind has: glibc, Windows 10's own libraries, and macOS's.
LIBRARIES = {
    "Linux": ["libc.so.6", "libm.so.6", "libpthread.so.0", "libdl.so.2", "ld-linux-x86-64.so.2"],
    "Windows": ["kernel32.dll", "ntdll.dll", "api-ms-win-crt-*-l1-1-0.dll", "python3{minor}.dll"],
    "Darwin": ["/usr/lib/libSystem.B.dylib", "/usr/lib/libc++.1.dylib"],
}
PROCESSORS = {
    "linux-x64": lief.ELF.ARCH.X86_64,
    "windows-x64": lief.PE.Header.MACHINE_TYPES.AMD64,
    "macos-arm64": lief.MachO.Header.CPU_TYPE.ARM64,
    "macos-x64": lief.MachO.Header.CPU_TYPE.X86_64,
}

# What zig's linkers cannot hide: exceptions of pybind11 on Windows and Macs, new and delete on Macs.
SHOWN = {"Linux": "$", "Windows": r"Z\w*8pybind11", "Darwin": r"_Z\w*8pybind11|_Z(nw|na|dl|da)|__dso_handle|_mh_"}

MORE_PYTHONS = tuple(os.environ["FRAGMOTION_MORE_PYTHONS"].split())
MADE = [replace(named(name), more_pythons=MORE_PYTHONS) for name in os.environ["FRAGMOTION_PLATFORMS"].split()]

platforms = pytest.mark.parametrize("platform", MADE, ids=lambda platform: platform.name)
with_legacy = pytest.mark.parametrize("platform", [p for p in MADE if p.legacy], ids=lambda p: p.name)


def read(path: Path) -> dict[str, bytes]:
    """The files of a zip."""
    with zipfile.ZipFile(path) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def wheels_in(platform: Platform) -> dict[str, bytes]:
    """The wheels of a platform's extension."""
    files = read(packages.extension_path(platform))
    return {Path(name).name: data for name, data in files.items() if name.endswith(".whl")}


def modules_of(platform: Platform) -> Iterator[tuple[str, bytes]]:
    """The minor version of its Python, and the bytes, of every compiled core in a platform's zips."""
    for name, wheel in wheels_in(platform).items():
        if name.startswith("fragmotion_core"):
            files = read_bytes(wheel)
            yield next((minor_of(inner), files[inner]) for inner in files if inner.endswith((".so", ".pyd")))
    if platform.legacy:
        for name, data in read(packages.legacy_path(platform)).items():
            if re.search(r"fragmotion_core\.\S+\.(so|pyd)$", name):
                yield minor_of(name), data


def read_bytes(data: bytes) -> dict[str, bytes]:
    """The files of a zip in memory."""
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def minor_of(module: str) -> str:
    """11 of fragmotion_core.cp311-win_amd64.pyd."""
    match = re.search(r"cp(?:ython-)?3(\d+)", module)
    assert match, module
    return match[1]


@platforms
def test_a_platform_has_its_pythons(platform: Platform) -> None:
    assert packages.pythons_inside(packages.extension_path(platform)) == list(platform.extension_pythons)
    if platform.legacy:
        assert packages.pythons_inside(packages.legacy_path(platform)) == list(LEGACY_PYTHONS)
    modules = [minor for minor, _ in modules_of(platform)]
    assert len(modules) == len(platform.extension_pythons) + (len(LEGACY_PYTHONS) if platform.legacy else 0)


@platforms
def test_the_command_comes_with_every_core(platform: Platform) -> None:
    files = ["fragmotion_command/parser.py", "fragmotion_command/evaluate/measures/synthesis.py"]
    for name, wheel in wheels_in(platform).items():
        if name.startswith("fragmotion_core"):
            assert set(files) <= read_bytes(wheel).keys(), name
    if platform.legacy:
        assert {f"fragmotion/{name}" for name in files} <= read(packages.legacy_path(platform)).keys()


@platforms
def test_the_manifest_names_one_platform_and_the_wheels_that_are_there(platform: Platform) -> None:
    files = read(packages.extension_path(platform))
    manifest = tomllib.loads(files["blender_manifest.toml"].decode())
    assert manifest["platforms"] == [platform.name]
    assert sorted(manifest["wheels"]) == sorted(f"./{name}" for name in files if name.endswith(".whl"))


@platforms
def test_wheels_are_for_that_platform(platform: Platform) -> None:
    systems = {
        "linux-x64": ["manylinux*_x86_64"],
        "windows-x64": ["win_amd64"],
        "macos-arm64": ["macosx_*_arm64", "macosx_*_universal2"],
        "macos-x64": ["macosx_*_x86_64", "macosx_*_universal2"],
    }[platform.name]
    cores = set()
    for name in wheels_in(platform):
        project, _, _, tags = parse_wheel_filename(name)
        for tag in tags:
            assert tag.platform == "any" or any(fnmatch.fnmatch(tag.platform, system) for system in systems), name
        if project == "fragmotion-core":
            cores |= tags
    expected = [python.replace(".", "") for python in platform.extension_pythons]
    assert cores == {Tag(f"cp{digits}", f"cp{digits}", platform.wheel_tag) for digits in expected}


@platforms
def test_wheels_tell_what_is_in_them(platform: Platform) -> None:
    for name, data in wheels_in(platform).items():
        if not name.startswith("fragmotion_core"):
            continue
        files = read_bytes(data)
        info = next(inner.rpartition("/")[0] for inner in files if inner.endswith(".dist-info/RECORD"))
        rows = list(csv.reader(io.StringIO(files[f"{info}/RECORD"].decode())))
        assert {row[0] for row in rows} == set(files)
        for path, digest, size in rows[:-1]:
            expected = base64.urlsafe_b64encode(hashlib.sha256(files[path]).digest()).rstrip(b"=").decode()
            assert (digest, int(size)) == (f"sha256={expected}", len(files[path]))
        metadata = Metadata.from_email(files[f"{info}/METADATA"])  # raises where PyPI would
        assert metadata.name == "fragmotion_core" and metadata.license_expression == "MIT AND GPL-3.0-or-later"
        assert metadata.description and metadata.description.startswith("# fragmotion_core")
        tag = re.search(r"^Tag: (\S+)$", files[f"{info}/WHEEL"].decode(), re.MULTILINE)
        assert tag and name.endswith(f"-{tag[1]}.whl")
        licences = ("LICENSE", "LICENSE-third-party", "addon/fragmotion/LICENSE")
        assert {f"{info}/licenses/{licence}" for licence in licences} <= set(files)
        for path, text in files.items():  # what of the add-on is inside is in a folder of its own
            is_gpl = text.startswith(b"# SPDX-License-Identifier: GPL-3.0-or-later")
            assert is_gpl == path.startswith("fragmotion_blender/"), path


@platforms
def test_a_zip_is_small_without_sdl(platform: Platform) -> None:
    paths = [packages.extension_path(platform)] + ([packages.legacy_path(platform)] if platform.legacy else [])
    for path in paths:
        with zipfile.ZipFile(path) as archive:
            own = sum(entry.compress_size for entry in archive.infolist() if "sdl" not in entry.filename.lower())
        print(f"{path.name}: {own / 1e6:.2f} MB without SDL, {path.stat().st_size / 1e6:.2f} MB with it")
        assert own < MEGABYTES_WITHOUT_SDL * 1e6


@with_legacy
def test_the_legacy_zip_is_one_folder_with_sdl_and_no_manifest(platform: Platform) -> None:
    files = read(packages.legacy_path(platform))
    assert {name.partition("/")[0] for name in files} == {"fragmotion"}
    assert not any(name.endswith("blender_manifest.toml") for name in files)
    library = {"linux-x64": "libSDL2-2.0.so", "windows-x64": "SDL2.dll"}[platform.name]
    assert [name for name in files if "sdl2dll" in name] == [f"fragmotion/sdl2dll/dll/{library}"]
    assert "fragmotion/sdl2/__init__.py" in files


@platforms
def test_modules_link_only_what_the_platform_has(platform: Platform) -> None:
    for minor, data in modules_of(platform):
        binary = parse(data)
        allowed = [pattern.format(minor=minor) for pattern in LIBRARIES[platform.system]]
        libraries = {str(getattr(library, "name", library)) for library in binary.libraries if not is_own(library)}
        unknown = [name for name in libraries if not any(fnmatch.fnmatch(name.lower(), a.lower()) for a in allowed)]
        assert not unknown, f"Python 3.{minor}: {unknown}"
        assert binary_machine(binary) == PROCESSORS[platform.name]


@platforms
def test_modules_export_nothing_but_their_entry(platform: Platform) -> None:
    for minor, data in modules_of(platform):
        names = {function.name.removeprefix("_") for function in exported(parse(data))}
        others = {name for name in names if not re.match(SHOWN[platform.system], name)}
        assert others == {"PyInit_fragmotion_core"}, f"Python 3.{minor}"


@platforms
def test_modules_run_on_old_systems_and_take_everything_from_python_or_the_system(platform: Platform) -> None:
    check = {"Linux": check_elf, "Windows": check_pe, "Darwin": check_macho}[platform.system]
    for minor, data in modules_of(platform):
        assert check(parse(data)) == [], f"Python 3.{minor}"


def check_elf(binary: lief.Binary) -> list[str]:
    """The symbols that are neither glibc's nor Python's; its glibc must be old enough."""
    assert isinstance(binary, lief.ELF.Binary)
    versions = [
        tuple(int(part) for part in auxiliary.name.removeprefix("GLIBC_").split("."))
        for requirement in binary.symbols_version_requirement
        for auxiliary in requirement.get_auxiliary_symbols()
        if auxiliary.name.startswith("GLIBC_")
    ]
    assert versions and max(versions) <= OLDEST_GLIBC
    return [name for name in undefined(binary) if not symbol_has_version(binary, name) and not python_api(name)]


def check_pe(binary: lief.Binary) -> list[str]:
    """The names that are imported from Python's library and are not Python's; its Windows must be old enough."""
    assert isinstance(binary, lief.PE.Binary)
    assert binary.optional_header.major_operating_system_version <= OLDEST_WINDOWS
    python = [library for library in binary.imports if str(library.name).startswith("python3")]
    assert len(python) == 1
    return [str(entry.name) for entry in python[0].entries if not python_api(str(entry.name))]


def check_macho(binary: lief.Binary) -> list[str]:
    """The symbols that are neither the system's nor Python's; its macOS must be old enough."""
    assert isinstance(binary, lief.MachO.Binary)
    assert minimum_macos(binary) == OLDEST_MACOS
    foreign = []
    for symbol in binary.imported_symbols:
        library = symbol.binding_info.library.name if has_library(symbol) else ""
        name = str(symbol.name).removeprefix("_")
        if not library.startswith("/usr/lib/") and not python_api(name) and name not in system_symbols():
            foreign.append(f"{name} of {library or 'nowhere'}")
    return foreign


def is_own(library: object) -> bool:
    """Whether a library of a Mach-O file is the file's own name."""
    return isinstance(library, lief.MachO.DylibCommand) and library.command == lief.MachO.LoadCommand.TYPE.ID_DYLIB


@cache
def system_symbols() -> set[str]:
    """What macOS' libSystem has, by the list that zig links with."""
    listed = (cross.zig().parent / "lib" / "libc" / "darwin" / "libSystem.tbd").read_text()
    return {name.removeprefix("_") for name in re.findall(r"\b_[\w$]+", listed)}


@platforms
def test_the_same_sources_give_the_same_bytes(platform: Platform) -> None:
    before = {path.name: path.read_bytes() for path in packages.build(platform)}
    shutil.rmtree(cross.build_folder(platform) / "3.11")
    for made in (packages.wheels_for, packages.build):
        made.cache_clear()
    after = {path.name: path.read_bytes() for path in packages.build(platform)}
    assert [name for name in before if before[name] != after[name]] == []


def parse(data: bytes) -> lief.Binary:
    """A compiled module."""
    binary = lief.parse(list(data))
    assert isinstance(binary, lief.Binary), "neither ELF, PE nor Mach-O"
    return binary


def binary_machine(binary: lief.Binary) -> object:
    """The processor that it is for."""
    if isinstance(binary, lief.ELF.Binary):
        return binary.header.machine_type
    if isinstance(binary, lief.PE.Binary):
        return binary.header.machine
    assert isinstance(binary, lief.MachO.Binary)
    return binary.header.cpu_type


def exported(binary: lief.Binary) -> list[lief.Function]:
    """The functions that it shows to others."""
    return list(binary.exported_functions)


def undefined(binary: lief.ELF.Binary) -> list[str]:
    """The symbols that others must have; not those that may be missing."""
    weak = lief.ELF.Symbol.BINDING.WEAK
    return [str(symbol.name) for symbol in binary.imported_symbols if symbol.name and symbol.binding != weak]


def symbol_has_version(binary: lief.ELF.Binary, name: str) -> bool:
    """Whether glibc's version of the symbol is named."""
    symbol = binary.get_dynamic_symbol(name)
    return symbol is not None and symbol.symbol_version is not None and symbol.symbol_version.has_auxiliary_version


def has_library(symbol: lief.MachO.Symbol) -> bool:
    """Whether it is told where the symbol comes from; what is looked up while loading has no library."""
    return symbol.has_binding_info and symbol.binding_info.has_library


def python_api(name: str) -> bool:
    """Whether a symbol is Python's."""
    return re.match(r"_?Py", name) is not None


def minimum_macos(binary: lief.MachO.Binary) -> list[int]:
    """The oldest macOS that it runs on."""
    if binary.has_build_version:
        return list(binary.build_version.minos)
    return list(binary.version_min.version)
