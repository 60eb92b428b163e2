// SPDX-License-Identifier: MIT
// A soft round shadow under each of many.

import { BufferAttribute, BufferGeometry, DataTexture, DynamicDrawUsage, LinearFilter, Mesh, MeshBasicMaterial } from "three";

const RADIUS = 0.38; // m
const ABOVE = 0.02; // m
const DARKEST = 150, ACROSS = 32; // of 255; pixels
const CORNERS = [[-1, -1], [1, -1], [1, 1], [-1, 1]];

export class Blobs {
  constructor(most, scene) {
    this.ground = scene.ground;
    this.used = 0;
    const geometry = new BufferGeometry(), each = Array.from({ length: most }, (_, i) => i);
    this.position = new BufferAttribute(new Float32Array(12 * most), 3).setUsage(DynamicDrawUsage);
    geometry.setAttribute("position", this.position);
    geometry.setAttribute("uv", new BufferAttribute(new Float32Array(each.flatMap(() => CORNERS.flat().map((way) => (way + 1) / 2))), 2));
    geometry.setIndex(each.flatMap((i) => [0, 2, 1, 0, 3, 2].map((corner) => 4 * i + corner)));
    const material = new MeshBasicMaterial({ map: spot(), transparent: true, depthWrite: false, color: 0x000000 });
    this.mesh = new Mesh(geometry, material);
    this.mesh.frustumCulled = false;
    scene.scene.add(this.mesh);
  }

  begin() {
    this.used = 0;
  }

  /** Under one who stands there, as steep as the ground. */
  show([x, y, z]) {
    const { height, normal: [across, up, along] } = this.ground(x, y, z), { array } = this.position;
    let at = 12 * this.used++;
    for (const [right, back] of CORNERS) {
      array[at++] = x + RADIUS * right;
      array[at++] = height + ABOVE - (RADIUS * (right * across + back * along)) / up;
      array[at++] = z + RADIUS * back;
    }
  }

  end() {
    this.mesh.geometry.setDrawRange(0, 6 * this.used);
    this.position.needsUpdate = true;
  }

  remove() {
    this.mesh.removeFromParent();
    this.mesh.geometry.dispose();
    this.mesh.material.map.dispose();
    this.mesh.material.dispose();
  }
}

function spot() {
  const pixels = new Uint8Array(4 * ACROSS * ACROSS), half = (ACROSS - 1) / 2;
  for (let i = 0; i < ACROSS * ACROSS; ++i) {
    const way = Math.hypot((i % ACROSS) - half, Math.floor(i / ACROSS) - half) / half;
    pixels[4 * i + 3] = DARKEST * Math.max(0, 1 - way) ** 1.3;
  }
  const texture = new DataTexture(pixels, ACROSS, ACROSS);
  texture.magFilter = texture.minFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}
