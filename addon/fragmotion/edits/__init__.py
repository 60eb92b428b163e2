# SPDX-License-Identifier: GPL-3.0-or-later
"""Recordings changed afterwards: played again from a change on, cut, glued, pinned."""
