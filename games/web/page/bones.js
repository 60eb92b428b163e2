// SPDX-License-Identifier: MIT
// Characters shown as their bones: an eight-sided solid for each, all in one instanced mesh.

import { Color, InstancedMesh, Matrix4, MeshLambertMaterial, OctahedronGeometry } from "three";

const LIMB = 0.2, TRUNK = 0.5; // thickness, of a bone's length
const LARGEST = 0.12, SMALLEST = 0.03; // m
const OVERLAP = 1.2; // of what is shown and a bone's length
const LEFT = new Color(0x2f86a8), RIGHT = new Color(0xd06a2c), MIDDLE = new Color(0xcfcabd);

export class BoneShapes {
  constructor(character, count, scene) {
    this.character = character;
    this.rig = character.rig({
      names: character.bones.map((bone) => bone.name),
      inverseBinds: character.bones.flatMap((bone) => shapeOf(bone).elements),
    });
    const geometry = new OctahedronGeometry(1, 0);
    this.mesh = new InstancedMesh(geometry, new MeshLambertMaterial(), count * character.bones.length);
    this.mesh.frustumCulled = false;
    this.mesh.castShadow = count === 1;
    const colors = character.bones.map(colorOf);
    for (let i = 0; i < this.mesh.count; ++i) this.mesh.setColorAt(i, colors[i % colors.length]);
    scene.scene.add(this.mesh);
  }

  /** One of the players, as it is now. */
  pose(player, index) {
    const matrices = player.skinning(this.rig, "world");
    this.mesh.instanceMatrix.array.set(matrices, index * matrices.length);
  }

  shown() {
    this.mesh.instanceMatrix.needsUpdate = true;
  }

  remove() {
    this.mesh.removeFromParent();
    this.mesh.geometry.dispose();
    this.mesh.dispose();
    this.rig.release();
  }
}

/** From the solid to the bone, whose length lies along y: it takes the place of an inverse bind. */
function shapeOf(bone) {
  const half = bone.role || bone.parent >= 0 ? bone.length / 2 : 0; // a root on the ground is no part of the body
  const radius = half && Math.min(LARGEST, Math.max(SMALLEST, (colorOf(bone) === MIDDLE ? TRUNK : LIMB) * bone.length));
  return new Matrix4().makeTranslation(0, half, 0).multiply(new Matrix4().makeScale(radius, OVERLAP * half, radius));
}

function colorOf(bone) {
  if (/left|(^|[._\s-])l$/i.test(bone.name)) return LEFT;
  return /right|(^|[._\s-])r$/i.test(bone.name) ? RIGHT : MIDDLE;
}
