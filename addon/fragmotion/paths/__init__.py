# SPDX-License-Identifier: GPL-3.0-or-later
"""Paths that a character follows: from what Blender has, and what becomes of them."""
