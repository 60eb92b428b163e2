# SPDX-License-Identifier: GPL-3.0-or-later
"""A character's performance as keys: what plays, where it goes, and crowds."""
