# SPDX-License-Identifier: MIT
"""`dev.py tune`: fits the run time's constants by what players and viewers see, and judges them on takes not fitted."""
