# SPDX-License-Identifier: MIT
"""Pictures that are made in a Blender with a window."""
