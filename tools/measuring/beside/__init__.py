# SPDX-License-Identifier: MIT
"""`dev.py beside`: Fragmotion beside motion matching, on the same takes and sessions, by the same measures."""
