# SPDX-License-Identifier: MIT
"""`dev.py retarget`: takes of any skeletons on another one, and the character that they make."""
