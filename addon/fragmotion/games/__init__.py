# SPDX-License-Identifier: GPL-3.0-or-later
"""A character with its mesh, as games take it."""
