// SPDX-License-Identifier: MIT
// One character with its player, shown as a skinned mesh or as its bones.

import { Matrix4, Quaternion, Vector3 } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { BoneShapes } from "./bones.js";

const HIGHEST_STEP = 0.35; // m

export class Actor {
  /** Throws, in words for people, where the mesh has no bones of the character's. */
  static async make(character, glb, scene) {
    const meshes = glb ? await skinnedMeshes(glb) : [];
    return new Actor(character, meshes, scene);
  }

  constructor(character, meshes, scene) {
    Object.assign(this, { character, scene });
    this.skins = meshes.map((mesh) => new Skin(character, mesh));
    this.remark = remarkOn(this.skins);
    if (!this.skins.length) this.shapes = new BoneShapes(character, 1, scene);
    for (const { mesh } of this.skins) scene.scene.add(mesh);
    this.crossFade(false);
    this.cost = 0;
  }

  /** A player whose motions are mixed plainly, or again the usual one, where it stands. */
  crossFade(on) {
    const before = this.player;
    this.player = this.character.player({ crossFades: on, holdFeet: !on });
    this.player.setGround(this.scene.ground);
    if (before) this.player.reset(before.state, before.state.style);
    before?.release();
  }

  step(input, seconds) {
    const start = performance.now(), { player } = this;
    const [x, y, z] = player.state.position;
    player.step(input, seconds);
    if (Math.abs(player.state.position[1] - y) > HIGHEST_STEP) {
      player.moveTo({ position: [x, y, z], heading: player.state.heading });
    }
    for (const skin of this.skins) skin.pose(player);
    this.shapes?.pose(player, 0);
    this.cost += 0.02 * (performance.now() - start - this.cost);
    this.shapes?.shown();
  }

  remove() {
    for (const skin of this.skins) skin.remove();
    this.shapes?.remove();
    this.player.release();
    this.character.release();
  }
}

/** A skinned mesh whose bones' matrices are the player's. */
class Skin {
  constructor(character, mesh) {
    const bones = mesh.skeleton.bones, names = bones.map((bone) => bone.userData.name ?? bone.name);
    const placed = bones.map((bone) => partsOf(bone.matrixWorld));
    const parents = bones.map((bone) => bones.indexOf(nearestBone(bone.parent, bones)));
    const isSorted = parents.every((parent, i) => parent < i);
    const inverseBinds = bones.map((_, i) => scaled(mesh.skeleton.boneInverses[i], placed[i].scale).elements);
    const rest = isSorted && bones.map((bone, i) => transform(bone, bones[parents[i]]));
    this.rig = character.rig({
      names, parents: isSorted ? parents : undefined, rest: rest ? rest.flat() : undefined, inverseBinds: inverseBinds.flat() });
    this.names = names;
    this.mesh = mesh;
    this.#leaveToPlayer();
  }

  #leaveToPlayer() {
    const { mesh } = this, identity = new Matrix4();
    mesh.removeFromParent();
    identity.decompose(mesh.position, mesh.quaternion, mesh.scale);
    mesh.bind(mesh.skeleton, identity);
    mesh.skeleton.update = () => {};
    mesh.skeleton.computeBoneTexture();
    mesh.frustumCulled = false;
    mesh.castShadow = true;
  }

  pose(player) {
    const { skeleton } = this.mesh;
    skeleton.boneMatrices.set(player.skinning(this.rig, "world"));
    skeleton.boneTexture.needsUpdate = true;
  }

  remove() {
    this.mesh.removeFromParent();
    this.mesh.geometry.dispose();
    this.mesh.skeleton.dispose();
    this.rig.release();
  }
}

function nearestBone(object, bones) {
  return !object || bones.includes(object) ? object : nearestBone(object.parent, bones);
}

function partsOf(matrix) {
  const parts = { position: new Vector3(), rotation: new Quaternion(), scale: new Vector3() };
  matrix.decompose(parts.position, parts.rotation, parts.scale);
  return parts;
}

/** A mesh in centimetres hangs from bones that are scaled: the player's are not. */
function scaled(inverseBind, scale) {
  return inverseBind.clone().premultiply(new Matrix4().makeScale(scale.x, scale.y, scale.z));
}

function transform(bone, parent) {
  const inside = parent ? parent.matrixWorld.clone().invert().multiply(bone.matrixWorld) : bone.matrixWorld;
  const { position, rotation } = partsOf(inside);
  return [...position.toArray(), ...rotation.toArray()];
}

async function skinnedMeshes(glb) {
  const { scene } = await new GLTFLoader().parseAsync(glb, "");
  scene.updateMatrixWorld(true);
  const meshes = [];
  scene.traverse((object) => object.isSkinnedMesh && meshes.push(object));
  if (!meshes.length) {
    throw new Error("The .glb has no mesh with bones. Export the mesh together with its armature, with Skinning ticked.");
  }
  return meshes;
}

/** What a person is to know of how the mesh's bones were found; throws where there is next to none. */
function remarkOn(skins) {
  if (!skins.length) return null;
  const names = skins.flatMap(({ names }) => names), found = skins.flatMap(({ rig }) => rig.bones);
  const missing = [...new Set(names.filter((_, i) => found[i] < 0))];
  const few = missing.slice(0, 6).join(", ") + (missing.length > 6 ? ", ..." : "");
  if (found.every((bone) => bone < 0)) {
    throw new Error(`No bone of the mesh has the name of one of the character's bones: ${few}. ` +
      "The .policy and the .glb must come from the same armature.");
  }
  return missing.length ? `${missing.length} bones of the mesh are none of the character's and rest: ${few}` : null;
}
