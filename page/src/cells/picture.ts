// What the picture in space shows for a frame and a selection.

import { colourOf, marks, type Rgb } from "./colours.ts";
import type { Frame, Light, Vec3 } from "./details.ts";
import { canBeEven, evenDepth } from "./even_depth.ts";
import { cellOf, type Geometry, indexOf } from "./geometry.ts";
import type { Strokes } from "./gl.ts";
import { type CellRows, countsAt, extentOf, most, type Selection, shownCells } from "./selection.ts";
import type { Picture } from "./space.ts";
import { outlineOf, outlineOfCell, outlineOfView } from "./strokes.ts";

const shrink = 0.72; // of cells, so that those behind can be seen
const mostOutlines = 1500; // of lights

const lamp: Rgb = [230, 170, 30];
const rays: Rgb = [130, 140, 155]; // of the camera's view

type Warp = (point: Vec3) => Vec3;

function warped(positions: number[], warp: Warp): number[] {
  return positions.flatMap((_, at) =>
    at % 3 === 0 ? warp([positions[at]!, positions[at + 1]!, positions[at + 2]!]) : [],
  );
}

// Lights of the picked cell by what they are to it; or all in one colour.
function lightStrokes(
  rows: CellRows,
  geometry: Geometry,
  selection: Selection,
  endless: number,
  warp: Warp,
): Strokes[] {
  const { frame } = rows;
  const dots = (lights: Light[], colour: Rgb, opacity: number): Strokes => ({
    kind: "points",
    positions: lights.flatMap((light) => warp(light.position)),
    colour,
    opacity,
  });
  const outlines = (lights: Light[], colour: Rgb, opacity: number): Strokes => ({
    kind: "lines",
    positions: warped(
      lights.slice(0, mostOutlines).flatMap((light) => outlineOf(light, endless)),
      warp,
    ),
    colour,
    opacity,
  });
  if (selection.lights === "none") return [];
  if (selection.lights === "all") return [outlines(frame.lights, lamp, 0.4), dots(frame.lights, lamp, 1)];
  const row = rows.rowOf(geometry, ...selection.cell);
  const list = row < 0 ? [] : (frame.listOf?.(row) ?? []);
  const ofCell = marks.flatMap(({ colour }, mark) => {
    const lights = list.filter((pair) => pair.mark === mark).map((pair) => pair.light);
    return [outlines(lights, colour, 0.85), dots(lights, colour, 1)].map((strokes) => ({ ...strokes, inFront: true }));
  });
  return [dots(frame.lights, lamp, 0.8), ...ofCell];
}

// Depth at which the view's outline ends: where the grid does, or what is drawn.
function viewDepth(frame: Frame, radius: number): number {
  return Math.min(frame.boundaries.at(-1) ?? 2 * radius, frame.camera.far_m ?? Infinity);
}

export function pictureOf(
  rows: CellRows,
  real: Geometry,
  selection: Selection,
  ink: Rgb,
): Omit<Picture, "onPick"> & { shown: number[] } {
  const { frame } = rows;
  const isEven = selection.isEven && canBeEven(real, frame.boundaries);
  const { geometry, warp } = isEven
    ? evenDepth(real, frame.boundaries)
    : { geometry: real, warp: (point: Vec3) => point };
  const shown = shownCells(frame, real, selection);
  const highest = most(frame, selection.what);
  const blocks = new Float32Array(6 * shown.length),
    colours = new Uint8Array(3 * shown.length);
  shown.forEach((at, instance) => {
    blocks.set(geometry.block(...cellOf(geometry.size, frame.cells[at]!)), 6 * instance);
    colours.set(colourOf(selection.what, countsAt(frame, at), highest), 3 * instance);
  });
  const extent = extentOf(frame, geometry);
  const picked = indexOf(real.size, ...selection.cell);
  const strokes: Strokes[] = [
    {
      kind: "lines",
      positions: warped(outlineOfView(frame, viewDepth(frame, extent.radius)), warp),
      colour: rays,
      opacity: 0.9,
    },
    ...lightStrokes(rows, real, selection, 4 * extent.radius, warp),
  ];
  if (!real.isHole(...selection.cell))
    strokes.push({ kind: "lines", positions: outlineOfCell(geometry, picked), colour: ink, opacity: 1, inFront: true });
  const about = `Cells in space, ${shown.length} of ${frame.cells.length} drawn. Arrow keys turn, with Shift move, plus and minus zoom, Home goes back.`;
  return { cells: { geometry, blocks, colours, shrink }, strokes, extent, about, shown };
}
