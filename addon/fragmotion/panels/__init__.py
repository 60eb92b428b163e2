# SPDX-License-Identifier: GPL-3.0-or-later
"""The sidebar's panels, and the entries in Blender's menus."""
