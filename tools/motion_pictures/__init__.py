# SPDX-License-Identifier: MIT
"""Pictures of motion: sheets that compare the takes with what is played from them, and a turntable of a drive."""
