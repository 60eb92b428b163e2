# SPDX-License-Identifier: MIT
"""What the motion of both methods is judged by."""
