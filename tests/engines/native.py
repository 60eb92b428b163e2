# SPDX-License-Identifier: MIT
"""libfragmotion by ctypes, and ten seconds of a stick that every engine plays alike."""

from __future__ import annotations

import ctypes
from ctypes import POINTER, byref, c_char_p, c_double, c_float, c_int32, c_size_t, c_uint32, c_void_p
from pathlib import Path
from typing import Any

import numpy as np

FRAMES = 600
SECONDS = 1 / 60
CAMERA, LOCAL, GLTF = 2, 0, 1


class Input(ctypes.Structure):
    """FragmotionInput."""

    _fields_ = (
        ("size", c_uint32),
        ("steer", c_int32),
        ("move", c_float * 3),
        ("facing", c_float * 3),
        ("turn", c_float),
        ("jump", c_int32),
    )


class LoadOptions(ctypes.Structure):
    """FragmotionLoadOptions."""

    _fields_ = (("size", c_uint32), ("axes", c_int32), ("units_per_metre", c_float))


class Info(ctypes.Structure):
    """FragmotionCharacterInfo."""

    _fields_ = (
        ("size", c_uint32),
        *((name, c_int32) for name in ("bones", "moves", "styles", "hips", "jumps", "turns")),
        *((name, c_float) for name in ("height", "hips_height")),
        ("markers", c_int32),
    )


def stick(frame: int) -> Input:
    """The stick at a frame: it changes every 45 frames, by the camera, which looks to -z."""
    part = frame // 45
    move = ((part * 7 % 5 - 2) / 2, (part * 11 % 7 - 2) / 4, 0)
    return Input(ctypes.sizeof(Input), CAMERA, move, (0, 0, -1), 0, int(part % 6 == 5))


class Library:
    """The shared library at a path."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.dll = ctypes.CDLL(str(path))
        self.dll.fragmotion_last_error.restype = c_char_p
        signatures: dict[str, list[Any]] = {
            "character_load": [c_char_p, c_size_t, POINTER(LoadOptions), POINTER(c_void_p)],
            "character_info": [c_void_p, POINTER(Info)],
            "character_release": [c_void_p],
            "player_create": [c_void_p, c_void_p, POINTER(c_void_p)],
            "player_start_move": [c_void_p, c_int32],
            "player_step": [c_void_p, POINTER(Input), c_double],
            "player_pose": [c_void_p, c_void_p, c_int32, c_void_p, c_int32],
            "player_release": [c_void_p],
        }
        for name, arguments in signatures.items():
            getattr(self.dll, f"fragmotion_{name}").argtypes = arguments

    def call(self, name: str, *arguments: Any) -> None:
        """Call a function that returns a FragmotionResult; it must be OK."""
        result = getattr(self.dll, f"fragmotion_{name}")(*arguments)
        assert result == 0, f"{name}: {self.dll.fragmotion_last_error().decode()}"

    def play(self, policy: bytes, frames: int = FRAMES) -> Any:
        """Poses [frames, bones, 7] in local space and glTF's axes: position, then rotation x, y, z, w. The stick is
        stick(frame); the first move, if there is one, starts at frame 300."""
        character, player, info = c_void_p(), c_void_p(), Info(ctypes.sizeof(Info))
        options = LoadOptions(ctypes.sizeof(LoadOptions), GLTF, 1)
        self.call("character_load", policy, len(policy), byref(options), byref(character))
        self.call("character_info", character, byref(info))
        self.call("player_create", character, None, byref(player))
        poses = np.empty((frames, info.bones, 7), np.float32)
        for frame, pose in enumerate(poses):
            if frame == 300 and info.moves:
                self.call("player_start_move", player, 0)
            self.call("player_step", player, byref(stick(frame)), SECONDS)
            self.call("player_pose", player, None, LOCAL, pose.ctypes.data, info.bones)
        self.dll.fragmotion_player_release(player)
        self.dll.fragmotion_character_release(character)
        return poses
