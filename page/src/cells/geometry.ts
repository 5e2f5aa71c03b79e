// Where cells lie: each is a block lo..hi of three parameters, which its grid's kind turns into points in view space.

import type { CaseResult } from "../result.ts";
import type { Cells, Vec3 } from "./details.ts";

// "slopes": x/depth, y/depth, depth. "shells": x/depth, y/depth, distance. "box": x, y, z of view space or the world.
export type Shape = "slopes" | "shells" | "box";
export type Block = [x0: number, x1: number, y0: number, y1: number, z0: number, z1: number];

export interface Geometry {
  shape: Shape;
  size: Vec3; // cells along each axis
  block: (x: number, y: number, z: number) => Block;
  isHole: (x: number, y: number, z: number) => boolean;
  topDown: boolean; // y counts from the top
  sliceName: (z: number) => string;
  rotation: [Vec3, Vec3, Vec3]; // rows; view = rotation (p - origin), of boxes in the world
  origin: Vec3;
}

interface FullGrid {
  tiles: { pixels?: [number, number] };
  levels: number;
  finest: number;
  origin: Vec3;
  bounds: { min: Vec3; max: Vec3 };
}

const identity: [Vec3, Vec3, Vec3] = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
];
export const metres = (value: number) => `${Number(value.toPrecision(3))}`;
const mix = (a: number, b: number, t: number) => a + (b - a) * t;

function screen(aCase: CaseResult, frame: Cells, grid: FullGrid): Geometry {
  const [columns, rows] = frame.tiles?.count ?? aCase.grid.cells;
  const size: Vec3 = [columns!, rows!, aCase.grid.cells[2]];
  const [left, right, bottom, top] = frame.camera.sides;
  const pixels = frame.tiles ? frame.tiles.pixels : grid.tiles.pixels;
  const across = pixels ? pixels[0]! / aCase.viewport[0] : 1 / size[0];
  const down = pixels ? pixels[1]! / aCase.viewport[1] : 1 / size[1];
  const x = (tile: number) => mix(left, right, Math.min(1, tile * across));
  const y = (tile: number) => mix(top, bottom, Math.min(1, tile * down));
  const z = frame.boundaries;
  const isShells = aCase.grid.kind === "distance";
  return {
    shape: isShells ? "shells" : frame.camera.orthographic ? "box" : "slopes",
    size,
    block: (i, j, k) =>
      frame.camera.orthographic
        ? [x(i), x(i + 1), y(j + 1), y(j), -z[k + 1]!, -z[k]!]
        : [x(i), x(i + 1), y(j + 1), y(j), z[k]!, z[k + 1]!],
    isHole: () => false,
    topDown: true,
    sliceName: (k) => `${metres(z[k]!)} to ${metres(z[k + 1]!)} m ${isShells ? "from the eye" : "deep"}`,
    rotation: identity,
    origin: [0, 0, 0],
  };
}

function cascades(aCase: CaseResult, grid: FullGrid): Geometry {
  const size = aCase.grid.cells;
  const depth = size[2] / grid.levels;
  return {
    shape: "box",
    size,
    block: (x, y, z) => {
      const edge = grid.finest * 2 ** Math.floor(z / depth);
      const left = x - size[0] / 2,
        top = size[1] / 2 - y,
        k = z % depth;
      return [left * edge, (left + 1) * edge, (top - 1) * edge, top * edge, -(k + 1) * edge, -k * edge];
    },
    isHole: (x, y, z) =>
      z >= depth && z % depth < depth / 2 && [x / size[0], y / size[1]].every((share) => share >= 0.25 && share < 0.75),
    topDown: true,
    sliceName: (z) => {
      const level = Math.floor(z / depth),
        edge = grid.finest * 2 ** level;
      return `level ${level}, ${metres((z % depth) * edge)} to ${metres(((z % depth) + 1) * edge)} m deep`;
    },
    rotation: identity,
    origin: [0, 0, 0],
  };
}

function world(aCase: CaseResult, frame: Cells, grid: FullGrid): Geometry {
  const size = aCase.grid.cells,
    { origin, min, max } = frame.box ?? { origin: grid.origin, ...grid.bounds };
  const at = (axis: 0 | 1 | 2, i: number) => mix(min[axis], max[axis], i / size[axis]);
  return {
    shape: "box",
    size,
    block: (x, y, z) => [at(0, x), at(0, x + 1), at(1, y), at(1, y + 1), at(2, z), at(2, z + 1)],
    isHole: () => false,
    topDown: false,
    sliceName: (z) => `world z ${metres(origin[2] + at(2, z))} to ${metres(origin[2] + at(2, z + 1))} m`,
    rotation: frame.camera.view_from_world,
    origin: frame.camera.eye.map((value, axis) => value - origin[axis]!) as Vec3,
  };
}

export function geometryOf(aCase: CaseResult, frame: Cells): Geometry {
  const grid = aCase.grid as unknown as FullGrid;
  if (aCase.grid.kind === "cascades") return cascades(aCase, grid);
  if (aCase.grid.kind === "world") return world(aCase, frame, grid);
  return screen(aCase, frame, grid);
}

export const indexOf = ([nx, ny]: Vec3, x: number, y: number, z: number) => (z * ny + y) * nx + x;
export const cellOf = ([nx, ny]: Vec3, index: number): Vec3 => [
  index % nx,
  Math.floor(index / nx) % ny,
  Math.floor(index / (nx * ny)),
];

// A point of view space from parameters, as the vertex shader makes it.
export function inView(geometry: Geometry, [x, y, z]: Vec3): Vec3 {
  if (geometry.shape === "slopes") return [x * z, y * z, -z];
  if (geometry.shape === "shells") {
    const scale = z / Math.hypot(x, y, 1);
    return [x * scale, y * scale, -scale];
  }
  const local = geometry.origin.map((value, axis) => [x, y, z][axis]! - value) as Vec3;
  return geometry.rotation.map((row) => row[0] * local[0] + row[1] * local[1] + row[2] * local[2]) as Vec3;
}

export function centreOf(geometry: Geometry, index: number): Vec3 {
  const [x0, x1, y0, y1, z0, z1] = geometry.block(...cellOf(geometry.size, index));
  return inView(geometry, [(x0 + x1) / 2, (y0 + y1) / 2, (z0 + z1) / 2]);
}
