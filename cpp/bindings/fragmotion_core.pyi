# SPDX-License-Identifier: MIT
"""Fragment-based responsive character motion (Cheng, Liu, Pan and Tang 2009): the compiled core of Fragmotion.

Units: metres, seconds, radians, frames a second; z is up. Rotations are unit quaternions (w, x, y, z). F is a number of
frames, B of bones, N of fragments, n of classes. Everything that is wrong with an argument or a file raises ValueError
with the cause and the place in its text; a cancelled call raises Cancelled. Arrays may be of any kind that NumPy makes
numbers of, and lie in memory as they like. Names that a file does not hold in UTF-8 are taken for Latin-1.

Long calls release the GIL and are deterministic: the same input and seed give the same bits, whatever the number of
threads. Several threads may use one object at a time, except that a Player or Crowd takes one call after the other:
RuntimeError on a call in the middle of another, as of another thread's or from a progress callback.
"""

import pathlib
from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

Doubles = NDArray[np.float64]
Floats = NDArray[np.float32]
Ints = NDArray[np.int32]
Progress = Callable[[float, str], bool | None]
"""Called now and then with the fraction done (0..1) and the stage's name; returning False cancels the call, None does
not."""

class Cancelled(RuntimeError):
    """A progress callback returned False."""

ROLES: list[str]
"""The roles of a Skeleton's bones."""

class Skeleton:
    """Bones in parent-before-child order; only the first has no parent (-1)."""

    def __init__(
        self,
        names: Sequence[str],
        parents: Sequence[int],
        rest_rotations: ArrayLike,
        offsets: ArrayLike,
        tips: ArrayLike,
        roles: dict[str, str] | None = None,
    ) -> None:
        """rest_rotations [B,4] relative to the parent, offsets [B,3] m of the head in the parent's frame, tips [B,3] m
        of the tail in the bone's own frame; bone 0 is relative to the world. `roles` (role -> bone name) overrides
        what the names tell; the roles are hips, head, left_hand, right_hand, left_foot, right_foot, left_toe,
        right_toe, left_thigh, right_thigh, and of bodies on four legs left_fore_foot, right_fore_foot, left_fore_toe,
        right_fore_toe, left_fore_leg, right_fore_leg."""
    names: list[str]
    parents: list[int]
    rest_rotations: Doubles
    offsets: Doubles
    tips: Doubles
    roles: dict[str, str]
    """Role -> bone name, for the roles that the skeleton has."""
    stature: float
    """Height of a person with these legs, m."""
    def role_map(self, heads: ArrayLike | None = None, skin: Skin | None = None) -> dict[str, tuple[str, float]]:
        """Role -> (bone name, confidence 0.5 to 1) of every bone that is told: root, hips, spine_1 ..., neck_1 ...,
        head, and with left_ or right_ shoulder, upper_arm, lower_arm, hand, thumb_1 ... pinky_1 ..., thigh, shin, foot,
        toe. Names tell them, and where those say nothing the shape; `heads` [P,B,3] m, places in a motion, tell more.
        Of two feet of one leg the foot is the one that carries `skin`."""
    def other_feet(self) -> list[str]:
        """The bones that end the limbs on which the body stands at rest beside those that end in its feet: a spider's
        other six, which no foot lock holds."""
    def relaxed_pose(self) -> Doubles:
        """Rotations [B,4] of the rest pose with relaxed hands: fingers side by side and bent as a hand's at rest (K.-S.
        Lee, M.-C. Jung, Safety and Health at Work 6, 2015); of hands of which two fingers are known at least."""
    def rest_heads(self) -> Doubles:
        """World position [B,3] of each bone's head at rest, m."""
    def rest_tails(self) -> Doubles:
        """World position [B,3] of each bone's tail at rest, m."""

class Skin:
    """What of meshes follows which bones of a skeleton: which of them are a body's, and where a hand points."""

    def __init__(self, skeleton: Skeleton) -> None: ...
    def add(self, world: ArrayLike, points: ArrayLike, groups: Sequence[str], weights: ArrayLike) -> None:
        """A mesh: points [V,3] in its own space; world [4,4]: its place (m) where the skeleton rests; weights [N,3], as
        rows of a point's number, the number of a group and how much the point follows it, 0 to 1, of what bones have of
        it; groups that are named as no bone count for nothing. ValueError on numbers of no point or group, and on other
        weights."""

def group_skeletons(skeletons: Sequence[Skeleton]) -> list[list[int]]:
    """Indices of the skeletons that are the same, in their order: motion of one is motion of the others as it stands.
    They have the same bones and parents, and below the hips the same rest rotations (1e-6 rad) and lengths (1/1000 of
    the stature)."""

class Take:
    """A motion capture file as it stands: local transforms [F,B] on its own skeleton."""

    def __init__(
        self,
        skeleton: Skeleton,
        name: str,
        rate: float,
        translations: ArrayLike,
        rotations: ArrayLike,
        unit: float = 1.0,
    ) -> None:
        """A take that no reader has made. Numbers may be missing (not finite); rotations need not be unit."""
    name: str
    rate: float
    unit: float
    """What was taken for one unit of the file's lengths, m."""
    skeleton: Skeleton
    translations: Doubles
    """[F,B,3] m: a bone's head in its parent's frame (replaces the skeleton's offset)."""
    rotations: Doubles
    """[F,B,4]: a bone's rotation relative to its parent."""
    @staticmethod
    def from_clip(clip: Clip, skeleton: Skeleton) -> Take:
        """A clip's motion on its skeleton; bones above the hips rest. The inverse of Clip.from_take."""
    def world_transforms(self) -> tuple[Doubles, Doubles]:
        """World positions [F,B,3] m and rotations [F,B,4] of every bone's frame."""

def read_bvh(path: str | PathLike[str], unit: float = 0.01) -> Take:
    """Read a BVH file; `unit` is one file unit in metres, 1e-6 .. 1000. y-up becomes z-up as (x, -z, y)."""

def write_bvh(take: Take, path: str | PathLike[str], unit: float = 0.01) -> None:
    """Write a take as a BVH file, y up, `unit` metres being one file unit; whole or not at all. ValueError on a bone's
    name that is empty, holds a brace or other blanks than one between words, and on numbers that are missing."""

def read_asf(path: str | PathLike[str]) -> Skeleton:
    """Read an Acclaim skeleton alone."""

def find_asf(amc: str | PathLike[str]) -> pathlib.Path:
    """The skeleton of an Acclaim motion: the .asf in its folder named by what stands before the motion's underscore
    (02.asf of 02_01.amc) or by the whole of it, else the folder's only one. ValueError where there is none."""

def read_asf_amc(asf: str | PathLike[str], amc: str | PathLike[str], rate: float = 120.0) -> Take:
    """Read an Acclaim skeleton and a motion on it; AMC holds no frame rate: 0.1 .. 10000."""

FINDING_CODES: list[str]
"""Every code that a finding can have: missing, unit, up, mirrored, facing, flip, spike, doubled, frozen,
calibration, dropped, jump, ground, slope, axes, drift, in_place, noise, rate, size, body, short, duplicate."""

class Finding:
    """Something about a take that a person should know before anything is made of it."""

    code: str
    severity: str
    """'info', 'warning' or 'error'."""
    frames: tuple[int, int]
    """The first and the last frame, from 0."""
    text: str
    """What is wrong, where and what to do."""
    mendable: bool
    """Whether mend can put it right; a duplicate is mended by leaving the take out."""
    safe: bool
    """Whether it may be mended unasked: what is mended is sure, and nothing is invented."""
    other: int | None
    """Of a duplicate: the take that has the same motion."""

class Examination:
    """What a take is, and what is wrong with it. Directions are '+X' to '-Z' in the take's own axes, or ''."""

    stature: float
    """m, in the unit that the body tells."""
    scale: float
    """What the take's lengths are to be multiplied by to be metres."""
    up: str
    """From the feet to the head as the body moves."""
    facing: str
    """Where a body that stands at rest looks."""
    rate: float
    root_motion: bool
    rest_pose: str
    """'T', 'A', 'down', 'other' (or no pose of a body), or '' without arms."""
    roles: dict[str, str]
    """Role -> bone name, as of Skeleton.role_map."""
    findings: list[Finding]

def tell_four_legs(takes: Sequence[Take]) -> None:
    """Give takes the roles of a body on four legs where their skeleton stands on no legs at rest, and on four in the
    mean over all takes that have it; others stay as they are."""

def examine(takes: list[Take], threads: int = 0, progress: Progress | None = None) -> list[Examination]:
    """Examine takes as they were read, each by itself and for motion that several have. 0 threads: the machine's."""

def examine_ground(take: Take) -> list[Finding]:
    """What examine finds of the height at which feet stand, in a take with whose other faults nothing is done."""

def mend(take: Take, findings: list[Finding], progress: Progress | None = None) -> Take:
    """The take without what these findings of its examination say, where they are mendable; others change nothing."""

def euler_to_quaternion(order: str, angles: ArrayLike) -> Doubles:
    """[F,3] radians in the order X, Y, Z of the channels (whatever `order` is) to [F,4]. `order` is Blender's: in
    'XYZ' the rotation about X comes first, about fixed axes."""

def quaternion_to_euler(order: str, rotations: ArrayLike) -> Doubles:
    """Inverse of euler_to_quaternion [F,4] -> [F,3]; successive frames are kept continuous."""

def axis_angle_to_quaternion(axis_angles: ArrayLike) -> Doubles:
    """[F,4] as (angle, x, y, z) to [F,4]; a zero axis is no rotation."""

def quaternion_to_axis_angle(rotations: ArrayLike) -> Doubles:
    """[F,4] to [F,4] as (angle, x, y, z)."""

class Rig:
    """An armature as an animation package stores it: rest matrices, and per frame each bone's channels (a location and
    a rotation relative to its rest in its parent). Turns channels into clips, and poses back into channels."""

    def __init__(
        self,
        names: Sequence[str],
        parents: Sequence[int],
        rest: ArrayLike,
        lengths: ArrayLike,
        world: ArrayLike,
        inherit_rotation: ArrayLike | None = None,
        local_location: ArrayLike | None = None,
        roles: dict[str, str] | None = None,
        hangs: dict[str, str] | None = None,
        held: Mapping[str, Sequence[float]] | None = None,
        sizes: Mapping[str, float] | None = None,
    ) -> None:
        """rest [B,4,4]: armature-space rest matrices (row-major, y along the bone), lengths [B] of the bones along y,
        world [4,4]: the armature object's matrix (a scale that is uniform but along the vertical), inherit_rotation and
        local_location [B] bool (default all True). hangs: bone -> the bone that it moves with, though it is another's
        child. held: bone -> the location (x, y, z) and rotation (w, x, y, z) that it has in the armature where nothing
        keys it: so the skeleton rests, but what is below the hips is not turned by it. sizes: bone -> how many times as
        large as it rests it is posed, with all its descendants. Raises ValueError on any other or a mirrored scale,
        naming it, and on a bone that hangs on one that it moves. Bones outside the tree of the hips keep their rest
        pose."""
    skeleton: Skeleton
    """In world metres, as wide as it is shown."""
    carried: Doubles
    """[4,4]: what takes the hips, and what they carry, from the armature's rest to where they are held and as large as
    they are then, in its own space."""
    rise: float
    """How many times as high as the heights of its skeleton, clips and poses it is shown; 1 but for a hundredth."""
    def clip(
        self, name: str, rate: float, locations: ArrayLike, rotations: ArrayLike, worlds: ArrayLike | None = None
    ) -> Clip:
        """Channels [F,B,3], [F,B,4] (quaternions; need not be unit) to a clip; `worlds` [F,4,4] where the object
        moves."""
    def clip_from_matrices(self, name: str, rate: float, matrices: ArrayLike, worlds: ArrayLike | None = None) -> Clip:
        """Armature-space pose matrices [F,B,4,4] (row-major; uniform scale is dropped) to a clip."""
    def channels(self, root_positions: ArrayLike, rotations: ArrayLike) -> tuple[Doubles, Doubles]:
        """A clip's or performance's poses to channels: locations [F,B,3] in the armature's units and rotations [F,B,4],
        successive quaternions on the same side. Bones above the hips follow the character frame."""
    def take_channels(self, take: Take) -> tuple[Doubles, Doubles]:
        """A take's transforms as channels of this rig, bones matched by name; every one of the rig's bones that the
        take lacks rests. The rig must have been made from a take's skeleton (same rest heads), its world matrix a
        uniform scale. Raises ValueError naming the take's bones that the rig lacks."""

def find_hanging(
    names: Sequence[str], parents: Sequence[int], poses: ArrayLike, candidates: Sequence[int]
) -> dict[int, int]:
    """Bones that carry keys outside the chain of their parents, as feet that are the targets of a leg's IK: on which
    bone each of the candidates hangs, where it does. poses [F,B,4,4] in the armature's space. A bone hangs on the one
    in whose frame it goes least from frame to frame, where that is a third at most of what it goes in its parent's; two
    that are each other's left and right by their names hang alike."""

def find_joints(
    names: Sequence[str], parents: Sequence[int], poses: ArrayLike, bearing: Sequence[int]
) -> dict[int, int]:
    """Of the bones that carry a mesh, on which of them each hangs whose parent is none of them, as in rigs that were
    exported with their controls: a joint stays in its place as the bone sees it that it hangs on. All but one hang.
    poses [F,B,4,4] in the armature's space; bearing: in the bones' order."""

def span_beside(poses: ArrayLike, bone: int, other: int) -> float:
    """How far a bone's head goes to and fro as another bone sees it: the diagonal of the box that holds it in all of
    the poses [F,B,4,4], in the armature's units."""

class Clip:
    """One take on a skeleton at a fixed rate."""

    def __init__(
        self, skeleton: Skeleton, name: str, rate: float, root_positions: ArrayLike, rotations: ArrayLike
    ) -> None:
        """rate 0.1 .. 10000; root_positions [F,3]: world position of the hips' head, within 1000 km; rotations [F,B,4]:
        the hips' in the world, every other bone's relative to its parent (bones above the hips are ignored)."""
    @staticmethod
    def from_take(take: Take, skeleton: Skeleton | None = None) -> Clip:
        """The take on its own skeleton, or on `skeleton` with the same bone names. Only the hips translate: what other
        bones move away from their offsets is dropped."""
    name: str
    rate: float
    root_positions: Doubles
    rotations: Doubles
    markers: list[tuple[float, str]]
    """What an animator has marked, by the frame, from 0: there a game is told of it as the character plays it."""
    led: bool
    """Whether it was shown on the spot, and its way is what its feet told."""
    def as_led(self) -> Clip:
        """The clip, which was so before its way was written into its file."""
    def with_markers(self, markers: Sequence[tuple[float, str]]) -> Clip:
        """The clip with these markers alone. ValueError where one has no name, is outside of the clip, or is before the
        one before it."""
    def world_transforms(self, skeleton: Skeleton) -> tuple[Doubles, Doubles]:
        """World positions [F,B,3] of the heads, m, and rotations [F,B,4]."""
    def with_fingers(self, skeleton: Skeleton, pose: ArrayLike) -> Clip:
        """With those fingers that rest in all of it as in a pose's rotations [B,4], which are as in Clip."""
    def led_by_feet(self, skeleton: Skeleton, speed: float = 0.0) -> tuple[Clip, float] | None:
        """Of a clip on the spot, whose feet tread while the hips stay: the clip on the way that its feet tell, and how
        fast they go, m/s. `speed`: how fast it shall go, 0 .. 1000 m/s; 0: as its feet do. Where they tell nothing it
        goes straight ahead at `speed`, and 0 is how fast they go. None of any other clip."""
    def may_go(self, skeleton: Skeleton) -> bool:
        """Whether a clip whose feet tell no way may be a gait all the same: a cycle on the spot in which they, or where
        it has none the bone that does most, go about as fast as a body does that moves."""
    def bobs(self, skeleton: Skeleton) -> float:
        """How many times as far as its legs stretch and bend the hips go up and down; 0 where that is not told."""
    def discontinuities(self, skeleton: Skeleton) -> list[int]:
        """The frames that no body gets to from the frame before, in order: as after a calibration pose, or where one
        motion follows another in a file; none in a closed cycle."""
    def stands(self, skeleton: Skeleton) -> bool:
        """Whether the body stands in any frame: its hips are more over the middle between its feet than beside it. A
        body without feet is taken to."""
    def motions_within(self, skeleton: Skeleton) -> list[tuple[int, int]]:
        """Of a clip on the spot that holds several motions, one after the other: the frames of its gaits and stands, of
        each the first and the one after the last; empty where it holds no gait or one motion alone."""
    def character_frames(self, skeleton: Skeleton) -> Doubles:
        """[F,3]: the character frame's x, y and heading (rad, within a half turn; of the hips' thighs, not
        smoothed)."""

def mirrored(skeleton: Skeleton, clips: Sequence[Clip]) -> list[Clip]:
    """The clips' mirror images, left for right, in the plane x = 0. Which of a bone's axes is which on the other side
    is told by the rest pose where that is symmetric, else by the clips' mean pose. ValueError where a clip has not the
    skeleton's number of bones."""

def bobs_too_far(skeleton: Skeleton, clips: Sequence[Clip]) -> float:
    """How many times too far up and down the hips go in the clips for what their legs do; 1 where that is not told, or
    they go less than five times too far. ValueError where a clip has not the skeleton's number of bones."""

def on_one_floor(skeleton: Skeleton, clips: Sequence[Clip]) -> list[Clip]:
    """The clips as a build learns them: level where the studio's floor rises, and moved up or down onto one floor.
    ValueError where a clip has not the skeleton's number of bones."""

def role_doubts(
    skeleton: Skeleton, roles: dict[str, str] | None = None, skin: Skin | None = None
) -> list[tuple[str, str, str]]:
    """(role, bone name, what is doubtful and what to do) of each bone that a person should look at before motion is
    brought onto the skeleton; `roles` as of Body."""

class Body:
    """A skeleton as a body that motion goes from or onto: its roles, and the pose that bodies are compared in, which is
    told by the rest pose, however its arms are held, or by clips."""

    def __init__(
        self,
        skeleton: Skeleton,
        clips: Sequence[Clip] = (),
        roles: dict[str, str] | None = None,
        told: dict[str, str] = ...,
        skin: Skin | None = None,
    ) -> None:
        """`clips` of the skeleton tell how it stands where its rest pose is not that of a standing body, as in many BVH
        files, how its feet stand flat, and what bones are that names do not tell; `roles` (as Skeleton.role_map has
        them, role -> bone name) take the place of all that are found, `told` of some; `skin` tells where hands without
        fingers point, and feet from what stands beside them. ValueError names what is missing of hips, thighs, shins
        and feet, or hangs wrong."""
    skeleton: Skeleton
    roles: dict[str, str]
    """Role -> bone name."""
    stands: bool
    """Whether the rest pose or the clips tell how it stands."""
    reference: Doubles
    """[B,4]: world rotations in the pose that bodies are compared in: a T, facing +y, feet flat."""

class RetargetedClip:
    """A clip on another body, and what came of its feet and knees."""

    clip: Clip
    foot_skate: float
    """Mean horizontal speed of balls and heels, the more weighted the lower they are, m/s."""
    source_foot_skate: float
    """The same of the source, in lengths of the target."""
    foot_skate_ratio: float
    """The one over the other, of which each is counted 1 mm/s more."""
    contact_error: float
    """Greatest height of a standing foot over or under where the source has it, m."""
    knee_beyond: float
    """How far a knee bends less or more than it ever does in the source, rad."""
    hips_moved: float
    """How far at most the hips are lowered or raised for the legs to reach, m."""
    limb_angles: dict[str, float]
    """Role -> how far the limb is from the actor's on the mean, rad: the angle between where both lead in the
    world; a hand or a foot leads as the bone before it does when straight, at rest or, of the actor, in a T."""
    remarks: list[tuple[str, str, str]]
    """(code, "warning" or "error", what a viewer may find fault with)."""

class Retarget:
    """Brings clips of one body onto another, by roles: bones turn as the source's do, lengths are scaled by the legs,
    feet stand where and as long as the source's do, knees bend in its plane and range."""

    def __init__(self, source: Body, target: Body) -> None:
        """ValueError where it is not told how a body stands, unless both are the same one but for names, scale and the
        bones' frames."""
    scale: float
    """Metres of the target for a metre of the source."""
    def apply(self, clip: Clip) -> RetargetedClip:
        """A clip of the source's skeleton on the target's, by the same name."""
    def apply_all(self, clips: Sequence[Clip], threads: int = 0) -> list[RetargetedClip]:
        """apply() of each; `threads`: 0: as many as the machine has, which change no bit."""

class ControlSpace:
    """What can be asked for (Sec. 4): standing and each of the speeds in each of the directions x turn {-1,0,1} x jump
    {0,1}; the paper's 102 by default. Velocity 0 stands, then the slowest speed's directions, counter-clockwise from
    forward, and so on; of the default space, control i = 6 velocity + 2 (turn + 1) + jump."""

    def __init__(
        self,
        walk: float = 1.2,
        run: float = 3.3,
        turn_rate: float = ...,
        scale: float = 1.0,
        speeds: Sequence[float] | None = None,
        directions: int = 8,
        turn: bool = True,
        jump: bool = True,
    ) -> None:
        """Speeds in m/s, turn rate in rad/s (default 70 degrees/s), scale: 1.8 m / stature; all over 0, to 1e9.
        `speeds`: one to four, ascending, in place of walk and run; 4, 8 or 16 directions; whether turns and jumps can
        be asked for."""
    shape: tuple[int, int, int]
    """(17, 3, 2) of the default space: what is told of each control, reshaped to it, is a table of velocity, turn
    (right, none, left; or none alone) and jump (no, yes; or no alone)."""
    speeds: list[float]
    """m/s, the slowest first."""
    gaits: list[str]
    """What each speed is called: of two "walk" and "run"; else of stroll, walk, jog, run and sprint the nearest."""
    directions: int
    turns: bool
    jumps: bool
    walk: float
    """Of the speeds that of the walk, or of what comes nearest to one."""
    run: float
    """The fastest speed."""
    turn_rate: float
    scale: float
    weights: tuple[float, float, float]
    """Of velocity, turn and jump in ControlDis."""
    points: Doubles
    """[controls,4]: velocity x (right), velocity y (forward) in m/s, turn (-1, 0, 1; 1 is left), jump (0, 1)."""
    quickest_turn: float
    """The most that a control's turn is: 1 or, where the takes turn slowly, 170 degrees/s, but no more than 6."""
    def turn_towards(self, off: float) -> float:
        """The turn of a control for a character to face where is `off` rad to the left of where it faces, soon and
        softly. ValueError unless `off` is finite."""
    def nearest(self, controls: ArrayLike) -> Ints:
        """Index of the nearest point for each of [T,4] controls."""
    def distance(self, a: ArrayLike, b: ArrayLike) -> float:
        """ControlDis (Eq. 2) of two controls [4]."""

def read_trace(path: str | PathLike[str]) -> Doubles:
    """Read a trace [T,4] from CSV (header velocity_x,velocity_y,turn,jump; 10 rows a second), as it was written: what
    asks a policy snaps controls to the points of its ControlSpace. ValueError with FILE:LINE."""

def read_asked(
    path: str | PathLike[str],
) -> tuple[
    list[tuple[int, str, int]],
    list[tuple[int, str]],
    list[tuple[int, int, float, float, float]],
    list[tuple[int, int, float, int, float, float, float]],
]:
    """What a trace file asks for beside its controls, in its columns `move` (there may be several), `style`, `look`,
    `left_hand` and `right_hand`: moves by their names, each with the control before which it is started and for how
    many it is held; styles, each with the control before which it is gone over to; looks and reaches as Player.run has
    them. ValueError with FILE:LINE."""

def write_trace(
    path: str | PathLike[str],
    trace: ArrayLike,
    moves: Sequence[tuple[int, str, int]] = ...,
    styles: Sequence[tuple[int, str]] = ...,
    looks: Sequence[tuple[int, int, float, float, float]] = ...,
    reaches: Sequence[tuple[int, int, float, int, float, float, float]] = ...,
) -> None:
    """Write a trace [T,4] as CSV, with moves, styles, looks and reaches as read_asked() tells them; without any, with
    the four columns alone. ValueError on what could not be read back."""

def simulate_trace(player: str, seconds: float = 60.0, seed: int = 1, space: ControlSpace | None = None) -> Doubles:
    """A trace [T,4] of a simulated player: a stick with inertia that chases targets. See PLAYERS for the habits."""

PLAYERS: list[str]

GAITS: list[str]
"""What speeds are called, from the slowest."""

DIRECTIONS: list[str]
"""What sixteen directions are called, counter-clockwise from forward."""

class BuildOptions:
    """All that a build can be told; every field has a documented default."""

    def __init__(self) -> None: ...
    cut: str
    """'gait' (foot strikes where the skeleton has feet, else windows; default) or 'windows'."""
    shortest: float
    """Shortest fragment, s (default 0.1)."""
    longest: float
    """Longest fragment, s (default 0.5)."""
    find_controls: bool
    """As many speeds and directions as the takes hold, turns and jumps where they do; the next four are not looked at
    then (default False)."""
    speeds: int
    """1 to 4, as fast as the takes have them (default 2)."""
    directions: int
    """4, 8 or 16 (default 8)."""
    turn: bool
    """Whether turns can be asked for (default True)."""
    jump: bool
    """Whether jumps can be asked for (default True)."""
    usual_space: ControlSpace
    """What simulated players ask for who teach: as many speeds as are told, as fast as people go. ValueError on a
    number of speeds or directions that there is none."""
    mirror: bool
    """Add the mirror image of every take (default True)."""
    synthesize: bool
    """Fill the controls that the takes lack (Sec. 4; default True)."""
    classes: int
    """Number of classes n (default 97)."""
    restarts: int
    """Clusterings, of which the one that serves Optimal best on the traces is taken (default 8)."""
    seed: int
    policies: list[str]
    """Of POLICIES; the first one drives, the others are there to be compared (default anticipate, iterate, svm,
    greedy)."""
    policy: str
    """The first of `policies`; setting it puts that policy in front."""
    threads: int
    """0: as many as the machine has."""

POLICIES: list[str]

class Move:
    """Anything that is not locomotion: wave, punch, sit down."""

    def __init__(
        self, name: str, clip: Clip, upper_body: bool = False, wait: float = 0.5, loop: tuple[float, float] = (0.0, 0.0)
    ) -> None:
        """All of a clip, of 0.1 to 60 s. `upper_body`: only what is above the legs, which go on walking; `wait`: in how
        many seconds, 0 .. 2, it looks for the moment that joins best; `loop`: begin and end, s, of what is played again
        while it is held, at least 0.1 s (the same: nothing). ValueError on other times."""
    name: str
    clip: Clip
    upper_body: bool
    wait: float
    loop: tuple[float, float]

class Character:
    """A skeleton, its fragments, their classes and a policy: what a policy file holds and a player plays."""

    skeleton: Skeleton
    space: ControlSpace
    policies: list[str]
    """The policies; the first one drives."""
    policy: str
    """The policy that drives."""
    clip_names: list[str]
    fragment_clips: Ints
    """[N] index into clip_names."""
    fragment_ranges: Doubles
    """[N,2]: first and last pose's time in the clip, s."""
    fragment_origins: list[str]
    """[N]: captured, mirrored, interpolated, turned, scaled, stood, raised ..."""
    fragment_durations: Doubles
    """[N] s"""
    evident: Doubles
    """[N,4]: Ev(f), the control each fragment visibly performs."""
    labels: Ints
    """[N]: class of each fragment."""
    representatives: Ints
    """[n]: the medoid fragment of each class."""
    class_names: list[str]
    """[n]: what each class's representative does, as "walk forward left"; numbered from the second of a name on."""
    smoothness: Doubles
    """[n,n]: 1/(1 + Dis(last pose of Q, first pose of Q')), the first factor of Eq. 2."""
    match: Doubles
    """[n,controls]: 1/(1 + ControlDis(Ev(Q'), c)), the second factor of Eq. 2."""
    table: Ints
    """[n,controls]: the policy that drives, class x control -> next class."""
    bridges: Ints
    """[n,n]: the stand-in-place class that goes between two classes, or -1."""
    coverage_counts: Ints
    """[controls]: fragments whose evident control is nearest to this one."""
    coverage_distances: Doubles
    """[controls]: ControlDis to the nearest fragment's evident control."""
    report: dict[str, float]
    """Figures of the build: fragments, captured, synthesized, classes, seconds of each stage. Empty in a loaded one."""
    def save(self, path: str | PathLike[str]) -> None:
        """Write the policy file (to a temporary file, then renamed)."""
    def to_bytes(self) -> bytes: ...
    @staticmethod
    def load(path: str | PathLike[str]) -> Character:
        """Read a policy file; ValueError says why a damaged or foreign one is refused."""
    @staticmethod
    def from_bytes(data: bytes) -> Character: ...
    def optimal(self, trace: ArrayLike) -> tuple[Ints, float]:
        """Path [T+1] of classes that is best in hindsight (Eqs. 1, 3, 4) and its total quality."""
    def able(self, trace: ArrayLike) -> Doubles:
        """What it does of controls [n,4]: at most as fast as it walks, or 1.3 times as fast as its takes go within 30
        degrees of the same direction."""
    def percent_of_optimal(self, trace: ArrayLike, policy: str = "") -> float:
        """Quality of one of its policies (default: the one that drives) on a trace [T,4], in percent of Optimal's, both
        from Optimal's first class."""
    def without(self, excluded: Sequence[int], style: int = 0) -> Character:
        """The character that is never sent to the excluded classes: where a policy's table said one, it says the class
        of the greatest Eq. 2 and value to come of those left. The classes are those of one style; the others stay as
        they are. ValueError where a class or the style does not exist or none is left."""
    move_names: list[str]
    """The moves, in the order of their numbers."""
    moves: list[Move]
    """The moves, as with_moves() takes them: each time made anew."""
    def with_moves(self, moves: Sequence[Move]) -> Character:
        """The character with these moves, at most 256, in place of its own. ValueError that begins with the move's name
        on one of another skeleton, two of one name, one without a name, and one of the upper body where the skeleton
        has no spine that carries two hands."""
    style_names: list[str]
    """The styles, in the order of their numbers; none in a character without."""
    def in_style(self, style: int) -> Character:
        """The character in one of its styles: classes, table and figures are that style's. The first one is itself.
        ValueError on a style that does not exist."""

def with_styles(styles: Sequence[tuple[str, Character]]) -> Character:
    """One character in these styles, at most 64, each by its name: it drives in the first, and has its moves.
    ValueError on two of one name, one without, one that has styles itself, and on one that is of another skeleton or
    has other policies than the first."""

def build(
    skeleton: Skeleton,
    clips: Sequence[Clip],
    traces: Sequence[ArrayLike],
    options: BuildOptions | None = None,
    progress: Progress | None = None,
) -> Character:
    """Clips to a character: fragments, synthesis, classes, quality, policy. Traces [T,4] teach the policy."""

def build_styles(
    skeleton: Skeleton,
    styles: Sequence[tuple[str, Sequence[Clip]]],
    traces: Sequence[ArrayLike],
    options: BuildOptions | None = None,
    progress: Progress | None = None,
) -> Character:
    """A character in these styles, each by its name and with its takes: as build() makes one of each, put together as
    by with_styles(). ValueError names the style."""

class PlayerOptions:
    """All that a Player can be told. What takes these takes them one by one, too."""

    def __init__(
        self,
        seed: int = 1,
        stitch: float = 0.2,
        policy: str = "",
        stitching: str = "inertialize",
        lock_feet: bool = True,
        root_adjustment: float = 1.0,
        responsiveness: float = 0.5,
        constants: Mapping[str, float] = ...,
    ) -> None: ...
    seed: int
    """Draws which fragment of a class plays."""
    stitch: float
    """Seconds that a stitch takes, 0 .. 1."""
    policy: str
    """One of the character's; empty: the one that drives."""
    stitching: str
    """"inertialize" or the paper's "crossfade"."""
    lock_feet: bool
    """Planted feet stay where they are."""
    root_adjustment: float
    """How much the root does of the command beyond its fragments, 0 .. 1."""
    responsiveness: float
    """How soon a change of the control is followed, 0 .. 1: at 1 at once, at the default as a body does."""
    constants: Mapping[str, float]
    """Those of the run time by their names, all of them when read; others than are named when written are as they are.
    `dev.py tune` fits them. ValueError on a name that there is not, and on a value not over 0 and at most 1000."""

class Player:
    """The run-time (Sec. 3.3, Fig. 3): policy, fragments and stitching to poses."""

    @overload
    def __init__(self, character: Character, options: PlayerOptions) -> None: ...
    @overload
    def __init__(
        self,
        character: Character,
        seed: int = 1,
        stitch: float = 0.2,
        policy: str = "",
        stitching: str = "inertialize",
        lock_feet: bool = True,
        root_adjustment: float = 1.0,
        responsiveness: float = 0.5,
        constants: Mapping[str, float] = ...,
    ) -> None: ...
    def reset(self, x: float = 0.0, y: float = 0.0, heading: float = 0.0, style: int = 0) -> None:
        """Stand at a place, facing `heading` (radians, counter-clockwise from +y), in a style, and draw again from the
        seed: after a reset the same steps show the same poses. ValueError on a style that does not exist."""
    def change_style(self, style: int) -> None:
        """Go on in another style: at the moment within 0.8 s at which it joins best, but after the landing of a jump,
        and after a move of the whole body. One that waits is forgotten for it. ValueError on a style that does not
        exist."""
    playing_style: int
    """The style that plays: classes and fragments are its."""
    waiting_style: int
    """The style that waits for its moment, or -1."""
    def force(self, next_class: int) -> None:
        """Play a member of this class, drawn at random, whatever the policy says: as soon as the stitch under way is
        done, and to its end. ValueError on a class that does not exist."""
    def start_move(self, move: int) -> None:
        """Play a move, held from now on: at the moment within its time to wait at which it joins best on to what would
        be shown until then, but not within a jump. One of the whole body goes its own way on the ground, and then into
        the class that joins best for the control; one of the upper body plays over all others. A move that waits is
        forgotten for it, one that plays is played to its end before. ValueError on a move that does not exist."""
    def release_move(self, move: int) -> None:
        """The move is not held any more: its loop is not begun again. ValueError on one that does not exist."""
    def look(self, look: int, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> None:
        """Let head and chest look somewhere from now on, until a reset, as far as in the takes or easily: 0 as they
        have it, 1 where it goes, 2 at a place in the world, m. ValueError on another number and on no place."""
    def reach(
        self, hand: int, weight: float, carried: bool = False, x: float = 0.0, y: float = 0.0, z: float = 0.0
    ) -> None:
        """Let a hand (0 left, 1 right) hold something or reach for it from now on, until a reset: its palm is at a
        place, m, by a weight 0 .. 1 (0: as captured), in the world or, `carried`, seen from the character: to its
        right, before it and over the ground. It goes there smoothly, and reaches for nothing that is far away or behind
        it. ValueError on a hand or a weight that there is not, and on no place."""
    playing_moves: tuple[int, int]
    """The move of the whole body and that of the upper body that play; -1: none."""
    waiting_moves: tuple[int, int]
    """Those that wait for their moment, likewise."""
    passed_markers: list[str]
    """The names of the markers of its takes and moves that the last step passed."""
    def step(self, control: ArrayLike, seconds: float) -> tuple[Doubles, Doubles]:
        """Advance by 0 to 3600 s under a control [4] and return the pose: root position [3] m and rotations [B,4] as in
        Clip. ValueError on what is not finite."""
    frame: tuple[float, float, float]
    """x, y, heading of the character frame now."""
    playing: tuple[int, int]
    """Class and fragment that play now; while a move of the whole body plays, those before it."""
    entered: int
    """Fragments, and parts of moves of the whole body, begun since it was made."""
    seconds_left: float
    """Until the end of the fragment that plays."""
    standing_feet: Doubles
    """[0 .. 2,3]: of each foot that stands where the fragment has it stand, left first, the middle of its sole as it is
    shown, m."""
    def stand_on(self, ground: Callable[[float, float, float], Sequence[float] | None] | None) -> None:
        """Stand and go from the next step or reset on on this ground: a function that is given a place x, y, z, from
        which a ray goes straight down, and returns the height of the first ground that it meets and that ground's
        normal x, y, z, or None; None is level ground at height 0. It is asked at most 8 times a step, and must not
        call the player. What is not finite counts as no ground. What it raises ends the step; the player must be reset
        then. TypeError on what cannot be called or returns something else."""
    ground_level: float
    """The height of the ground under it, m, as its hips follow it."""
    ground_missed: float
    """Seconds since its last reset (or stand_on) in which there was no ground where it asked: meanwhile it went on at
    the height that it had."""
    def quality(self, control: ArrayLike) -> float:
        """Eq. 2, 0 .. 1, for the transition that led to what plays and the point nearest to a control [4]."""
    def run(
        self,
        trace: ArrayLike,
        rate: float,
        progress: Progress | None = None,
        moves: ArrayLike | None = None,
        styles: ArrayLike | None = None,
        looks: ArrayLike | None = None,
        reaches: ArrayLike | None = None,
    ) -> Performance:
        """Reset is not called. Play a trace [T,4] (10 controls a second) from now, sampled at `rate` (any, also
        29.97, to 1000): frames 0 .. round(T/10 * rate), of which there may be 1048574. Each number of a control is
        within a million. `moves` [M,3]: before which control (0 .. T-1) which move is started, and after how many it is
        released; `styles` [S,2]: before which control it changes to which style; `looks` [L,5]: before which control it
        looks where, and at which place, as look(); `reaches` [R,7]: before which control which hand reaches with which
        weight, carried or not, for which place, as reach(). ValueError where one does not exist, or is not of whole
        numbers."""

class Crowd:
    """Many players of one character that step together. Player i shows, to the bit, what a Player of the seed `seed` +
    i shows that is stepped alone."""

    @overload
    def __init__(self, character: Character, count: int, options: PlayerOptions, threads: int = 0) -> None:
        """`count`: 0 .. 100000; `threads`: of a step (0: as many as the machine has), which change no bit of what is
        shown."""
    @overload
    def __init__(
        self,
        character: Character,
        count: int,
        seed: int = 1,
        stitch: float = 0.2,
        policy: str = "",
        stitching: str = "inertialize",
        lock_feet: bool = True,
        root_adjustment: float = 1.0,
        responsiveness: float = 0.5,
        constants: Mapping[str, float] = ...,
        threads: int = 0,
    ) -> None: ...
    def __len__(self) -> int: ...
    def step_many(
        self,
        controls: ArrayLike,
        seconds: float,
        roots: Doubles | None = None,
        rotations: Doubles | None = None,
    ) -> tuple[Doubles, Doubles]:
        """Advance each player by 0 to 3600 s under its control [count,4] and return the poses: root positions
        [count,3] m and rotations [count,B,4]. Arrays that are given are written to and returned: float64, in C order.
        ValueError on what is not finite or of another shape, before any player has moved."""
    def reset(self, player: int, x: float = 0.0, y: float = 0.0, heading: float = 0.0, style: int = 0) -> None:
        """Player.reset of one of them."""
    def change_style(self, player: int, style: int) -> None:
        """Player.change_style of one of them."""
    def force(self, player: int, next_class: int) -> None:
        """Player.force of one of them."""
    def start_move(self, player: int, move: int) -> None:
        """Player.start_move of one of them."""
    def release_move(self, player: int, move: int) -> None:
        """Player.release_move of one of them."""
    character_frames: Doubles
    """[count,3]: x, y, heading of the character frames now."""
    playing: Ints
    """[count,2]: class and fragment that play now."""

def carried_motion(
    root_positions: ArrayLike, rotations: ArrayLike, path: ArrayLike, hips: int, to: ArrayLike
) -> tuple[Doubles, Doubles, Doubles]:
    """Poses [F,3], [F,B,4] in which the character frame is `path` [F,3] (x, y, heading), as they are seen from there,
    with that frame at `to` [F,3]: root positions, rotations and `to`. `hips` is the bone's number."""

def looped_motion(
    root_positions: ArrayLike, rotations: ArrayLike, path: ArrayLike, hips: int, count: int
) -> tuple[Doubles, Doubles, Doubles]:
    """The same, its last `count` frames eased so that it ends as it began: seen from the character frame the last pose
    is the first one, and the one before leads up to it at the first's velocity; the path's last step is its first."""

def resampled_motion(
    times: ArrayLike, root_positions: ArrayLike, rotations: ArrayLike, path: ArrayLike, rate: float
) -> tuple[Doubles, Doubles, Doubles, Ints]:
    """Poses that were shown at times [F] (s, ascending from 0) at a fixed rate (frames a second), on straight lines
    between them; and which [G] of those shown is nearest to each."""

def fit_keys(values: ArrayLike, tolerance: float) -> tuple[Ints, Doubles, Doubles]:
    """Few keys whose cubic Hermite curve passes all values [F,N] within a distance of `tolerance`: their frames [K],
    the first and the last among them, the slopes there [K,N] a frame, and the curve's values on all frames [F,N]. A key
    has its frame's value (P. Schneider, "An algorithm for automatically fitting digitized curves", Graphics Gems 1990).
    """

def reduce_keys(
    rig: Rig,
    tracks: Sequence[tuple[int, str, ArrayLike]],
    locations: ArrayLike,
    rotations: ArrayLike,
    object_locations: ArrayLike | None,
    object_rotations: ArrayLike | None,
    above: ArrayLike,
    scale: ArrayLike,
    distance: float,
    angle: float,
    progress: Progress | None = None,
) -> tuple[list[tuple[Ints, Doubles | None, Doubles]], float, float]:
    """So few keys of each track that on no frame a bone is further than `distance` (m) and `angle` (rad) from where it
    was in the world: for each what fit_keys() tells (no slopes where all keys stay), and how far a bone is at most. A
    track is its owner (a bone of the armature, or -1: the object), its mode (LOCATION, QUATERNION, AXIS_ANGLE, XYZ ...)
    and values [F,N] on all frames. `locations` [F,B,3] and `rotations` [F,B,4] are the channels of all the armature's
    bones, `object_locations` [F,3] and `object_rotations` [F,4] the object's own where it moves, `above` [4,4] what
    stands above these, `scale` [3] the object's. ValueError on sizes, owners and modes that do not fit."""

class Path:
    """A way over the ground: straight lines from point to point. Places on it are told by the way from its beginning in
    metres: round a closed path this goes on lap after lap, and beyond the ends of an open one it leads straight on."""

    def __init__(self, points: ArrayLike, closed: bool = False, speeds: ArrayLike | None = None) -> None:
        """`points` [N,2] or [N,3] m, of which z does not count, within 1e6; `closed`: the last leads back to the first;
        `speeds` [N] m/s, over 0 to 1000: how fast to go at each. ValueError on fewer than two points, and where they
        have no length on the ground (a millimetre)."""
    length: float
    """m, of a closed path once round."""
    is_closed: bool
    start: tuple[float, float, float]
    """x, y and heading of a character that stands at its beginning, facing along it."""
    def places(self, ways: ArrayLike) -> Doubles:
        """Where the path is [K,2], m, after so many metres [K], within 1e6."""

class PathFollower:
    """Steers a character along a path in closed loop: from where it is, the control to give now. A character that
    begins away from the path goes to its beginning first. Takes one call after the other, as a Player does."""

    def __init__(
        self,
        space: ControlSpace,
        path: Path,
        speed: float = 0.0,
        arrive: float = 0.0,
        facing: str = "along",
        heading: float = 0.0,
        place: ArrayLike = (0.0, 0.0),
        end: str = "stand",
    ) -> None:
        """`speed`: m/s to 1000, 0: as fast as the character walks; the path's own speeds count before it. `arrive`: s,
        to a day, after the beginning at which it is to be at the path's end, whatever the speed, or the time of a
        round where it loops; 0: any time; a
        character that would be there too soon sets off later. `facing`: "along" the path, to a "heading" (radians), or
        towards a "place" [2] m. `end`: it is to "stand" there (of a closed path after one round), "loop" (round and
        round; an open path is closed by a straight line) or "go_on" straight ahead. In bends it goes as slowly as a
        body must, and never faster than the character runs."""
    def reset(self) -> None:
        """Begin again."""
    def steer(self, frame: tuple[float, float, float], seconds: float) -> Doubles:
        """The control [4] for a character at `frame` (as Player.frame), 0 to 3600 s after the last call: one for each
        frame of a game, or one each 1/10 s. ValueError on what is not finite."""
    way: float
    """How far it has come along the path, m."""
    stands: bool
    """Whether it has been told to stand at the end."""
    seconds_left: float
    """Until it is at the path's end, s, of a character on the path."""

class Steering:
    """Steers by the view or by the character, as third-person games do. By the view, the stick says where on the screen
    to go: a character that turns well as it goes turns there and goes ahead, on the spot first where that is behind it;
    one that does not goes there at once, sidewards or backwards if need be, and so does any while the user turns it. By
    the character, the stick says where to go as the character sees it, and it turns only as the user turns it."""

    def __init__(self, space: ControlSpace, walk_turns: bool, run_turns: bool) -> None:
        """Whether the character turns well as it walks, and as it runs: turns_well()."""
    def control(
        self, right: float, ahead: float, turn: float, jump: bool, heading: float, view: float | None
    ) -> tuple[float, float, float, float]:
        """The control for a stick within the unit circle, a turn -1 to 1 (left) and a jump button, of a character that
        faces `heading`; `view`: where the screen's up points on the ground, radians as headings are, None: by the
        character."""

def stick_speed(space: ControlSpace, push: float) -> float:
    """m/s of a stick pushed 0 to 1: a walk half way, a run at the end, straight lines between."""

def turns_well(character: Character, policy: str = "", style: int = 0) -> tuple[bool, bool]:
    """Whether a character turns about as fast as it is told while it walks, and while it runs: a player is let try."""

class PathWalk:
    """What a player did along a path."""

    trace: Doubles
    """[T,4]: as from a stick. Played from the same start and seed at the same rate, it shows the same motion."""
    mean_distance: float
    """Of the character frame from the path, m, while it was on it and had not arrived."""
    greatest_distance: float
    """m, likewise."""
    arrival_distance: float
    """m from the path's end: where it stands at last; where it does not stop there, when it arrived or at last."""
    arrived: bool
    """It came to the path's end; where it is to stand, to less than 0.2 m of a character of 1.8 m, and slowly."""
    seconds: float
    """When it arrived; where it did not, how long the trace is."""
    planned_seconds: float
    """When it was to: at the time that was asked for, or as soon as a body can."""
    asked_speed: float
    """m/s: the greatest speed that was asked for, or the mean where a time was. A character that does not run so fast
    goes as fast as it runs."""

def follow_path(
    player: Player,
    path: Path,
    start: tuple[float, float, float] | None = None,
    speed: float = 0.0,
    arrive: float = 0.0,
    facing: str = "along",
    heading: float = 0.0,
    place: ArrayLike = (0.0, 0.0),
    end: str = "stand",
    rate: float = 60.0,
    seconds: float = 600.0,
    progress: Progress | None = None,
) -> PathWalk:
    """Let a player follow a path from `start` (as Player.frame; default: the path's start), where it is reset to; other
    arguments as PathFollower's. It is stepped at `rate`, over 0 to 1000, as Player.run does, and lasts a second longer
    than until it stands at the end, and `seconds`, 0.1 to 3600, at most. Where it does not stand or arrive just so, it
    is tried again a few times, and the best is taken."""

def keep_clear(
    players: Sequence[Player],
    wishes: Sequence[Path | ArrayLike],
    worlds: ArrayLike,
    speed: float = 0.0,
    arrive: float = 0.0,
    facing: str = "along",
    heading: float = 0.0,
    place: ArrayLike = (0.0, 0.0),
    end: str = "stand",
    obstacles: Sequence[ArrayLike] = ...,
    radius: float = 0.4,
    seconds: float = 60.0,
    rate: float = 60.0,
    progress: Progress | None = None,
    area: PaintedArea | None = None,
    passers_by: Sequence[ArrayLike] = ...,
) -> list[Doubles]:
    """A trace [T,4] for each player of a crowd, who stands where it begins, by which it keeps clear of the others and
    of obstacles, convex outlines [N,2], m, and does what it would alone as far as that lets it: its wish is a trace
    [T,4], a path, which it goes along as follow_path() says, or goals [G,2], to which it goes one after another.
    `worlds` [P,4]: where a player's origin is in the world that all share, x, y and heading, and by how much larger
    that is. Each has `radius` metres around it to itself. Nobody leaves the `area`, and who stands beside it goes
    there. `passers_by` make way for nobody: the places [N,2] of each, m, ten a second, at the last of which it stays.
    Paths and goals are gone for so many seconds, 0.1 to 3600. Stepped at `rate`, from the same start and seed, each
    shows the same motion. ValueError on what is out of its range."""

class PaintedArea:
    """Triangles, corners [T,3,3] in m, each corner painted 0 to 1, [T,3]; ValueError where nothing is painted."""

    def __init__(self, corners: ArrayLike, paint: ArrayLike) -> None: ...
    def draw_apart(self, count: int, spacing: float, seed: int, room: float = 0.0) -> Doubles:
        """Places [N,3] on it, the more is painted there, the likelier, linear between the corners; seen from above no
        two of them are nearer than `spacing`, m, and where there are enough of them, none is nearer to its edge than
        `room`, m. N is `count`, or fewer where no room is found for more."""

    def draw_ways(self, starts: ArrayLike, count: int, seed: int, room: float = 0.0) -> Doubles:
        """From each start [S,3] such places one after another, [S,count,3]: the straight way to each from the one
        before is painted all along, seen from above, and comes no nearer to the edge than `room`, m, unless it begins
        there or there is no such way. Where none is found it is the one before."""

class Performance:
    """What a player did."""

    rate: float
    root_positions: Doubles
    """[F,3] m"""
    rotations: Doubles
    """[F,B,4]"""
    path: Doubles
    """[F,3]: character frame x, y, heading (unwrapped)."""
    styles: Ints
    """[F]"""
    classes: Ints
    """[F], of the style that plays"""
    fragments: Ints
    """[F], likewise"""
    moves: Ints
    """[F,2]: the move of the whole body and that of the upper body that play; -1: none."""
    entered: Ints
    """[F]: fragments begun since the first frame; one may follow itself."""
    quality: float
    """Time-weighted mean of Eq. 2 over what was played, 0..1."""
    velocity_error: float
    """Mean over frames of the distance of the hips' velocity from the commanded one, both in the character frame,
    m/s."""
    turn_error: float
    """Mean over frames of the difference of the turn rate from the commanded one, rad/s."""
    jump_error: float
    """Share of the frames in which a jump was commanded and none played, or none and one did."""
    commanded_speed: float
    """Mean commanded speed, m/s."""
    drift: float
    """How far the root gets in a second from where the trace, followed exactly, would have led it, m/s: mean over all
    spans of two seconds, from the place and heading at the beginning of each."""
    drift_heading: float
    """How far its heading gets from that in two seconds, rad: mean over these spans."""
    velocity_error_limited: float
    """m/s: as `velocity_error`, against the trace as a body can follow it, whose velocity changes by no more than
    5 m/s^2 of a 1.8 m character."""
    drift_limited: float
    """m/s: as `drift`, against the trace so limited."""
    drift_heading_limited: float
    """rad: as `drift_heading`, against the trace so limited."""

def judge_clip(character: Character, trace: ArrayLike, clip: Clip, entered: Sequence[int]) -> Performance:
    """A clip that anything made under a trace [T,4], judged as a player's performance is. Where the character faces is
    told by the poses alone; there are no classes, fragments, quality and jump error. `entered` [F] as in Performance.
    ValueError unless the clip has the character's bones and frames 0 .. round(T/10 * rate)."""

def optimal_performance(character: Character, trace: ArrayLike, rate: float, shortest: float = 0.1) -> float:
    """The greatest `Performance.quality` that a player could reach who knew the whole trace: it may play a class for
    any time from `shortest` seconds (0 .. 3600) to the longest of its fragments."""

def abilities(character: Character, threads: int = 0) -> list[bool]:
    """Which of its controls the character does: those without a jump are asked for over six seconds, and done where
    velocity and turn rate are within a fifth and 30 %; of those with a jump, which a fragment performs."""

def names_idle(clip: str) -> bool:
    """Whether a clip's name holds the word "idle", in any case. Of clips that rest for longer than they go or turn,
    those alone that are named so by the fewest words have fragments that rest in a character, where there are any."""

def undone_controls(space: ControlSpace, done: Sequence[bool]) -> list[str]:
    """What can be asked for by the stick alone, as "run back", and is not done, as `abilities` tells; ValueError unless
    `done` has a value of each control."""

NO_RESPONSE: float
"""s after which a change of the stick counts as not answered."""

@overload
def response_times(character: Character, options: PlayerOptions) -> Doubles:
    """[272] seconds from each step of the command between two of the 17 velocities until the velocity over the last
    0.1 s has made 90 % of the way; NO_RESPONSE where it takes longer."""

@overload
def response_times(
    character: Character,
    seed: int = 1,
    stitch: float = 0.2,
    policy: str = "",
    stitching: str = "inertialize",
    lock_feet: bool = True,
    root_adjustment: float = 1.0,
    responsiveness: float = 0.5,
    constants: Mapping[str, float] = ...,
) -> Doubles: ...
@overload
def about_face_times(character: Character, options: PlayerOptions) -> Doubles:
    """[16] seconds from the command to turn, left and right in turn, given to a player that walks forward, until it has
    turned by 180 degrees and walks straight back at nine tenths of the walk; 10 where it takes longer. The whole turn
    rate is held until it has turned so far."""

@overload
def about_face_times(
    character: Character,
    seed: int = 1,
    stitch: float = 0.2,
    policy: str = "",
    stitching: str = "inertialize",
    lock_feet: bool = True,
    root_adjustment: float = 1.0,
    responsiveness: float = 0.5,
    constants: Mapping[str, float] = ...,
) -> Doubles: ...

class SpeedRipple:
    """How evenly a character goes at a commanded speed, m and m/s of a 1.8 m character; NaN where the takes do not go
    steadily."""

    commanded: float
    speed: float
    """Mean of the centre of mass along the ground."""
    ripple: float
    """Standard deviation of its speed over 0.1 s within a second, mean over all seconds."""
    bob: float
    """Standard deviation of the hips' height within a second, mean over all seconds."""
    steps: float
    """How often a foot comes to stand in a second."""
    takes_speed: float
    """Of the takes' steady seconds, the speed nearest to the command."""
    takes_ripple: float
    """Of the takes' steady seconds within 0.1 m/s of that,"""
    takes_bob: float
    """likewise,"""
    takes_steps: float
    """likewise."""

@overload
def speed_ripples(character: Character, options: PlayerOptions) -> list[SpeedRipple]:
    """For forward commands of 0.5, 1, 1.5 ... 3 m/s of a 1.8 m character, each held for 11 s, of which the first three
    do not count."""

@overload
def speed_ripples(
    character: Character,
    seed: int = 1,
    stitch: float = 0.2,
    policy: str = "",
    stitching: str = "inertialize",
    lock_feet: bool = True,
    root_adjustment: float = 1.0,
    responsiveness: float = 0.5,
    constants: Mapping[str, float] = ...,
) -> list[SpeedRipple]: ...
@overload
def change_pushes(character: Character, options: PlayerOptions) -> dict[str, ChangePushes]:
    """How hard the centre of mass is pushed in the 1.5 s after a change of the command, by its kind: start, stop,
    reverse (by more than 100 degrees), turn (to another direction, or the turn rate) and gait (another speed). Of every
    change between two of the 17 velocities, and of walking and running forward between no turn and either turn."""

@overload
def change_pushes(
    character: Character,
    seed: int = 1,
    stitch: float = 0.2,
    policy: str = "",
    stitching: str = "inertialize",
    lock_feet: bool = True,
    root_adjustment: float = 1.0,
    responsiveness: float = 0.5,
    constants: Mapping[str, float] = ...,
) -> dict[str, ChangePushes]: ...

class Motion:
    """What was shown at a fixed rate: as Performance's arrays of these names."""

    def __init__(self, rate: float, root_positions: ArrayLike, rotations: ArrayLike, path: ArrayLike) -> None:
        """`rate`: frames a second; `root_positions` [F,3] m, `rotations` [F,B,4] as in Clip, `path` [F,3]: character
        frame x, y (m) and heading (rad), unwrapped. What they hold is checked where it is used."""
    rate: float
    root_positions: Doubles
    rotations: Doubles
    path: Doubles

def join(skeleton: Skeleton, first: Motion, end: int, second: Motion, beginning: int) -> Motion:
    """The first motion's frames 0 .. `end` to the bit, then the second's after frame `beginning`, which is taken for
    the moment of `end`: carried to where the character is and faces then, and stitched. From 0.8 s later on it shows,
    seen from the character frame, what the second showed. ValueError unless both have the skeleton's bones and one
    rate, and on frames that do not exist."""

def find_seam(
    skeleton: Skeleton, first: Motion, ends: Sequence[int], second: Motion, beginnings: Sequence[int]
) -> tuple[int, int, float]:
    """Of all pairs of a frame of the first and one of the second those whose poses, and poses a thirtieth of a second
    later, are nearest; and the mean distance of the bones' tips there, seen from the character frame, in m of a 1.8 m
    character. ValueError on frames that do not exist."""

def spread(skeleton: Skeleton, motion: Motion, begin: int, end: int, target: ArrayLike) -> Motion:
    """The motion with its character frame at frame `end` moved to `target` [3]: x, y (m), heading (rad). Frames 0 ..
    `begin` are to the bit as they were, those after `end` are moved as a whole, and in between it goes there smoothly.
    ValueError unless 0 <= begin < end < F."""

class Pin:
    """What find_pin found."""

    trace: Doubles
    """[T,4]"""
    seed: int
    """The player's."""
    reached: Doubles
    """[3]: x, y (m) and heading (rad) of the character frame at the pin's time."""
    asked: float
    """How far, in m, the trace was from the pin before;"""
    asked_angle: float
    """and in rad."""
    distance: float
    """How far it is now, m;"""
    angle: float
    """and rad."""
    tries: int
    fits: bool
    """Whether that is as near as was asked for."""

def find_pin(
    character: Character,
    start: ArrayLike,
    trace: ArrayLike,
    seconds: float,
    target: ArrayLike,
    seed: int = 1,
    stitch: float = 0.2,
    policy: str = "",
    stitching: str = "inertialize",
    lock_feet: bool = True,
    root_adjustment: float = 1.0,
    responsiveness: float = 0.5,
    constants: Mapping[str, float] = ...,
    begin: float = 0.0,
    distance: float = 0.02,
    angle: float = ...,
    tries: int = 4000,
    threads: int = 0,
    progress: Progress | None = None,
) -> Pin:
    """Small changes of the trace's [T,4] controls between `begin` (s) and `seconds`, by which a Player of these
    options, reset to `start` [3] and run at 60 frames a second, is then at `target` [3] (x, y in m, heading in rad)
    within `distance` (m) and `angle` (rad, default 2 degrees): searched at random, up to `tries` tries, 1 .. 1e6.
    Speeds change by two fifths at most, directions by 20 degrees, turns by 0.6; who stands goes on standing. The seed
    changes, too, where it begins at 0. The same whatever the thread count (0: the machine's). Where it is not reached,
    the nearest that was found. ValueError unless 0 <= begin < seconds <= T/10, 0.1 s apart at least."""

class ClassesTried:
    """What a number of classes is good for: means over a minute of each simulated player."""

    classes: int
    quality: float
    """As Performance's."""
    velocity_error: float
    """Over the commanded speed."""

def suggest_classes(
    skeleton: Skeleton,
    clips: Sequence[Clip],
    traces: Sequence[ArrayLike],
    options: BuildOptions | None = None,
    progress: Progress | None = None,
) -> tuple[int, list[ClassesTried]]:
    """The fewest classes with which the character follows the stick as well as with any more, and all that were tried:
    24 to 274, as far as there are four fragments a class."""

class Alternative:
    """A class that might be played next, and what speaks for it."""

    next: int
    smoothness: float
    """First factor of Eq. 2."""
    match: float
    """Second factor of Eq. 2."""
    future_value: float
    """Eq. 2 expected of all later steps, discounted, if the policy goes on from there."""
    value: float
    """smoothness * match + future_value"""
    fragments: list[int]
    """Up to three of the class's fragments: those of the greatest Eq. 2 of their own, best first."""

class Explainer:
    """Why a policy plays what it plays."""

    def __init__(self, character: Character, policy: str = "") -> None:
        """`policy`: one of the character's (default: the one that drives); it is evaluated once, here."""
    def __call__(self, playing: int, control: int) -> list[Alternative]:
        """All classes after class `playing` under a control index, the greatest value first."""

class Steps:
    """How far something of all joints goes from one frame to the next, at 60 frames a second."""

    p99: float
    p999: float
    worst: float

class Excess:
    """How far joints turn beyond the least and the greatest that the takes and their mirror images show of them, about
    each of the axes about which a joint turns most, less and least."""

    share: float
    """Of all joints in all frames, those beyond by more than a degree."""
    worst: float
    """rad"""

class Spread:
    """Percentiles of some values, and the greatest; 0 where there are none."""

    p50: float
    p99: float
    p999: float
    worst: float

class Pushes(Spread):
    """How hard a body is pushed along the ground: the change over 0.2 s of its mean velocity over 0.2 s, m/s^2."""

    over_6: float
    """Share of the time in which it is more than 6 m/s^2."""

class ChangePushes(Pushes):
    """What changes of the command do to a body."""

    dragged: float
    """m that feet go lower than those of the takes that are as fast, in the 1.5 s after each."""

class JumpMeans:
    """The jumps of a motion: means over those in which the centre of mass rises 0.2 m or more; NaN where there are
    none."""

    count: int
    dip: float
    """m by which the hips get under their usual height in the half second before the flight."""
    landing_dip: float
    """m, in the half second after it."""
    flight_ratio: float
    """The time in the air over that of a ballistic flight that rises and falls as far."""

class Footfalls:
    """The steps of a body that goes faster than 0.5 m/s."""

    count: int
    same_foot: int
    """Of these, how many are of the foot that came down last."""
    quick: int
    """Of these, how many are of the other foot less than 0.2 s later."""

class MotionMeasures:
    """What a viewer finds fault with, for a character of 1.8 m."""

    foot_skate: float
    """Mean horizontal speed of balls and heels, weighted by 2 - 2^(height / 2.5 cm), m/s."""
    sliding_share: float
    """Share of the time with a point under 2.5 cm in which it goes faster than 0.1 m/s."""
    foot_turn: float
    """Mean rate at which feet turn on the ground, weighted by ball and heel likewise, rad/s."""
    penetration: float
    """The deepest that a point sinks under the ground, m."""
    positions: Steps
    """m"""
    velocities: Steps
    """m/s"""
    accelerations: Steps
    """m/s^2"""
    center_of_mass: Pushes
    hips: Pushes
    yaw: Spread
    """rad/s^2: the change over 0.2 s of the mean turn rate over 0.2 s of where the body faces."""
    jumps: JumpMeans
    footfalls: Footfalls
    dragged_share: float
    """Share of the way of feet along the ground that they go lower than all but a fiftieth of the takes' that are as
    fast or faster."""
    turns: Excess
    """Of the takes: each beyond all others."""

class MotionMetrics:
    """Measures performances by what the takes do themselves. ValueError where the character holds no captured
    fragment."""

    def __init__(self, character: Character) -> None: ...
    takes: MotionMeasures
    """The captured takes' own measures."""
    def of(self, performance: Performance) -> MotionMeasures:
        """Its steps are those within a quarter of a second after a fragment began. ValueError where it is of another
        number of bones."""

# The stages of a build, each a function of arrays. The factors of Eq. 2 are 0 .. 1.

def trajectories(character: Character, poses: int = 16) -> tuple[Floats, Floats, Floats]:
    """The fragments as Dis sees them (Sec. 3.1), m of a 1.8 m character: bone tips [N,poses*K,3] at equal times in the
    character frame of the first pose, and [N,K,3] of the first and the last pose, each in its own character frame.
    `poses`: 2 .. 1000."""

MOST_CLASSES: int
"""More cannot be asked for."""

def cluster(
    points: ArrayLike,
    classes: int,
    weights: ArrayLike | None = None,
    restarts: int = 4,
    seed: int = 1,
    threads: int = 0,
    progress: Progress | None = None,
) -> tuple[Ints, Ints, float]:
    """k-means of points [N,K,3] (K > 0) under Dis, the sum of K distances; weights [N] > 0 say how much each counts;
    `restarts`: up to 10000. Returns labels [N], representatives [n] (medoids) and the inertia, the weighted sum of
    squares of Dis to the class's mean."""

def optimal_path(smoothness: ArrayLike, match: ArrayLike, trace: ArrayLike) -> tuple[Ints, float]:
    """The best path in hindsight (Eqs. 1, 3, 4) for the factors of Eq. 2, [n,n] and [n,controls], over a trace of
    control indices [T]: classes [T+1] and total quality. Ties go to the lower class."""

def percent_of_optimal(smoothness: ArrayLike, match: ArrayLike, table: ArrayLike, trace: ArrayLike) -> float:
    """Quality of a policy table [n,controls] over control indices [T], percent of Optimal's, both from Optimal's first
    class."""

def greedy_table(smoothness: ArrayLike, match: ArrayLike) -> Ints:
    """[n,controls]: argmax of Eq. 2 (Sec. 4, "Greedy")."""

def control_model(
    traces: Sequence[ArrayLike], stays: float = 8.5, goes_anywhere: float = 1.5, controls: int = 102
) -> Doubles:
    """[controls,controls]: P(next control | control): the transitions of traces of control indices, and for every
    control a prior of `stays` counts of itself and `goes_anywhere` counts spread over all (0 .. 1e9); rows sum to 1."""

def anticipate_table(smoothness: ArrayLike, match: ArrayLike, traces: Sequence[ArrayLike]) -> Ints:
    """[n,controls] by value iteration with control_model(traces): the default policy."""

def iterate_table(
    smoothness: ArrayLike, match: ArrayLike, traces: Sequence[ArrayLike], discount: float = ..., tolerance: float = ...
) -> Ints:
    """[n,controls] by value iteration with control_model(traces, 0.5, 0) (McCann and Pollard 2007)."""

def class_features(character: Character) -> Doubles:
    """[n, up to 8]: each class as a previous class in the SVM's inputs: principal components of its last pose."""

def svm_samples(
    smoothness: ArrayLike, match: ArrayLike, traces: Sequence[ArrayLike], features: ArrayLike, space: ControlSpace
) -> tuple[Doubles, Ints]:
    """The SVM's training samples from Optimal's paths (Sec. 3.3): inputs [S, features + 4] and next classes [S]."""

def svm_table(
    smoothness: ArrayLike,
    match: ArrayLike,
    traces: Sequence[ArrayLike],
    features: ArrayLike,
    space: ControlSpace,
    c: float = 0.0,
    gamma: float = 0.0,
    threads: int = 0,
) -> tuple[Ints, float, float, float]:
    """[n,controls] by C-SVC with the RBF kernel (Eqs. 5, 6), and its C, gamma (1e-6 .. 1e6; 0: by cross-validation) and
    the accuracy of the cross-validation (0 where both were given). Features [n, 1 or more] are within a million."""
