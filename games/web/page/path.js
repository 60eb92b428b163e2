// SPDX-License-Identifier: MIT
// A path that the mouse draws on the ground.

import { BufferGeometry, Line, LineBasicMaterial, Vector3 } from "three";

const APART = 0.15; // m between its points
const ABOVE = 0.03; // m

export class DrawnPath {
  constructor(scene, canvas, drawn) {
    Object.assign(this, { scene, drawn, points: [] });
    this.line = new Line(new BufferGeometry(), new LineBasicMaterial({ color: 0xffe08a }));
    this.line.frustumCulled = false;
    scene.scene.add(this.line);
    canvas.addEventListener("pointerdown", (event) => this.#begin(event));
    canvas.addEventListener("pointermove", (event) => this.isUnderWay && this.#add(event));
    canvas.addEventListener("pointerup", () => this.isUnderWay && this.#end());
  }

  /** Whether the mouse draws from now on. */
  draw(on) {
    document.body.classList.toggle("drawing", on);
  }

  clear() {
    this.points = [];
    this.#show();
  }

  #begin(event) {
    if (!document.body.classList.contains("drawing")) return;
    this.isUnderWay = true;
    this.points = [];
    this.#add(event);
  }

  #add(event) {
    const point = this.scene.seenAt(event.clientX, event.clientY), last = this.points.at(-1);
    if (!point || (last && point.distanceTo(new Vector3(...last)) < APART)) return;
    this.points.push(point.toArray());
    this.#show();
  }

  #end() {
    this.isUnderWay = false;
    if (this.points.length > 1) this.drawn(this.points);
  }

  #show() {
    this.line.geometry.dispose();
    this.line.geometry = new BufferGeometry().setFromPoints(this.points.map(([x, y, z]) => new Vector3(x, y + ABOVE, z)));
  }
}
