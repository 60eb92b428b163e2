// SPDX-License-Identifier: MIT
// Many who wander about and turn back at the rim of a wide place.

import { BoneShapes } from "./bones.js";
import { groundAt } from "./scene.js";

export const CROWD = 500;
const RADIUS = 24; // m
const ROOM = 0.35; // m around each
const CALM = 0.25; // changes of mind a second

export class Crowd {
  constructor(character, scene, count) {
    this.crowd = character.crowd(count, { seed: 100, stepInterval: 2 });
    this.shapes = new BoneShapes(character, count, scene);
    const { walk, run } = character.styles[0];
    this.speeds = [0, walk, walk, walk, run];
    this.minds = this.crowd.players.map((player, i) => {
      const angle = 2.4 * i, distance = RADIUS * Math.sqrt((i + 0.5) / count);
      const [x, z] = [distance * Math.cos(angle), distance * Math.sin(angle)];
      player.setGround(scene.ground);
      player.reset({ position: [x, groundAt(x, z).height, z], heading: angle });
      return { steer: "world", move: [0, 0, 0], facing: [0, 0, 0], wait: Math.random() / CALM };
    });
  }

  /** `hero`: the state of whom they make way for. */
  step(seconds, hero) {
    this.crowd.makeWay(ROOM, seconds, [hero]);
    this.crowd.players.forEach((player, i) => {
      const mind = this.minds[i];
      mind.wait -= seconds;
      if (mind.wait < 0) this.#think(mind, player.state.position);
      player.step(mind, seconds);
      this.shapes.pose(player, i);
    });
    this.shapes.shown();
  }

  #think(mind, [x, , z]) {
    const isOut = Math.hypot(x, z) > RADIUS;
    const angle = isOut ? Math.atan2(-z, -x) : 2 * Math.PI * Math.random();
    const speed = this.speeds[isOut ? 1 : Math.floor(Math.random() * this.speeds.length)];
    mind.move = [speed * Math.cos(angle), 0, speed * Math.sin(angle)];
    mind.wait = (0.5 + Math.random()) / CALM;
  }

  remove() {
    this.shapes.remove();
    this.crowd.release();
  }
}
