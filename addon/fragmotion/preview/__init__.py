# SPDX-License-Identifier: GPL-3.0-or-later
"""An armature that shows something for a while, and is given back: a drive, a take or a class."""
