// SPDX-License-Identifier: MIT
// Many bodies in a few draws: each corner is moved by its bone and lit here, so that what draws has next to nothing to do.

import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Frustum, Matrix4, Mesh, MeshBasicMaterial, Sphere } from "three";
import { simplified } from "./body.js";

const MATRIX = 16; // numbers

export class Bodies {
  #frustum = new Frustum();
  #seen = new Matrix4();
  #sphere = new Sphere();

  /** `levels`: [{upTo, most, rings, sides, least}]: how far from the camera, and how many at most, the finest first. */
  constructor(body, levels, height, scene) {
    this.scene = scene;
    this.layers = levels.map((level) => new Layer(simplified(body, level), level, scene));
    this.#sphere.radius = height;
  }

  /** Begins a picture. */
  begin() {
    const { camera } = this.scene;
    camera.updateMatrixWorld();
    this.#frustum.setFromProjectionMatrix(this.#seen.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse));
    for (const layer of this.layers) layer.used = 0;
  }

  /** Shows one who stands at a place, where the camera sees him; `matrices` makes his bones'. Returns whether it does. */
  show(place, matrices) {
    const { center } = this.#sphere;
    center.fromArray(place);
    if (!this.#frustum.intersectsSphere(this.#sphere)) return false;
    const away = center.distanceTo(this.scene.camera.position);
    this.layers.find((layer) => away < layer.upTo && layer.used < layer.most)?.add(matrices());
    return true;
  }

  end() {
    for (const layer of this.layers) layer.end();
  }

  remove() {
    for (const layer of this.layers) layer.remove();
  }
}

/** All that are shown in the same detail: one mesh. */
class Layer {
  constructor({ corners, triangles }, { upTo, most }, { scene, sun, ambient }) {
    Object.assign(this, { upTo, most, used: 0, size: corners.length, drawn: 3 * triangles.length });
    this.bones = Int32Array.from(corners, ({ bone }) => MATRIX * bone);
    this.places = Float32Array.from(corners.flatMap(({ place }) => place.toArray()));
    this.normals = Float32Array.from(corners.flatMap(({ normal }) => normal.toArray()));
    this.sun = sun.position.clone().sub(sun.target.position).normalize();
    this.inShade = Float32Array.from(corners.flatMap(({ color }) => reflected(color, ambient)));
    this.bySun = Float32Array.from(corners.flatMap(({ color }) => reflected(color, sun)));
    const geometry = new BufferGeometry();
    this.position = new BufferAttribute(new Float32Array(3 * this.size * most), 3).setUsage(DynamicDrawUsage);
    this.color = new BufferAttribute(new Uint8ClampedArray(4 * this.size * most).fill(255), 4, true).setUsage(DynamicDrawUsage);
    geometry.setAttribute("position", this.position);
    geometry.setAttribute("color", this.color);
    geometry.setIndex(new BufferAttribute(repeated(triangles.flat(), most, this.size), 1));
    this.mesh = new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true }));
    this.mesh.frustumCulled = false;
    scene.add(this.mesh);
  }

  add(matrices) {
    const { bones, places, normals, inShade, bySun, size, sun } = this, to = this.position.array, colors = this.color.array;
    const first = this.used++ * size, light = [0, 0, 0]; // as the bone sees it
    for (let i = 0, from = 0, at = 3 * first, color = 4 * first; i < size; ++i, from += 3, at += 3, color += 4) {
      const m = bones[i], x = places[from], y = places[from + 1], z = places[from + 2];
      if (i === 0 || m !== bones[i - 1]) {
        for (let k = 0; k < 3; ++k) light[k] = sun.x * matrices[m + 4 * k] + sun.y * matrices[m + 4 * k + 1] + sun.z * matrices[m + 4 * k + 2];
      }
      const lit = Math.max(0, normals[from] * light[0] + normals[from + 1] * light[1] + normals[from + 2] * light[2]);
      for (let k = 0; k < 3; ++k) {
        to[at + k] = matrices[m + k] * x + matrices[m + k + 4] * y + matrices[m + k + 8] * z + matrices[m + k + 12];
        colors[color + k] = inShade[from + k] + lit * bySun[from + k];
      }
    }
  }

  end() {
    this.mesh.visible = this.used > 0;
    this.mesh.geometry.setDrawRange(0, this.used * this.drawn);
    for (const attribute of [this.position, this.color]) {
      attribute.clearUpdateRanges();
      attribute.addUpdateRange(0, attribute.itemSize * this.used * this.size);
      attribute.needsUpdate = this.used > 0;
    }
  }

  remove() {
    this.mesh.removeFromParent();
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
}

/** What a matt color gives back of a light that falls straight on it, of 255. */
function reflected(color, light) {
  return light.color.clone().multiply(color).multiplyScalar((255 * light.intensity) / Math.PI).toArray();
}

/** The indices for each of many bodies, which have so many corners. */
function repeated(indices, times, corners) {
  const all = new Uint32Array(indices.length * times);
  for (let i = 0; i < all.length; ++i) all[i] = indices[i % indices.length] + corners * Math.floor(i / indices.length);
  return all;
}
