# SPDX-License-Identifier: GPL-3.0-or-later
"""What the user sets, in the .blend and in the preferences, and how its fields are drawn."""
