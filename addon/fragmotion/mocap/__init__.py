# SPDX-License-Identifier: GPL-3.0-or-later
"""Motion capture: files to Actions, Actions to clips, and the frames that are left out."""
