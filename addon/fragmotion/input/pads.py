# SPDX-License-Identifier: GPL-3.0-or-later
"""Gamepads by SDL, asked when somebody wants to know: no thread, no window."""

from __future__ import annotations

from typing import Any, NamedTuple

from . import sdl
from .steering import Intent, respond

_FULL = 32767.0
_HINTS = {
    b"SDL_JOYSTICK_ALLOW_BACKGROUND_EVENTS": b"1",  # no window of SDL's ever has the focus
    b"SDL_NO_SIGNAL_HANDLERS": b"1",  # Ctrl C is Blender's
}


MOVE_BUTTONS = (
    *("B", "X", "Y", "BACK", "LEFTSTICK", "RIGHTSTICK"),
    *("DPAD_UP", "DPAD_DOWN", "DPAD_LEFT", "DPAD_RIGHT"),
)
"""Buttons that may start a move, by SDL's names."""


STYLE_BUTTONS = {"DPAD_RIGHT": 1, "DPAD_LEFT": -1}
"""Buttons that change to the next style and to the one before, unless they start a move."""


class PadState(NamedTuple):
    """Sticks from -1 to 1, right and up; a turn from -1 to 1 (left) by the shoulder buttons."""

    left: tuple[float, float] = (0.0, 0.0)
    right: tuple[float, float] = (0.0, 0.0)
    shoulders: int = 0
    jump: bool = False
    record: bool = False
    buttons: frozenset[str] = frozenset()
    """Those that are pressed of MOVE_BUTTONS."""


class Pad:
    """A gamepad that is open."""

    def __init__(self, label: str, preferences: Any) -> None:
        self.label = label
        self.state = PadState()
        self._dead_zone, self._curve = preferences.dead_zone, preferences.curve

    def intent(self) -> Intent:
        state = self.state
        right, ahead = respond(*state.left, self._dead_zone, self._curve)
        stick, _ = respond(state.right[0], 0, self._dead_zone, self._curve)
        return Intent(right, ahead, float(state.shoulders) or -stick or 0.0, state.jump)

    def release(self) -> None:
        """Only its user can let go of a pad."""


class Pads:
    """The gamepads that are connected. Open until `close`, which leaves nothing of them with SDL."""

    def __init__(self, preferences: Any) -> None:
        """SdlMissing where there is no SDL."""
        self._sdl = sdl.load()
        self._preferences = preferences
        self._devices: dict[int, tuple[Any, Pad]] = {}  # by SDL's number of the instance
        for name, value in _HINTS.items():
            self._sdl.SDL_SetHint(name, value)
        self._systems = self._sdl.SDL_INIT_JOYSTICK | self._sdl.SDL_INIT_GAMECONTROLLER
        if self._sdl.SDL_InitSubSystem(self._systems) != 0:
            raise sdl.SdlMissing(f"Gamepads cannot be used: SDL says '{self._sdl.SDL_GetError().decode()}'")
        self._sdl.SDL_JoystickEventState(self._sdl.SDL_IGNORE)  # asked, not told: no queue fills
        self._sdl.SDL_GameControllerEventState(self._sdl.SDL_IGNORE)

    def poll(self) -> tuple[list[Pad], list[Pad]]:
        """Look at all pads; those that came and those that went since the last time."""
        self._sdl.SDL_JoystickUpdate()
        gone = [self._forget(number) for number in list(self._devices) if not self._attached(number)]
        come = [pad for index in range(self._sdl.SDL_NumJoysticks()) if (pad := self._open(index))]
        for device, pad in self._devices.values():
            pad.state = self._read(device)
        return come, gone

    @property
    def pads(self) -> list[Pad]:
        """Those that are connected."""
        return [pad for _, pad in self._devices.values()]

    def close(self) -> None:
        """Let go of all pads and of SDL."""
        for number in list(self._devices):
            self._forget(number)
        self._sdl.SDL_QuitSubSystem(self._systems)

    def _open(self, index: int) -> Pad | None:
        """Open a device that is new, if it is a gamepad."""
        library = self._sdl
        if library.SDL_JoystickGetDeviceInstanceID(index) in self._devices or not library.SDL_IsGameController(index):
            return None
        device = library.SDL_GameControllerOpen(index)
        if not device:
            return None
        name = (library.SDL_GameControllerName(device) or b"Gamepad").decode(errors="replace")
        pad = Pad(name, self._preferences)
        self._devices[library.SDL_JoystickInstanceID(library.SDL_GameControllerGetJoystick(device))] = device, pad
        return pad

    def _attached(self, number: int) -> bool:
        return bool(self._sdl.SDL_GameControllerGetAttached(self._devices[number][0]))

    def _forget(self, number: int) -> Pad:
        device, pad = self._devices.pop(number)
        self._sdl.SDL_GameControllerClose(device)
        return pad

    def _read(self, device: Any) -> PadState:
        library = self._sdl

        def axis(name: str) -> float:
            code = getattr(library, f"SDL_CONTROLLER_AXIS_{name}")
            return max(float(library.SDL_GameControllerGetAxis(device, code)) / _FULL, -1.0)

        def button(name: str) -> bool:
            return bool(library.SDL_GameControllerGetButton(device, getattr(library, f"SDL_CONTROLLER_BUTTON_{name}")))

        return PadState(
            (axis("LEFTX"), 0.0 - axis("LEFTY")),
            (axis("RIGHTX"), 0.0 - axis("RIGHTY")),
            button("LEFTSHOULDER") - button("RIGHTSHOULDER"),
            button("A"),
            button("START"),
            frozenset(name for name in MOVE_BUTTONS if button(name)),
        )
