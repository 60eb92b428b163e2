# SPDX-License-Identifier: MIT
"""Make the README's pictures from what the demo left in build/demo. After `python3 dev.py demo`:

blender --background --factory-startup --python-exit-code 1 --python docs/make_pictures.py [-- DEMO_FOLDER]
"""

from __future__ import annotations

import sys
from pathlib import Path

import bpy

DOCS = Path(__file__).resolve().parent
QUALITY = 85


def save_jpeg(picture: Path, target: Path) -> None:
    """A PNG as a JPEG, its colours unchanged."""
    scene = bpy.context.scene
    scene.view_settings.view_transform = "Standard"
    scene.render.image_settings.file_format = "JPEG"
    scene.render.image_settings.quality = QUALITY
    bpy.data.images.load(str(picture)).save_render(str(target), scene=scene)


def main() -> None:
    """Convert the filmstrip: as PNG it is too large for a README."""
    arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    demo = Path(arguments[0]).resolve() if arguments else DOCS.parent / "build" / "demo"
    target = DOCS / "filmstrip.jpg"
    save_jpeg(demo / "filmstrip.png", target)
    print(f"{target}: {target.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
