# SPDX-License-Identifier: MIT
"""Run pytest inside Blender: `blender -b --python run_in_blender.py -- PYTEST_FOLDER PYTEST_ARGUMENT...`.

PYTEST_FOLDER holds pytest and nothing that Blender brings itself, so that Blender's own NumPy is used.
"""

import sys

_folder, *_arguments = sys.argv[sys.argv.index("--") + 1 :]
sys.path.insert(0, _folder)

import pytest  # noqa: E402

sys.exit(pytest.main(_arguments))
