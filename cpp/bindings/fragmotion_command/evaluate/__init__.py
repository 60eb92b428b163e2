# SPDX-License-Identifier: MIT
"""`fragmotion evaluate`: how good the policies are on given takes and traces, by the measures of the paper's Sec. 4."""
