# SPDX-License-Identifier: MIT
"""Run inside Blender by `dev.py demo`: from takes to a baked, controlled Action, by the add-on's own operators.

Arguments after `--`: the output folder and the add-on's zip.
"""

from __future__ import annotations

import math
import sys
from collections import Counter
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy
import numpy as np

if TYPE_CHECKING:
    from fragmotion_core import Doubles

SAMPLES = Path(__file__).resolve().parent.parent / "sample_rigs"
sys.path.insert(0, str(SAMPLES))

FPS = 30
SECONDS = 60
PLAYER, SEED = "explorer", 2009  # the policy learns from another session (seed 1)
ACTION = "Driven by a trace"
MOMENTS = 12
SPAN = (121, 286)  # frames of the filmstrip


def install(package: str) -> str:
    """Install and enable the zip with Blender's own operators; the name of the add-on's module."""
    if bpy.app.version < (4, 2, 0):
        bpy.ops.preferences.addon_install(filepath=package)
        bpy.ops.preferences.addon_enable(module="fragmotion")
        return "fragmotion"
    bpy.ops.extensions.package_install_files(filepath=package, repo="user_default", enable_on_install=True)
    return "bl_ext.user_default.fragmotion"


def open_sample() -> bpy.types.Object:
    """Open the sample file; its armature, active."""
    bpy.ops.wm.open_mainfile(filepath=str(SAMPLES / "fragmotion_sample.blend"))
    armature = next(thing for thing in bpy.context.scene.objects if thing.type == "ARMATURE")
    bpy.context.view_layer.objects.active = armature
    bpy.context.scene.render.fps = FPS
    return armature


def expect(result: set[str], step: str) -> None:
    """Stop when an operator did not finish; it has said why."""
    if result != {"FINISHED"}:
        raise SystemExit(f"{step} ended as {result}")


def build() -> None:
    """Press Build, with the Actions ticked that the file has ticked."""
    expect(bpy.ops.fragmotion.build(), "Build")


def record(core: Any, character: Any, path: Path) -> Any:
    """A minute of a made-up joystick session, as a trace file; returns it [T,4]."""
    core.write_trace(path, core.simulate_trace(PLAYER, SECONDS, SEED, character.space))
    return core.read_trace(path)


def bake(trace: Path) -> bpy.types.Action:
    """Press Bake for a trace file; the Action that the armature now plays."""
    expect(bpy.ops.fragmotion.bake(trace_source="FILE", trace_file=str(trace), action=ACTION), "Bake")
    action = bpy.data.actions[ACTION]
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = (int(frame) for frame in action.frame_range)
    return action


def watch(armature: bpy.types.Object, bones: dict[str, str]) -> tuple[Doubles, Doubles]:
    """What Blender shows as the scene plays: ground position [F,2] of the hips and where they face [F], rad from +y."""
    scene, places, rights = bpy.context.scene, [], []
    for frame in range(scene.frame_start, scene.frame_end + 1):
        scene.frame_set(frame)
        heads = {role: armature.matrix_world @ armature.pose.bones[bone].head for role, bone in bones.items()}
        places.append(heads["hips"][:2])
        rights.append((heads["right_thigh"] - heads["left_thigh"])[:2])
    scene.frame_set(scene.frame_start)
    right = np.array(rights)
    return np.array(places), np.unwrap(np.arctan2(right[:, 1], right[:, 0]))


def velocity_errors(places: Doubles, headings: Doubles, trace: Doubles) -> str:
    """Mean distance of the hips' velocity from the commanded one, over a second (a step sways) and frame by frame."""
    controls = trace[np.arange(len(places) - 1) * 10 // FPS]
    cosine, sine = np.cos(headings[:-1]), np.sin(headings[:-1])
    x, y = controls[:, 0], controls[:, 1]
    commanded = np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=1)
    errors = FPS * np.diff(places, axis=0) - commanded
    sums = np.cumsum(np.concatenate([np.zeros((1, 2)), errors]), axis=0)
    by_second = np.linalg.norm(sums[FPS:] - sums[:-FPS], axis=1).mean() / FPS
    by_frame, speed = np.linalg.norm(errors, axis=1).mean(), np.hypot(x, y).mean()
    return (
        f"{by_second:.2f} m/s over a second, {by_second / speed:.0%} of the commanded {speed:.2f} m/s; "
        f"{by_frame:.2f} m/s frame by frame, {by_frame / speed:.0%}"
    )


def count_fragments(character: Any) -> str:
    """The number of fragments, and of each origin."""
    origins = Counter(character.fragment_origins)
    captured, mirrored = origins.pop("captured", 0), origins.pop("mirrored", 0)
    synthesized = ", ".join(f"{count} {origin}" for origin, count in sorted(origins.items()))
    return (
        f"{sum(origins.values()) + captured + mirrored}: {captured} captured, {mirrored} mirrored, "
        f"{sum(origins.values())} synthesized ({synthesized})"
    )


def qualities(character: Any, trace: Doubles) -> str:
    """Every policy's quality on the trace; the first drives."""
    return ", ".join(f"{name} {character.percent_of_optimal(trace, name):.1f} %" for name in character.policies)


def speeds(space: Any) -> str:
    """The control space's scale."""
    return (
        f"{', '.join(f'{gait} {speed:.2f} m/s' for gait, speed in zip(space.gaits, space.speeds))}, "
        f"turn {math.degrees(space.turn_rate):.0f} degrees/s; "
        f"{len(space.points)} points"
    )


def show(rows: dict[str, str]) -> None:
    """Print the table."""
    print()
    for name, text in rows.items():
        print(f"{name:<16} {text}")


def main(output: str, package: str) -> None:
    """Do it all, in the order of the add-on's panels."""
    folder = Path(output).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    core = import_module(f"{install(package)}.compat.core").core
    armature = open_sample()
    takes = sum(action.fragmotion.use for action in bpy.data.actions)
    build()
    policy = folder / "fragmotion_demo.policy"
    policy.write_bytes(armature.fragmotion.policy)
    character = core.Character.load(policy)
    trace = record(core, character, folder / "trace.csv")
    action = bake(folder / "trace.csv")
    error = velocity_errors(*watch(armature, character.skeleton.roles), trace)
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "fragmotion_demo.blend"), compress=True)
    picture = import_module("filmstrip").render_filmstrip(
        armature, action, str(folder / "filmstrip.png"), MOMENTS, frame_range=SPAN
    )
    show(
        {
            "Core": f"{core.__version__}, in Blender {bpy.app.version_string}",
            "Takes": f"{takes} Actions of {SAMPLES.name}/fragmotion_sample.blend",
            "Fragments": count_fragments(character),
            "Classes": str(len(character.representatives)),
            "Controls": speeds(character.space),
            "Policy table": f"{character.table.shape[0]} x {character.table.shape[1]}",
            "Build time": f"{armature.fragmotion.figures.seconds:.2f} s",
            "Trace": f"{len(trace) / 10:.0f} s of a simulated {PLAYER} that no policy learned from",
            "Quality": f"{qualities(character, trace)} of Optimal; {character.policies[0]} drives",
            "Velocity error": error,
            "Action": f"'{action.name}', {int(np.ptp(action.frame_range)) + 1} frames at {FPS} a second",
            "Blender file": str(folder / "fragmotion_demo.blend"),
            "Policy file": str(policy),
            "Trace file": str(folder / "trace.csv"),
            "Picture": picture,
        }
    )


main(*sys.argv[sys.argv.index("--") + 1 :])
