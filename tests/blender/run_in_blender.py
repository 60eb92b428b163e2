# SPDX-License-Identifier: MIT
"""Run pytest inside Blender: `blender -b --python run_in_blender.py -- PYTEST_FOLDER PYTEST_ARGUMENT...`.

PYTEST_FOLDER holds pytest and nothing that Blender brings itself, so that Blender's own NumPy is used. Blender ends at
once with pytest's result: a Python that is taken down while Blender's data is there crashes in 4.3 where tests hold it.
"""

import os
import sys

_folder, *_arguments = sys.argv[sys.argv.index("--") + 1 :]
sys.path.insert(0, _folder)

import pytest  # noqa: E402

_result = pytest.main(_arguments)
sys.stdout.flush()
sys.stderr.flush()
os._exit(_result)
