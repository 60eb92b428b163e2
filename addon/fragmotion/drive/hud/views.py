# SPDX-License-Identifier: GPL-3.0-or-later
"""The 3D views, found anew each time: Blender frees an area when the user closes it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import bpy

_SIDES = {"TOOLS", "UI"}
_TOPS = {"HEADER", "TOOL_HEADER"}


class Free(NamedTuple):
    """What no toolbar, sidebar or header covers of a view; pixels of its region."""

    left: float
    bottom: float
    right: float
    top: float


class Views:
    """The 3D view in which a drive began, or another one where that is closed."""

    def __init__(self, area: bpy.types.Area | None) -> None:
        self._pointer = area.as_pointer() if area is not None else 0

    def main(self) -> bpy.types.Area | None:
        """The view's area, if there is any 3D view."""
        areas = list(all_areas())
        return next((area for area in areas if area.as_pointer() == self._pointer), areas[0] if areas else None)

    def is_main(self, area: bpy.types.Area | None) -> bool:
        """Whether this is the view's area."""
        main = self.main()
        return main is not None and area is not None and area.as_pointer() == main.as_pointer()

    def rotation(self) -> list[list[float]]:
        """Rows of the view matrix's rotation; from the front where there is no view."""
        area = self.main()
        if area is None:
            return [[1, 0, 0], [0, 0, 1], [0, -1, 0]]
        return [list(row)[:3] for row in area.spaces.active.region_3d.view_matrix][:3]


def all_areas() -> Iterator[bpy.types.Area]:
    """Every 3D view of every window."""
    for window in bpy.context.window_manager.windows:
        yield from areas_of(window)


def areas_of(window: bpy.types.Window) -> Iterator[bpy.types.Area]:
    """Every 3D view of a window."""
    return (area for area in window.screen.areas if area.type == "VIEW_3D")


def all_views() -> list[Any]:
    """Their RegionView3D."""
    return [area.spaces.active.region_3d for area in all_areas()]


def tag_redraw(kind: str = "WINDOW") -> None:
    """Have the views drawn, or another kind of their regions: their sidebars, with all the panels."""
    for area in all_areas():
        for region in area.regions:
            if region.type == kind:
                region.tag_redraw()


def window_region(area: bpy.types.Area) -> bpy.types.Region:
    """The region in which the scene is drawn."""
    return next(region for region in area.regions if region.type == "WINDOW")


def free_part(area: bpy.types.Area) -> Free:
    """Where there is room to draw."""
    main = window_region(area)
    left, right, top = 0, main.width, main.height
    for region in area.regions:
        if region.width <= 1 or region.height <= 1:
            continue
        if region.type in _SIDES and region.alignment == "LEFT":
            left = max(left, region.x + region.width - main.x)
        elif region.type in _SIDES:
            right = min(right, region.x - main.x)
        elif region.type in _TOPS:
            top = min(top, region.y - main.y) if region.y > main.y + main.height / 2 else top
    return Free(left, 0, right, top)


def is_inside(part: Any, event: bpy.types.Event) -> bool:
    """Whether the mouse is over an area or a region."""
    across, up = event.mouse_x - part.x, event.mouse_y - part.y
    return bool(0 <= across < part.width and 0 <= up < part.height)
