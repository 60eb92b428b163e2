# SPDX-License-Identifier: MIT
"""How like the takes a character looks that re-enacts takes which it does not know."""
