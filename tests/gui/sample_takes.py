# SPDX-License-Identifier: MIT
"""The sample character's Actions as BVH files, to be imported as a user would."""

from __future__ import annotations

import re
from pathlib import Path

import bpy
import making
import numpy as np

_CENTIMETRES = 100
_ORDER = "Xposition Yposition Zposition Zrotation Xrotation Yrotation"  # as Blender writes a world whose z is up
_Y_UP = ("Zrotation Xrotation Yrotation", "Yrotation Xrotation Zrotation")


def export_takes(folder: Path) -> None:
    """Open the sample file, and write each of its ticked Actions to a BVH file of that name by Blender's own
    exporter."""
    folder.mkdir()
    obj = making.open_sample()
    for action in filter(lambda action: action.fragmotion.use, bpy.data.actions):
        making.play(obj, action, 1)
        path = folder / f"{action.name}.bvh"
        first, last = (round(frame) for frame in action.frame_range)
        with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
            bpy.ops.export_anim.bvh(
                filepath=str(path), frame_start=first, frame_end=last, rotate_mode="ZXY", global_scale=_CENTIMETRES
            )
        path.write_text(_with_y_up(path.read_text()))


def _with_y_up(text: str) -> str:
    """A BVH file whose z is up as one whose y is: (x, y, z) becomes (x, z, -y)."""
    head, numbers = re.split(r"(?<=Frame Time: )\S+\n", text)
    time = re.search(r"Frame Time: (\S+)", text)
    assert time and _ORDER in head
    channels = re.findall(r"\wposition|\wrotation", head)
    rows = np.array([row.split() for row in numbers.strip().splitlines()], float)
    for index, channel in enumerate(channels):
        if channel == "Yposition":
            rows[:, [index, index + 1]] = np.column_stack((rows[:, index + 1], -rows[:, index]))
        elif channel == "Yrotation":
            rows[:, index] *= -1
    head = re.sub(r"OFFSET (\S+) (\S+) (\S+)", lambda found: "OFFSET {0} {2} {1}".format(*_turned(found)), head)
    return head.replace(*_Y_UP) + time[1] + "\n" + "\n".join(" ".join(f"{x:.6f}" for x in row) for row in rows) + "\n"


def _turned(offset: re.Match[str]) -> tuple[str, float, str]:
    return offset[1], -float(offset[2]), offset[3]
