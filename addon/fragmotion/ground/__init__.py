# SPDX-License-Identifier: GPL-3.0-or-later
"""What a character stands on: meshes as the core's player asks for them."""
