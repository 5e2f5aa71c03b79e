// The most lights of any cell in each slice of depth, of all cases that carry details of what is seen from one camera.

import { unpackedCells } from "./cells/details.ts";
import { cellOf, geometryOf } from "./cells/geometry.ts";
import { figureView } from "./figure.ts";
import * as format from "./format.ts";
import type { Case } from "./model.ts";
import { chart, chartWidth, Plot } from "./plots.ts";
import type { View } from "./view.ts";

export interface Slice {
  aCase: Case;
  near: number; // m
  far: number;
  lights: number; // in the fullest cell of any frame that has details
}

// Slices of world grids have no depth of their own.
export function slicesOf(aCase: Case): Slice[] {
  const { raw } = aCase;
  if (raw.grid.kind === "world") return [];
  const slices = new Map<string, Slice>();
  for (const packed of raw.details?.frames ?? []) {
    const frame = unpackedCells(packed, raw.grid);
    const geometry = geometryOf(raw, frame);
    frame.cells.forEach((index, row) => {
      const [, , , , z0, z1] = geometry.block(...cellOf(geometry.size, index));
      const [near, far] = geometry.shape === "box" ? [-z1, -z0] : [z0, z1];
      const slice = slices.get(`${near} ${far}`) ?? { aCase, near, far, lights: 0 };
      slice.lights = Math.max(slice.lights, frame.reported[row]!);
      slices.set(`${near} ${far}`, slice);
    });
  }
  return [...slices.values()].sort((a, b) => a.near - b.near || a.far - b.far);
}

const fullest = (slices: Slice[]) => slices.reduce((most, slice) => (slice.lights > most.lights ? slice : most));
const middle = ({ near, far }: Slice, first: number) => Math.sqrt(Math.max(near, first) * far);
const metres = (value: number) => `${Number(value.toPrecision(3))}`;
const range = (slice: Slice) => `${metres(slice.near)} to ${metres(slice.far)} m`;

// Details are of some frames, and the path's longest list can be in another.
function limitOf(each: Slice[][]): string {
  const { frames, details } = each[0]![0]!.aCase.raw;
  if (details!.frames.length === frames) return "";
  const longer = each.map(fullest).filter(({ aCase, lights }) => (aCase.longest ?? 0) > lights);
  const longest = longer.reduce((most, { aCase }) => Math.max(most, aCase.longest!), 0);
  const more = longer.length > 0 ? `; in others a cell has up to ${format.plural(longest, "light")}` : "";
  return ` Details are of ${details!.frames.length} of ${frames} frames${more}.`;
}

export function lightsByDepth(view: View, cases: Case[]): HTMLElement | null {
  const each = cases.map(slicesOf).filter((slices) => slices.length > 0);
  const all = each.flat();
  if (all.length === 0) return null;
  const first = all.reduce((least, { far }) => Math.min(least, far), Infinity) / 2; // where the axis begins
  const last = all.reduce((most, { far }) => Math.max(most, far), 0);
  const look = ({ aCase }: Slice) => view.palette(aCase);
  const named = ({ aCase }: Slice) => `${view.named(aCase)}, ${aCase.grid}`;
  return figureView({
    id: "lights-by-depth",
    title: "Most lights in a cell over depth",
    lead: `A bar is a slice, as high as its fullest cell in any frame with details; the mark is at the fullest of all. Of distance grids it is the distance from the eye. Slices without lights have no bar.${limitOf(each)}`,
    chart: chart(`Most lights in a cell by depth of ${each.map((slices) => named(slices[0]!)).join("; ")}`, {
      width: chartWidth(),
      height: 280,
      marginLeft: 64,
      x: { type: "log", domain: [first, last], label: "depth, m", ticks: 6, tickFormat: metres, grid: true },
      y: { zero: true, label: "most lights in a cell", ticks: 5, grid: true },
      marks: [
        Plot.ruleY(all, {
          x1: ({ near }: Slice) => Math.max(near, first),
          x2: "far",
          y: "lights",
          stroke: (slice: Slice) => look(slice).colour,
          strokeWidth: 2.5,
        }),
        Plot.dot(each.map(fullest), {
          x: (slice: Slice) => middle(slice, first),
          y: "lights",
          r: 4.5,
          symbol: (slice: Slice) => look(slice).shape,
          fill: (slice: Slice) => (look(slice).isFilled ? look(slice).colour : "var(--panel)"),
          stroke: (slice: Slice) => look(slice).colour,
          strokeWidth: 1.5,
        }),
        Plot.tip(
          all,
          Plot.pointer({
            x: (slice: Slice) => middle(slice, first),
            y: "lights",
            title: (slice: Slice) =>
              `${named(slice)}\n${range(slice)}: ${format.plural(slice.lights, "light")} at most`,
          }),
        ),
      ],
    }),
    table: () => ({
      caption: "Most lights in a cell by depth",
      columns: [
        { label: "method", value: ({ aCase }) => view.named(aCase) },
        { label: "grid", value: ({ aCase }) => aCase.grid },
        { label: "from m", value: ({ near }) => near, show: ({ near }) => metres(near) },
        { label: "to m", value: ({ far }) => far, show: ({ far }) => metres(far) },
        { label: "most lights", value: ({ lights }) => lights },
      ],
      rows: all,
    }),
    cases: each.map((slices) => slices[0]!.aCase),
  });
}
