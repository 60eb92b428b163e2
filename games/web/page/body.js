// SPDX-License-Identifier: MIT
// What a character looks like in few triangles, each corner moved by one bone: for many, and where no graphics processor is.

import { Color, OctahedronGeometry, Vector3 } from "three";

const LIMB = 0.2, TRUNK = 0.5; // thickness, of a bone's length
const LARGEST = 0.12, SMALLEST = 0.03; // m
const OVERLAP = 1.2; // of what is shown and a bone's length
const LEFT = new Color(0x2f86a8), RIGHT = new Color(0xd06a2c), MIDDLE = new Color(0xcfcabd);

/** Corners, each with its place and normal in its bone's own frame, its color and part, and triangles of three each. */
class Body {
  corners = [];
  triangles = [];

  /** Adds a part: [{bone, place, normal, color}], and triangles by indices into it. */
  add(corners, indices) {
    const first = this.corners.length, part = (this.corners.at(-1)?.part ?? -1) + 1;
    for (const corner of corners) this.corners.push({ ...corner, part });
    for (let i = 0; i < indices.length; i += 3) this.triangles.push([0, 1, 2].map((k) => first + indices[i + k]));
  }
}

/** Of meshes: [{mesh, inverseBinds}], whose bones follow each other in the rig. */
export function bodyOfMeshes(skins) {
  const body = new Body();
  let firstBone = 0;
  for (const { mesh, inverseBinds } of skins) {
    const { position, normal, skinIndex, skinWeight, uv } = mesh.geometry.attributes, color = colorsOf(mesh.material, uv);
    const corners = Array.from({ length: position.count }, (_, i) => {
      const joint = heaviest(skinIndex, skinWeight, i), inverse = inverseBinds[joint];
      const away = normal ? new Vector3().fromBufferAttribute(normal, i) : new Vector3(0, 1, 0);
      return {
        bone: firstBone + joint, color: color(i),
        place: new Vector3().fromBufferAttribute(position, i).applyMatrix4(inverse), normal: away.transformDirection(inverse),
      };
    });
    body.add(corners, mesh.geometry.index?.array ?? corners.map((_, i) => i));
    firstBone += inverseBinds.length;
  }
  return body;
}

/** An eight-sided solid for each bone, whose length lies along y. */
export function bodyOfBones(bones) {
  const body = new Body(), { position, normal } = new OctahedronGeometry(1, 0).attributes;
  bones.forEach((bone, index) => {
    const color = colorOf(bone), half = bone.role || bone.parent >= 0 ? bone.length / 2 : 0; // a root on the ground is no part of it
    if (!half) return;
    const radius = Math.min(LARGEST, Math.max(SMALLEST, (color === MIDDLE ? TRUNK : LIMB) * bone.length));
    const size = new Vector3(radius, OVERLAP * half, radius), middle = new Vector3(0, half, 0);
    const corners = Array.from({ length: position.count }, (_, i) => ({
      bone: index, color, place: new Vector3().fromBufferAttribute(position, i).multiply(size).add(middle),
      normal: new Vector3().fromBufferAttribute(normal, i).divide(size).normalize(),
    }));
    body.add(corners, corners.map((_, i) => i));
  });
  return body;
}

function colorOf(bone) {
  if (/left|(^|[._\s-])l$/i.test(bone.name)) return LEFT;
  return /right|(^|[._\s-])r$/i.test(bone.name) ? RIGHT : MIDDLE;
}

function heaviest(skinIndex, skinWeight, i) {
  let best = 0;
  for (let k = 1; k < 4; ++k) if (skinWeight.getComponent(i, k) > skinWeight.getComponent(i, best)) best = k;
  return skinIndex.getComponent(i, best);
}

/** The color of a corner: the material's, times its texture's there. */
function colorsOf({ color, map }, uv) {
  if (!map?.image || !uv) return () => color;
  const size = 64, context = new OffscreenCanvas(size, size).getContext("2d"), at = (way) => Math.floor((way - Math.floor(way)) * size);
  context.drawImage(map.image, 0, 0, size, size);
  const { data } = context.getImageData(0, 0, size, size);
  return (i) => {
    const pixel = 4 * (at(uv.getX(i)) + size * at(map.flipY ? 1 - uv.getY(i) : uv.getY(i)));
    return new Color().setRGB(...[0, 1, 2].map((k) => data[pixel + k] / 255), map.colorSpace).multiply(color);
  };
}

/**
 * The same with fewer corners: what each bone moves of a part is cut along its longest side into rings, and around it into
 * sides, and the corners of a piece become one. Of what is shorter than `least`, m, nothing is left.
 */
export function simplified(body, { rings, sides, least }) {
  const ways = waysAlong(body), pieces = new Map();
  const pieceOf = body.corners.map((corner) => {
    const way = ways.get(keyOf(corner));
    if (way.length < least) return null;
    const across = [corner.place.getComponent(way.u) - way.middle[way.u], corner.place.getComponent(way.v) - way.middle[way.v]];
    const ring = Math.round((rings * (corner.place.getComponent(way.axis) - way.low)) / way.length);
    const side = Math.floor(sides * (Math.atan2(across[1], across[0]) / (2 * Math.PI) + 1)) % sides;
    const key = `${keyOf(corner)} ${ring} ${side}`;
    if (!pieces.has(key)) pieces.set(key, new Piece(corner.bone, way, ring / rings, sides));
    pieces.get(key).take(corner, across);
    return pieces.get(key);
  });
  const kept = [...pieces.values()].sort((a, b) => a.bone - b.bone);
  kept.forEach((piece, i) => (piece.index = i));
  return { corners: kept.map((piece) => piece.corner()), triangles: trianglesBetween(body.triangles, pieceOf) };
}

function keyOf({ bone, part }) {
  return `${bone} ${part}`;
}

/** Of all that a bone moves of a part: along which axis it is longest, from where, and its middle. */
function waysAlong({ corners }) {
  const boxes = new Map();
  for (const corner of corners) {
    const key = keyOf(corner), box = boxes.get(key) ?? { low: corner.place.clone(), high: corner.place.clone() };
    box.low.min(corner.place);
    box.high.max(corner.place);
    boxes.set(key, box);
  }
  return new Map([...boxes].map(([key, { low, high }]) => {
    const size = high.clone().sub(low).toArray(), axis = size.indexOf(Math.max(...size));
    const middle = low.clone().add(high).divideScalar(2).toArray();
    return [key, { axis, u: (axis + 1) % 3, v: (axis + 2) % 3, low: low.getComponent(axis), length: Math.max(size[axis], 1e-6), middle }];
  }));
}

/** Corners that become one. */
class Piece {
  count = 0;
  reach = 0;
  across = [0, 0];
  normal = new Vector3();
  color = new Color(0, 0, 0);

  constructor(bone, way, share, sides) {
    // A prism of few sides is as thick as what is round where both have the same area.
    Object.assign(this, { bone, way, share, wider: Math.sqrt(Math.PI / ((sides / 2) * Math.sin((2 * Math.PI) / sides))) });
  }

  take({ normal, color }, [x, y]) {
    ++this.count;
    this.reach += Math.hypot(x, y);
    this.across[0] += x;
    this.across[1] += y;
    this.normal.add(normal);
    this.color.add(color);
  }

  corner() {
    const { way, across } = this, length = Math.hypot(...across) || 1, reach = (this.wider * this.reach) / this.count;
    const place = new Vector3().setComponent(way.axis, way.low + this.share * way.length)
      .setComponent(way.u, way.middle[way.u] + (reach * across[0]) / length)
      .setComponent(way.v, way.middle[way.v] + (reach * across[1]) / length);
    return { bone: this.bone, place, normal: this.normal.normalize(), color: this.color.multiplyScalar(1 / this.count) };
  }
}

/** Those that still have three corners, once each. */
function trianglesBetween(triangles, pieceOf) {
  const found = new Map();
  for (const triangle of triangles) {
    const [a, b, c] = triangle.map((corner) => pieceOf[corner]?.index);
    if (a === undefined || b === undefined || c === undefined || a === b || b === c || c === a) continue;
    found.set([a, b, c].sort((x, y) => x - y).join(), [a, b, c]);
  }
  return [...found.values()];
}
