# SPDX-License-Identifier: MIT
"""`dev.py directing`: how well a character does what it is directed to: paths that it follows, and pins."""
