# SPDX-License-Identifier: GPL-3.0-or-later
"""Takes in the files that Blender's own importers read: each Action of each armature there."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import bpy
import numpy as np

from ..compat import versions
from ..compat.core import core
from ..errors import SinglePose, UserError
from ..files import check_regular
from ..rig.rigs import FEWEST_BONES
from .actions import RATE, SCENE_RATE, fits
from .sampling import rig_as_posed, sample, scene_rate
from .scratch import nothing_left

if TYPE_CHECKING:
    from fragmotion_core import Clip, Rig, Skeleton, Take


_Read = TypeVar("_Read")


class _Importer(NamedTuple):
    """An operator of Blender's, and what it is told beside the file."""

    name: str
    settings: dict[str, Any]


_FBX = (_Importer("wm.fbx_import", {"anim_offset": 0}), _Importer("import_scene.fbx", {"anim_offset": 0}))
_GLTF = (_Importer("import_scene.gltf", {}),)
_USD = (_Importer("wm.usd_import", {"set_frame_range": False}),)
_IMPORTERS = {".fbx": _FBX, ".glb": _GLTF, ".gltf": _GLTF, ".vrm": _GLTF}  # a VRM is a GLB of another name

_ARCHIVES = {b"PK\x03\x04": "ZIP", b"Rar!": "RAR", b"7z\xbc\xaf": "7z", b"\x1f\x8b": "gzip"}
_PACKED = {".usdz"}  # archives by their nature
_USD_RATE = 24.0  # frames a second of a USD file that tells none
_LOWEST_RATE = 24.0  # samples a second: motion whose keys are further apart is sampled between them
_COUNTED = re.compile(r"\.\d{3}$")  # what Blender adds to a name that the file has already

seen: list[str] = []
"""The characters of the file with several that was read last, to choose from."""


class NoTakes(UserError):
    """A file in which no armature is animated."""


def read_takes(context: bpy.types.Context, path: Path, character: str) -> list[Take]:
    """Each Action of each armature in a file, or of the one named `character` where there are several. Needs a scratch
    scene; nothing else stays in the .blend. NoTakes where no armature is animated; UserError on what cannot be read."""

    def read(importer: _Importer) -> list[Take]:
        with nothing_left():
            return _read_by(context, importer, path, character)

    return _first_success(path, read)


def import_all(path: Path) -> None:
    """Bring all that is in a file into the scene; UserError on what cannot be read."""
    _first_success(path, lambda importer: _run(importer, path))


def _first_success(path: Path, read: Callable[[_Importer], _Read]) -> _Read:
    """What the first importer gives that reads the file; where none does, what the first had against it."""
    check_regular(path)
    _check_archive(path)
    refusals: list[UserError] = []
    for importer in _available(path):
        try:
            return read(importer)
        except UserError as error:
            refusals.append(error)
    if not refusals:
        raise UserError(f"'{path}': {_without_importer(path.suffix.lower())}")
    raise refusals[0]


def _without_importer(suffix: str) -> str:
    if suffix in _IMPORTERS:
        return f"no importer of {suffix} files is here: switch it on in Preferences > Add-ons"
    return "this Blender was built without USD: the one from blender.org reads it"


def _check_archive(path: Path) -> None:
    try:
        with path.open("rb") as file:
            start = file.read(4)
    except OSError as error:
        raise UserError(f"'{path}' cannot be read ({error.strerror})") from error
    kind = next((kind for magic, kind in _ARCHIVES.items() if start.startswith(magic)), None)
    if kind and path.suffix.lower() not in _PACKED:
        raise UserError(f"'{path}' is no {path.suffix} file but a {kind} archive: unpack it, and import what is inside")


def _available(path: Path) -> Iterator[_Importer]:
    """The importers for a file that this Blender has."""
    for importer in _IMPORTERS.get(path.suffix.lower(), _USD):
        try:
            _operator(importer).get_rna_type()
        except (AttributeError, KeyError):
            continue
        yield importer


def _operator(importer: _Importer) -> Any:
    module, _, name = importer.name.partition(".")
    return getattr(getattr(bpy.ops, module), name)


def _read_by(context: bpy.types.Context, importer: _Importer, path: Path, character: str) -> list[Take]:
    scene = context.scene
    known = {obj.name for obj in bpy.data.objects}
    actions_before = set(bpy.data.actions)
    _run(importer, path)
    _keep_armatures(scene)
    context.view_layer.update()
    actions = sorted(set(bpy.data.actions) - actions_before, key=lambda action: action.name)
    characters = _animated(scene, actions, known)
    if not characters:
        raise NoTakes(f"'{path}': no armature in it is animated")
    chosen = _choose(path, characters, character)
    rate = _usd_rate(path) if importer in _USD else scene_rate(scene)
    takes = [take for one in chosen for take in _takes_of(context, path, one, rate, len(characters) == 1)]
    if not takes:
        raise NoTakes(f"'{path}': its armature holds a single pose, no motion")
    return takes


def _run(importer: _Importer, path: Path) -> None:
    try:
        with versions.old_numpy():
            done = _operator(importer)(filepath=str(path), **importer.settings)
    except RuntimeError as error:
        cause = _cause(error).replace(f" '{path}'", "")
        raise UserError(f"'{path}': Blender cannot import it ({cause}): it may be cut off or damaged") from error
    if done != {"FINISHED"}:
        raise UserError(f"'{path}': Blender cannot import it")


def _cause(error: RuntimeError) -> str:
    """What an importer says in its first line; where it has failed itself, what Python says in the last."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip()]
    said = [line for line in lines if not line.startswith("Location:")]
    return said[-1 if "Traceback" in said[0] else 0].removeprefix("Error: ") if said else "no reason given"


def _keep_armatures(scene: bpy.types.Scene) -> None:
    """Remove all but armatures and what carries them: meshes would be deformed on every frame that is read."""
    kept: set[bpy.types.Object] = set()
    for obj in scene.objects:
        carrier = obj if obj.type == "ARMATURE" else None
        while carrier is not None:
            kept.add(carrier)
            carrier = carrier.parent
    bpy.data.batch_remove(set(scene.objects) - kept)


class _Character(NamedTuple):
    """An armature in a file, what it is called there, and its Actions."""

    name: str
    obj: bpy.types.Object
    actions: list[bpy.types.Action]


def _animated(scene: bpy.types.Scene, actions: Sequence[bpy.types.Action], known: set[str]) -> list[_Character]:
    """The scene's armatures that have Actions; `known`: names that Blender could not give to them again."""
    armatures = [obj for obj in scene.objects if obj.type == "ARMATURE" and len(obj.data.bones) >= FEWEST_BONES]
    found: list[_Character] = []
    for obj in armatures:
        plain = _COUNTED.sub("", obj.name)
        name = plain if plain in known and plain not in {one.name for one in found} else obj.name
        own = [a for a in actions if fits(a, obj) and (len(armatures) == 1 or _is_of(a, obj))]
        if own:
            found.append(_Character(name, obj, own))
    return found


def _is_of(action: bpy.types.Action, obj: bpy.types.Object) -> bool:
    """Whether an Action is meant for an armature among several: it plays it, or the importer named it for it."""
    data = obj.animation_data
    strips = [strip.action for track in data.nla_tracks for strip in track.strips] if data else []
    played = [data.action, *strips] if data else []
    return action in played or action.name.startswith(f"{obj.name}|") or versions.has_slot_of(action, obj)


def _choose(path: Path, characters: list[_Character], name: str) -> list[_Character]:
    if len(characters) == 1:
        return characters
    seen[:] = [one.name for one in characters]
    chosen = [one for one in characters if name in {"", one.name}]
    if not chosen:
        raise UserError(f"'{path}' has no character '{name}': there is {', '.join(seen)}")
    return chosen


def _takes_of(context: bpy.types.Context, path: Path, one: _Character, rate: float, is_alone: bool) -> list[Take]:
    """A character's takes, named after the file, and what tells them from its others."""
    try:
        rig = rig_as_posed(one.obj)
        clips = list(_sample(context, one, rig, rate))
    except UserError as error:
        raise UserError(f"'{path}': {error}") from error
    takes = []
    for action, clip in clips:
        parts = [path.stem, "" if is_alone else one.name, _label(action, one.obj) if len(clips) > 1 else ""]
        take = core.Take.from_clip(clip, rig.skeleton)
        name = " ".join(filter(None, parts))
        takes.append(core.Take(_with_ends(rig.skeleton), name, take.rate, take.translations, take.rotations))
    return takes


def _with_ends(skeleton: Skeleton) -> Skeleton:
    """The skeleton with bones that end amid their children, as in BVH files: these formats hold joints alone, and
    importers invent the bones' ends."""
    tips, parents = np.array(skeleton.tips), np.array(skeleton.parents)
    for bone in set(skeleton.parents) - {-1}:
        tips[bone] = skeleton.offsets[parents == bone].mean(axis=0)
    names, rests, offsets = skeleton.names, skeleton.rest_rotations, skeleton.offsets
    ended: Skeleton = core.Skeleton(names, skeleton.parents, rests, offsets, tips, skeleton.roles)
    return ended


def _sample(
    context: bpy.types.Context, one: _Character, rig: Rig, rate: float
) -> Iterator[tuple[bpy.types.Action, Clip]]:
    """Each Action that is no single pose, with its clip."""
    for action in one.actions:
        _tell_rate(action, one.obj, rate)
        with suppress(SinglePose):
            yield action, sample(context, one.obj, action, rig)


def _label(action: bpy.types.Action, obj: bpy.types.Object) -> str:
    """What an Action is called in its file: importers put the armature before or behind it, and layers."""
    name = action.name.removeprefix(f"{obj.name}|").removesuffix(f"_{obj.name}")
    return _COUNTED.sub("", name).replace("|", " ")


def _tell_rate(action: bpy.types.Action, obj: bpy.types.Object, scene_rate: float) -> None:
    """Keep with an Action how often it is to be sampled, which its keys tell; `scene_rate`: scene frames a second."""
    curve = max(versions.curves_of(action, obj), key=lambda curve: len(curve.keyframe_points))
    points = np.empty(2 * len(curve.keyframe_points), np.float32)
    curve.keyframe_points.foreach_get("co", points)
    gaps = np.diff(points[::2].astype(float))
    gap = float(np.median(gaps)) if len(gaps) else 0.0
    if gap > 0:
        gap = float(gaps.sum() / round(gaps.sum() / gap))  # single precision blurs each, hardly their sum
    rate = scene_rate / gap if gap > 0 else scene_rate
    action[RATE] = rate * max(1, math.ceil(_LOWEST_RATE / rate - 0.01))
    action[SCENE_RATE] = scene_rate


def _usd_rate(path: Path) -> float:
    """Frames a second of a USD file, which Blender's importer does not take over."""
    try:
        usd = import_module("pxr.Usd")
        return float(usd.Stage.Open(str(path)).GetTimeCodesPerSecond())
    except (ImportError, RuntimeError):
        return _USD_RATE
