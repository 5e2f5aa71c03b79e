// The most lights of any cell in each slice of depth: where lights crowd, and where slices are too thick or wasted.

import { figureView } from "./figure.ts";
import * as format from "./format.ts";
import type { Case } from "./model.ts";
import { chart, chartHeight, chartWidth, Plot } from "./plots.ts";
import type { Grid } from "./result.ts";
import { keysOf, lookOf, markOf, type Series, seriesOf } from "./series.ts";
import type { View } from "./view.ts";

interface Slice {
  series: Series;
  near: number; // m
  far: number;
  lights: number; // in the fullest cell of any frame
}

// From and to, m: of depth, of distance grids from the eye. Cascades have as many slices as layers of cells in each level.
function rangeOf(grid: Grid, slice: number): [number, number] {
  if (grid.slices) return [grid.slices.boundaries[slice]!, grid.slices.boundaries[slice + 1]!];
  const layers = grid.cells[2]! / grid.levels!;
  const edge = grid.finest! * 2 ** Math.floor(slice / layers);
  return [(slice % layers) * edge, ((slice % layers) + 1) * edge];
}

// Slices without lights have no bar.
function slicesOf(series: Series): Slice[] {
  return series.values.flatMap((lights, at) => {
    const [near, far] = rangeOf(series.cases[0]!.raw.grid, at);
    return lights > 0 ? [{ series, near, far, lights }] : [];
  });
}

// Depth at a share of the way through a slice, of which `first` is the nearest that is shown.
function within({ near, far }: Slice, first: number, share: number): number {
  const from = Math.max(near, first);
  return from * (far / from) ** share;
}
const metres = (value: number) => `${Number(value.toPrecision(3))}`;
const range = (slice: Slice) => `${metres(slice.near)} to ${metres(slice.far)} m`;

// All cases are on one grid.
export function lightsByDepth(view: View, cases: Case[]): HTMLElement | null {
  const each = seriesOf(view, cases, (aCase) => aCase.raw.occupancy?.longest_by_slice)
    .map(slicesOf)
    .filter((slices) => slices.length > 0);
  const all = each.flat();
  if (all.length === 0) return null;
  const isDistance = cases[0]!.raw.grid.kind === "distance";
  const first = all.reduce((least, { far }) => Math.min(least, far), Infinity) / 2; // where the axis begins
  const last = all.reduce((most, { far }) => Math.max(most, far), 0);
  const drawn = each.map((slices) => slices[0]!.series);
  return figureView({
    id: "lights-by-depth",
    title: "Most lights in a cell over depth",
    lead: "A bar is a slice, as high as the longest list in it over all frames. Slices without lights have no bar. Methods with the same figures share bars.",
    chart: chart(`Most lights in a cell by depth of ${each.map((slices) => slices[0]!.series.label).join("; ")}`, {
      width: chartWidth(),
      height: chartHeight(280),
      marginLeft: 64,
      x: {
        type: "log",
        domain: [first, last],
        label: isDistance ? "distance from the eye, m" : "depth, m",
        ticks: 6,
        tickFormat: metres,
        grid: true,
      },
      y: { zero: true, label: "most lights in a cell", ticks: 5, grid: true },
      marks: [
        Plot.ruleY(all, {
          x1: ({ near }: Slice) => Math.max(near, first),
          x2: "far",
          y: "lights",
          stroke: ({ series }: Slice) => lookOf(view, series).colour,
          strokeWidth: 2.5,
        }),
        Plot.dot(all, {
          x: (slice: Slice) => within(slice, first, (drawn.indexOf(slice.series) + 0.5) / drawn.length),
          y: "lights",
          ...markOf<Slice>(view),
        }),
        Plot.tip(
          all,
          Plot.pointer({
            x: (slice: Slice) => within(slice, first, 0.5),
            y: "lights",
            title: (slice: Slice) =>
              `${slice.series.label}\n${range(slice)}: ${format.plural(slice.lights, "light")} at most`,
          }),
        ),
      ],
    }),
    methods: keysOf(view, drawn),
    hasLines: true,
    table: () => ({
      caption: "Most lights in a cell by depth",
      columns: [
        { label: "method", value: ({ series }) => series.label },
        { label: "from m", value: ({ near }) => near, show: ({ near }) => metres(near) },
        { label: "to m", value: ({ far }) => far, show: ({ far }) => metres(far) },
        { label: "most lights", value: ({ lights }) => lights },
      ],
      rows: all,
    }),
    cases: each.flatMap((slices) => slices[0]!.series.cases),
  });
}
