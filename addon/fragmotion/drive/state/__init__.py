# SPDX-License-Identifier: GPL-3.0-or-later
"""What a drive puts aside and gives back: the armature's own pose and animation, and the scene's."""
