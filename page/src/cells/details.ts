// The details of a case (see `clusterbench schema result`) and one of its frames, unpacked.

import type { CaseResult, Details } from "../result.ts";
import { ascending, numbers } from "./numbers.ts";

export type Vec3 = [number, number, number];

export type { Details };
export type DetailsFrame = Details["frames"][number];
export type Camera = DetailsFrame["camera"];

export interface Light {
  name: string;
  position: Vec3; // view space
  range: number;
  spot: { axis: Vec3; halfAngle: number } | null;
}

export type Mark = 0 | 1 | 2; // reported and true, false positive, false negative

export interface Frame {
  camera: Camera;
  boundaries: number[]; // of slices; empty for grids without
  tiles: DetailsFrame["tiles"]; // of a grid that reacts; else the case's hold
  box: DetailsFrame["box"]; // of a world grid that follows something; else the case's holds
  cells: Float64Array; // indices, ascending; the rows below stand beside them
  reported: Float64Array;
  truth: Float64Array;
  falsePositives: Float64Array;
  falseNegatives: Float64Array;
  lights: Light[];
  listOf: ((row: number) => { light: Light; mark: Mark }[]) | null; // of a cell by its index in `cells`
}

function lightsOf(packed: DetailsFrame["lights"]): Light[] {
  const positions = numbers(packed.positions),
    ranges = numbers(packed.ranges);
  const axes = numbers(packed.spot_axes),
    angles = numbers(packed.spot_half_angles);
  const triple = (row: Float64Array, at: number): Vec3 => [row[3 * at]!, row[3 * at + 1]!, row[3 * at + 2]!];
  const firstBox = packed.names.length - (packed.boxes ?? 0);
  const firstSpot = firstBox - packed.spots;
  return packed.names.map((name, at) => ({
    name,
    position: triple(positions, at),
    range: ranges[at]!,
    spot:
      at < firstSpot || at >= firstBox
        ? null
        : { axis: triple(axes, at - firstSpot), halfAngle: angles[at - firstSpot]! },
  }));
}

function listsOf(packed: DetailsFrame, frame: Omit<Frame, "listOf">): Frame["listOf"] {
  if (!packed.pairs) return null;
  const gaps = numbers(packed.pairs.lights),
    marks = numbers(packed.pairs.marks);
  const begins = ascending(frame.reported.map((count, at) => count + frame.falseNegatives[at]!));
  const byIndex = new Map(
    [...ascending(numbers(packed.lights.indices))].map((index, at) => [index, frame.lights[at]!]),
  );
  return (row) => {
    const begin = row === 0 ? 0 : begins[row - 1]!,
      end = begins[row]!;
    return [...ascending(gaps.slice(begin, end))].map((index, at) => ({
      light: byIndex.get(index)!,
      mark: marks[begin + at] as Mark,
    }));
  };
}

export type Cells = Omit<Frame, "lights" | "listOf">;

export function unpackedCells(packed: DetailsFrame, grid: CaseResult["grid"]): Cells {
  const { cells } = packed;
  return {
    camera: packed.camera,
    boundaries: packed.boundaries
      ? [...numbers(packed.boundaries)]
      : ((grid as { slices?: { boundaries: number[] } }).slices?.boundaries ?? []),
    tiles: packed.tiles,
    box: packed.box,
    cells: ascending(numbers(cells.indices)),
    reported: numbers(cells.reported),
    truth: numbers(cells.true),
    falsePositives: numbers(cells.false_positives),
    falseNegatives: numbers(cells.false_negatives),
  };
}

export function unpacked(packed: DetailsFrame, grid: CaseResult["grid"]): Frame {
  const frame = { ...unpackedCells(packed, grid), lights: lightsOf(packed.lights) };
  return { ...frame, listOf: listsOf(packed, frame) };
}

// What is asked for and not here, in words; "" if nothing is.
export function leftOut({ left_out, max_bytes }: Details): string {
  const list = (label: string, frames: number[], why: string) =>
    frames.length ? `${label} ${frames.join(", ")} ${why}.` : "";
  return [
    list("Frames", left_out.frames, `are left out: max_bytes ${max_bytes} has no room for them`),
    list("Lists of frames", left_out.pairs, `are left out: max_bytes ${max_bytes} has no room for them`),
    list("Frames", left_out.not_on_path, "are not on the path"),
  ]
    .filter(Boolean)
    .join(" ");
}
