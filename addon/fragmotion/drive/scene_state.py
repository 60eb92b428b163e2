# SPDX-License-Identifier: GPL-3.0-or-later
"""The frame, the selection and the mode, to be given back after a drive."""

from __future__ import annotations

import bpy

from ..compat import versions
from ..compat.data_blocks import is_alive


class SceneState:
    """What a drive leaves alone, but its user may not.

    Blender tells when a data-block that Python holds is gone, but not when a view layer is: it is found anew each time.
    """

    def __init__(self, context: bpy.types.Context, obj: bpy.types.Object) -> None:
        layer, scene = context.view_layer, context.scene
        self.scene, self._obj = scene, obj
        self._layer = layer.as_pointer()
        self._frame = scene.frame_current, scene.frame_subframe
        self._selected = {other.as_pointer() for other in layer.objects if other.select_get(view_layer=layer)}
        self._active = layer.objects.active
        self._mode = self._active.mode if self._active is not None else "OBJECT"
        self._bones = versions.get_bone_selection(obj)

    @property
    def layer(self) -> bpy.types.ViewLayer | None:
        """The view layer, if it is still there."""
        layers = self.scene.view_layers if is_alive(self.scene) else ()
        return next((layer for layer in layers if layer.as_pointer() == self._layer), None)

    def trouble(self) -> str:
        """What has become of the scene that a drive needs, empty where it is shown as it was."""
        if not is_alive(self.scene):
            return "The scene was deleted"
        layer = self.layer
        if layer is None:
            return "The view layer was removed"
        if self._obj.name not in layer.objects:
            return f"Armature '{self._obj.name}' is not in the view layer any more"
        return "" if bpy.context.scene == self.scene else "Another scene is shown"

    def restore(self) -> None:
        """Give all back; what has been deleted meanwhile stays deleted."""
        if is_alive(self.scene) and (self.scene.frame_current, self.scene.frame_subframe) != self._frame:
            self.scene.frame_set(self._frame[0], subframe=self._frame[1])
        layer = self.layer
        if layer is not None:
            self._restore_selection(layer)
        if is_alive(self._obj):
            versions.set_bone_selection(self._obj, self._bones)

    def _restore_selection(self, layer: bpy.types.ViewLayer) -> None:
        """Give back which objects are selected, which is active, and its mode."""
        if layer.objects.active != self._active:
            _set_mode(layer, "OBJECT")
        for other in layer.objects:
            selected = other.as_pointer() in self._selected
            if other.select_get(view_layer=layer) != selected:
                other.select_set(selected, view_layer=layer)
        if self._active is None or (is_alive(self._active) and self._active.name in layer.objects):
            layer.objects.active = self._active
            _set_mode(layer, self._mode)


def _set_mode(layer: bpy.types.ViewLayer, mode: str) -> None:
    """Bring the active object to a mode, where Blender lets it: in the view layer that is shown."""
    active = layer.objects.active
    if active is None or active.mode == mode or bpy.context.view_layer != layer:
        return
    if bpy.ops.object.mode_set.poll():
        bpy.ops.object.mode_set(mode=mode)
