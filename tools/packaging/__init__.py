# SPDX-License-Identifier: MIT
"""Compiling the core, and making the wheels and zips of it."""
