# SPDX-License-Identifier: MIT
"""Pythons from Maven Central's org.bytedeco:cpython: one that runs here, or the headers of one that runs elsewhere."""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import ssl
import stat
import subprocess
import threading
import zipfile
from collections.abc import Callable
from functools import cache
from pathlib import Path, PurePosixPath

from tools.paths import BUILD
from tools.platforms import LINUX, WINDOWS, Platform
from tools.shell import Failure, run, step

PACKAGES = ("maven",)
"""The Debian packages that it takes."""

VERSIONS = {"3.10": "3.10.8-1.5.8", "3.11": "3.11.3-1.5.9", "3.13": "3.13.5-1.5.12", "3.14": "3.14.3-1.5.13"}
"""The Pythons that it has, and which artifact of each."""

_COPY = "org.apache.maven.plugins:maven-dependency-plugin:3.6.1:copy"
_JARS = BUILD / "maven"
_JAVA_CERTIFICATES = Path("/etc/ssl/certs/java/cacerts")  # where Debian keeps them
_ONE_AT_A_TIME = threading.Lock()


def ensure_python(version: str) -> Path:
    """The interpreter of a Python ("3.11") for this machine, whole, in build/python/3.11."""
    folder = BUILD / "python" / version
    interpreter = folder / "bin" / f"python{version}"
    if not interpreter.exists():
        _unpack(_jar(version, LINUX.artifact), folder, lambda name: not name.startswith(f"lib/python{version}/test/"))
        for path in (folder / "bin").iterdir():
            path.chmod(path.stat().st_mode | stat.S_IXUSR | stat.S_IXGRP | stat.S_IXOTH)
    return interpreter


def ensure_windows_python(version: str, folder: Path) -> None:
    """Put Windows' Python, whole, into a folder: python.exe, and what it needs beside it."""
    if not (folder / "python.exe").exists():
        _unpack(_jar(version, WINDOWS.artifact), folder, lambda name: not name.startswith("lib/test/"))


def has_headers(platform: Platform) -> bool:
    """Whether nothing of what `ensure_headers` gives is missing."""
    folder = BUILD / "headers" / platform.artifact
    return all((folder / version / "include" / "Python.h").exists() for version in platform.pythons)


def ensure_headers(platform: Platform) -> Path:
    """The folder whose VERSION/include and VERSION/libs are those of the platform's Pythons."""
    folder = BUILD / "headers" / platform.artifact
    for version in platform.pythons:
        if not (folder / version / "include" / "Python.h").exists():
            _unpack_headers(_jar(version, platform.artifact), folder / version, version)
    return folder


def _unpack_headers(jar: Path, folder: Path, version: str) -> None:
    _unpack(
        jar, folder, lambda name: name.startswith("include/") or name == f"libs/python{version.replace('.', '')}.lib"
    )
    inner = folder / "include" / f"python{version}"
    if inner.is_dir():  # all but Windows
        inner.rename(folder / "headers")
        (folder / "include").rmdir()
        (folder / "headers").rename(folder / "include")


def _unpack(jar: Path, folder: Path, wanted: Callable[[str], bool]) -> None:
    """Unpack what is wanted of the files under org/bytedeco/cpython/PLATFORM/, all of it or nothing."""
    partial = folder.with_name(f"{folder.name}.partial")
    shutil.rmtree(partial, ignore_errors=True)
    shutil.rmtree(folder, ignore_errors=True)
    with zipfile.ZipFile(jar) as archive:
        for member in archive.infolist():
            name = "/".join(PurePosixPath(member.filename).parts[4:])
            if member.filename.startswith("org/") and name and not member.is_dir() and wanted(name):
                target = partial / name
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_bytes(archive.read(member))
    partial.rename(folder)


def _jar(version: str, classifier: str) -> Path:
    """The artifact of a Python for one platform, downloaded unless it is here."""
    if version not in VERSIONS:
        raise Failure(f"Python {version} is needed; install it, as only {', '.join(VERSIONS)} can be downloaded")
    artifact = f"org.bytedeco:cpython:{VERSIONS[version]}:jar:{classifier}"
    jar = _JARS / f"cpython-{VERSIONS[version]}-{classifier}.jar"
    with _ONE_AT_A_TIME:
        if not jar.exists():
            partial = _JARS / "partial"
            where = [f"-Dartifact={artifact}", f"-DoutputDirectory={partial}"]
            with step(f"Python {version} for {classifier}", "(about 25 MB)"):
                run(["mvn", "-B", *_trusting(), _COPY, *where], f"maven-{jar.stem}")
                (partial / jar.name).rename(jar)
    return jar


@cache
def _trusting() -> list[str]:
    """Maven's options to trust, beside Java's own certificates, those of SSL_CERT_FILE, as pip and apt do."""
    bundle = os.environ.get("SSL_CERT_FILE")
    if not bundle or not _JAVA_CERTIFICATES.exists():
        return []
    _JARS.mkdir(parents=True, exist_ok=True)
    store = _JARS / "certificates"
    shutil.copy(_JAVA_CERTIFICATES, store)
    keytool = ["keytool", "-keystore", str(store), "-storepass", "changeit", "-noprompt"]
    known = subprocess.run([*keytool, "-list"], capture_output=True, text=True, check=False).stdout
    for certificate in re.findall(
        r"-----BEGIN CERTIFICATE-----.*?-----END CERTIFICATE-----", Path(bundle).read_text(), re.DOTALL
    ):
        name = hashlib.sha256(ssl.PEM_cert_to_DER_cert(certificate)).hexdigest()
        if ":".join(re.findall("..", name.upper())) not in known:
            subprocess.run(
                [*keytool, "-importcert", "-alias", name],
                input=certificate,
                text=True,
                capture_output=True,
                check=False,
            )
    return [f"-Djavax.net.ssl.trustStore={store}"]
