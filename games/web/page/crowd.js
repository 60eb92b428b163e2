// SPDX-License-Identifier: MIT
// Many who wander about and turn back at the rim of a wide place.

import { Bodies } from "./bodies.js";
import { Blobs } from "./blobs.js";
import { groundAt } from "./scene.js";

export const CROWD = 500;
const RADIUS = 24; // m
const ROOM = 0.35; // m around each
const CALM = 0.25; // changes of mind a second
const LOOK_OUT = 3; // frames between two looks at who is in the way
const LEVELS = [
  { upTo: 6, most: 16, rings: 5, sides: 8, least: 0 },
  { upTo: 14, most: 80, rings: 2, sides: 5, least: 0.06 },
  { upTo: Infinity, most: CROWD, rings: 1, sides: 4, least: 0.1 },
];
const PLAIN_LEVELS = [
  { upTo: 6, most: 8, rings: 3, sides: 6, least: 0 },
  { upTo: 10, most: 24, rings: 1, sides: 4, least: 0.1 },
  { upTo: 26, most: 200, rings: 1, sides: 3, least: 0.2 },
  { upTo: Infinity, most: CROWD, rings: 1, sides: 3, least: 0.25 },
];
const STEPS = [[5, 1], [12, 2], [20, 4], [Infinity, 6]]; // m from the hero, frames from step to step
const UNSEEN = 6; // frames from step to step where the camera sees nobody

export class Crowd {
  constructor({ character, body, rig }, scene) {
    Object.assign(this, { scene, rig });
    this.crowd = character.crowd(CROWD, { seed: 100 });
    this.bodies = new Bodies(body, scene.isPlain ? PLAIN_LEVELS : LEVELS, character.height, scene);
    this.blobs = new Blobs(CROWD, scene);
    this.frame = 0;
    this.unseen = 0; // s since the last look
    const { walk, run } = character.styles[0];
    this.speeds = [0, walk, walk, walk, run];
    this.people = this.crowd.players.map((player, i) => {
      const angle = 2.4 * i, distance = RADIUS * Math.sqrt((i + 0.5) / CROWD);
      const place = [distance * Math.cos(angle), 0, distance * Math.sin(angle)];
      place[1] = groundAt(place[0], place[2]).height;
      player.setGround(scene.ground);
      player.reset({ position: place, heading: angle });
      return { player, place, matrices: () => player.skinning(rig, "world"), passed: 0, wait: Math.random() / CALM,
        input: { steer: "world", move: [0, 0, 0], facing: [0, 0, 0] } };
    });
  }

  /** `hero`: the state of whom they make way for. Those far away or out of sight are stepped more seldom. */
  step(seconds, hero) {
    this.unseen += seconds;
    if (++this.frame % LOOK_OUT === 0) {
      this.crowd.makeWay(ROOM, this.unseen, [hero]);
      this.unseen = 0;
    }
    const [x, , z] = hero.position;
    this.people.forEach((person, i) => {
      const away = Math.hypot(person.place[0] - x, person.place[2] - z), [, every] = STEPS.find(([upTo]) => away < upTo);
      const due = person.isSeen ? every : UNSEEN;
      person.passed += seconds;
      if ((this.frame + i) % due === 0) this.#move(person);
    });
  }

  #move(person) {
    person.wait -= person.passed;
    if (person.wait < 0) this.#think(person);
    person.player.step(person.input, person.passed);
    person.place = person.player.state.position;
    person.passed = 0;
  }

  #think(person) {
    const [x, , z] = person.place, isOut = Math.hypot(x, z) > RADIUS;
    const angle = isOut ? Math.atan2(-z, -x) : 2 * Math.PI * Math.random();
    const speed = this.speeds[isOut ? 1 : Math.floor(Math.random() * this.speeds.length)];
    person.input.move = [speed * Math.cos(angle), 0, speed * Math.sin(angle)];
    person.wait = (0.5 + Math.random()) / CALM;
  }

  /** Draws those whom the camera sees. */
  show() {
    this.bodies.begin();
    this.blobs.begin();
    for (const person of this.people) {
      person.isSeen = this.bodies.show(person.place, person.matrices);
      if (person.isSeen) this.blobs.show(person.place);
    }
    this.bodies.end();
    this.blobs.end();
  }

  remove() {
    this.bodies.remove();
    this.blobs.remove();
    this.crowd.release();
  }
}
