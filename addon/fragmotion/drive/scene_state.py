# SPDX-License-Identifier: GPL-3.0-or-later
"""The frame, the selection and the mode, to be given back after a drive."""

from __future__ import annotations

import bpy

from .. import versions


class SceneState:
    """What a drive leaves alone, but its user may not."""

    def __init__(self, context: bpy.types.Context, obj: bpy.types.Object) -> None:
        layer, scene = context.view_layer, context.scene
        self.scene, self.objects, self._obj = scene, layer.objects, obj
        self._layer = layer
        self._frame = scene.frame_current, scene.frame_subframe
        self._selected = {other.name for other in layer.objects if other.select_get(view_layer=layer)}
        self._active = layer.objects.active
        self._mode = self._active.mode if self._active is not None else "OBJECT"
        self._bones = versions.get_bone_selection(obj)

    def restore(self) -> None:
        """Give all back; what has been deleted meanwhile stays deleted."""
        if (self.scene.frame_current, self.scene.frame_subframe) != self._frame:
            self.scene.frame_set(self._frame[0], subframe=self._frame[1])
        if self._is_other_mode():
            bpy.ops.object.mode_set(mode="OBJECT")
        objects = self._layer.objects
        for other in objects:
            if other.select_get(view_layer=self._layer) != (other.name in self._selected):
                other.select_set(other.name in self._selected, view_layer=self._layer)
        if objects.active != self._active:
            objects.active = self._active
        if self._is_other_mode():
            bpy.ops.object.mode_set(mode=self._mode)
        versions.set_bone_selection(self._obj, self._bones)

    def _is_other_mode(self) -> bool:
        active = self._layer.objects.active
        return bpy.context.view_layer == self._layer and active is not None and active.mode != self._mode
