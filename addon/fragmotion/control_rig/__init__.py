# SPDX-License-Identifier: GPL-3.0-or-later
"""Rigs whose bones are moved by controls: a motion skeleton in their place, which the controls follow."""
