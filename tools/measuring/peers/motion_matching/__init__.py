# SPDX-License-Identifier: MIT
"""Motion matching, the method that games use today: what Fragmotion is held against. Needs NumPy and SciPy."""
