# SPDX-License-Identifier: MIT
"""The gate for quality: figures of the sample's takes that no change may make worse, in tests/quality/baseline.json."""
