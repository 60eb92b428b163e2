# SPDX-License-Identifier: MIT
"""Debian packages: which are missing, and installing them as root or through sudo."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Iterable
from pathlib import Path

from tools.shell import Failure, run, step

OPTIONS = ("-y", "--no-install-recommends", "-o", "DPkg::Lock::Timeout=300", "-o", "Acquire::Retries=3")


def missing(packages: Iterable[str], root: Path = Path("/")) -> list[str]:
    """Those of the packages that are not installed in the system that lies there."""
    if not shutil.which("dpkg-query"):
        raise Failure(f"this is set up for Debian 12; elsewhere install the like of: {' '.join(packages)}")
    query = ["dpkg-query", f"--admindir={root / 'var' / 'lib' / 'dpkg'}", "-W", "-f=${binary:Package} ${Status}\n"]
    answer = subprocess.run(query, capture_output=True, text=True, check=True)
    installed = {line.split()[0].split(":")[0] for line in answer.stdout.splitlines() if line.endswith("ok installed")}
    return [package for package in packages if package not in installed]


def check_permission(packages: Iterable[str]) -> None:
    """Raise Failure with the command to run when packages are missing that this user cannot install."""
    absent = missing(packages)
    if absent and _root_prefix() is None:
        raise Failure(
            "Debian packages are missing, and only root can install them. Run this, then try again:\n"
            f"  sudo apt-get update && sudo apt-get install -y --no-install-recommends {' '.join(absent)}"
        )


def install(packages: Iterable[str], log: str) -> None:
    """Install what is missing of the packages; nothing is run when all are there."""
    absent = missing(packages)
    if not absent:
        return
    prefix = [*(_root_prefix() or ()), "env", "DEBIAN_FRONTEND=noninteractive", "apt-get"]
    with step(f"{len(absent)} Debian packages", " ".join(absent)):
        run([*prefix, "update", "-o", "Acquire::Retries=3"], f"{log}-update")
        run([*prefix, "install", *OPTIONS, *absent], log)


def _root_prefix() -> list[str] | None:
    if os.geteuid() == 0:
        return []
    sudo = shutil.which("sudo")
    if sudo and subprocess.run([sudo, "-n", "true"], capture_output=True, check=False).returncode == 0:
        return [sudo, "-n"]
    return None
