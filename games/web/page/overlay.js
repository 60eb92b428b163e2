// SPDX-License-Identifier: MIT
// What is asked and what is done, the class that plays and the feet that stand, as when driving in Blender.

import { ArrowHelper, CircleGeometry, Mesh, MeshBasicMaterial, Vector3 } from "three";

const ASKED = 0x6cb6ff, DONE = 0xffb454, STANDS = 0x3f9b5b;
const ABOVE = 0.03; // m
const EVERY = 250; // ms between two texts
const NAMED = 1000; // ms that a marker's name is read for

export class Overlay {
  constructor(scene) {
    this.scene = scene;
    this.arrows = [ASKED, DONE].map((color) => new ArrowHelper(new Vector3(0, 0, -1), new Vector3(), 1, color, 0.2, 0.14));
    this.prints = [0, 1].map(() => new Mesh(
      new CircleGeometry(0.1, 20).rotateX(-Math.PI / 2), new MeshBasicMaterial({ color: STANDS, transparent: true, opacity: 0.6 })));
    scene.scene.add(...this.arrows, ...this.prints);
    this.texts = Object.fromEntries(["class", "asked", "done", "left", "right", "cost", "rate"].map((id) => [id, document.getElementById(id)]));
    this.stood = [false, false]; // where it set its foot down is not told before it does
    this.frames = 0;
    this.due = 0;
    this.marker = { name: "", until: 0 };
  }

  update(actor, input, followsPath, now) {
    const { state } = actor.player, style = actor.character.styles[state.style];
    const asked = followsPath ? state.velocity : velocity(input, style);
    this.#arrow(0, state, asked);
    this.#arrow(1, state, state.velocity);
    for (const event of actor.player.events()) {
      this.#foot(event);
      if (event.type === "marker") this.marker = { name: actor.character.markers[event.index], until: now + NAMED };
    }
    this.prints.forEach((print, foot) => (print.visible = this.stood[foot] && state.footStands[foot] === 1));
    ++this.frames;
    if (now >= this.due) this.#write(actor, state, style, asked, followsPath, now);
  }

  #foot({ type, index, position: [x, y, z] }) {
    if (type !== "foot down") return;
    this.prints[index].position.set(x, y + ABOVE, z);
    this.stood[index] = true;
  }

  #arrow(index, { position: [x, y, z] }, [vx, , vz]) {
    const arrow = this.arrows[index], speed = Math.hypot(vx, vz);
    arrow.visible = speed > 0.1;
    if (!arrow.visible) return;
    arrow.position.set(x, y + ABOVE * (index + 1), z);
    arrow.setDirection(new Vector3(vx / speed, 0, vz / speed));
    arrow.setLength(0.5 * speed + 0.3, 0.2, 0.14);
  }

  #write(actor, state, style, asked, followsPath, now) {
    const seconds = (now - this.since) / 1000, { texts } = this, say = (id, text) => (texts[id].textContent = text);
    const move = [state.wholeBodyMove, state.upperBodyMove].filter((each) => each >= 0).map((each) => actor.character.moves[each].name);
    const marker = now < this.marker.until ? this.marker.name : "";
    say("class", [style.classes[state.playingClass], style.name, ...move, marker].filter(Boolean).join(", "));
    say("asked", followsPath ? "along the path" : `${Math.hypot(asked[0], asked[2]).toFixed(1)} m/s`);
    say("done", `${Math.hypot(state.velocity[0], state.velocity[2]).toFixed(1)} m/s${state.inTheAir ? ", in the air" : ""}`);
    texts.left.classList.toggle("stands", state.footStands[0] === 1);
    texts.right.classList.toggle("stands", state.footStands[1] === 1);
    say("cost", `${Math.round(actor.cost * 1000)} \u00b5s of the character`);
    if (this.since) say("rate", `${Math.round(this.frames / seconds)} a second`);
    Object.assign(this, { since: now, frames: 0, due: now + EVERY });
  }
}

/** What a stick asks for, in the world: half its way is a walk, all of it a run. */
function velocity({ move: [x, y], facing: [forwardX, , forwardZ] }, { walk, run }) {
  const reach = Math.min(1, Math.hypot(x, y));
  const speed = reach < 0.5 ? 2 * reach * walk : walk + (2 * reach - 1) * (run - walk);
  const along = reach && speed / reach;
  return [along * (y * forwardX - x * forwardZ), 0, along * (y * forwardZ + x * forwardX)];
}
