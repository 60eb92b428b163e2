# SPDX-License-Identifier: MIT
"""What is measured, a module each."""
