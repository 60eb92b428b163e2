// SPDX-License-Identifier: MIT
// The structs of fragmotion.h in WebAssembly's memory: where each field lies, read and written by name.

const SIZES = { i: 4, u: 4, f: 4, p: 4, d: 8, q: 8 };

/** A struct: fields as "name:type" or "name:typeCount", types i(nt32) u(int32) f(loat) p(ointer) d(ouble) q (uint64). */
class Struct {
  constructor(text) {
    this.fields = {};
    let end = 0, align = 4;
    for (const [, name, type, count] of text.matchAll(/(\w+):([iufpdq])(\d*)/g)) {
      const size = SIZES[type];
      end = Math.ceil(end / size) * size;
      this.fields[name] = { at: end, index: end / size, size, view: VIEWS[type], count: Number(count) };
      end += size * (Number(count) || 1);
      align = Math.max(align, size);
    }
    this.size = Math.ceil(end / align) * align;
  }
}

const VIEWS = { i: "ints", u: "words", f: "reals", p: "words", d: "doubles", q: "longs" }; // of Memory

/** One of the struct's values, which lies at an address for good. */
export class Value {
  constructor(memory, struct) {
    this.struct = struct;
    this.memory = memory;
    this.address = memory.allocate(struct.size);
    this.memory.bytes.fill(0, this.address, this.address + struct.size);
    if (struct.fields.size) this.set("size", struct.size);
  }

  get(name, index = 0) {
    const field = this.struct.fields[name];
    return this.memory[field.view][this.address / field.size + field.index + index];
  }

  set(name, value, index = 0) {
    const field = this.struct.fields[name];
    this.memory[field.view][this.address / field.size + field.index + index] = field.view === "longs" ? BigInt(value) : value;
  }

  /** Writes a list of numbers, or zeros. */
  setAll(name, values) {
    for (let i = 0; i < this.struct.fields[name].count; ++i) this.set(name, values?.[i] ?? 0, i);
  }

  /** Reads a list of numbers into an array, which is returned. */
  getAll(name, into) {
    for (let i = 0; i < this.struct.fields[name].count; ++i) into[i] = this.get(name, i);
    return into;
  }
}

export const structs = {
  loadOptions: new Struct("size:u axes:i unitsPerMetre:f"),
  info: new Struct("size:u bones:i moves:i styles:i hips:i jumps:i turns:i height:f hipsHeight:f markers:i"),
  bone: new Struct("size:u parent:i name:p role:i length:f rest:f7 model:f7"),
  move: new Struct("size:u upperBody:i loops:i name:p seconds:f wait:f"),
  style: new Struct("size:u classes:i speeds:i name:p speed:f4 walk:f run:f turnRate:f"),
  rigOptions: new Struct("size:u bones:i names:p parents:p rest:p inverseBinds:p"),
  playerOptions: new Struct(
    "size:u stepInterval:u seed:q responsiveness:d rootAdjustment:d stitch:d timeScale:d fixedStep:d " +
      "holdFeet:i crossFades:i"),
  input: new Struct("size:u steer:i move:f3 facing:f3 turn:f jump:i"),
  place: new Struct("position:f3 heading:f"),
  groundHit: new Struct("height:f normal:f3"),
  state: new Struct(
    "size:u style:i waitingStyle:i playingClass:i wholeBodyMove:i upperBodyMove:i waitingWholeBodyMove:i " +
      "waitingUpperBodyMove:i footStands:i2 inTheAir:i pathArrived:i position:f3 heading:f rotation:f4 velocity:f3 " +
      "motion:f3 motionHeading:f groundMissed:f pathWay:f pathSecondsLeft:f"),
  event: new Struct("type:i index:i position:f3 seconds:f"),
  body: new Struct("position:f3 velocity:f3 radius:f"),
  path: new Struct(
    "size:u points:i positions:p speeds:p closed:i end:i speed:f arrive:f facing:f3"),
  pointer: new Struct("value:p"),
  number: new Struct("value:i"),
  sum: new Struct("value:q"),
};
