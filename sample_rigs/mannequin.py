# SPDX-License-Identifier: MIT
"""The mannequin's shape in NumPy: smooth lofted shells and dark joints, with bone weights. Metres, rest pose.

A part is a tube through rings. Most parts belong to one bone; waist and neck blend over several.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import body
import numpy as np

Array = np.ndarray
SHELL, JOINT, LEFT, RIGHT = range(4)  # material slots
AROUND = 20  # vertices of a ring
_X, _FRONT, _Z = np.eye(3) * [1, -1, 1]


@dataclass
class Part:
    """A closed surface: vertices [V, 3], quad and triangle faces, a material slot, weights [V] by bone."""

    vertices: Array
    faces: list[tuple[int, ...]]
    material: int
    weights: dict[str, Array] = field(default_factory=dict)

    def mirrored(self) -> Part:
        """The same part on the right side."""
        faces = [tuple(reversed(face)) for face in self.faces]
        weights = {name.replace(".L", ".R"): value for name, value in self.weights.items()}
        return Part(self.vertices * [-1, 1, 1], faces, RIGHT if self.material == LEFT else self.material, weights)


def _loft(rings: Array, caps: tuple[float, float], material: int, square: float = 2.0, smooth: int = 3) -> Part:
    """Tube through rings [K, 3, 3] (centre, half axis u, half axis v), with elliptic caps of the given depths.

    square is the exponent of the superellipse: 2 is an ellipse, more is boxier. Seen along the tube, u x v points back
    along it, so faces look outward.
    """
    dense = _capped(_refined(np.asarray(rings, float), smooth), caps)
    angle = np.arange(AROUND) * 2 * np.pi / AROUND
    cosine, sine = np.cos(angle), np.sin(angle)
    across = np.sign(cosine) * np.abs(cosine) ** (2 / square)
    along = np.sign(sine) * np.abs(sine) ** (2 / square)
    points = dense[:, None, 0] + across[None, :, None] * dense[:, None, 1] + along[None, :, None] * dense[:, None, 2]
    vertices = np.concatenate([points.reshape(-1, 3), points[[0, -1]].mean(axis=1)])
    part = Part(vertices, _tube_faces(len(dense)), material)
    return part if _volume(part) > 0 else Part(vertices, [tuple(reversed(f)) for f in part.faces], material)


def _refined(rings: Array, smooth: int) -> Array:
    """Catmull-Rom interpolation of the rings, `smooth` rings for each given one."""
    slope = np.gradient(rings, axis=0)
    s = (np.arange(smooth) / smooth)[:, None, None, None]
    a, b, m, n = rings[:-1], rings[1:], slope[:-1], slope[1:]
    cubic = (2 * s**3 - 3 * s**2 + 1) * a + (s**3 - 2 * s**2 + s) * m + (3 * s**2 - 2 * s**3) * b + (s**3 - s**2) * n
    inner = np.swapaxes(cubic, 0, 1).reshape(-1, 3, 3)
    return np.concatenate([inner, rings[-1:]])


def _capped(rings: Array, caps: tuple[float, float]) -> Array:
    """Add rings that close both ends as half ellipsoids."""
    angle = np.linspace(0.12, 1, 6)[:-1] * np.pi / 2
    ends = []
    for end, inner, depth in ((rings[0], rings[1], caps[0]), (rings[-1], rings[-2], caps[1])):
        out = end[0] - inner[0]
        out /= np.linalg.norm(out)
        cap = np.repeat(end[None], len(angle), axis=0)
        cap[:, 0] += out * (depth * np.cos(angle))[:, None]
        cap[:, 1:] *= np.sin(angle)[:, None, None]
        ends.append(cap)
    return np.concatenate([ends[0], rings, ends[1][::-1]])


def _tube_faces(rings: int) -> list[tuple[int, ...]]:
    """Quads between neighbouring rings and fans to the two poles, which are the last two vertices."""
    faces: list[tuple[int, ...]] = []
    for ring in range(rings - 1):
        for k in range(AROUND):
            a, b = ring * AROUND + k, ring * AROUND + (k + 1) % AROUND
            faces.append((a, b, b + AROUND, a + AROUND))
    last, pole = (rings - 1) * AROUND, rings * AROUND
    for k in range(AROUND):
        following = (k + 1) % AROUND
        faces += [(pole, following, k), (pole + 1, last + k, last + following)]
    return faces


def _volume(part: Part) -> float:
    """Signed volume (times 6): positive if the faces look outward."""
    corners = np.array([[face[0], face[1], face[2]] for face in part.faces] + [
        [face[0], face[2], face[3]] for face in part.faces if len(face) == 4])  # fmt: skip
    a, b, c = (part.vertices[corners[:, k]] - part.vertices.mean(axis=0) for k in range(3))
    return float(np.sum(a * np.cross(b, c)))


def _rigid(part: Part, bone: str) -> Part:
    part.weights = {bone: np.ones(len(part.vertices))}
    return part


def _blended(part: Part, bones: tuple[str, ...], heights: tuple[float, ...]) -> Part:
    """Weights that pass from bone to bone at the given heights, eased."""
    place = np.interp(part.vertices[:, 2], heights, range(len(heights)))
    for index, bone in enumerate(bones):
        near = np.clip(1 - np.abs(place - index), 0, 1)
        part.weights[bone] = near * near * (3 - 2 * near)
    return part


def _upright(rows: list[tuple[float, float, float, float]]) -> Array:
    """Rings of a vertical tube from rows (height, half width, half depth, centre y)."""
    return np.array([[[0, y, z], width * _X, depth * _FRONT] for z, width, depth, y in rows])


def _limb(bone: str, rows: list[tuple[float, float, float, float]]) -> Array:
    """Rings along a bone from rows (part of its length, half width, half depth, shift to the front)."""
    rest = body.BY_NAME[bone]
    along = rest.tail - rest.head
    unit = along / np.linalg.norm(along)
    front = _FRONT - unit * (unit @ _FRONT)
    front /= np.linalg.norm(front)
    side = np.cross(front, unit)
    return np.array([[rest.head + t * along + s * front, w * side, d * front] for t, w, d, s in rows])


def _ball(centre: Array, radii: tuple[float, float, float], material: int = JOINT) -> Part:
    """An ellipsoid."""
    x, y, z = radii
    ring = np.array([[centre + h * z * _Z, np.sqrt(1 - h * h) * x * _X, np.sqrt(1 - h * h) * y * _FRONT]
                     for h in np.sin(np.linspace(-1.45, 1.45, 13))])  # fmt: skip
    return _loft(ring, (z * 0.007, z * 0.007), material, smooth=1)


def _trunk() -> list[Part]:
    """Pelvis, waist, chest, neck and head."""
    pelvis = [(0.90, 0.105, 0.085, 0.012), (0.945, 0.150, 0.108, 0.014), (1.0, 0.158, 0.112, 0.010),
              (1.045, 0.140, 0.098, 0.004)]  # fmt: skip
    waist = [(0.99, 0.118, 0.080, 0.0), (1.08, 0.118, 0.084, 0.0), (1.17, 0.116, 0.084, 0.0),
             (1.26, 0.124, 0.086, 0.005)]  # fmt: skip
    chest = [(1.215, 0.128, 0.094, 0.0), (1.29, 0.147, 0.110, 0.0), (1.37, 0.160, 0.116, 0.008),
             (1.44, 0.142, 0.092, 0.018), (1.475, 0.098, 0.064, 0.022)]  # fmt: skip
    neck = [(1.44, 0.062, 0.060, 0.020), (1.50, 0.052, 0.054, 0.016), (1.60, 0.050, 0.054, 0.004)]
    head = [(1.595, 0.046, 0.056, -0.022), (1.64, 0.066, 0.084, -0.016), (1.70, 0.077, 0.098, -0.006),
            (1.745, 0.074, 0.094, 0.0)]  # fmt: skip
    visor = np.array([[[x, -0.070 + 0.9 * x * x * 5, 1.695], 0.026 * _Z, 0.040 * _FRONT] for x in
                      np.linspace(-0.048, 0.048, 7)])  # fmt: skip
    return [
        _rigid(_loft(_upright(pelvis), (0.03, 0.02), SHELL, 2.3), "hips"),
        _blended(_loft(_upright(waist), (0.02, 0.02), JOINT, 2.2), ("hips", "spine", "chest"), (1.03, 1.14, 1.25)),
        _rigid(_loft(_upright(chest), (0.02, 0.025), SHELL, 2.3), "chest"),
        _blended(_loft(_upright(neck), (0.01, 0.01), JOINT), ("chest", "neck", "head"), (1.465, 1.53, 1.59)),
        _rigid(_loft(_upright(head), (0.022, 0.055), SHELL, 2.1), "head"),
        _rigid(_loft(visor, (0.012, 0.012), JOINT, 2.4, smooth=2), "head"),
    ]


def _arm() -> list[Part]:
    """Left arm: joints dark, hand in the accent colour."""
    upper = [(0.06, 0.048, 0.050, 0), (0.18, 0.052, 0.055, 0), (0.45, 0.044, 0.050, 0.002), (0.9, 0.034, 0.036, 0)]
    lower = [(0.10, 0.036, 0.038, 0), (0.30, 0.040, 0.042, 0), (0.65, 0.033, 0.032, 0), (0.93, 0.025, 0.024, 0)]
    hand = [(0.10, 0.022, 0.024, 0), (0.35, 0.017, 0.040, 0), (0.60, 0.015, 0.040, 0.002), (0.95, 0.010, 0.028, 0.006)]
    thumb = [(0.22, 0.011, 0.014, 0.030), (0.40, 0.012, 0.012, 0.048), (0.55, 0.010, 0.010, 0.056)]
    at = body.head
    return [
        _rigid(_ball(at("upper_arm.L") - np.array([0.012, 0, 0]), (0.050, 0.052, 0.052)), "shoulder.L"),
        _rigid(_loft(_limb("upper_arm.L", upper), (0.035, 0.02), SHELL), "upper_arm.L"),
        _rigid(_ball(at("forearm.L"), (0.036, 0.037, 0.037)), "forearm.L"),
        _rigid(_loft(_limb("forearm.L", lower), (0.02, 0.012), SHELL), "forearm.L"),
        _rigid(_ball(at("hand.L"), (0.024, 0.024, 0.024)), "hand.L"),
        _rigid(_loft(_limb("hand.L", hand), (0.012, 0.012), LEFT, 2.4), "hand.L"),
        _rigid(_loft(_limb("hand.L", thumb), (0.01, 0.012), LEFT), "hand.L"),
    ]


def _leg() -> list[Part]:
    """Left leg: joints dark, shoe in the accent colour."""
    upper = [(0.03, 0.078, 0.086, -0.004), (0.25, 0.078, 0.088, 0.0), (0.6, 0.064, 0.070, 0.004),
             (0.9, 0.050, 0.052, 0.0)]  # fmt: skip
    lower = [(0.10, 0.047, 0.047, 0.0), (0.30, 0.053, 0.057, -0.012), (0.60, 0.042, 0.045, -0.008),
             (0.90, 0.032, 0.034, 0)]  # fmt: skip
    at = body.head
    return [
        _rigid(_ball(at("thigh.L") + np.array([0.008, 0, 0]), (0.080, 0.086, 0.078)), "thigh.L"),
        _rigid(_loft(_limb("thigh.L", upper), (0.05, 0.03), SHELL), "thigh.L"),
        _rigid(_ball(at("shin.L"), (0.051, 0.052, 0.052)), "shin.L"),
        _rigid(_loft(_limb("shin.L", lower), (0.025, 0.015), SHELL), "shin.L"),
        _rigid(_ball(at("foot.L"), (0.034, 0.036, 0.036)), "foot.L"),
        *_shoe(),
    ]


def _shoe() -> list[Part]:
    """Foot and toe of the left side: flat soles at z = 0, round where they roll."""
    x = body.head("foot.L")[0]
    foot = [(0.075, 0.034, 0.034), (0.030, 0.039, 0.043), (-0.03, 0.042, 0.039), (-0.085, 0.046, 0.031),
            (-0.125, 0.047, body.BALL_HEIGHT)]  # fmt: skip
    toe = [(-0.125, 0.0475, body.BALL_HEIGHT), (-0.16, 0.046, 0.0245), (-0.185, 0.038, 0.022)]
    parts = []
    for bone, rows, caps in (("foot.L", foot, (0.034, 0.026)), ("toe.L", toe, (0.026, 0.024))):
        rings = np.array([[[x, y, tall], wide * _X, tall * _Z] for y, wide, tall in rows])
        parts.append(_rigid(_loft(rings, caps, LEFT, 2.5), bone))
    return parts


def parts() -> list[Part]:
    """All parts of the mannequin."""
    left = _arm() + _leg()
    return _trunk() + left + [part.mirrored() for part in left]
