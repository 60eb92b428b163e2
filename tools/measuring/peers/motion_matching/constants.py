# SPDX-License-Identifier: MIT
"""What motion matching can be told, and the constants that are kept for it."""

from __future__ import annotations

import dataclasses
import json
import math
from pathlib import Path

from tools.shell import Failure

TUNED = Path(__file__).with_name("tuned.json")


@dataclasses.dataclass(frozen=True)
class Constants:
    """The defaults are those of D. Holden's example program, which is what a user begins with. Half-lives and times in
    s, lengths in m of a character of 1.8 m."""

    # How much the parts of the features count: each is divided by its spread in the takes and multiplied by this.
    foot_place: float = 0.75
    foot_velocity: float = 1.0
    hip_velocity: float = 1.0
    places: float = 1.0
    directions: float = 1.5
    # The database.
    ends: int = 20  # last frames of a take that are not gone to
    goes_on: bool = False  # past its end, a take's path goes on as over its last half second; else it stops there
    contact_speed: float = 0.15  # m/s under which a ball stands ...
    contact_share: float = 0.0  # ... and this share of the hips' speed more
    contact_height: float = 10.0  # over its floor, up to which a ball may stand: any
    # The search.
    search: float = 0.1  # between two searches
    forced: float = 50.0  # m/s^2: the command's change at whose end there is one at once
    ignored: int = 20  # frames around the one that plays
    transition_cost: float = 0.0
    # What is shown.
    blend: float = 0.1  # half-life of what differs at a transition
    velocity_halflife: float = 0.27  # of the simulated object that the stick moves
    turn_halflife: float = 0.27
    place_halflife: float = 0.1  # with which the character is drawn to that object
    heading_halflife: float = 0.2
    ratio: float = 0.5  # of its own speed by which it is drawn at most
    farthest: float = 0.15  # from the object
    widest: float = 0.5 * math.pi  # rad from the object
    # Feet.
    unlock: float = 0.2  # beyond which a locked foot lets go
    lock_halflife: float = 0.1
    reserve: float = 0.015  # of the leg's length, never used


def load(path: Path = TUNED) -> Constants:
    """Constants from a file that `save` wrote; those that it does not name are the published ones."""
    known = {field.name for field in dataclasses.fields(Constants)}
    try:
        found = json.loads(path.read_text())["constants"]
        unknown = set(found) - known
        if unknown:
            raise Failure(f"{path}: there is no constant called {min(unknown)}")
        return Constants(**found)
    except (ValueError, KeyError, TypeError, OSError) as error:
        raise Failure(f"{path}: not constants of motion matching ({error})") from error


def save(path: Path, constants: Constants, tries: int, cost: float) -> None:
    """Write what differs from the published constants, and how good it was found to be."""
    published = dataclasses.asdict(Constants())
    changed = {name: value for name, value in dataclasses.asdict(constants).items() if value != published[name]}
    path.write_text(json.dumps({"constants": changed, "tries": tries, "cost": cost}, indent=1) + "\n")
