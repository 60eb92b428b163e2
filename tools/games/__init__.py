# SPDX-License-Identifier: MIT
"""What plays a character without Blender."""
