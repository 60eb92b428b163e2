# SPDX-License-Identifier: MIT
"""What the commands need on this machine: Debian packages, Pythons, Blenders, Wine."""
