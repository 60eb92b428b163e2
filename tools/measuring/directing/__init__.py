# SPDX-License-Identifier: MIT
"""`dev.py directing`: how well a character does what it is directed to: paths, pins, moves, styles, ground."""
