# SPDX-License-Identifier: GPL-3.0-or-later
"""What a stick did: kept with the armature, and as the trace that a stage asks for."""
