# SPDX-License-Identifier: MIT
"""`dev.py bench`: the core beside NumPy, scikit-learn and ozz-animation, and each of the project's goals."""
