# SPDX-License-Identifier: MIT
"""Bodies, their rotations and legs, in NumPy."""
