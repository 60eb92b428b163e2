# SPDX-License-Identifier: MIT
"""Run inside Blender by `dev.py demo`: install the zip as a user would, and show what the add-on does.

Arguments after `--`: the output folder and the add-on's zip.
"""

from __future__ import annotations

import sys
from importlib import import_module

import bpy


def install(package: str) -> None:
    """Install and enable the legacy zip with Blender's own operators."""
    bpy.ops.preferences.addon_install(filepath=package)
    bpy.ops.preferences.addon_enable(module="fragmotion")


def main(output: str, package: str) -> None:
    """Install the add-on and say what runs."""
    install(package)
    core = import_module("fragmotion.core").core
    print(f"Fragmotion's core {core.__version__} in Blender {bpy.app.version_string}; output folder: {output}")


main(*sys.argv[sys.argv.index("--") + 1 :])
