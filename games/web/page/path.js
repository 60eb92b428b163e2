// SPDX-License-Identifier: MIT
// A path that the mouse draws on the ground.

import { BufferGeometry, Line, LineBasicMaterial, Raycaster, Vector2, Vector3 } from "three";

const APART = 0.15; // m between its points
const ABOVE = 0.03; // m

export class DrawnPath {
  constructor(scene, canvas, drawn) {
    Object.assign(this, { scene, canvas, drawn, points: [] });
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
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    const at = new Vector2((2 * (event.clientX - left)) / width - 1, 1 - (2 * (event.clientY - top)) / height);
    const ray = new Raycaster();
    ray.setFromCamera(at, this.scene.camera);
    const [hit] = ray.intersectObjects(this.scene.floor);
    const last = this.points.at(-1);
    if (!hit || (last && hit.point.distanceTo(new Vector3(...last)) < APART)) return;
    this.points.push(hit.point.toArray());
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
