# SPDX-License-Identifier: MIT
"""The parts of dev.py; the standard library only, so that a bare machine can run them."""
