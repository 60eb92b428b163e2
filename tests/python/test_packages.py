# SPDX-License-Identifier: MIT
"""What `dev.py package` says of the zips."""

from __future__ import annotations

import zipfile
from pathlib import Path

import pytest

from tools import packages


@pytest.mark.parametrize(
    ("names", "pythons"),
    [
        (["fragmotion/core.py", "fragmotion/fragmotion_core.cpython-311-x86_64-linux-gnu.so"], ["3.11"]),
        (
            [
                "core.py",
                "wheels/fragmotion_core-0.1.0-cp313-cp313-manylinux_2_35_x86_64.whl",
                "wheels/fragmotion_core-0.1.0-cp39-cp39-manylinux_2_35_x86_64.whl",
            ],
            ["3.9", "3.13"],
        ),
        (["core.py"], []),
    ],
)
def test_a_zip_tells_which_pythons_it_is_for(tmp_path: Path, names: list[str], pythons: list[str]) -> None:
    with zipfile.ZipFile(tmp_path / "addon.zip", "w") as archive:
        for name in names:
            archive.writestr(name, "")
    assert packages.pythons_inside(tmp_path / "addon.zip") == pythons
