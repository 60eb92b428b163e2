# SPDX-License-Identifier: GPL-3.0-or-later
"""The armature that is driven: what plays it, and what is kept while the user records."""
