// How long the lists are: cells by number of lights.

import { figureView } from "./figure.ts";
import * as format from "./format.ts";
import type { Case } from "./model.ts";
import { chart, chartHeight, chartWidth, Plot } from "./plots.ts";
import { keysOf, markedAt, markOf, type Series, seriesOf } from "./series.ts";
import type { View } from "./view.ts";

const mostBins = 80;
const foot = 0.8; // of the logarithmic axis, where no cells are drawn

interface Bin {
  series: Series;
  lights: number; // at least
  cells: number;
}

const histogramOf = (aCase: Case) => aCase.raw.occupancy?.lights_per_cell.histogram;
const perEntry = (series: Series) => histogramOf(series.cases[0]!)!.lights_per_entry;
const lengthOf = (series: Series) => series.values.length * perEntry(series);

// Entries of histograms are powers of two wide, and bins a multiple of the widest.
function binned(all: Series[], width: number): Bin[] {
  return all.flatMap((series) => {
    const entries = width / perEntry(series);
    return Array.from({ length: Math.ceil(series.values.length / entries) }, (_, at) => ({
      series,
      lights: at * width,
      cells: series.values.slice(at * entries, (at + 1) * entries).reduce((total, value) => total + value, 0),
    }));
  });
}

// With an end to the last step of each line.
function ended(all: Series[], bins: Bin[], width: number): Bin[] {
  return all.flatMap((series) => {
    const own = bins.filter((bin) => bin.series === series);
    return [...own, { series, lights: own.length * width, cells: 0 }];
  });
}

export function listLengths(view: View, cases: Case[]): HTMLElement {
  const all = seriesOf(view, cases, (aCase) => histogramOf(aCase)?.cells);
  const longest = all.reduce((most, series) => Math.max(most, lengthOf(series)), 1);
  const widest = all.reduce((most, series) => Math.max(most, perEntry(series)), 1);
  const width = widest * Math.ceil(longest / mostBins / widest);
  const bins = binned(all, width);
  const colour = (series: Series) => view.palette(series.cases[0]!).colour;
  const range = (bin: Bin) => (width === 1 ? `${bin.lights}` : `${bin.lights} to ${bin.lights + width - 1}`);
  return figureView({
    id: "list-lengths",
    title: "List lengths",
    lead: `How many cells have lists of a length, over all frames. The vertical axis is logarithmic; a line at its foot means no cells. Methods with the same lists share a line.${width > 1 ? ` Each step counts ${width} lengths: 0 to ${width - 1}, ${width} to ${2 * width - 1} and so on.` : ""}`,
    chart: chart(`Cells by list length of ${all.map((series) => series.label).join("; ")}`, {
      width: chartWidth(),
      height: chartHeight(280),
      marginLeft: 64,
      x: { label: "lights in the list", domain: [0, longest] },
      y: {
        type: "log",
        label: "cells",
        grid: true,
        ticks: 5,
        tickFormat: format.short,
        domain: [foot, 2 * bins.reduce((most, bin) => Math.max(most, bin.cells), 1)],
      },
      marks: [
        Plot.line(ended(all, bins, width), {
          x: "lights",
          y: ({ cells }: Bin) => cells || foot,
          z: ({ series }: Bin) => series.label,
          curve: "step-after",
          stroke: ({ series }: Bin) => colour(series),
          strokeWidth: 1.6,
        }),
        Plot.dot(
          all.flatMap((series) =>
            markedAt(
              all,
              series,
              bins.filter((bin) => bin.series === series && bin.cells > 0),
            ),
          ),
          { x: "lights", y: "cells", ...markOf<Bin>(view) },
        ),
        Plot.tip(
          bins,
          Plot.pointer({
            x: "lights",
            y: ({ cells }: Bin) => cells || NaN,
            title: (bin: Bin) => `${bin.series.label}\n${range(bin)} lights: ${format.count(bin.cells)} cells`,
          }),
        ),
      ],
    }),
    methods: keysOf(view, all),
    hasLines: true,
    table: () => ({
      caption: "Cells by list length",
      columns: [
        { label: "method", value: (bin) => bin.series.label },
        { label: "lights", value: (bin) => bin.lights, show: range },
        { label: "cells", value: (bin) => bin.cells, show: (bin) => format.count(bin.cells) },
      ],
      rows: bins,
    }),
    cases,
  });
}
