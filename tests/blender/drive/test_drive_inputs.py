# SPDX-License-Identifier: MIT
"""From sticks and keys to the control that the core gets. The pads are virtual ones of SDL's, the rest is real."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from importlib import import_module
from types import ModuleType, SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest

PREFERENCES = SimpleNamespace(dead_zone=0.2, curve=1.0)
WALK, RUN = 1.2, 3.3


@pytest.fixture
def steering(addon: ModuleType) -> ModuleType:
    """The module of the name."""
    return part(addon, "steering")


def part(addon: ModuleType, name: str) -> ModuleType:
    """A module of the add-on's folder `input`."""
    return import_module(f"{addon.__name__}.input.{name}")


def space(addon: ModuleType) -> Any:
    """The controls' space with default speeds."""
    return addon.compat.core.core.ControlSpace(WALK, RUN)


def test_a_stick_does_nothing_in_the_dead_zone_and_all_at_its_rim(steering: ModuleType) -> None:
    assert steering.respond(0.1, -0.17, 0.2, 1.0) == (0, 0)
    for angle in np.linspace(0, 2 * math.pi, 9):
        x, y = math.cos(angle), math.sin(angle)
        assert steering.respond(x, y, 0.2, 2.0) == pytest.approx((x, y))
        assert steering.respond(1.2 * x, 1.2 * y, 0.2, 2.0) == pytest.approx((x, y)), "beyond the rim"
    assert steering.respond(0.6, 0, 0.2, 1.0) == pytest.approx((0.5, 0)), "half of the rest of the way"
    assert steering.respond(0.6, 0, 0.2, 2.0) == pytest.approx((0.25, 0)), "finer near the middle"
    pushes = [steering.respond(x, 0, 0.2, 0.5)[0] for x in np.linspace(0, 1, 50)]
    assert pushes == sorted(pushes)


def test_half_way_is_a_walk_and_fully_is_a_run(addon: ModuleType) -> None:
    speeds = [addon.compat.core.core.stick_speed(space(addon), push) for push in (0, 0.25, 0.5, 0.75, 1)]
    assert speeds == pytest.approx([0, WALK / 2, WALK, (WALK + RUN) / 2, RUN])


def test_by_the_character_the_stick_is_its_velocity(addon: ModuleType, steering: ModuleType) -> None:
    steer = steering.Steering(space(addon), False, False)
    for heading in (0, 1, 4):
        assert steer.control(steering.Intent(0.5, 0, 0, True), heading, None) == pytest.approx((WALK, 0, 0, 1))
        assert steer.control(steering.Intent(0, -1, -1), heading, None) == pytest.approx((0, -RUN, -1, 0))
    assert steer.control(steering.REST, 2, None) == (0, 0, 0, 0)


def follow(addon: ModuleType, steer: Any, stick: Any, view: float, heading: float) -> tuple[np.ndarray, np.ndarray]:
    """Five seconds of controls followed exactly from a heading: the frames, and the way of the stick on the ground."""
    track = addon.drive.acting.slider.Track((0.0, 0.0, heading))
    frames = [track.frame]
    for _ in range(300):
        track.step(steer.control(stick, track.frame[2], view), 1 / 60, space(addon))
        frames.append(track.frame)
    return np.array(frames), np.array(part(addon, "steering").rotate(stick.right, stick.ahead, view))


@pytest.mark.parametrize("turns_well", [True, False])
def test_by_the_view_the_character_goes_where_the_stick_points_and_faces_it(
    addon: ModuleType, steering: ModuleType, turns_well: bool
) -> None:
    for view in (0.0, 2.0, -3.0):
        for heading in np.linspace(-3, 3, 7):
            steer = steering.Steering(space(addon), turns_well, turns_well)
            frames, way = follow(addon, steer, steering.Intent(0.6, 0.8), view, float(heading))
            steps = np.diff(frames[:, :2], axis=0)
            settled = steps[240:] if turns_well else steps
            np.testing.assert_allclose(settled, np.outer(np.full(len(settled), RUN / 60), way), atol=2e-3)
            assert (-math.sin(frames[-1, 2]), math.cos(frames[-1, 2])) == pytest.approx(way, abs=0.02)
            if turns_well:
                assert (steps @ way > -RUN / 60 * 0.2).all(), "it goes the other way first"


def test_by_the_view_a_turn_of_the_users_is_kept(addon: ModuleType, steering: ModuleType) -> None:
    steer = steering.Steering(space(addon), False, False)
    assert steer.control(steering.Intent(0, 1, turn=-1), 0.0, 1.0).turn == -1
    assert steer.control(steering.Intent(0, 1), 0.0, 1.0).turn == space(addon).quickest_turn


def test_a_stick_that_points_behind_turns_the_character_one_way_round(addon: ModuleType, steering: ModuleType) -> None:
    steer = steering.Steering(space(addon), False, False)
    first = steer.control(steering.Intent(0, 1), math.radians(170), 0.0).turn
    turns = {steer.control(steering.Intent(0, 1), math.radians(angle), 0.0).turn for angle in (178, 182, 176, 184)}
    assert turns == {first}


def test_how_well_a_character_turns_is_asked_of_the_policy_that_drives(addon: ModuleType, obj: Any) -> None:
    character = addon.character.building.load(obj)
    space, seconds = character.space, 2.0
    for policy in character.policies:
        turned = 0.0
        for turn in (1, -1):
            player = addon.compat.core.core.Player(character, 1, policy=policy)
            frames = player.run(np.repeat([(0, space.run, 0, 0), (0, space.run, turn, 0)], (10, 20), axis=0), 60).path
            turned += turn * (frames[-1, 2] - frames[60, 2]) / 2
        turns_well = addon.drive.acting.actor.Actor(bpy.context, obj, 1, policy).turns_well()[1]
        assert turns_well == (turned > 0.75 * space.turn_rate * seconds)


def test_the_screens_up_on_the_ground_is_where_the_view_looks(steering: ModuleType) -> None:
    from mathutils import Euler

    for around in np.linspace(-3, 3, 7):
        for tilt in (5, 45, 89, 0, 100):  # degrees from straight down
            view = Euler((math.radians(tilt), 0, around)).to_matrix().inverted()
            heading = steering.view_heading([list(row) for row in view])
            assert math.remainder(heading - around, 2 * math.pi) == pytest.approx(0, abs=1e-5)


def test_a_control_in_words(addon: ModuleType, steering: ModuleType) -> None:
    core = addon.compat.core.core

    def say(*control: float, space: Any = None) -> str:
        return str(steering.describe(steering.Control(*control), space or core.ControlSpace(WALK, RUN)))

    assert say() == "stand" and say(0, 0, -1, 1) == "stand, turn right, jump"
    assert say(0, WALK) == "walk forward" and say(-RUN, 0, 1) == "run left, turn left"
    assert say(WALK, -WALK) == "walk back-right"
    fine = core.ControlSpace(speeds=[0.7, 1.3, 2.2, 3.5], directions=16)
    assert say(0, 0.5, space=fine) == "stroll forward" and say(-0.9, 2, space=fine) == "jog forward-slightly-left"
    assert say(0, -9, space=fine) == "run back" and say(0.3, 0, space=fine) == "stand"


def test_the_keyboard_walks_runs_turns_and_jumps(addon: ModuleType) -> None:
    keyboard_module = part(addon, "keyboard")
    keyboard = keyboard_module.Keyboard({**keyboard_module.DEFAULT_KEYS, "jump": "J"})

    def hold(*keys: str) -> Any:
        keyboard.release()
        for key in keys:
            keyboard.press(key)
        return keyboard.intent()

    assert hold() == (0, 0, 0, False, None)
    assert hold("W")[:2] == (0, 0.5) and hold("UP_ARROW", "RIGHT_SHIFT")[:2] == (0, 1)
    assert hold("A", "S", "LEFT_SHIFT")[:2] == pytest.approx((-math.sqrt(0.5), -math.sqrt(0.5)))
    assert hold("W", "S")[:2] == (0, 0) and hold("Q")[2] == 1 and hold("E")[2] == -1
    assert hold("J").jump and keyboard.action_of("SPACE") is None and keyboard.action_of("R") == "record"
    keyboard.let_go("J")
    assert not keyboard.intent().jump


def test_the_on_screen_stick_is_dragged_and_springs_back(addon: ModuleType) -> None:
    stick = part(addon, "screen_stick").ScreenStick()
    stick.place(100, 0, 2.0)
    x, y = stick.center
    assert not stick.press(x + 1.01 * stick.radius, y) and stick.intent()[:2] == (0, 0)
    assert stick.press(x, y) and stick.held
    stick.drag(x - stick.radius / 2, y)
    assert stick.intent()[:2] == pytest.approx((-0.5, 0))
    stick.drag(x, y + 5 * stick.radius)
    assert stick.intent()[:2] == pytest.approx((0, 1))
    stick.release()
    assert stick.intent()[:2] == (0, 0) and not stick.held


class Knob:
    """An input of the tests' own."""

    def __init__(self, steering: ModuleType, label: str) -> None:
        self.label, self.now, self.released = label, steering.REST, 0

    def intent(self) -> Any:
        return self.now

    def release(self) -> None:
        self.released += 1


def test_the_last_input_touched_drives(addon: ModuleType, steering: ModuleType) -> None:
    one, two = Knob(steering, "one"), Knob(steering, "two")
    arbiter = part(addon, "arbiter").Arbiter((one, two))
    assert arbiter.intent() == steering.REST and arbiter.current is None
    one.now = steering.Intent(1, 0)
    assert arbiter.intent() == one.now
    two.now = steering.Intent(0, 0.05)
    assert arbiter.intent() == one.now, "a trembling hand is no touch"
    two.now = steering.Intent(0, 1)
    assert arbiter.intent() == two.now and one.released == 1
    one.now = steering.REST
    assert arbiter.intent() == two.now, "letting go is no touch"
    one.now = steering.Intent(jump=True)
    assert arbiter.intent() == one.now
    arbiter.remove(one)
    assert arbiter.intent() == steering.REST, "what is gone drives no more"


def test_a_trace_drives_until_it_ends_or_another_input_is_touched(addon: ModuleType, steering: ModuleType) -> None:
    trace = part(addon, "tracing").TraceInput(60)
    knob = Knob(steering, "knob")
    arbiter = part(addon, "arbiter").Arbiter((trace, knob))
    rows = np.array([(0, 1, 0, 0), (1, 0, 1, 0), (0, 3, 0, 1)], float)
    trace.play(rows)
    arbiter.take(trace)
    seen = []
    while trace.playing:
        seen.append(arbiter.intent().control)
        trace.advance()
    assert seen == [tuple(row) for row in np.repeat(rows, 6, axis=0)]
    assert arbiter.intent() == steering.REST
    trace.play(rows)
    knob.now = steering.Intent(1, 0)
    assert arbiter.intent() == knob.now and not trace.playing


class VirtualPads:
    """Real SDL devices without hardware; their axes and buttons are numbered as SDL numbers a controller's."""

    def __init__(self, library: Any) -> None:
        self.library = library

    def attach(self) -> Any:
        """Connect a pad; its handle."""
        index = self.library.SDL_JoystickAttachVirtual(self.library.SDL_JOYSTICK_TYPE_GAMECONTROLLER, 6, 15, 0)
        assert index >= 0, self.library.SDL_GetError()
        return self.library.SDL_JoystickOpen(index)

    def set(self, pad: Any, axes: dict[int, float], buttons: tuple[int, ...] = ()) -> None:
        """Push its sticks (-1 to 1, down is positive) and hold its buttons."""
        for axis in range(4):
            self.library.SDL_JoystickSetVirtualAxis(pad, axis, round(32767 * axes.get(axis, 0)))
        for button in range(15):
            self.library.SDL_JoystickSetVirtualButton(pad, button, int(button in buttons))

    def detach(self, pad: Any) -> None:
        """Pull its plug."""
        number = self.library.SDL_JoystickInstanceID(pad)
        self.library.SDL_JoystickClose(pad)
        for index in range(self.library.SDL_NumJoysticks()):
            if self.library.SDL_JoystickGetDeviceInstanceID(index) == number:
                assert self.library.SDL_JoystickDetachVirtual(index) == 0
                return


@pytest.fixture
def pads(addon: ModuleType) -> Iterator[Any]:
    """The add-on's pads, open."""
    opened = part(addon, "pads").Pads(PREFERENCES)
    yield opened
    opened.close()


@pytest.fixture
def virtual(addon: ModuleType, pads: Any) -> VirtualPads:
    """Pads to connect."""
    return VirtualPads(part(addon, "sdl").load())


def test_a_pads_sticks_shoulders_and_buttons_are_read(pads: Any, virtual: VirtualPads) -> None:
    assert pads.poll() == ([], []) or pads.pads
    device = virtual.attach()
    come, gone = pads.poll()
    assert len(come) == 1 and not gone
    (pad,) = come
    assert pad.label and pad.intent() == (0, 0, 0, False, None)
    virtual.set(device, {0: 0.6, 1: 0.0})
    pads.poll()
    assert pad.intent() == pytest.approx((0.5, 0, 0, False, None), abs=1e-3)
    virtual.set(device, {1: -1.0, 2: 1.0}, (0,))
    pads.poll()
    assert pad.intent() == pytest.approx((0, 1, -1, True, None), abs=1e-3), "up is ahead, right turns right"
    virtual.set(device, {0: 0.1, 1: -0.1}, (9, 6))
    pads.poll()
    assert pad.intent() == (0, 0, 1, False, None) and pad.state.record
    virtual.set(device, {}, (10,))
    pads.poll()
    assert pad.intent().turn == -1
    virtual.detach(device)


def test_pads_come_and_go(addon: ModuleType) -> None:
    inputs = part(addon, "inputs").Inputs(SimpleNamespace(keys=dict, **vars(PREFERENCES)), 60)
    virtual = VirtualPads(part(addon, "sdl").load())
    try:
        assert inputs.messages == []
        first, second = virtual.attach(), virtual.attach()
        inputs.poll()
        assert len(inputs.pads) == 2
        virtual.set(first, {1: -1.0})
        inputs.poll()
        assert inputs.intent().ahead == pytest.approx(1) and inputs.label == inputs.pads[0].label
        virtual.set(second, {0: 1.0})
        inputs.poll()
        assert inputs.intent()[:2] == pytest.approx((1, 0)), "the second was touched last"
        virtual.detach(second)
        inputs.poll()
        assert len(inputs.pads) == 1 and inputs.intent()[:2] == (0, 0)
        (message,) = inputs.messages
        assert "is gone: the character stands" in message
        virtual.set(first, {}, (6,))
        assert inputs.poll() and not inputs.poll(), "the record button counts once"
        virtual.detach(first)
    finally:
        inputs.close()


def test_moves_are_held_by_their_keys_and_buttons(addon: ModuleType) -> None:
    preferences = SimpleNamespace(**vars(PREFERENCES), keys=lambda: {"forward": "W"})
    inputs = part(addon, "inputs").Inputs(preferences, 60, [("F", "NONE"), ("NONE", "X"), ("G", "DPAD_UP")])
    virtual = VirtualPads(part(addon, "sdl").load())
    try:
        pad = virtual.attach()
        virtual.set(pad, {}, (2, 11))
        inputs.poll()
        assert inputs.moves() == {1, 2}
        virtual.set(pad, {})
        inputs.poll()
        inputs.keyboard.press("F")
        inputs.keyboard.press("W")
        assert inputs.moves() == inputs.moves() == {0}
        inputs.keyboard.let_go("F")
        assert inputs.moves() == set()
        inputs.keyboard.press("G")
        inputs.keyboard.let_go("G")
        assert inputs.moves() == {2}, "a tap between two looks"
        assert inputs.moves() == set()
        inputs.play(np.zeros((30, 4)), [[1, 1, 2]])
        held = []
        for _ in range(30):
            held.append(inputs.moves())
            inputs.trace.advance()
        assert held == [set()] * 6 + [{1}] * 12 + [set()] * 12
        virtual.detach(pad)
    finally:
        inputs.close()


def test_closed_pads_leave_nothing_with_sdl(addon: ModuleType) -> None:
    def threads() -> int:
        return len(os.listdir("/proc/self/task"))

    library, before = part(addon, "sdl").load(), threads()
    opened = part(addon, "pads").Pads(PREFERENCES)
    device = VirtualPads(library).attach()
    library.SDL_JoystickClose(device)
    opened.poll()
    assert opened.pads and library.SDL_WasInit(0) != 0 and library.SDL_WasInit(library.SDL_INIT_VIDEO) == 0
    assert threads() == before
    opened.close()
    assert library.SDL_WasInit(0) == 0 and opened.pads == []
    assert "PYSDL2_DLL_PATH" not in os.environ, "other add-ons would load our SDL"


def test_without_sdl_the_keyboard_still_drives(addon: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
    sdl = part(addon, "sdl")

    def fail(*_arguments: Any) -> Any:
        raise ImportError("no such library")

    monkeypatch.setattr(sdl, "import_module", fail)
    inputs = part(addon, "inputs").Inputs(SimpleNamespace(keys=lambda: {"forward": "W"}, **vars(PREFERENCES)), 60)
    (message,) = inputs.messages
    assert "SDL" in message and "no such library" in message
    inputs.keyboard.press("W")
    assert not inputs.poll() and inputs.intent().ahead == 0.5
    inputs.close()
