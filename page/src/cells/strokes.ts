// Outlines of lights, cells and the camera, as lines in view space.

import type { Frame, Light, Vec3 } from "./details.ts";
import { cellOf, type Geometry, inView } from "./geometry.ts";

const segments = 64;
const plus = (a: Vec3, b: Vec3, scale: number): Vec3 => [a[0] + b[0] * scale, a[1] + b[1] * scale, a[2] + b[2] * scale];
const cross = (a: Vec3, b: Vec3): Vec3 => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const unit = (a: Vec3): Vec3 => plus([0, 0, 0], a, 1 / Math.hypot(...a));

function path(points: Vec3[]): number[] {
  return points.slice(1).flatMap((point, at) => [...points[at]!, ...point]);
}

// Around a centre in the plane of two unit vectors, from one angle to another.
function arc(centre: Vec3, a: Vec3, b: Vec3, radius: number, from = 0, to = 2 * Math.PI): number[] {
  const at = (step: number) => from + ((to - from) * step) / segments;
  return path(
    Array.from({ length: segments + 1 }, (_, step) =>
      plus(plus(centre, a, radius * Math.cos(at(step))), b, radius * Math.sin(at(step))),
    ),
  );
}

// A straight line in steps, because a warped depth bends it.
const straight = (a: Vec3, b: Vec3) => path(Array.from({ length: 9 }, (_, step) => plus(a, plus(b, a, -1), step / 8)));

// A ball by three circles; a spot by its rim, four lines to it, and two arcs over its cap.
export function outlineOf(light: Light, endless: number): number[] {
  const { position, spot } = light,
    range = Math.min(light.range, endless);
  if (!spot) {
    const axes: Vec3[] = [
      [1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
    ];
    return [0, 1, 2].flatMap((at) => arc(position, axes[at]!, axes[(at + 1) % 3]!, range));
  }
  const { axis, halfAngle } = spot;
  const side = unit(cross(axis, Math.abs(axis[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0])),
    other = cross(axis, side);
  const rim = plus(position, axis, range * Math.cos(halfAngle)),
    radius = range * Math.sin(halfAngle);
  const spokes = [
    plus(rim, side, radius),
    plus(rim, side, -radius),
    plus(rim, other, radius),
    plus(rim, other, -radius),
  ];
  return [
    ...arc(rim, side, other, radius),
    ...arc(position, axis, side, range, -halfAngle, halfAngle),
    ...arc(position, axis, other, range, -halfAngle, halfAngle),
    ...spokes.flatMap((spoke) => straight(position, spoke)),
  ];
}

const edges = [
  [0, 1],
  [2, 3],
  [4, 5],
  [6, 7],
  [0, 2],
  [1, 3],
  [4, 6],
  [5, 7],
  [0, 4],
  [1, 5],
  [2, 6],
  [3, 7],
] as const;

export function outlineOfCell(geometry: Geometry, index: number): number[] {
  const block = geometry.block(...cellOf(geometry.size, index));
  const corner = (at: number) => inView(geometry, [block[at & 1]!, block[2 + ((at >> 1) & 1)]!, block[4 + (at >> 2)]!]);
  return edges.flatMap(([a, b]) => [...corner(a), ...corner(b)]);
}

// The camera's view from the eye to a depth.
export function outlineOfView({ camera }: Frame, depth: number): number[] {
  const [left, right, bottom, top] = camera.sides;
  const corners: [number, number][] = [
    [left, bottom],
    [right, bottom],
    [right, top],
    [left, top],
  ];
  const at = ([x, y]: [number, number], z: number): Vec3 => (camera.orthographic ? [x, y, -z] : [x * z, y * z, -z]);
  const rays = corners.flatMap((corner) => straight(at(corner, 0), at(corner, depth)));
  const end = corners.flatMap((corner, side) => straight(at(corner, depth), at(corners[(side + 1) % 4]!, depth)));
  return [...rays, ...end];
}
