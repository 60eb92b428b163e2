# SPDX-License-Identifier: MIT
"""Debian unstable in a folder of its own, for the engines that Debian's stable releases lack; takes root."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path

from tools.paths import TOP
from tools.setup import apt
from tools.shell import Failure, run, step

ROOT = Path(os.environ.get("FRAGMOTION_UNSTABLE", "/opt/fragmotion-sid"))
"""Where it lies. Outside of the project, so that no one who deletes build/ deletes what is mounted in it."""

_PATH = "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"
_FROM_OUTSIDE = ("/etc/resolv.conf", "/etc/pip.conf", "/etc/ssl/certs/ca-certificates.crt")
# What is mounted here is so for the command alone, and is gone with it.
_ENTER = """set -e
root=$1 top=$2 folder=$3; shift 3
mkdir -p "$root$top"
mount --bind "$top" "$root$top"
mount -t proc proc "$root/proc"
mount --rbind /dev "$root/dev"
exec chroot "$root" sh -c 'cd "$0" && exec "$@"' "$folder" "$@"
"""


def why_not() -> str | None:
    """Why nothing can run in it, and what to do; None where it can."""
    if not (ROOT / "usr" / "bin" / "apt-get").exists():
        return "Debian unstable is not set up: sudo python3 dev.py unstable"
    return None if os.geteuid() == 0 else "Debian unstable takes root: run this with sudo"


def command(words: Sequence[str | Path], folder: Path = TOP) -> list[str]:
    """What runs a command in it, from a folder of the project, which has the same path inside."""
    if reason := why_not():
        raise Failure(reason)
    inside = [f"PATH={_PATH}", "HOME=/root", "LANG=C.UTF-8", "LIBGL_ALWAYS_SOFTWARE=1"]
    arguments = [ROOT, TOP, folder, "env", *inside, *words]
    return ["unshare", "--mount", "sh", "-c", _ENTER, "sh", *(str(word) for word in arguments)]


def set_up(packages: Sequence[str]) -> None:
    """Make it, once, and install what is missing of the packages: several gigabytes."""
    if os.geteuid() != 0:
        raise Failure("Debian unstable takes root: run this with sudo")
    if why_not():
        apt.install(("debootstrap",), "apt-debootstrap")
        with step("Debian unstable", str(ROOT)):
            options = ("--variant=minbase", "--include=ca-certificates")
            run(["debootstrap", *options, "sid", ROOT, _mirror()], "debootstrap", timeout=3600.0)
    for path in filter(os.path.exists, _FROM_OUTSIDE):
        shutil.copy(path, f"{ROOT}{path}")
    shutil.copytree("/etc/apt/apt.conf.d", ROOT / "etc" / "apt" / "apt.conf.d", dirs_exist_ok=True)
    if absent := apt.missing(packages, ROOT):
        with step(f"{len(absent)} packages of Debian unstable", " ".join(absent)):
            run(command(["apt-get", "update", "-o", "Acquire::Retries=3"]), "unstable-update")
            install = ["env", "DEBIAN_FRONTEND=noninteractive", "apt-get", "install", *apt.OPTIONS, *absent]
            run(command(install), "unstable-install", timeout=3600.0)


def _mirror() -> str:
    """Where this machine's own packages come from."""
    words = ["apt-get", "indextargets", "--format", "$(REPO_URI)", "Created-By: Packages", "Label: Debian"]
    places = subprocess.run(words, capture_output=True, text=True, check=True).stdout.split()
    if not places:
        raise Failure("apt-get knows no Debian mirror: run apt-get update, then try again")
    return min(places)
