# SPDX-License-Identifier: MIT
"""How long daily work takes: import and Build of 159 takes, a step of a drive, opening a file with ten characters.

`dev.py test blender-4.5 -k daily` prints the figures: processors' time, which a busy machine may double. So what is
bounded is how long it takes beside what Blender's own importer takes for these takes in the same run.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import bpy
import numpy as np
import pytest
from making import MOCAP

IMPORT, BUILD = 0.4, 0.6  # of the time of Blender's importer, which only makes an armature and an Action of each take
STEP, OPENING = 2e-4, 0.03
STEPS, CHARACTERS, TIMES = 600, 10, 3
SAMPLE = 10  # one of so many takes goes through Blender's importer


def seconds(work: Callable[[], object]) -> float:
    """The processors' time that it takes, s."""
    begin = time.process_time()
    work()
    return time.process_time() - begin


def blenders_import(takes: list[Path]) -> float:
    """The processors' time that Blender's importer takes for all takes, s, told by some of them."""
    some = takes[::SAMPLE]
    taken = seconds(lambda: [bpy.ops.import_anim.bvh(filepath=str(path)) for path in some])
    return taken * sum(path.stat().st_size for path in takes) / sum(path.stat().st_size for path in some)


def quickest_opening(path: Path) -> float:
    return min(seconds(lambda: bpy.ops.wm.open_mainfile(filepath=str(path))) for _ in range(TIMES))


@pytest.mark.measures
@pytest.mark.skipif(not MOCAP.is_dir(), reason="the takes of Bandai Namco are not there")
def test_daily_work_is_quick(
    addon: ModuleType, session: ModuleType, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = MOCAP / "bandai-namco"
    importing = seconds(lambda: bpy.ops.fragmotion.import_mocap("EXEC_DEFAULT", directory=str(folder)))
    building = seconds(lambda: bpy.ops.fragmotion.build("EXEC_DEFAULT"))
    obj = bpy.context.view_layer.objects.active
    driven = session.start(bpy.context, obj)
    driven.inputs.keyboard.press("W")
    steps = [seconds(lambda: driven.update(1 / 60)) for _ in range(STEPS)]
    session.stop()
    for action in list(bpy.data.actions):
        bpy.data.actions.remove(action)
    for _ in range(CHARACTERS - 1):
        bpy.context.scene.collection.objects.link(obj.copy())
    path = tmp_path / "ten.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    size, opening = len(obj.fragmotion.policy), quickest_opening(path)
    bpy.ops.preferences.addon_disable(module=addon.__name__)
    try:
        bare = quickest_opening(path)
    finally:
        bpy.ops.preferences.addon_enable(module=addon.__name__)
    blenders = blenders_import(sorted(folder.glob("*.bvh")))
    with capsys.disabled():
        print(
            f"\nprocessors' time: import of 159 takes {importing:.2f} s; Build {building:.2f} s; a step of a drive "
            f"{1e3 * np.median(steps):.2f} ms, 95 % {1e3 * np.quantile(steps, 0.95):.2f} ms; opening {CHARACTERS} "
            f"characters of {size / 1e6:.1f} MB {opening:.2f} s, without the add-on {bare:.2f} s; Blender's "
            f"import of the takes {blenders:.2f} s"
        )
    assert importing < IMPORT * blenders and building < BUILD * blenders
    assert np.median(steps) < STEP * blenders and opening - bare < OPENING * blenders
