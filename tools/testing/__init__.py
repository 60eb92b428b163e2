# SPDX-License-Identifier: MIT
"""The stages of `dev.py test`, and the fuzzers."""
