# SPDX-License-Identifier: GPL-3.0-or-later
"""What an armature has learned: built, kept, named, explained and previewed."""
