# SPDX-License-Identifier: MIT
"""What dev.py does, a folder for what each does. What needs no core of the command `fragmotion` is found without it."""

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).parents[1] / "cpp" / "bindings"))
