# SPDX-License-Identifier: GPL-3.0-or-later
"""What drives: pads, keyboard, the stick on the screen, traces; and controls from what they say."""
