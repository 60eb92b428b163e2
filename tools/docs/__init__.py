# SPDX-License-Identifier: MIT
"""Making the pictures and the tables of README.md and docs/, all from what the program itself does."""
