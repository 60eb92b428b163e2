// SPDX-License-Identifier: MIT
// In Node: plays the stick of native.py and writes the poses as floats; then tells the time of a frame and what fails
// how. Arguments: the module's folder, the policy, the file for the poses.
import { readFileSync, writeFileSync } from "node:fs";
import { performance } from "node:perf_hooks";
import { pathToFileURL } from "node:url";

const [folder, policy, output] = process.argv.slice(2);
const { load, FragmotionError } = await import(pathToFileURL(`${folder}/fragmotion.js`));
const bytes = readFileSync(policy);
const fragmotion = await load();
const character = fragmotion.character(bytes);
const SECONDS = 1 / 60, FRAMES = 600;

function stick(frame) {
  const part = Math.floor(frame / 45);
  const move = [((part * 7) % 5 - 2) / 2, ((part * 11) % 7 - 2) / 4, 0];
  return { steer: "camera", move, facing: [0, 0, -1], jump: part % 6 === 5 };
}

function play(player, frames, see = () => {}) {
  for (let frame = 0; frame < frames; ++frame) {
    if (frame === 300 && character.moves.length) player.startMove(0);
    player.step(stick(frame), SECONDS);
    see(player, frame);
  }
}

const player = character.player();
const size = character.bones.length * 7, poses = new Float32Array(FRAMES * size);
play(player, FRAMES, (each, frame) => poses.set(each.pose(), frame * size));
writeFileSync(output, poses);

const saved = player.save(), before = player.checksum();
play(player, 60);
player.restore(saved);
const isBack = player.checksum() === before;

const events = new Set(), grounded = character.player({ seed: 3 });
grounded.setGround((x, y, z) => ({ height: 0.3 * Math.max(0, -z), normal: [0, 1, 0.3] }));
play(grounded, FRAMES, (each) => each.events().forEach((event) => events.add(event.type)));
const isOnSlope = Math.abs(grounded.state.position[1] - 0.3 * Math.max(0, -grounded.state.position[2])) < 0.1;

const walker = character.player();
walker.setPath([[0, 0, 0], [0, 0, -3], [2, 0, -5]]);
for (let frame = 0; frame < 900; ++frame) walker.step({ steer: "path" }, SECONDS);
const { pathArrived, position } = walker.state;

const gazer = character.player(), head = character.findBone("head");
function turnedBy(where, place) {
  gazer.reset();
  gazer.look(where, place);
  for (let frame = 0; frame < 60; ++frame) gazer.step({}, SECONDS);
  const [, , , x, y, z, w] = gazer.pose(null, "model").subarray(7 * head, 7 * head + 7);
  return Math.atan2(2 * (x * z + w * y), 1 - 2 * (x * x + y * y));
}
const gaze = { ahead: turnedBy("ahead"), left: turnedBy("at", [-5, 1.6, -1]), right: turnedBy("at", [5, 1.6, -1]) };

const crowd = character.crowd(3, { seed: 1 });
play(crowd.players[0], FRAMES);
const isAlone = crowd.players[0].checksum() !== crowd.players[1].checksum();

function message(run) {
  try {
    run();
  } catch (error) {
    return error instanceof FragmotionError ? error.message : `${error}`;
  }
  return "";
}

const failures = {
  noPolicy: message(() => fragmotion.character(new Uint8Array(100))),
  cutShort: message(() => fragmotion.character(bytes.subarray(0, 5000))),
  noMove: message(() => player.startMove(99)),
  notANumber: message(() => player.step({ move: [NaN, 0] }, SECONDS)),
  noLook: message(() => player.look("down")),
  noSteer: message(() => player.step({ steer: "wheel" }, SECONDS)),
  fadesLater: message(() => player.setOptions({ crossFades: true })),
};

const timed = character.player(), rig = character.rig({ names: character.bones.map((bone) => bone.name) });
const times = [];
for (let frame = 0; frame < 10000;) {
  const start = performance.now(); // each round too short for other programs to come between
  for (let i = 0; i < 20; ++i, ++frame) {
    timed.step(stick(frame), SECONDS);
    void (timed.state.heading + timed.skinning(rig)[0]);
  }
  times.push((performance.now() - start) / 20);
}
for (const each of [player, grounded, walker, timed, gazer, crowd, rig, character]) each.release();
console.log(JSON.stringify({
  version: fragmotion.version, moves: character.moves, styles: character.styles, isBack, isOnSlope, isAlone,
  pathArrived, position, gaze, events: [...events], failures, frame: Math.min(...times) * 1000 }));
