# SPDX-License-Identifier: MIT
"""What measures the core: benchmarks, and the commands that play characters and judge them."""
