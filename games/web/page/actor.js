// SPDX-License-Identifier: MIT
// One character with its player, shown as a skinned mesh, as its bones, or in few triangles.

import { Matrix4, Quaternion, Vector3 } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { Bodies } from "./bodies.js";
import { bodyOfBones, bodyOfMeshes } from "./body.js";
import { Blobs } from "./blobs.js";

const HIGHEST_STEP = 0.35; // m
const PLAIN = [{ upTo: Infinity, most: 1, rings: 6, sides: 8, least: 0 }]; // how it is drawn without a graphics processor

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
    for (const { mesh } of this.skins) scene.scene.add(mesh);
    this.body = this.skins.length ? bodyOfMeshes(this.skins) : bodyOfBones(character.bones);
    this.rig = bonesOf(character, this.skins);
    this.bodies = new Bodies(this.body, PLAIN, character.height, scene);
    this.blobs = new Blobs(1, scene);
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
    const isPlain = this.scene.isPlain || !this.skins.length;
    if (isPlain) this.matrices = player.skinning(this.rig, "world");
    else for (const skin of this.skins) skin.pose(player);
    this.cost += 0.02 * (performance.now() - start - this.cost);
    for (const { mesh } of this.skins) mesh.visible = !isPlain;
    this.#showPlainly(isPlain);
  }

  #showPlainly(isPlain) {
    const { position } = this.player.state, drawn = [this.bodies, this.blobs];
    for (const each of drawn) each.begin();
    if (isPlain) for (const each of drawn) each.show(position, () => this.matrices);
    for (const each of drawn) each.end();
  }

  remove() {
    for (const each of [...this.skins, this.bodies, this.blobs]) each.remove();
    this.rig.release();
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
    this.inverseBinds = bones.map((_, i) => scaled(mesh.skeleton.boneInverses[i], placed[i].scale));
    const rest = isSorted && bones.map((bone, i) => transform(bone, bones[parents[i]]));
    this.bones = { names, parents: isSorted ? parents : undefined, rest: rest ? rest.flat() : undefined };
    this.rig = character.rig({ ...this.bones, inverseBinds: this.inverseBinds.flatMap(({ elements }) => elements) });
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

/** What tells where the bones of all meshes are, one after the other; without meshes, the character's own. */
function bonesOf(character, skins) {
  const lists = skins.length ? skins.map(({ bones }) => bones) : [{ names: character.bones.map(({ name }) => name) }];
  const names = lists.flatMap((list) => list.names), isWhole = lists.every(({ rest }) => rest);
  const starts = lists.map((_, i) => lists.slice(0, i).reduce((sum, list) => sum + list.names.length, 0));
  const shifted = (list, i) => list.parents.map((parent) => (parent < 0 ? -1 : parent + starts[i]));
  return character.rig({
    names, parents: isWhole ? lists.flatMap(shifted) : undefined, rest: isWhole ? lists.flatMap(({ rest }) => rest) : undefined,
    inverseBinds: names.flatMap(() => new Matrix4().elements),
  });
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
