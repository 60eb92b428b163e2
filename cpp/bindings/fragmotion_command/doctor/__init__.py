# SPDX-License-Identifier: MIT
"""`fragmotion doctor`: what is wrong with motion capture files, before anything is made of them."""

from __future__ import annotations

import argparse

from ..files import BY_BLENDER, find_takes
from ..running import Done
from .examining import examine, is_readable
from .report import lines


def doctor(options: argparse.Namespace) -> Done:
    """Examine files; the exit code is 1 where one cannot be read."""
    result = examine(find_takes(options.takes, BY_BLENDER))
    return Done(result, "\n".join(lines(result)), 0 if all(map(is_readable, result["files"])) else 1)
