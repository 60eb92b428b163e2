# SPDX-License-Identifier: MIT
"""Good arguments of every public callable of fragmotion_core, which wrong_arguments.py makes wrong."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import fragmotion_core as core
import numpy as np
from bodies import humanoid
from conftest import NAMES, OFFSETS, PARENTS, TIPS, build_options, make_skeleton, walking_arrays, walking_clips
from test_threads import BVH, rig_of

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


def good_arguments(folder: Path) -> dict[str, dict[str, Any]]:
    """Good arguments of every public callable, by name."""
    skeleton = make_skeleton()
    clips = walking_clips(skeleton)[:3]
    trace = core.simulate_trace("explorer", 8, 1)
    options = build_options(classes=4, restarts=1, synthesize=False)
    built = core.build(skeleton, clips, [trace], options)
    moving = built.with_moves([core.Move("stroll", clips[0]), core.Move("nod", clips[1], upper_body=True)])
    made = core.with_styles([("normal", moving), ("tired", built)])
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
        "constants": {"stitch_fades": 2.0},
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
    body, skin = core.Body(human), core.Skin(human)
    performance = core.Player(made).run(trace, 30)
    short = core.Player(made).run(trace[:10], 30)
    motion = {
        "root_positions": short.root_positions,
        "rotations": short.rotations,
        "path": short.path,
        "hips": 0,
    }
    shown = core.Motion(30.0, short.root_positions, short.rotations, short.path)
    return {
        "Skeleton": {
            "names": NAMES,
            "parents": PARENTS,
            "rest_rotations": turns[0],
            "offsets": np.array(OFFSETS, float),
            "tips": np.array(TIPS, float),
            "roles": {"head": "head"},
        },
        "find_hanging": {
            "names": NAMES,
            "parents": PARENTS,
            "poses": np.tile(upright, (2, 1, 1, 1)),
            "candidates": [1],
        },
        "find_joints": {
            "names": NAMES,
            "parents": PARENTS,
            "poses": np.tile(upright, (2, 1, 1, 1)),
            "bearing": [0, 1],
        },
        "span_beside": {"poses": np.tile(upright, (2, 1, 1, 1)), "bone": 1, "other": 0},
        "Skeleton.relaxed_pose": {"self": skeleton},
        "Skeleton.role_map": {
            "self": skeleton,
            "heads": np.stack([skeleton.rest_heads()] * 2),
            "skin": core.Skin(skeleton),
        },
        "Skeleton.other_feet": {"self": skeleton},
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
        "tell_four_legs": {"takes": [walked, take]},
        "examine": {"takes": [walked, take], "threads": 1, "progress": quiet},
        "examine_ground": {"take": walked},
        "mend": {"take": walked, "findings": core.examine([walked])[0].findings, "progress": quiet},
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
            "hangs": {},
            "held": {"head": [0.0, 0.0, 0.1, 1.0, 0.0, 0.0, 0.0]},
            "sizes": {"head": 1.2},
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
        "Clip.with_markers": {"self": walk, "markers": [(2.5, "whoosh")]},
        "Clip.world_transforms": {"self": walk, "skeleton": skeleton},
        "Clip.with_fingers": {"self": clips[0], "skeleton": skeleton, "pose": skeleton.rest_rotations},
        "Clip.led_by_feet": {"self": walk, "skeleton": skeleton, "speed": 0.0},
        "Clip.may_go": {"self": walk, "skeleton": skeleton},
        "Clip.discontinuities": {"self": walk, "skeleton": skeleton},
        "Clip.stands": {"self": walk, "skeleton": skeleton},
        "Clip.bobs": {"self": walk, "skeleton": skeleton},
        "Clip.as_led": {"self": walk},
        "Clip.motions_within": {"self": walk, "skeleton": skeleton},
        "Clip.character_frames": {"self": walk, "skeleton": skeleton},
        "bobs_too_far": {"skeleton": skeleton, "clips": clips[:1]},
        "mirrored": {"skeleton": skeleton, "clips": clips[:1]},
        "on_one_floor": {"skeleton": skeleton, "clips": clips[:1]},
        "Body": {
            "skeleton": human,
            "clips": [strolling],
            "roles": body.roles,
            "told": {"head": body.roles["head"]},
            "skin": skin,
        },
        "Skin": {"skeleton": human},
        "Skin.add": {
            **{"self": core.Skin(human), "world": np.eye(4), "points": np.zeros((2, 3)), "groups": ["hips", "none"]},
            "weights": np.array([[0, 0, 1.0], [1, 0, 0.5], [1, 1, 0.5]]),
        },
        "role_doubts": {"skeleton": human, "roles": core.Body(human).roles, "skin": skin},
        "Retarget": {"source": body, "target": core.Body(humanoid("unreal"))},
        "Retarget.apply": {"self": core.Retarget(body, body), "clip": strolling},
        "Retarget.apply_all": {"self": core.Retarget(body, body), "clips": [strolling], "threads": 1},
        "ControlSpace": {
            **{"walk": 1.2, "run": 3.3, "turn_rate": 1.2, "scale": 1.0},
            **{"speeds": [1.2, 3.3], "directions": 8, "turn": True, "jump": True},
        },
        "ControlSpace.nearest": {"self": made.space, "controls": trace},
        "ControlSpace.distance": {"self": made.space, "a": trace[0], "b": trace[1]},
        "ControlSpace.turn_towards": {"self": made.space, "off": 1.0},
        "read_trace": {"path": folder / "trace.csv"},
        "read_asked": {"path": folder / "trace.csv"},
        "write_trace": {
            **{"path": folder / "written.csv", "trace": trace},
            **{"moves": [(3, "stroll", 2)], "styles": [(0, "tired")]},
            **{"looks": [(2, 2, 1.0, 2.0, 1.5)], "reaches": [(2, 1, 0.5, 1, 0.2, 0.4, 1.2)]},
        },
        "simulate_trace": {"player": "walker", "seconds": 5.0, "seed": 1, "space": made.space},
        "BuildOptions": {},
        "Character.save": {"self": made, "path": folder / "saved.policy"},
        "Character.to_bytes": {"self": made},
        "Character.load": {"path": folder / "made.policy"},
        "Character.from_bytes": {"data": made.to_bytes()},
        "Character.optimal": {"self": made, "trace": trace},
        "Character.able": {"self": made, "trace": trace},
        "Character.percent_of_optimal": {"self": made, "trace": trace, "policy": ""},
        "Character.without": {"self": made, "excluded": [1, 2], "style": 1},
        "Character.with_moves": {"self": made, "moves": made.moves},
        "Character.in_style": {"self": made, "style": 1},
        "with_styles": {"styles": [("normal", built), ("tired", built)]},
        "Move": {"name": "wave", "clip": clips[0], "upper_body": False, "wait": 0.5, "loop": (0.5, 1.0)},
        "build": building,
        "build_styles": {
            **{name: value for name, value in building.items() if name != "clips"},
            "styles": [("normal", building["clips"])],
        },
        "suggest_classes": {**building, "clips": clips[:1], "options": build_options(synthesize=False)},
        "PlayerOptions": {**player},
        "Player": {"character": made, **player},
        "Player.reset": {"self": core.Player(made), "x": 0.0, "y": 0.0, "heading": 0.0, "style": 1},
        "Player.change_style": {"self": core.Player(made), "style": 1},
        "Player.force": {"self": core.Player(made), "next_class": 1},
        "Player.start_move": {"self": core.Player(made), "move": 1},
        "Player.release_move": {"self": core.Player(made), "move": 1},
        "Player.stand_on": {"self": core.Player(made), "ground": lambda x, y, z: (0.1 * y, 0.0, -0.1, 1.0)},
        "Player.reach": {
            "self": core.Player(made),
            "hand": 1,
            "weight": 0.5,
            "carried": True,
            "x": 1.0,
            "y": 2.0,
            "z": 1.5,
        },
        "Player.look": {"self": core.Player(made), "look": 2, "x": 1.0, "y": 2.0, "z": 1.5},
        "Player.step": {"self": core.Player(made), "control": trace[0], "seconds": 0.1},
        "Player.quality": {"self": core.Player(made), "control": trace[0]},
        "Player.run": {
            "self": core.Player(made),
            "trace": trace,
            "rate": 30.0,
            "progress": quiet,
            "moves": np.array([[5, 0, 3.0]]),
            "styles": np.array([[5, 1.0]]),
            "looks": np.array([[5, 2.0, 1.0, 2.0, 1.5]]),
            "reaches": np.array([[5, 1.0, 0.5, 0.0, 1.0, 2.0, 1.5]]),
        },
        "Crowd": {"character": made, "count": 2, **player, "threads": 1},
        "Crowd.step_many": {
            "self": crowd,
            "controls": trace[:3],
            "seconds": 0.1,
            "roots": np.zeros((3, 3)),
            "rotations": np.zeros((3, bones, 4)),
        },
        "Crowd.reset": {"self": core.Crowd(made, 3), "player": 1, "x": 0.0, "y": 0.0, "heading": 0.0, "style": 1},
        "Crowd.change_style": {"self": core.Crowd(made, 3), "player": 1, "style": 1},
        "Crowd.force": {"self": core.Crowd(made, 3), "player": 1, "next_class": 1},
        "Motion": {
            "rate": 30.0,
            "root_positions": short.root_positions,
            "rotations": short.rotations,
            "path": short.path,
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
        "Steering": {"space": made.space, "walk_turns": True, "run_turns": False},
        "Steering.control": {
            "self": core.Steering(made.space, True, False),
            "right": 0.3,
            "ahead": 0.9,
            "turn": 0.0,
            "jump": False,
            "heading": 1.0,
            "view": 2.0,
        },
        "stick_speed": {"space": made.space, "push": 0.7},
        "turns_well": {"character": made, "policy": "", "style": 1},
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
        "keep_clear": {
            "players": [core.Player(made), core.Player(made)],
            "wishes": [path, trace],
            "worlds": np.array([[0.0, 0.0, 0.0, 1.0], [3.0, 0.0, 0.0, 1.0]]),
            **following,
            "obstacles": [np.array([[5.0, 5.0], [6.0, 5.0], [6.0, 6.0]])],
            "passers_by": [np.array([[0.0, 3.0], [0.1, 3.0]])],
            "radius": 0.4,
            "seconds": 2.0,
            "rate": 30.0,
            "progress": quiet,
            "area": core.PaintedArea(np.eye(3)[None], np.ones((1, 3))),
        },
        "PaintedArea": {"corners": np.eye(3)[None], "paint": np.ones((1, 3))},
        "PaintedArea.draw_ways": {
            "self": core.PaintedArea(np.eye(3)[None], np.ones((1, 3))),
            "starts": np.ones((2, 3)) / 3,
            "count": 2,
            "seed": 1,
            "room": 0.1,
        },
        "PaintedArea.draw_apart": {
            "self": core.PaintedArea(np.eye(3)[None], np.ones((1, 3))),
            "count": 2,
            "spacing": 0.1,
            "seed": 1,
            "room": 0.1,
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
        "abilities": {"character": other, "threads": 1},
        "names_idle": {"clip": "Hero|Idle"},
        "undone_controls": {"space": other.space, "done": [True] * len(other.space.points)},
        "response_times": {"character": other, **player},
        "about_face_times": {"character": other, **player},
        "speed_ripples": {"character": other, **player},
        "change_pushes": {"character": other, **player},
        "carried_motion": {**motion, "to": short.path},
        "looped_motion": {**motion, "count": 5},
        "resampled_motion": {
            **{k: motion[k] for k in list(motion)[:3]},
            "times": np.arange(len(short.path)) / 30,
            "rate": 24.0,
        },
        "fit_keys": {"values": short.root_positions, "tolerance": 0.01},
        "reduce_keys": {
            "rig": rig,
            "tracks": [(0, "QUATERNION", turns[:, 0])],
            "locations": np.zeros((frames, bones, 3)),
            "rotations": turns,
            "object_locations": np.zeros((frames, 3)),
            "object_rotations": turns[:, 0],
            "above": np.eye(4),
            "scale": np.ones(3),
            "distance": 0.01,
            "angle": 0.01,
            "progress": quiet,
        },
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
        "control_model": {**traces, "stays": 8.5, "goes_anywhere": 1.5, "controls": 102},
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
    """Takes of that one: it stands, and it walks."""
    gaits = [(0.0, "stand"), (1.2, "walk")]
    arrays = [(name, walking_arrays(speed)) for speed, name in gaits]
    return [core.Clip(skeleton, name, 30.0, roots, rotations[:, :3]) for name, (roots, rotations) in arrays]
