# SPDX-License-Identifier: MIT
"""What a person says that bones are to a body, over what their names and shape tell."""

from __future__ import annotations

from collections.abc import Sequence

from ..core import core

_SIDES = {".l": "left_", ".r": "right_"}


def role_of(text: str) -> tuple[str, str]:
    """The role and the bone of a --role, foot.L as left_foot; ValueError where there is none."""
    role, _, bone = text.partition("=")
    if not (role and bone):
        raise ValueError(f"--role {text} tells no role or no bone, as in foot.L=LeftAnkle")
    role = role.lower()
    side = _SIDES.get(role[-2:], "")
    return (side + role[:-2] if side else role), bone


def make_body(
    skeleton: core.Skeleton,
    clips: Sequence[core.Clip],
    told: Sequence[tuple[str, str]],
    skin: core.Skin | None = None,
) -> core.Body:
    """The body of a skeleton, whose bones are what is told of those that it has."""
    own = {role: bone for role, bone in told if bone in skeleton.names}
    return core.Body(skeleton, clips, told=own, skin=skin)


def check_bones(skeletons: Sequence[core.Skeleton], told: Sequence[tuple[str, str]]) -> None:
    """ValueError on a bone that none of the skeletons has."""
    for role, bone in told:
        if not any(bone in skeleton.names for skeleton in skeletons):
            where = "neither in the takes nor in what they go onto"
            raise ValueError(f"--role {role}={bone}: there is no bone '{bone}', {where}")
