# SPDX-License-Identifier: GPL-3.0-or-later
"""A drive: from the inputs to the armature's pose, and back to how everything was."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from typing import TYPE_CHECKING, Any

import bpy

from ..character import classes
from ..character.moves import bring_up_to_date, check_keys, names_of, triggers_of
from ..compat.data_blocks import is_alive
from ..compat.event_keys import name_of
from ..ground.meshes import find_ground
from ..input.inputs import Inputs
from ..input.steering import Control, Intent, Steering, view_heading
from ..preview.posed_armature import PosedArmature
from ..recordings.holding import holds_of
from ..recordings.looks import Aim, LookChange, aim_of
from ..recordings.reaches import Holds, ReachChange
from ..recordings.recordings import NEXT, POSE_RATE, TRACE_RATE, add_recording
from ..recordings.styles import AS_EVER, Styled
from ..settings import preferences
from .acting.actor import Actor
from .acting.asking import Asking
from .acting.punch import Punch
from .acting.recorder import Recorder, Taken
from .follow import FollowCamera
from .hud import overlays, views
from .hud.readings import Readings
from .hud.shown import LONGEST_UPDATE, Shown
from .over import Over
from .scene_state import SceneState

if TYPE_CHECKING:
    from fragmotion_core import Doubles

    from ..rig.motion import Motion

RATE = POSE_RATE
"""Steps a second. All are equally long, so that a recorded trace shows the same motion when it is replayed."""

_STILL = 0.2  # m/s
_LEAD = 2  # s that a recording plays before the stick takes over
_NEWS = 3  # s that news stand over the view
_SMOOTH = 0.05  # share of the newest in a running mean

current: Session | None = None
"""The drive that is under way; the panel shows it."""


class Session:
    """An armature is driven from construction until `close`. UserError where it cannot be; then nothing has changed."""

    def __init__(self, context: bpy.types.Context, obj: bpy.types.Object, seed: int, policy: str) -> None:
        context.view_layer.update()
        preferred = preferences.get(context)
        self.keys: dict[str, str] = preferred.keys()
        """What a key does, and the key."""
        check_keys(obj, {key: action for action, key in self.keys.items()})
        bring_up_to_date(context, obj)
        self.obj = obj
        self.seed = self.settings.seed if seed < 0 else seed
        ground = find_ground(context, obj)
        self.actor = Actor(context, obj, self.seed, policy, ground)
        self.ground = ground if self.actor.character is not None else None
        """What it stands on; None: the plane."""
        self.views, self._follow = views.Views(context.area), FollowCamera()
        self._state = SceneState(context, obj)
        self._asking = Asking(self.actor)
        self.styling = self._asking.styling
        self._steerings: dict[int, Steering] = {}  # by style
        self._steering()
        self.readings = Readings(self.actor, RATE)
        self.recording: Recorder | None = None
        self._over: Over | None = None
        self._ends_with_trace = False
        self._elapsed, self._steps = 0.0, 0
        self._replays = False
        self.cost = self.interval = 0.0
        """Our own time for an update and the time between updates, s; running means."""
        self.farewell = ""
        """What the user should be told when it has ended."""
        self.windows: set[int] = set()
        """Those whose keys it hears, by their addresses."""
        self.triggers = triggers_of(obj, self.actor.character)
        """The key and the button of each move."""
        self.inputs = Inputs(preferred, RATE, self.triggers)
        self._news, self._news_until = "", 0
        self._target_level = 0.0
        self.span: tuple[float, float] | None = None
        """The scene's frames from and to which a recording is recorded over, for the timeline."""
        self._missed = False
        if ground is not None and ground.remark:
            self.inputs.messages.append(ground.remark)
        try:
            self._armature = PosedArmature(obj, self.actor.rig)
        except BaseException:
            self.inputs.close()
            raise

    @property
    def punch(self) -> Punch | None:
        """The stretch of a recording over which the user is recorded, if any."""
        return None if self._over is None else self._over.punch

    @property
    def armature(self) -> str:
        """The armature object's name; where it was deleted, the last one."""
        return self._armature.name

    @property
    def scene(self) -> bpy.types.Scene:
        """Where it is driven."""
        return self._state.scene

    @property
    def player(self) -> Any:
        """What plays: a core.Player, or what slides as one."""
        return self.actor.player

    @property
    def control(self) -> Control:
        """The control of this moment."""
        return self.readings.control

    @property
    def settings(self) -> Any:
        """The armature's, asked for anew each time: Blender frees them with it."""
        return self.obj.fragmotion.drive

    def update(self, seconds: float) -> bool:
        """Go on by the time since the last update: read the inputs, step, and pose the armature; whether a step was
        due, so that there is something new to be seen."""
        begin = time.perf_counter()
        if self.inputs.poll():
            self.toggle_recording()
        self.styling.step_by(self.inputs.style_step())
        self._elapsed += min(seconds, LONGEST_UPDATE)
        due = round(self._elapsed * RATE) - self._steps
        pose = None
        for _ in range(due):
            pose = self._step()
        if pose is None:
            return False
        self._armature.pose(*pose)
        self._tell_missed()
        self._follow_actor(due / RATE)
        self.cost = _running(self.cost, time.perf_counter() - begin)
        self.interval = _running(self.interval, seconds)
        return True

    def _step(self) -> tuple[Doubles, Doubles]:
        self.inputs.target.steer(self.actor.space, self.actor.frame, 1 / RATE)
        intent, held = self.inputs.intent(), self.inputs.moves()
        if self._over is not None:
            self._over.offer(intent, held)
        control = self._control(intent)
        self._ask_beside(held)
        pose = self.actor.step(control, 1 / RATE)
        if self.recording is not None:
            self.recording.add(pose)
        self.inputs.trace.advance()
        self.readings.step(control)
        self._steps += 1
        if self.punch is not None:
            self.punch.advance()
            if self.punch.over and self._keep_over():
                bpy.ops.ed.undo_push(message="Record Over")
        return pose

    def _tell_missed(self) -> None:
        """Say once that there is no ground under the feet."""
        if self.player.ground_missed and not self._missed:
            self._missed = True
            self.inputs.messages.append("There is no ground under its feet: it goes on at the height that it had")

    def _control(self, intent: Intent) -> Control:
        by_view = self.settings.relative == "VIEW"
        view = view_heading(self.views.rotation()) if by_view else None
        style = self.inputs.trace.style()
        if style is not None:
            self.styling.want(style)
        control = self._steering().control(intent, self.actor.frame[2], view)
        if self.punch is not None and not self.punch.takes:
            return self.punch.control
        return control if self._taken is None else self._taken.hold(control)

    @property
    def _taken(self) -> Taken | None:
        """What keeps what the user does in the next step."""
        if self.punch is not None:
            return self.punch.taken if self.punch.takes else None
        return self.recording

    def _steering(self) -> Steering:
        """How the stick steers in the style that plays."""
        actor, space = self.actor, self.actor.space
        if actor.style not in self._steerings:
            self._steerings[actor.style] = Steering(space, *actor.turns_well())
        return self._steerings[actor.style]

    def _ask_beside(self, held: set[int]) -> None:
        """Tell the player what the next step asks for beside its control, where the user holds these moves."""
        self._asking.tell(held, self._aim, self._holds, self._taken, self.punch)

    @property
    def _aim(self) -> Aim:
        """Where to look in the next step."""
        if self.punch is not None:
            return self.punch.aim
        trace = self.inputs.trace
        return trace.aim if trace.playing else aim_of(self.obj.fragmotion.look)

    @property
    def _holds(self) -> Holds:
        """What hands reach for in the next step."""
        if self.punch is not None:
            return self.punch.holds
        trace = self.inputs.trace
        return trace.holds if trace.playing else holds_of(self.obj)

    @property
    def move(self) -> str:
        """The moves that play, or wait for their moment, in words; empty where there are none."""
        names = names_of(self.actor.character)
        if not names:
            return ""
        playing = [names[move] for move in self.player.playing_moves if move >= 0]
        waiting = [f"{names[move]} (waits)" for move in self.player.waiting_moves if move >= 0]
        return ", ".join(playing + waiting)

    def _follow_actor(self, seconds: float) -> None:
        area = self.views.main()
        if self.settings.follow and area is not None:
            self._follow.step(area.spaces.active.region_3d, self.actor.frame[:2], seconds)

    def play(
        self,
        trace: Doubles,
        start: tuple[float, float, float] | None = None,
        moves: Sequence[Sequence[int]] = (),
        styled: Styled = AS_EVER,
        looks: Sequence[LookChange] = (),
        reaches: Sequence[ReachChange] = (),
    ) -> None:
        """Let a trace [T,4] drive, with moves [M,3], changes of style, looks and reaches, until it ends or another
        input is touched; from a character frame, if one is given. It begins in its style: changes to it, without a
        frame."""
        self._replays = start is not None
        if start is not None:
            self._begin(start, styled)
            self.readings = Readings(self.actor, RATE)
        self.styling.want(styled.begin)
        self.inputs.play(trace, moves, styled.changes, looks, reaches)
        if styled.remark:
            self.inputs.messages.append(f"It plays {styled.remark}")

    def _begin(self, start: tuple[float, float, float], styled: Styled) -> None:
        """Stand where a recording begins, in its style."""
        self.actor.begin(start, styled.begin)
        self._asking.begin(styled.begin)

    def play_over(self, punch: Punch, start: tuple[float, float, float], styled: Styled, shown: Motion | None) -> None:
        """Let a recording, of which these poses are `shown`, drive from the character frame and the style in which it
        begins, from shortly before the stretch on which the stick takes over."""
        self._begin(start, styled)
        if shown is not None:
            self.actor.join_on(shown)
        self._over = Over(self.obj, punch, self.actor, self._asking, self.inputs)
        for _ in range(max(punch.begin * RATE // TRACE_RATE - _LEAD * RATE, 0)):
            self._ask_beside(set())
            self.actor.step(punch.control, 1 / RATE)
            punch.advance()
        self.readings = Readings(self.actor, RATE)

    def _keep_over(self) -> bool:
        """Keep what was recorded over a recording, once; whether there was anything."""
        over, self._over = self._over, None
        kept, told = (False, "") if over is None else over.keep()
        self._ends_with_trace = over is not None
        if told:
            self._announce(told)
        return kept

    def _announce(self, text: str) -> None:
        """Tell the user, over the view for a while, too."""
        self.inputs.messages.append(text)
        self._news, self._news_until = text, self._steps + _NEWS * RATE

    def walk_to(self, place: tuple[float, float], runs: bool = False, level: float = 0.0) -> None:
        """Let the character go to a place on the ground, which is so high there, until it is there or another input is
        touched."""
        self._target_level = level
        self.inputs.walk(self.actor.space, self.actor.frame, place, runs)

    @property
    def playing(self) -> str:
        """How far the trace is that plays, in words; empty while none does."""
        trace = self.inputs.trace
        verb = "Kept: playing the rest," if self._ends_with_trace else "Replaying" if self._replays else "Playing"
        return f"{verb} {trace.elapsed:.1f} of {trace.seconds:.1f} s" if trace.playing else ""

    def toggle_recording(self) -> None:
        """Begin a recording; or end it and keep it with the armature, an undo step.

        Where the character stands still it begins as its replay will, so that the replay shows the same.
        """
        if self.punch is not None:
            self.inputs.messages.append("A recording is recorded over already: that is kept by itself when it ends")
        elif self.recording is None:
            if math.hypot(*self.readings.velocity) < _STILL and not any(self.control):
                self.actor.start_afresh()
                self._asking.start_afresh()
            self.recording = Recorder(self.actor, RATE)
            self.styling.forget_told()
            self.readings = Readings(self.actor, RATE)
        elif self._keep_recording():
            bpy.ops.ed.undo_push(message="Record")

    def _keep_recording(self) -> bool:
        """End the recording; whether anything was recorded."""
        kept = self.end_recording()
        if kept is None:
            return False
        recording = add_recording(self.obj, **kept)
        self.inputs.messages.append(f"Recorded '{recording.name}': {recording.seconds:.1f} s; {NEXT}")
        return True

    def end_recording(self) -> dict[str, Any] | None:
        """End the recording; what `add_recording` keeps of it beside the armature, if anything was recorded."""
        recording, self.recording = self.recording, None
        if recording is None or not len(recording.trace):
            return None
        judge = self.readings.judge
        return {
            "trace": recording.trace,
            "seed": self.seed,
            "policy": self.actor.policy,
            "start": recording.start,
            "quality": judge.mean if judge else 0.0,
            "shown": recording.shown,
            "moves": recording.moves,
            "style": recording.style,
            "styles": recording.styles,
            "looks": recording.looks,
            "reaches": recording.reaches,
        }

    @property
    def is_done(self) -> bool:
        """Whether nothing is left to do: what was recorded over is kept, and the rest has played, or something else was
        touched."""
        return self._ends_with_trace and not self.inputs.trace.playing

    def trouble(self) -> str:
        """Why the drive cannot go on, empty where it can."""
        return self._armature.trouble() or self._state.trouble()

    def shown(self) -> Shown | None:
        """What is drawn of it now; None where it cannot go on."""
        if self.trouble():
            return None
        inputs = self.inputs
        return Shown(
            self._title,
            self._taken is not None,
            inputs.label,
            inputs.shown,
            inputs.stick,
            self.readings,
            self.settings,
            self.cost,
            self.interval,
            self.move,
            self.styling.words,
            self._steps / RATE,
            self._go_keys,
            self.span if self.punch is not None else None,
            None if inputs.target.place is None else (*inputs.target.place, self._target_level),
        )

    @property
    def news(self) -> str:
        """What the user was told over the view just now, empty where that is a while ago."""
        return self._news if self._steps < self._news_until else ""

    @property
    def _title(self) -> str:
        """What goes on, in words."""
        if self.punch is not None:
            return self.punch.words
        if self.recording is not None:
            return f"Recording {self.recording.seconds:.1f} s"
        return self.news or self.playing or f"Driving {self.armature}"

    @property
    def _go_keys(self) -> str:
        return " ".join(name_of(self.keys[name]) for name in ("forward", "left", "back", "right"))

    def give_back(self) -> None:
        """Let the armature have its own pose and animation until the next update: the file is saved."""
        self._armature.give_back(self._state.layer)

    def close(self) -> bool:
        """Let go of the inputs and give everything back; whether a recording was kept that no undo step holds yet.

        What was deleted meanwhile stays deleted. All is given back whatever fails of it.
        """
        with ExitStack() as closing:  # the last is done first
            closing.callback(self.give_back)
            closing.callback(self._state.restore)  # the frame, where it changes: Blender poses the armature anew
            closing.callback(lambda: self._follow.release(views.all_views()))
            closing.callback(self.inputs.close)
            kept = is_alive(self.obj) and self._keep_recording()
            return (is_alive(self.obj) and self._keep_over()) or kept


def _running(mean: float, value: float) -> float:
    return value if mean == 0 else mean + _SMOOTH * (value - mean)


@contextmanager
def opened(context: bpy.types.Context, obj: bpy.types.Object, seed: int, policy: str) -> Iterator[Session]:
    """A drive that goes on after the block, in place of the one that is under way; on any error there it ends."""
    global current
    stop()
    current = Session(context, obj, seed, policy)
    try:
        classes.session = current if current.actor.character else None
        overlays.add(current.shown, current.views)
        yield current
    except BaseException:
        stop(push=False)
        raise


def start(context: bpy.types.Context, obj: bpy.types.Object, seed: int = -1, policy: str = "") -> Session:
    """Begin a drive, by default with the panel's seed and the policy that drives; the one that is under way ends."""
    with opened(context, obj, seed, policy) as driven:
        return driven


def stop(push: bool = True) -> None:
    """End the drive that is under way, if any. What it was recording becomes an undo step, if that may be.

    Its operators end themselves when they are woken next.
    """
    global current
    session, current = current, None
    classes.session = None
    if session is None:
        return
    try:
        overlays.remove()
    finally:
        kept = session.close()
    if kept and push:
        bpy.ops.ed.undo_push(message="Record")
    views.tag_redraw()
    views.tag_redraw("UI")
