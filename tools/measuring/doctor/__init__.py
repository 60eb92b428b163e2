# SPDX-License-Identifier: MIT
"""`dev.py doctor`: what is wrong with motion capture files, before anything is made of them."""
