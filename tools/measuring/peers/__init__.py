# SPDX-License-Identifier: MIT
"""Other methods, to compare with."""
