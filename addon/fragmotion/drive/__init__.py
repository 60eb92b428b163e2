# SPDX-License-Identifier: GPL-3.0-or-later
"""Live driving: inputs to controls, controls to the armature's pose, what is drawn over the view, and recording."""
