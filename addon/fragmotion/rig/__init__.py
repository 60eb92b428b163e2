# SPDX-License-Identifier: GPL-3.0-or-later
"""An armature: as the core's rig, its poses, what else moves it, and motions as its keys."""
