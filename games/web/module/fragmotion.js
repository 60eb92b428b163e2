// SPDX-License-Identifier: MIT
// The C API of Fragmotion in JavaScript. What each thing means, its units and its ranges: fragmotion.d.ts.

import makeWasm from "./wasm.mjs";
import { Value, structs } from "./structs.js";

const AXES = ["blender", "gltf", "unity", "unreal"];
const SPACES = ["local", "model", "world"];
const STEERS = ["character", "world", "camera", "path"];
const LOOKS = ["as captured", "ahead", "at"];
const ENDS = ["stand", "loop", "go on"];
const EVENTS = [
  "foot down", "foot up", "take-off", "landing", "move begins", "move ends", "style changes", "path arrived",
  "marker"];
const ROLES = [
  "", "hips", "head", "left hand", "right hand", "left foot", "right foot", "left toe", "right toe", "left thigh",
  "right thigh"];
const STATE = Object.keys(structs.state.fields);
const MOST_EVENTS = 32;
const TRANSFORM = 7, MATRIX = 16; // numbers

export class FragmotionError extends Error {
  name = "FragmotionError";
}

/** WebAssembly's memory, which moves when it grows: look it up each time. */
class Memory {
  constructor(wasm) {
    this.wasm = wasm;
    this.buffer = null;
  }

  #look() {
    const { buffer } = this.wasm.wasmMemory;
    if (this.buffer === buffer) return this.views;
    this.buffer = buffer;
    this.views = {
      bytes: new Uint8Array(buffer), ints: new Int32Array(buffer), words: new Uint32Array(buffer),
      reals: new Float32Array(buffer), doubles: new Float64Array(buffer), longs: new BigUint64Array(buffer),
    };
    return this.views;
  }

  get bytes() {
    return this.#look().bytes;
  }

  get ints() {
    return this.#look().ints;
  }

  get words() {
    return this.#look().words;
  }

  get reals() {
    return this.#look().reals;
  }

  get doubles() {
    return this.#look().doubles;
  }

  get longs() {
    return this.#look().longs;
  }

  floats(address, count) {
    return this.reals.subarray(address / 4, address / 4 + count);
  }

  allocate(size) {
    const address = this.wasm._malloc(Math.max(1, size));
    if (!address) throw new FragmotionError(`there is no memory left for ${size} bytes`);
    return address;
  }

  free(address) {
    this.wasm._free(address);
  }

  text(address) {
    let end = address;
    while (this.bytes[end]) ++end;
    return new TextDecoder().decode(this.bytes.subarray(address, end));
  }

  put(bytes) {
    const address = this.allocate(bytes.length);
    this.bytes.set(bytes, address);
    return address;
  }

  putText(text) {
    return this.put(new TextEncoder().encode(`${text}\0`));
  }

  putFloats(values) {
    const address = this.allocate(values.length * 4);
    this.floats(address, values.length).set(values);
    return address;
  }
}

function number(names, value, what) {
  const index = names.indexOf(value);
  if (index < 0) throw new FragmotionError(`${what} is '${value}'; it can be ${names.join(", ")}`);
  return index;
}

/** Loads the WebAssembly module, once; `source` is where it lies, if it is not beside this file. */
export async function load(source) {
  if (typeof WebAssembly !== "object") {
    throw new FragmotionError("this browser has no WebAssembly, or it is turned off: take a current one");
  }
  const locate = source && { locateFile: () => String(source) };
  return new Fragmotion(await makeWasm(locate));
}

class Fragmotion {
  constructor(wasm) {
    this.wasm = wasm;
    this.memory = new Memory(wasm);
    this.result = this.value(structs.pointer);
  }

  get version() {
    return this.memory.text(this.wasm._fragmotion_version());
  }

  character(bytes, options = {}) {
    return new Character(this, bytes, options);
  }

  value(struct) {
    return new Value(this.memory, struct);
  }

  /** Calls a function that returns a FragmotionResult. */
  call(name, ...values) {
    if (this.wasm[`_fragmotion_${name}`](...values) !== 0) throw this.error();
  }

  /** What a function that writes a handle last has made. */
  make(name, ...values) {
    this.call(name, ...values, this.result.address);
    return this.result.get("value");
  }

  error() {
    return new FragmotionError(this.memory.text(this.wasm._fragmotion_last_error()));
  }
}

/** What can be freed, once. */
class Held {
  constructor(library, handle, kind) {
    Object.assign(this, { library, handle, kind });
  }

  release() {
    this.library.wasm[`_fragmotion_${this.kind}_release`](this.handle);
    this.handle = 0;
  }
}

class Character extends Held {
  constructor(library, bytes, { axes = "gltf", unitsPerMetre = 1 }) {
    const options = library.value(structs.loadOptions);
    options.set("axes", number(AXES, axes, "axes"));
    options.set("unitsPerMetre", unitsPerMetre);
    const data = bytes instanceof Uint8Array ? bytes : new Uint8Array(bytes);
    const address = library.memory.put(data);
    try {
      super(library, library.make("character_load", address, data.length, options.address), "character");
    } finally {
      library.memory.free(address);
      library.memory.free(options.address);
    }
    this.#describe();
  }

  #describe() {
    const info = this.#told(structs.info, "info");
    for (const name of ["height", "hipsHeight", "hips"]) this[name] = info.get(name);
    this.jumps = info.get("jumps") === 1;
    this.turns = info.get("turns") === 1;
    this.bones = this.#list(structs.bone, "bone", info.get("bones"), (bone, name) => ({
      name,
      parent: bone.get("parent"),
      role: ROLES[bone.get("role")],
      length: bone.get("length"),
      rest: bone.getAll("rest", []),
      model: bone.getAll("model", []),
    }));
    this.moves = this.#list(structs.move, "move", info.get("moves"), (move, name) => ({
      name,
      upperBody: move.get("upperBody") === 1,
      loops: move.get("loops") === 1,
      seconds: move.get("seconds"),
      wait: move.get("wait"),
    }));
    this.styles = this.#list(structs.style, "style", info.get("styles"), (style, name, index) => ({
      name,
      speeds: style.getAll("speed", []).slice(0, style.get("speeds")),
      walk: style.get("walk"),
      run: style.get("run"),
      turnRate: style.get("turnRate"),
      classes: Array.from({ length: style.get("classes") }, (_, i) => this.#nameOf("class", index, i)),
    }));
    this.markers = Array.from({ length: info.get("markers") }, (_, i) => this.#nameOf("marker", i));
    this.library.memory.free(info.address);
  }

  #told(struct, kind, ...index) {
    const value = this.library.value(struct);
    this.library.call(`character_${kind}`, this.handle, ...index, value.address);
    return value;
  }

  #list(struct, kind, count, tell) {
    return Array.from({ length: count }, (_, i) => {
      const value = this.#told(struct, kind, i);
      const told = tell(value, this.library.memory.text(value.get("name")), i);
      this.library.memory.free(value.address);
      return told;
    });
  }

  #nameOf(kind, ...index) {
    return this.library.memory.text(this.library.wasm[`_fragmotion_character_${kind}_name`](this.handle, ...index));
  }

  findBone(name) {
    const address = this.library.memory.putText(name);
    const index = this.library.wasm._fragmotion_character_find_bone(this.handle, address);
    this.library.memory.free(address);
    return index;
  }

  rig(options) {
    return new Rig(this, options);
  }

  player(options = {}) {
    const library = this.library, value = playerOptions(library, options);
    const made = library.make("player_create", this.handle, value.address);
    library.memory.free(value.address);
    return new Player(this, made);
  }

  crowd(count, options = {}) {
    return new Crowd(this, count, options);
  }
}

const PLAYER_DEFAULTS = {
  stepInterval: 1, seed: 1, responsiveness: 0.5, rootAdjustment: 1, stitch: 0.2, timeScale: 1, fixedStep: 0,
  holdFeet: true, crossFades: false,
};

function playerOptions(library, options) {
  const value = library.value(structs.playerOptions);
  for (const [name, usual] of Object.entries(PLAYER_DEFAULTS)) value.set(name, options[name] ?? usual);
  return value;
}

class Rig extends Held {
  constructor(character, { names, parents, rest, inverseBinds }) {
    const { library } = character, { memory } = library;
    const texts = names.map((name) => memory.putText(name));
    const list = memory.allocate(4 * names.length);
    texts.forEach((text, i) => (memory.words[list / 4 + i] = text));
    const parentList = parents && memory.allocate(4 * names.length);
    parents?.forEach((parent, i) => (memory.ints[parentList / 4 + i] = parent));
    const given = [rest, inverseBinds].map((values) => (values ? memory.putFloats(values) : 0));
    const options = library.value(structs.rigOptions);
    const values = { bones: names.length, names: list, parents: parentList ?? 0, rest: given[0], inverseBinds: given[1] };
    for (const [name, value] of Object.entries(values)) options.set(name, value);
    try {
      super(library, library.make("rig_create", character.handle, options.address), "rig");
    } finally {
      for (const address of [...texts, list, parentList ?? 0, ...given, options.address]) memory.free(address);
    }
    this.bones = names.map((_, i) => library.wasm._fragmotion_rig_bone(this.handle, i));
  }
}

/** One who plays a character; see fragmotion.d.ts. Its arrays are overwritten by the next call. */
class Player extends Held {
  #input;
  #state;
  #told = { footStands: [0, 0], position: [0, 0, 0], rotation: [0, 0, 0, 1], velocity: [0, 0, 0], motion: [0, 0, 0] };
  #isTold = false;
  #events;
  #count;
  #room = new Map();
  #ground = 0;

  constructor(character, handle) {
    super(character.library, handle, "player");
    this.character = character;
    this.#input = this.library.value(structs.input);
    this.#state = this.library.value(structs.state);
  }

  step(input, seconds) {
    writeInput(this.#input, input);
    this.library.call("player_step", this.handle, this.#input.address, seconds);
    this.#isTold = false;
  }

  get state() {
    if (this.#isTold) return this.#told;
    this.library.call("player_state", this.handle, this.#state.address);
    for (const name of STATE) {
      if (structs.state.fields[name].count) this.#state.getAll(name, this.#told[name]);
      else this.#told[name] = this.#state.get(name);
    }
    this.#isTold = true;
    return this.#told;
  }

  setOptions(options) {
    const value = playerOptions(this.library, options);
    this.library.call("player_set_options", this.handle, value.address);
    this.library.memory.free(value.address);
  }

  reset(place, style = 0) {
    this.#at(place, (address) => this.library.call("player_reset", this.handle, address, style));
  }

  moveTo(place) {
    this.#at(place, (address) => this.library.call("player_move_to", this.handle, address));
  }

  #at(place, run) {
    const value = place && this.library.value(structs.place);
    value?.setAll("position", place.position);
    value?.set("heading", place.heading ?? 0);
    run(value?.address ?? 0);
    this.library.memory.free(value?.address ?? 0);
    this.#isTold = false;
  }

  setGround(ground) {
    const { wasm, memory } = this.library, before = this.#ground;
    const ask = (_, from, hit) => {
      const { reals } = memory, found = ground(reals[from / 4], reals[from / 4 + 1], reals[from / 4 + 2]);
      if (!found) return 0;
      memory.reals[hit / 4] = found.height;
      memory.reals.set(found.normal, hit / 4 + 1);
      return 1;
    };
    this.#ground = ground ? wasm.addFunction(ask, "iiii") : 0;
    this.library.call("player_set_ground", this.handle, this.#ground, 0);
    if (before) wasm.removeFunction(before);
  }

  startMove(move) {
    this.library.call("player_start_move", this.handle, move);
  }

  releaseMove(move) {
    this.library.call("player_release_move", this.handle, move);
  }

  changeStyle(style) {
    this.library.call("player_change_style", this.handle, style);
  }

  look(where, place) {
    const address = this.library.memory.putFloats(place ?? [0, 0, 0]);
    try {
      this.library.call("player_look", this.handle, number(LOOKS, where, "where it looks"), address);
    } finally {
      this.library.memory.free(address);
    }
  }

  setPath(points, options = {}) {
    if (!points) {
      this.library.call("player_set_path", this.handle, 0);
      return;
    }
    const { memory } = this.library, positions = memory.putFloats(points.flat());
    const speeds = options.speeds ? memory.putFloats(options.speeds) : 0;
    const path = this.library.value(structs.path);
    const values = { points: points.length, positions, speeds, closed: options.closed, speed: options.speed, arrive: options.arrive };
    for (const [name, value] of Object.entries(values)) path.set(name, value ?? 0);
    path.set("end", number(ENDS, options.end ?? "stand", "end"));
    path.setAll("facing", options.facing);
    try {
      this.library.call("player_set_path", this.handle, path.address);
    } finally {
      for (const address of [positions, speeds, path.address]) memory.free(address);
    }
  }

  events() {
    const { library } = this;
    this.#events ??= library.memory.allocate(MOST_EVENTS * structs.event.size);
    this.#count ??= library.value(structs.number);
    library.call("player_events", this.handle, this.#events, MOST_EVENTS, this.#count.address);
    return Array.from({ length: this.#count.get("value") }, (_, i) => {
      const at = (this.#events + i * structs.event.size) / 4, { ints, reals } = library.memory;
      return { type: EVENTS[ints[at]], index: ints[at + 1], position: [...reals.subarray(at + 2, at + 5)], seconds: reals[at + 5] };
    });
  }

  pose(rig, space = "local") {
    return this.#written("player_pose", rig, space, TRANSFORM);
  }

  skinning(rig, space = "model") {
    return this.#written("player_skinning", rig, space, MATRIX);
  }

  #written(name, rig, space, numbers) {
    const { memory } = this.library, bones = (rig ?? this.character).bones.length, count = bones * numbers;
    if (!this.#room.has(count)) this.#room.set(count, memory.allocate(4 * count));
    const address = this.#room.get(count);
    this.library.call(name, this.handle, rig?.handle ?? 0, number(SPACES, space, "space"), address, bones);
    return memory.floats(address, count);
  }

  save() {
    const { library } = this, capacity = library.wasm._fragmotion_player_save_size(this.handle);
    const address = library.memory.allocate(capacity), written = library.value(structs.pointer);
    library.call("player_save", this.handle, address, capacity, written.address);
    const bytes = library.memory.bytes.slice(address, address + written.get("value"));
    library.memory.free(address);
    library.memory.free(written.address);
    return bytes;
  }

  restore(bytes) {
    const address = this.library.memory.put(bytes);
    try {
      this.library.call("player_restore", this.handle, address, bytes.length);
    } finally {
      this.library.memory.free(address);
    }
    this.#isTold = false;
  }

  checksum() {
    const sum = this.library.value(structs.sum);
    this.library.call("player_checksum", this.handle, sum.address);
    const value = sum.get("value");
    this.library.memory.free(sum.address);
    return value;
  }

  /** Gives back what it holds beside its handle. */
  forget() {
    this.setGround(null);
    for (const address of [this.#input.address, this.#state.address, this.#events, this.#count?.address, ...this.#room.values()]) {
      this.library.memory.free(address ?? 0);
    }
  }

  release() {
    this.forget();
    super.release();
  }
}

function writeInput(value, { steer = "character", move, facing, turn = 0, jump = false }) {
  value.set("steer", number(STEERS, steer, "steer"));
  value.setAll("move", move);
  value.setAll("facing", facing);
  value.set("turn", turn);
  value.set("jump", jump ? 1 : 0);
}

class Crowd extends Held {
  constructor(character, count, options) {
    const { library } = character, value = playerOptions(library, options);
    super(library, library.make("crowd_create", character.handle, value.address, count, 1), "crowd");
    library.memory.free(value.address);
    this.players = Array.from(
      { length: count }, (_, i) => new Player(character, library.wasm._fragmotion_crowd_player(this.handle, i)));
  }

  makeWay(radius, seconds, others = []) {
    const { library } = this, { memory } = library;
    const numbers = others.flatMap(({ position, velocity = [0, 0, 0], radius: own = radius }) => [...position, ...velocity, own]);
    const bodies = memory.putFloats(numbers);
    try {
      library.call("crowd_make_way", this.handle, radius, seconds, bodies, others.length);
    } finally {
      memory.free(bodies);
    }
  }

  release() {
    for (const player of this.players) player.forget();
    super.release();
  }
}
