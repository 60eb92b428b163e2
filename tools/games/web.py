# SPDX-License-Identifier: MIT
"""`dev.py web`: the live page as one folder of static files, and the ES module `fragmotion` that it uses."""

from __future__ import annotations

import shutil
from pathlib import Path

from tools.games import sample
from tools.packaging.compiling import COMPILING
from tools.paths import BUILD, TOP
from tools.setup import unstable
from tools.shell import Failure, run, say

_WEB = TOP / "games" / "web"
_BUILT = BUILD / "web"
_LICENSES = (TOP / "LICENSE", TOP / "LICENSE-third-party")
_THREE = "0.187.0"
# What the page takes of three.js: where it lies in npm's package, and where in ours.
_OF_THREE = {
    "LICENSE": "LICENSE",
    "build/three.module.js": "three.module.js",
    "build/three.core.js": "three.core.js",
    "examples/jsm/capabilities/WebGL.js": "addons/capabilities/WebGL.js",
    "examples/jsm/loaders/GLTFLoader.js": "addons/loaders/GLTFLoader.js",
    "examples/jsm/utils/BufferGeometryUtils.js": "addons/utils/BufferGeometryUtils.js",
    "examples/jsm/utils/SkeletonUtils.js": "addons/utils/SkeletonUtils.js",
}


def make(folder: Path) -> None:
    """Write the page into a folder, which is new, empty, or a page that was made before."""
    if folder.exists() and any(folder.iterdir()) and not (folder / "fragmotion" / "fragmotion.js").exists():
        raise Failure(f"{folder} holds something else than the live page: name a new or an empty folder")
    made = module(), _three(), sample.make()
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(_WEB / "page", folder)
    shutil.copytree(made[0], folder / "fragmotion")
    shutil.copytree(made[1], folder / "three")
    for name in ("sample.policy", "sample.glb"):
        shutil.copy(made[2] / name, folder)
    size = sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())
    say(f"{folder}: {size / 1e6:.1f} MB; see it by: python3 -m http.server --directory {folder}")


def module() -> Path:
    """Build the ES module `fragmotion` into a folder that npm can pack; the folder."""
    folder, package = _BUILT / "wasm", _BUILT / "fragmotion"
    configure: list[str | Path] = [
        "emcmake",
        "cmake",
        "-S",
        _WEB / "module",
        "-B",
        folder,
        "-G",
        "Ninja",
        "-DCMAKE_BUILD_TYPE=Release",
    ]
    with COMPILING:
        run(unstable.command(configure), "cmake-web")
        run(unstable.command(["cmake", "--build", folder]), "build-web")
    shutil.rmtree(package, ignore_errors=True)
    shutil.copytree(_WEB / "module", package, ignore=shutil.ignore_patterns("CMakeLists.txt"))
    for path in (folder / "wasm.mjs", folder / "wasm.wasm", *_LICENSES):
        shutil.copy(path, package)
    return package


def _three() -> Path:
    """What the page takes of three.js, once; the folder."""
    folder = _BUILT / f"three-{_THREE}"
    if not folder.exists():
        packed, fresh = _BUILT / "npm", _BUILT / "fresh"
        shutil.rmtree(packed, ignore_errors=True)
        packed.mkdir(parents=True)
        run(unstable.command(["npm", "pack", "--silent", f"three@{_THREE}"], packed), "npm-three")
        shutil.unpack_archive(packed / f"three-{_THREE}.tgz", packed)
        for source, target in _OF_THREE.items():
            (fresh / target).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(packed / "package" / source, fresh / target)
        fresh.rename(folder)
    return folder
