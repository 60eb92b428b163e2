# SPDX-License-Identifier: MIT
"""`python -m fragmotion_command` is `fragmotion`."""

from __future__ import annotations

import sys

from . import main

if __name__ == "__main__":
    sys.exit(main())
