// What of a frame is shown and how: kept while frames and cases change.

import { type Counts, shownValue, type What } from "./colours.ts";
import type { Frame, Vec3 } from "./details.ts";
import { cellOf, centreOf, type Geometry, indexOf } from "./geometry.ts";

export type Show = "all" | "slice" | "tile";
export type LightsShown = "cell" | "all" | "none";

export interface Selection {
  frame: number; // index among the frames
  what: What;
  show: Show;
  least: number; // cells with fewer are not drawn
  lights: LightsShown;
  isEven: boolean;
  cell: Vec3; // picked; where there is none, the one with the longest list is
}

export const freshSelection = (): Selection => ({
  frame: 0,
  what: "reported",
  show: "all",
  least: 1,
  lights: "cell",
  isEven: true,
  cell: [-1, -1, -1],
});

export function countsAt(frame: Frame, at: number): Counts {
  return at < 0
    ? { reported: 0, truth: 0, falsePositives: 0, falseNegatives: 0 }
    : {
        reported: frame.reported[at]!,
        truth: frame.truth[at]!,
        falsePositives: frame.falsePositives[at]!,
        falseNegatives: frame.falseNegatives[at]!,
      };
}

export class CellRows {
  private readonly rows: Map<number, number>;
  constructor(readonly frame: Frame) {
    this.rows = new Map([...frame.cells].map((cell, row) => [cell, row]));
  }
  rowOf(geometry: Geometry, x: number, y: number, z: number): number {
    return this.rows.get(indexOf(geometry.size, x, y, z)) ?? -1;
  }
}

// Indices of the frame's rows that are drawn.
export function shownCells(frame: Frame, geometry: Geometry, { what, show, least, cell }: Selection): number[] {
  const all = [...frame.cells.keys()].filter((at) => shownValue(what, countsAt(frame, at)) >= least);
  if (show === "all") return all;
  return all.filter((at) => {
    const [x, y, z] = cellOf(geometry.size, frame.cells[at]!);
    return show === "slice" ? z === cell[2] : x === cell[0] && y === cell[1];
  });
}

export function most(frame: Frame, what: What): number {
  return frame.cells.reduce((highest, _, at) => Math.max(highest, shownValue(what, countsAt(frame, at))), 0);
}

// The cell with the most of what is shown.
export function worstCell(frame: Frame, geometry: Geometry, what: What): Vec3 {
  let best = -1,
    value = 0;
  for (let at = 0; at < frame.cells.length; ++at) {
    const now = shownValue(what, countsAt(frame, at));
    if (now > value) [best, value] = [at, now];
  }
  return best < 0 ? [0, 0, 0] : cellOf(geometry.size, frame.cells[best]!);
}

// A ball around what is drawn.
export function extentOf(frame: Frame, geometry: Geometry): { centre: Vec3; radius: number } {
  const lo: Vec3 = [0, 0, 0],
    hi: Vec3 = [0, 0, 0];
  for (const cell of frame.cells)
    centreOf(geometry, cell).forEach((value, axis) => {
      lo[axis] = Math.min(lo[axis]!, value);
      hi[axis] = Math.max(hi[axis]!, value);
    });
  const centre = lo.map((value, axis) => (value + hi[axis]!) / 2) as Vec3;
  return { centre, radius: Math.max(Math.hypot(...lo.map((value, axis) => (hi[axis]! - value) / 2)), 1e-3) };
}
