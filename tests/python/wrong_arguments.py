# SPDX-License-Identifier: MIT
"""Calls every public callable of fragmotion_core with wrong arguments, one at a time, and prints each call before it is
made, so that the last line names the one that ended the process. Run by test_wrong_arguments.py."""

from __future__ import annotations

import inspect
import itertools
import os
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import fragmotion_core as core
import numpy as np
from conftest import Array
from good_arguments import good_arguments, make_other, other_clips
from test_stub import arguments_told

MOST_SECONDS = 60  # that a call may take: nothing here is large
EVERY = 1 if sys.platform == "linux" else 5  # wrong value: elsewhere the same core, and Wine is slow
NUMBERS = [np.nan, np.inf, -np.inf, -1, 0, 1, 2, 1.5, 477218589, 2**31 - 1, 2**31, 2**32 + 5, 2**64, 1e-308, 1e308, 1e9]
OTHERS = [None, True, "", "wrong", b"\xff\xfe", "a\0b", [], {}, (), object(), np.float32(2), "x" * 100000]
EMPTY = [np.zeros(0), np.zeros((0, 0)), np.zeros((0, 3)), np.zeros((0, 4)), np.zeros((3, 0)), np.zeros((60, 0, 3))]

Call = Callable[..., object]


def unaligned(array: Array) -> Array:
    """The same values, at an odd address."""
    array = np.ascontiguousarray(array)
    packed = np.zeros(array.nbytes + 1, np.uint8)[1:].view(array.dtype)
    packed[:] = array.ravel()
    return packed.reshape(array.shape)


def wrong_arrays(good: Array) -> Iterator[Array]:
    """Arrays like a good one, with one thing wrong, or only unusual."""
    flat = good.astype(float)
    for place, value in zip(itertools.cycle((0, flat.size // 2, flat.size - 1)), NUMBERS):
        if flat.size:
            broken = flat.copy()
            broken.flat[place] = float(value)
            yield broken
    yield from (np.full(good.shape, value, float) for value in NUMBERS)
    yield from (good[:-1], good[:1], good[:0], good[..., :-1], good[..., :0], good[None], good.ravel())
    yield from (good.T, good[::-1], np.asfortranarray(good), np.repeat(good, 2, -1)[..., ::2], unaligned(flat))
    yield from (good.astype(kind) for kind in (np.float16, np.int8, np.int64, np.uint64, complex, object, str, ">f8"))
    frozen = good.copy()
    frozen.setflags(write=False)
    yield from (
        frozen,
        np.full(good.shape, None),
        np.array(5.0),
        np.full(good.shape, "x"),
        np.zeros(good.shape, "M8[s]"),
    )


def wrong_values(good: object) -> Iterator[object]:
    """What may be given by mistake in the place of a good argument."""
    yield from NUMBERS
    yield from OTHERS
    yield from EMPTY
    if isinstance(good, np.ndarray):
        yield from wrong_arrays(good)
    elif isinstance(good, list):
        yield from (good[:-1], good[:1], good * 2, [None], [good], good[::-1])
        for value in (np.nan, -1, 2**31, "wrong", b"\xff", None, np.zeros(0)):
            yield [value, *good[1:]]
        if good and isinstance(good[0], np.ndarray):
            yield from ([array] for array in wrong_arrays(good[0]))


def public_callables() -> set[str]:
    """Functions, constructors and methods, as Owner.name."""
    names = set()
    for name, member in vars(core).items():
        if inspect.isclass(member) and not issubclass(member, Exception):
            if takes_arguments(member):
                names.add(name)
            names |= {
                f"{name}.{m}" for m, value in vars(member).items() if not m.startswith("_") and callable_of(value)
            }
        elif callable(member) and not inspect.isclass(member):
            names.add(name)
    return names


def callable_of(member: object) -> bool:
    return callable(member) or isinstance(member, staticmethod)


def takes_arguments(owner: type) -> bool:
    """Whether a class can be made in Python."""
    try:
        owner()
    except TypeError as refusal:
        return "No constructor" not in str(refusal)
    return True


def find(name: str) -> Call:
    found: Any = core
    for part in name.split("."):
        found = getattr(found, part)
    return found  # type: ignore[no-any-return]


def call(name: str, what: str, function: Call, given: dict[str, Any]) -> bool:
    """Make a call; whether it raised an exception."""
    print(f"{name}: {what[:200]}", flush=True)
    began = time.monotonic()
    try:
        named = {argument: value for argument, value in given.items() if argument != "self"}
        result = function(given["self"], **named) if "self" in given else function(**named)
    except Exception as refusal:
        assert not isinstance(refusal, SystemError) and str(refusal), f"{name}: {what[:200]}: {refusal!r}"
        return True
    finally:
        seconds = time.monotonic() - began
        assert seconds < MOST_SECONDS, f"{name}: {what[:200]} took {seconds:.0f} s"
    for part in result if isinstance(result, tuple) else (result,):
        if isinstance(part, (float, np.ndarray)):
            assert np.isfinite(part).all(), f"{name}: {what[:200]} gives what is not a number"
    return False


def told(value: object) -> str:
    if isinstance(value, np.ndarray):
        return f"{value.dtype}{list(value.shape)} of {value.ravel()[:3]}... aligned {value.flags.aligned}"
    return repr(value)


def call_attributes(character: core.Character) -> int:
    """Set every field of the options to everything."""
    calls = 0
    for field in [name for name in vars(core.BuildOptions) if not name.startswith("_")]:
        for value in [*NUMBERS, *OTHERS, *EMPTY]:
            given = {"self": core.BuildOptions(), "name": field, "value": value}
            call(
                "BuildOptions", f"{field} = {told(value)}", lambda self, name, value: setattr(self, name, value), given
            )
            calls += 1
    explainer = core.Explainer(character)
    for value in [*NUMBERS, *OTHERS, *EMPTY]:
        call("Explainer.__call__", f"playing {told(value)}", explainer, {"playing": value, "control": 0})
        call("Explainer.__call__", f"control {told(value)}", explainer, {"playing": 0, "control": value})
        calls += 2
    return calls


def main(folder: Path) -> None:
    os.chdir(folder)  # where what is given for a path is written
    good = good_arguments(folder)
    assert set(good) == public_callables(), set(good) ^ public_callables()
    strange = make_other()
    objects = [strange, *other_clips(strange)]
    objects += [value for given in good.values() for value in given.values() if type(value).__module__ == core.__name__]
    calls = refused = 0
    for name, given in good.items():
        function = find(name)
        told_names = set(arguments_told(function.__init__ if inspect.isclass(function) else function))
        assert told_names == set(given) - {"self"}, name
        call(name, "as it should be", function, given)
        for argument, value in given.items():
            lists = [[each] for each in objects] if isinstance(value, list) else []
            values = itertools.chain(wrong_values(value), objects, lists)
            for wrong in itertools.islice(values, calls % EVERY, None, EVERY):
                if argument == "self" and type(wrong) is not type(value):
                    continue  # the interpreter refuses it
                refused += call(name, f"{argument} = {told(wrong)}", function, {**given, argument: wrong})
                calls += 1
    calls += call_attributes(good["Player"]["character"])
    print(f"done: {calls} calls, {refused} refused")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
