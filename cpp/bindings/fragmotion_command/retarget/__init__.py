# SPDX-License-Identifier: MIT
"""`fragmotion retarget`: takes of any skeletons on another one, and the character that they make."""
