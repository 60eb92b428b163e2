# SPDX-License-Identifier: MIT
"""Make the pictures of docs/motion.md in docs/motion: a sheet for each movement, and a turntable of a drive.

python3 docs/make_motion_pictures.py                  (the sample character)
python3 docs/make_motion_pictures.py FOLDER           (a character of the folder's BVH files; pictures in build/motion)

It sets up what it needs as dev.py does, and takes a minute or two with the core already built.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
from pathlib import Path

DOCS = Path(__file__).resolve().parent
sys.path.insert(0, str(DOCS.parent))

from tools.packaging import packages  # noqa: E402
from tools.packaging.compiling import installed_core  # noqa: E402
from tools.paths import BUILD, TOP  # noqa: E402
from tools.setup import machine  # noqa: E402
from tools.setup.environments import BPY_PYTHON, environment_python  # noqa: E402
from tools.shell import Failure  # noqa: E402

SAMPLE = TOP / "sample_rigs" / "fragmotion_sample.blend"


def main(arguments: list[str]) -> int:
    """Build the core, and let tools.motion_pictures draw with it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("takes", nargs="?", type=Path, metavar="FOLDER", help="BVH files of one skeleton")
    options = parser.parse_args(arguments)
    takes, folder = (options.takes.resolve(), BUILD / "motion") if options.takes else (SAMPLE, DOCS / "motion")
    try:
        machine.set_up(machine.measuring_needs(BPY_PYTHON) | machine.BLENDER_45)
        core = installed_core(BPY_PYTHON, packages.wheel(BPY_PYTHON))
    except Failure as failure:
        print(failure, file=sys.stderr)
        return 1
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join((str(core), str(TOP)))}
    command = [str(environment_python(BPY_PYTHON)), "-m", "tools.motion_pictures", str(takes), str(folder)]
    return subprocess.run(command, env=environment, cwd=TOP, check=False).returncode


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
