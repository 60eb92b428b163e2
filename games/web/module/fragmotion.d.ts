// SPDX-License-Identifier: MIT
/**
 * Fragmotion for the web: a character that was made in Blender, a .policy file, as poses that follow a stick.
 *
 *     import { load } from "fragmotion";
 *     const hero = (await load()).character(await (await fetch("hero.policy")).arrayBuffer());
 *     const player = hero.player();
 *     // each frame:
 *     player.step({ steer: "camera", move: [x, y], facing: cameraForward, jump }, seconds);
 *     const { position, rotation } = player.state;
 *     const bones = player.pose(rig);
 *
 * Angles are in radians, times in seconds, lengths in metres unless told. Rotations are unit quaternions x, y, z, w.
 * What fails throws a FragmotionError that says what was wrong and what to do, and changes nothing. Arrays and states
 * that a player tells are its own: the next call overwrites them. What is made is released by release().
 */

/** Loads the WebAssembly module; `source`: where fragmotion's .wasm lies, if it is not beside this file. */
export function load(source?: string | URL): Promise<Fragmotion>;

export class FragmotionError extends Error {}

export interface Fragmotion {
  readonly version: string;
  /** Makes a character of a policy file's bytes; nothing in them is trusted. */
  character(bytes: ArrayBuffer | Uint8Array, options?: { axes?: Axes; unitsPerMetre?: number }): Character;
}

/** "gltf", which is three.js's and Babylon's right-handed world: x right, y up, -z forward. */
export type Axes = "gltf" | "blender" | "unity" | "unreal";
/** Of each bone in its parent; as seen from the character's place; of the world. */
export type Space = "local" | "model" | "world";
export type Vector = readonly [number, number, number] | readonly number[];

export interface Place {
  position: Vector;
  heading?: number;
}

export interface Character {
  readonly bones: readonly Bone[];
  readonly moves: readonly Move[];
  /** One at least. */
  readonly styles: readonly Style[];
  /** The bone that moves; all others turn alone. */
  readonly hips: number;
  readonly jumps: boolean;
  readonly turns: boolean;
  readonly height: number;
  readonly hipsHeight: number;
  /** That animators set in its takes, each name once. */
  readonly markers: readonly string[];
  /** -1: none. A name is found, too, as importers change it: "mixamorig:LeftLeg", "mixamorigLeftLeg", "LeftLeg". */
  findBone(name: string): number;
  rig(options: RigOptions): Rig;
  player(options?: PlayerOptions): Player;
  crowd(count: number, options?: PlayerOptions): Crowd;
  release(): void;
}

export interface Bone {
  name: string;
  parent: number;
  role: string;
  length: number;
  /** At rest: position and rotation, in its parent, and as seen from the character's place. */
  rest: number[];
  model: number[];
}

export interface Move {
  name: string;
  upperBody: boolean;
  loops: boolean;
  seconds: number;
  /** s within which it begins. */
  wait: number;
}

export interface Style {
  /** "" where there is but one style. */
  name: string;
  speeds: number[];
  walk: number;
  run: number;
  turnRate: number;
  classes: string[];
}

/** The mesh's own bones, in its order. */
export interface RigOptions {
  names: string[];
  /** -1: none; with `rest`, bones that the character lacks rest on their parents. */
  parents?: number[];
  /** 7 for each: position and rotation in its parent. */
  rest?: ArrayLike<number>;
  /** 16 for each, column by column. */
  inverseBinds?: ArrayLike<number>;
}

export interface Rig {
  /** The character's bone that each of the rig's is, -1: none. */
  readonly bones: number[];
  release(): void;
}

export interface PlayerOptions {
  /** Level of detail: it plays on every n-th step; 1 .. 64; 1. */
  stepInterval?: number;
  seed?: number | bigint;
  /** 0 .. 1: how soon what is asked for is done; 0.5 is what a body does. */
  responsiveness?: number;
  /** 0 .. 1: how much the body does of what is asked for beyond its motion; 1. */
  rootAdjustment?: number;
  /** s in which one motion goes over into the next; 0.2. */
  stitch?: number;
  /** 0 pauses; 1. */
  timeScale?: number;
  /** s: it plays on by whole steps of this; 0: by the very time of each step. */
  fixedStep?: number;
  /** Feet that stand stay where they are; true. */
  holdFeet?: boolean;
  /** Both motions are mixed while one goes over into the next, for comparison; chosen as the player is made; false. */
  crossFades?: boolean;
}

export interface Input {
  /**
   * "character": move is a velocity to the right and forward, as the character sees it; "world": a velocity in the
   * world, and facing where to face; "camera": a stick to the right and up within the unit circle, pushed half for a
   * walk and fully for a run, and facing where the camera looks; "path": along the path that is set.
   */
  steer?: "character" | "world" | "camera" | "path";
  move?: ArrayLike<number>;
  facing?: ArrayLike<number>;
  /** -1 right .. 1 left, times the turn rate. */
  turn?: number;
  jump?: boolean;
}

export interface State {
  style: number;
  /** -1: none; likewise the moves. */
  waitingStyle: number;
  playingClass: number;
  wholeBodyMove: number;
  upperBodyMove: number;
  waitingWholeBodyMove: number;
  waitingUpperBodyMove: number;
  /** Left, right: 0 or 1; likewise: */
  footStands: number[];
  inTheAir: number;
  pathArrived: number;
  position: number[];
  heading: number;
  /** Of the heading: what an object at `position` is turned by. */
  rotation: number[];
  velocity: number[];
  motion: number[];
  motionHeading: number;
  groundMissed: number;
  pathWay: number;
  pathSecondsLeft: number;
}

export interface Event {
  type: "foot down" | "foot up" | "take-off" | "landing" | "move begins" | "move ends" | "style changes" | "path arrived"
    | "marker";
  /** Of the foot (0 left, 1 right), the move, the style, the marker. */
  index: number;
  position: number[];
  /** Before the end of the step. */
  seconds: number;
}

export interface PathOptions {
  /** Of each point. */
  speeds?: number[];
  /** The last point leads back to the first. */
  closed?: boolean;
  end?: "stand" | "loop" | "go on";
  /** 0: as fast as it walks. */
  speed?: number;
  /** s after which it is to be at the end; 0: any time. */
  arrive?: number;
  /** Where to face; none: along the path. */
  facing?: Vector;
}

export interface Player {
  readonly character: Character;
  /** Where it is and what it does. */
  readonly state: State;
  /** Plays on for 0 to 3600 s. */
  step(input: Input, seconds: number): void;
  setOptions(options: PlayerOptions): void;
  reset(place?: Place | null, style?: number): void;
  /** Something else than its motion has put it there. */
  moveTo(place: Place): void;
  /** What of the ground is first below a place, or null; asked at most 8 times a step. null: level ground. */
  setGround(ground: ((x: number, y: number, z: number) => { height: number; normal: Vector } | null) | null): void;
  startMove(move: number): void;
  releaseMove(move: number): void;
  changeStyle(style: number): void;
  /** Where head and chest look from now on, until a reset; `place` in the world, of "at": for what moves, before each step. */
  look(where: "as captured" | "ahead" | "at", place?: Vector): void;
  /** What steer "path" goes along from now on; null: no path. */
  setPath(points: Vector[] | null, options?: PathOptions): void;
  /** What happened in the last step. */
  events(): Event[];
  /** 7 numbers a bone of the rig, or of the character: position, rotation. */
  pose(rig?: Rig | null, space?: Space): Float32Array;
  /** 16 numbers a bone: its matrix times its inverse bind, column by column. */
  skinning(rig: Rig | null, space?: "model" | "world"): Float32Array;
  /** All that its next poses depend on, but for its character, its ground and the points of its path. */
  save(): Uint8Array;
  restore(bytes: Uint8Array): void;
  checksum(): bigint;
  /** Not of a crowd's player: those go with it. */
  release(): void;
}

export interface Body {
  position: ArrayLike<number>;
  velocity?: ArrayLike<number>;
  /** The crowd's unless told. */
  radius?: number;
}

export interface Crowd {
  readonly players: readonly Player[];
  /** Before a step of so many seconds: all keep clear of each other, with so much room around each, m, and of others,
   * who do not make way. */
  makeWay(radius: number, seconds: number, others?: Body[]): void;
  release(): void;
}
