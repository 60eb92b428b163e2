# SPDX-License-Identifier: GPL-3.0-or-later
"""What differs between the Blenders and between the zips: versions, and where the compiled core is."""
