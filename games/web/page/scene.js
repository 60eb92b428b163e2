// SPDX-License-Identifier: MIT
// What is around the character: a floor with a slope, stairs and a hill, light, and a camera that follows.

import {
  AmbientLight, BoxGeometry, Color, DataTexture, DirectionalLight, Fog, LinearMipmapLinearFilter, Mesh, MeshLambertMaterial,
  PerspectiveCamera, PlaneGeometry, Raycaster, RepeatWrapping, RingGeometry, Scene as ThreeScene, Vector2, Vector3, WebGLRenderer,
} from "three";

const SKY = 0x2a3038, FLOOR = 0x8a93a0, SOLID = 0x6b7480;
const SQUARE = 1; // m
const SIZE = 120; // m
const FOLLOWING = 6; // a second
const SLOW = 1 / 52, QUICK = 1 / 58, TOO_SLOW = 1 / 30; // s of a frame
const LOOK = 0.5; // s between two looks at how long frames take
const LEAST_SHARE = 0.35, PLAIN_SHARE = 0.6; // of the screen's pixels, along each side
const LOWEST = 0.05, HIGHEST = 1.3; // rad that the camera looks down

// [x0, x1, z0, z1, height at z0, height at z1], m; the highest of those at a place is the ground.
const TOP = 1.2, STEPS = 8, TREAD = 0.32;
const SLOPE = [-5, -2, -9, -4, TOP, 0];
const LANDING = [-5, 5, -12, -9, TOP, TOP];
const STAIRS = Array.from({ length: STEPS }, (_, i) => {
  const height = (TOP * (i + 1)) / STEPS, end = -9 + TREAD * (STEPS - i);
  return [2, 5, end - TREAD, end, height, height];
});
const SOLIDS = [SLOPE, LANDING, ...STAIRS];
const HILL = { x: 10, z: 4, radius: 6, height: 1.1 };

function hillHeight(x, z) {
  const way = Math.hypot(x - HILL.x, z - HILL.z) / HILL.radius;
  return way < 1 ? 0.5 * HILL.height * (1 + Math.cos(Math.PI * way)) : 0;
}

const [WEST, EAST, NORTH, SOUTH] = [0, 1, 2, 3].map((i) =>
  SOLIDS.reduce((far, solid) => (i % 2 ? Math.max(far, solid[i]) : Math.min(far, solid[i])), SOLIDS[0][i]));

function solidAt(x, z) {
  let found = null, height = 0;
  if (x < WEST || x > EAST || z < NORTH || z > SOUTH) return { found, height };
  for (const solid of SOLIDS) {
    const [x0, x1, z0, z1, h0, h1] = solid;
    if (x < x0 || x > x1 || z < z0 || z > z1) continue;
    const here = h0 + ((z - z0) / (z1 - z0)) * (h1 - h0);
    if (here > height) [found, height] = [solid, here];
  }
  return { found, height };
}

/** How high the ground is at a place, and its normal. */
export function groundAt(x, z) {
  const { found, height } = solidAt(x, z);
  if (found) {
    const [, , z0, z1, h0, h1] = found;
    return { height, normal: [0, 1, -(h1 - h0) / (z1 - z0)] };
  }
  const small = 0.01, here = hillHeight(x, z);
  return { height: here, normal: [(here - hillHeight(x + small, z)) / small, 1, (here - hillHeight(x, z + small)) / small] };
}

export class Scene {
  ground = (x, y, z) => groundAt(x, z);

  constructor(canvas) {
    this.isPlain = isDrawnByProcessor(); // without shadows and smooth edges, and the character in few triangles
    this.scene = new ThreeScene();
    this.scene.background = new Color(SKY);
    this.scene.fog = new Fog(SKY, 20, 60);
    this.camera = new PerspectiveCamera(45, 1, 0.1, 100);
    this.renderer = new WebGLRenderer({ canvas, antialias: !this.isPlain });
    this.renderer.shadowMap.enabled = true;
    this.target = new Vector3(0, 1, 0);
    this.heading = 0;
    this.tilt = 0.3;
    this.distance = 5;
    this.share = this.isPlain ? PLAIN_SHARE : 1;
    this.mean = 1 / 60; // s of a frame
    this.left = LOOK; // s until it looks at that again
    this.#addLight();
    this.floor = this.#floor();
    addEventListener("resize", () => this.#fit());
    this.#fit();
  }

  #fit() {
    this.renderer.setPixelRatio(this.share * Math.min(devicePixelRatio, 2));
    this.renderer.setSize(innerWidth, innerHeight, false);
    this.camera.aspect = innerWidth / innerHeight;
    this.camera.updateProjectionMatrix();
  }

  #addLight() {
    this.sun = new DirectionalLight(0xfff2df, 2.6);
    this.sun.castShadow = !this.isPlain;
    this.sun.shadow.mapSize.set(1024, 1024);
    Object.assign(this.sun.shadow.camera, { left: -3, right: 3, top: 3, bottom: -3, far: 20 });
    this.ambient = new AmbientLight(0xc8d8ff, 1.1);
    this.#lightFrom(0, 0, 0);
    this.scene.add(this.ambient, this.sun, this.sun.target);
  }

  #floor() {
    const flat = new Mesh(new PlaneGeometry(SIZE, SIZE).rotateX(-Math.PI / 2), material(FLOOR));
    const parts = [flat, hillMesh(), wedge(SLOPE), ...[LANDING, ...STAIRS].map(box)];
    for (const part of parts) part.receiveShadow = true;
    flat.material.map = squares();
    this.scene.add(...parts);
    return parts;
  }

  /** What of the ground is seen at a place of the window, in pixels; where that is farther away, what is so far; or null. */
  seenAt(x, y, farthest = Infinity) {
    const { left, top, width, height } = this.renderer.domElement.getBoundingClientRect();
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2((2 * (x - left)) / width - 1, 1 - (2 * (y - top)) / height), this.camera);
    const [hit] = ray.intersectObjects(this.floor);
    if (hit && hit.distance < farthest) return hit.point;
    return farthest < Infinity ? ray.ray.at(farthest, new Vector3()) : null;
  }

  /** Where the camera looks, on the ground. */
  facing() {
    return [Math.sin(-this.heading), 0, -Math.cos(this.heading)];
  }

  turn(angle, tilt) {
    this.heading += angle;
    this.tilt = Math.min(HIGHEST, Math.max(LOWEST, this.tilt + tilt));
  }

  zoom(factor) {
    this.distance = Math.min(40, Math.max(2, this.distance * factor));
  }

  follow([x, y, z], seconds) {
    const near = 1 - Math.exp(-FOLLOWING * seconds);
    this.target.lerp(new Vector3(x, y + 1, z), near);
    const [forward, , ahead] = this.facing(), flat = this.distance * Math.cos(this.tilt);
    this.camera.position.set(
      this.target.x - forward * flat, this.target.y + this.distance * Math.sin(this.tilt), this.target.z - ahead * flat);
    this.camera.lookAt(this.target);
    this.#lightFrom(x, y, z);
  }

  /** The sun goes along, as its shadow reaches not far. */
  #lightFrom(x, y, z) {
    this.sun.position.set(x + 4, y + 8, z + 3);
    this.sun.target.position.set(x, y, z);
  }

  /** Fewer pixels where frames take long, at last all of it plain, and more pixels again where they do not. */
  suit(seconds) {
    this.mean += 0.1 * (seconds - this.mean);
    this.left -= seconds;
    const share = this.mean > SLOW ? 0.8 * this.share : this.mean < QUICK ? 1.1 * this.share : this.share;
    if (this.left > 0) return;
    this.left = LOOK;
    if (this.share === LEAST_SHARE && this.mean > TOO_SLOW) this.#bePlain();
    if (share === this.share) return;
    this.share = Math.min(1, Math.max(LEAST_SHARE, share));
    this.#fit();
  }

  #bePlain() {
    this.isPlain = true;
    this.sun.castShadow = false;
  }

  render() {
    this.renderer.render(this.scene, this.camera);
  }
}

/** Whether the browser has no graphics processor to draw with. */
function isDrawnByProcessor() {
  const gl = document.createElement("canvas").getContext("webgl2"), told = gl.getExtension("WEBGL_debug_renderer_info");
  const name = gl.getParameter(told ? told.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

function material(color) {
  return new MeshLambertMaterial({ color, flatShading: true });
}

/** Dark and pale ones in turn. */
function squares() {
  const [dark, pale] = [[120, 120, 120, 255], [150, 150, 150, 255]];
  const texture = new DataTexture(new Uint8Array([dark, pale, pale, dark].flat()), 2, 2);
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.repeat.setScalar(SIZE / (2 * SQUARE));
  texture.minFilter = LinearMipmapLinearFilter;
  texture.generateMipmaps = texture.needsUpdate = true;
  return texture;
}

function box([x0, x1, z0, z1, height]) {
  const mesh = new Mesh(new BoxGeometry(x1 - x0, height, z1 - z0), material(SOLID));
  mesh.position.set((x0 + x1) / 2, height / 2, (z0 + z1) / 2);
  return mesh;
}

/** A box whose upper edge at z1 lies on the floor. */
function wedge([x0, x1, z0, z1, height]) {
  const geometry = new BoxGeometry(x1 - x0, height, z1 - z0), { position } = geometry.attributes;
  for (let i = 0; i < position.count; ++i) {
    if (position.getY(i) > 0 && position.getZ(i) > 0) position.setY(i, -height / 2);
  }
  geometry.computeVertexNormals();
  const mesh = new Mesh(geometry, material(SOLID));
  mesh.position.set((x0 + x1) / 2, height / 2, (z0 + z1) / 2);
  return mesh;
}

function hillMesh() {
  const geometry = new RingGeometry(0, HILL.radius, 48, 16).rotateX(-Math.PI / 2);
  const { position } = geometry.attributes;
  for (let i = 0; i < position.count; ++i) {
    position.setY(i, hillHeight(position.getX(i) + HILL.x, position.getZ(i) + HILL.z) + 0.002);
  }
  geometry.computeVertexNormals();
  const mesh = new Mesh(geometry, material(SOLID));
  mesh.position.set(HILL.x, 0, HILL.z);
  return mesh;
}
