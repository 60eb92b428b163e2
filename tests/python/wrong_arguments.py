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
from bodies import humanoid
from conftest import NAMES, OFFSETS, PARENTS, TIPS, Array, build_options, make_skeleton, walking_arrays, walking_clips
from test_stub import arguments_told
from test_threads import BVH, rig_of

MOST_SECONDS = 60  # that a call may take: nothing here is large
NUMBERS = [np.nan, np.inf, -np.inf, -1, 0, 1, 2, 1.5, 477218589, 2**31 - 1, 2**31, 2**32 + 5, 2**64, 1e-308, 1e308, 1e9]
OTHERS = [None, True, "", "wrong", b"\xff\xfe", "a\0b", [], {}, (), object(), np.float32(2), "x" * 100000]
EMPTY = [np.zeros(0), np.zeros((0, 0)), np.zeros((0, 3)), np.zeros((0, 4)), np.zeros((3, 0)), np.zeros((60, 0, 3))]

ASF = """:units
length 0.45
angle deg
:root
order TX TY TZ RX RY RZ
axis XYZ
position 0 0 0
orientation 0 0 0
:bonedata
begin
name spine
direction 0 1 0
length 3
axis 0 0 0 XYZ
dof rx
end
:hierarchy
begin
root spine
end
"""

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
    for place, value in itertools.product((0, flat.size // 2, flat.size - 1), NUMBERS):
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


def arguments(folder: Path) -> dict[str, dict[str, Any]]:
    """Good arguments of every public callable, by name."""
    skeleton = make_skeleton()
    clips = walking_clips(skeleton)[:3]
    trace = core.simulate_trace("explorer", 8, 1)
    options = build_options(classes=4, restarts=1, synthesize=False)
    built = core.build(skeleton, clips, [trace], options)
    made = built.with_moves([core.Move("stroll", clips[0]), core.Move("nod", clips[1], upper_body=True)])
    other = core.build(bone := make_other(), other_clips(bone), [trace], options)
    roots, rotations = walking_arrays(seconds=0.5)
    rig, upright = rig_of(skeleton), np.tile(np.eye(4), (len(NAMES), 1, 1))
    (folder / "take.bvh").write_text(BVH.replace("9000", "20") + "0 0 5\n" * 20)
    take = core.read_bvh(folder / "take.bvh")
    (folder / "take.asf").write_text(ASF)
    (folder / "take.amc").write_text(":degrees\n1\nroot 0 1 0 0 0 0\nspine 5\n2\nroot 0 1 0 0 0 0\nspine 6\n")
    moves = np.tile(np.array(OFFSETS, float), (len(roots), 1, 1))
    moves[:, 0] = roots
    moves[:, 0, 2] += 1  # over the ground
    walked = core.Take(skeleton, "walk", 30.0, moves, rotations)
    core.write_trace(folder / "trace.csv", trace)
    made.save(folder / "made.policy")
    frames, bones = rotations.shape[:2]
    factors = {"smoothness": made.smoothness, "match": made.match}
    indices = made.space.nearest(trace)
    traces = {"traces": [indices]}
    svm = {**factors, **traces, "features": core.class_features(made), "space": made.space}
    player = {
        "seed": 1,
        "stitch": 0.2,
        "policy": "",
        "stitching": "crossfade",
        "lock_feet": True,
        "root_adjustment": 1.0,
        "responsiveness": 0.5,
    }
    path = core.Path([[0, 0], [0, 1.0]])
    following = {
        "speed": 1.0,
        "arrive": 0.0,
        "facing": "along",
        "heading": 0.0,
        "place": np.zeros(2),
        "end": "stand",
    }
    quiet: core.Progress = lambda *_: None  # noqa: E731
    building = {"skeleton": skeleton, "clips": clips, "traces": [trace], "options": options, "progress": quiet}
    crowd = core.Crowd(made, 3)
    walk = core.Clip(skeleton, "walk", 30.0, roots, rotations)
    turns = np.tile([1.0, 0, 0, 0], (frames, bones, 1))
    human = humanoid("mixamo")
    strolling = core.Clip(human, "stroll", 30.0, roots, np.tile(human.rest_rotations, (frames, 1, 1)))
    body = core.Body(human)
    performance = core.Player(made).run(trace, 30)
    motion = {
        "root_positions": performance.root_positions,
        "rotations": performance.rotations,
        "frames": performance.frames,
        "hips": 0,
    }
    shown = core.ShownMotion(30.0, performance.root_positions, performance.rotations, performance.frames)
    return {
        "Skeleton": {
            "names": NAMES,
            "parents": PARENTS,
            "rest_rotations": turns[0],
            "offsets": np.array(OFFSETS, float),
            "tips": np.array(TIPS, float),
            "roles": {"head": "head"},
        },
        "Skeleton.role_map": {"self": skeleton, "heads": np.stack([skeleton.rest_heads()] * 2)},
        "Skeleton.rest_heads": {"self": skeleton},
        "Skeleton.rest_tails": {"self": skeleton},
        "group_skeletons": {"skeletons": [skeleton, human]},
        "Take": {
            "skeleton": skeleton,
            "name": "take",
            "rate": 30.0,
            "translations": moves,
            "rotations": rotations,
            "unit": 1.0,
        },
        "Take.from_clip": {"clip": walk, "skeleton": skeleton},
        "Take.world_transforms": {"self": take},
        "examine": {"takes": [walked, take], "threads": 1},
        "mend": {"take": walked, "findings": core.examine([walked])[0].findings},
        "read_bvh": {"path": folder / "take.bvh", "unit": 0.01},
        "write_bvh": {"take": take, "path": folder / "written.bvh", "unit": 0.01},
        "read_asf": {"path": folder / "take.asf"},
        "find_asf": {"amc": folder / "take.amc"},
        "read_asf_amc": {"asf": folder / "take.asf", "amc": folder / "take.amc", "rate": 120.0},
        "euler_to_quaternion": {"order": "XYZ", "angles": roots},
        "quaternion_to_euler": {"order": "XYZ", "rotations": rotations[0]},
        "axis_angle_to_quaternion": {"axis_angles": rotations[0]},
        "quaternion_to_axis_angle": {"rotations": rotations[0]},
        "Rig": {
            "names": NAMES,
            "parents": PARENTS,
            "rest": upright,
            "lengths": np.full(bones, 0.1),
            "world": np.eye(4),
            "inherit_rotation": np.ones(bones, bool),
            "local_location": np.ones(bones, bool),
            "roles": {"head": "head"},
        },
        "Rig.clip": {
            "self": rig,
            "name": "clip",
            "rate": 30.0,
            "locations": np.zeros((frames, bones, 3)),
            "rotations": turns,
            "worlds": np.tile(np.eye(4), (frames, 1, 1)),
        },
        "Rig.clip_from_matrices": {
            "self": rig,
            "name": "clip",
            "rate": 30.0,
            "matrices": np.tile(upright, (frames, 1, 1, 1)),
            "worlds": np.tile(np.eye(4), (frames, 1, 1)),
        },
        "Rig.channels": {"self": rig, "root_positions": roots, "rotations": rotations},
        "Rig.take_channels": {"self": rig_of(take.skeleton), "take": take},
        "Clip": {
            "skeleton": skeleton,
            "name": "walk",
            "rate": 30.0,
            "root_positions": roots,
            "rotations": rotations,
        },
        "Clip.from_take": {"take": take, "skeleton": skeleton},
        "Clip.world_transforms": {"self": walk, "skeleton": skeleton},
        "Clip.character_frames": {"self": walk, "skeleton": skeleton},
        "mirrored": {"skeleton": skeleton, "clips": clips[:1]},
        "Body": {"skeleton": human, "clips": [strolling], "roles": body.roles},
        "Retarget": {"source": body, "target": core.Body(humanoid("unreal"))},
        "Retarget.apply": {"self": core.Retarget(body, body), "clip": strolling},
        "Retarget.apply_all": {"self": core.Retarget(body, body), "clips": [strolling], "threads": 1},
        "ControlSpace": {"walk": 1.2, "run": 3.3, "turn_rate": 1.2, "scale": 1.0},
        "ControlSpace.nearest": {"self": made.space, "controls": trace},
        "ControlSpace.distance": {"self": made.space, "a": trace[0], "b": trace[1]},
        "ControlSpace.turn_towards": {"self": made.space, "off": 1.0},
        "read_trace": {"path": folder / "trace.csv"},
        "write_trace": {"path": folder / "written.csv", "trace": trace},
        "simulate_trace": {"player": "walker", "seconds": 5.0, "seed": 1, "space": made.space},
        "BuildOptions": {},
        "Character.save": {"self": made, "path": folder / "saved.policy"},
        "Character.to_bytes": {"self": made},
        "Character.load": {"path": folder / "made.policy"},
        "Character.from_bytes": {"data": made.to_bytes()},
        "Character.optimal": {"self": made, "trace": trace},
        "Character.percent_of_optimal": {"self": made, "trace": trace, "policy": ""},
        "Character.without": {"self": made, "excluded": [1, 2]},
        "Character.with_moves": {"self": made, "moves": made.moves},
        "Move": {"name": "wave", "clip": clips[0], "upper_body": False, "wait": 0.5, "loop": (0.5, 1.0)},
        "build": building,
        "suggest_classes": {**building, "clips": clips[:1], "options": build_options(synthesize=False)},
        "PlayerOptions": {**player},
        "Player": {"character": made, **player},
        "Player.reset": {"self": core.Player(made), "x": 0.0, "y": 0.0, "heading": 0.0},
        "Player.force": {"self": core.Player(made), "next_class": 1},
        "Player.start_move": {"self": core.Player(made), "move": 1},
        "Player.release_move": {"self": core.Player(made), "move": 1},
        "Player.step": {"self": core.Player(made), "control": trace[0], "seconds": 0.1},
        "Player.quality": {"self": core.Player(made), "control": trace[0]},
        "Player.run": {
            "self": core.Player(made),
            "trace": trace,
            "rate": 30.0,
            "progress": quiet,
            "moves": np.array([[5, 0, 3.0]]),
        },
        "Crowd": {"character": made, "count": 2, **player, "threads": 1},
        "Crowd.step_many": {
            "self": crowd,
            "controls": trace[:3],
            "seconds": 0.1,
            "roots": np.zeros((3, 3)),
            "rotations": np.zeros((3, bones, 4)),
        },
        "Crowd.reset": {"self": core.Crowd(made, 3), "player": 1, "x": 0.0, "y": 0.0, "heading": 0.0},
        "Crowd.force": {"self": core.Crowd(made, 3), "player": 1, "next_class": 1},
        "ShownMotion": {
            "rate": 30.0,
            "root_positions": performance.root_positions,
            "rotations": performance.rotations,
            "frames": performance.frames,
        },
        "join": {"skeleton": skeleton, "first": shown, "end": 4, "second": shown, "beginning": 5},
        "find_seam": {"skeleton": skeleton, "first": shown, "ends": [3, 4], "second": shown, "beginnings": [0, 5]},
        "spread": {"skeleton": skeleton, "motion": shown, "begin": 2, "end": 9, "target": np.zeros(3)},
        "find_pin": {
            "character": made,
            "start": np.zeros(3),
            "trace": trace,
            "seconds": 2.0,
            "target": np.array([0.0, 1.0, 0.0]),
            **player,
            "begin": 0.5,
            "distance": 0.02,
            "angle": 0.1,
            "tries": 10,
            "threads": 1,
            "progress": quiet,
        },
        "Path": {"points": np.array([[0, 0], [0, 1], [1, 1.0]]), "closed": False, "speeds": np.ones(3)},
        "Path.places": {"self": path, "ways": np.zeros(3)},
        "PathFollower": {"space": made.space, "path": path, **following},
        "PathFollower.reset": {"self": core.PathFollower(made.space, path)},
        "PathFollower.steer": {
            "self": core.PathFollower(made.space, path),
            "frame": (0.0, 0.0, 0.0),
            "seconds": 0.1,
        },
        "follow_path": {
            "player": core.Player(made),
            "path": path,
            "start": (0.0, 0.0, 0.0),
            **following,
            "rate": 30.0,
            "seconds": 4.0,
            "progress": quiet,
        },
        "Crowd.start_move": {"self": core.Crowd(made, 3), "player": 1, "move": 1},
        "Crowd.release_move": {"self": core.Crowd(made, 3), "player": 1, "move": 1},
        "optimal_performance": {"character": made, "trace": trace, "rate": 30.0, "shortest": 0.1},
        "judge_clip": {
            "character": made,
            "trace": trace,
            "clip": core.Clip(skeleton, "shown", 30.0, performance.root_positions, performance.rotations),
            "entered": performance.entered.tolist(),
        },
        "response_times": {"character": other, **player},
        "about_face_times": {"character": other, **player},
        "speed_ripples": {"character": other, **player},
        "change_pushes": {"character": other, **player},
        "carried_motion": {**motion, "to": performance.frames},
        "looped_motion": {**motion, "count": 5},
        "resampled_motion": {
            **{k: motion[k] for k in list(motion)[:3]},
            "times": np.arange(len(performance.frames)) / 30,
            "rate": 24.0,
        },
        "fit_keys": {"values": performance.root_positions, "tolerance": 0.01},
        "Explainer": {"character": made, "policy": ""},
        "MotionMetrics": {"character": made},
        "MotionMetrics.of": {"self": core.MotionMetrics(other), "performance": performance},
        "trajectories": {"character": made, "poses": 4},
        "cluster": {
            "points": core.trajectories(made, 2)[0],
            "classes": 3,
            "weights": np.ones(len(made.labels)),
            "restarts": 1,
            "seed": 1,
            "threads": 1,
            "progress": quiet,
        },
        "optimal_path": {**factors, "trace": indices},
        "percent_of_optimal": {**factors, "table": made.table, "trace": indices},
        "greedy_table": factors,
        "control_model": {**traces, "stays": 8.5, "goes_anywhere": 1.5},
        "anticipate_table": {**factors, **traces},
        "iterate_table": {**factors, **traces, "discount": 0.9, "tolerance": 1e-4},
        "class_features": {"character": made},
        "svm_samples": svm,
        "svm_table": {**svm, "c": 1.0, "gamma": 1.0, "threads": 1},
    }


def make_other() -> core.Skeleton:
    """A skeleton with fewer bones than the usual one."""
    turns = np.tile([1.0, 0, 0, 0], (3, 1))
    return core.Skeleton(NAMES[:3], PARENTS[:3], turns, OFFSETS[:3], TIPS[:3])


def other_clips(skeleton: core.Skeleton) -> list[core.Clip]:
    gaits = [(0.0, "stand"), (1.2, "walk")]
    arrays = [(name, walking_arrays(speed)) for speed, name in gaits]
    return [core.Clip(skeleton, name, 30.0, roots, rotations[:, :3]) for name, (roots, rotations) in arrays]


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
    good = arguments(folder)
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
            for wrong in itertools.chain(wrong_values(value), objects, lists):
                if argument == "self" and type(wrong) is not type(value):
                    continue  # the interpreter refuses it
                refused += call(name, f"{argument} = {told(wrong)}", function, {**given, argument: wrong})
                calls += 1
    calls += call_attributes(good["Player"]["character"])
    print(f"done: {calls} calls, {refused} refused")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
