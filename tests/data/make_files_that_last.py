# SPDX-License-Identifier: MIT
"""Make a .blend that all later versions must open, with the add-on as it is: once for each version of the files.

`blender --background --factory-startup --python-exit-code 1 --python make_files_that_last.py -- ADDON.zip FOLDER`, in
Debian's Blender 3.4.1, so that all later ones open them; `tests/blender/test_files_that_last.py` says what must work.
"""

from __future__ import annotations

import sys
from importlib import import_module
from pathlib import Path

import bpy

sys.path.append(str(Path(__file__).parents[1] / "blender"))

import driving
import making

_TAKES, _FRAMES = 2, 30
_UNUSED = ("brushes", "palettes", "linestyles", "textures", "images", "materials", "lights", "worlds", "paint_curves")


def make_character(module: str) -> bpy.types.Object:
    """A small rig with a character, named classes, a recording, and an imported take to train on."""
    obj = making.add_armature(name="Hero")
    for index in range(_TAKES):
        making.add_action(obj, _FRAMES, seed=index, name=f"way {index}").use_fake_user = True
    bpy.ops.fragmotion.tick_actions(use=True)
    small = {"classes": 4, "seconds": 2.0, "mirror": False, "synthesize": False}
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", **small) == {"FINISHED"}
    obj.fragmotion.classes[1].name, obj.fragmotion.classes[2].excluded = "Stride", True
    obj.fragmotion.feel.responsiveness = 0.25
    bpy.data.actions["way 0"].fragmotion.left_out.add().last = 3
    session, recordings = import_module(f"{module}.drive.session"), import_module(f"{module}.recordings.recordings")
    recordings.add_recording(obj, making.waves(30, 4, 1) ** 2, name="Imported", seed=7, start=(1, 2, 0.5)).train = True
    driven = driving.start(session, obj)
    driven.inputs.keyboard.press("W")
    driven.toggle_recording()
    driving.go_on(driven, 1)
    driven.toggle_recording()
    session.stop()
    obj.fragmotion.recordings[-1].name = "Recorded"
    return obj


def make_room() -> None:
    """Delete what each new file has and none of the tests looks at, which is most of it."""
    for name in _UNUSED:
        bpy.data.batch_remove(getattr(bpy.data, name))


def add_twin(obj: bpy.types.Object, module: str) -> None:
    """A copy that keeps its policy beside the file, noted as in an autosave in the middle of a drive."""
    twin = obj.copy()
    twin.name = "Twin"
    bpy.context.scene.collection.objects.link(twin)
    twin.fragmotion.keep_policy = "BESIDE"
    import_module(f"{module}.preview.suspended_state").put_aside(twin)


def main(package: str, folder: Path) -> None:
    """Save the file, and the policy that is kept beside it."""
    module = making.install(package)
    paths = bpy.context.preferences.filepaths
    paths.save_version, paths.file_preview_type = 0, "NONE"
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    make_room()
    add_twin(make_character(module), module)
    for _ in range(2):  # 3.4 does not tell an add-on where a first save goes
        bpy.ops.wm.save_as_mainfile(filepath=str(folder / "kept.blend"), compress=True, check_existing=False)


arguments = sys.argv[sys.argv.index("--") + 1 :]
main(arguments[0], Path(arguments[1]).resolve())
