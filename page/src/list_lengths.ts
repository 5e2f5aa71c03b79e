// How long the lists are: cells by number of lights.

import { figureView } from "./figure.ts";
import * as format from "./format.ts";
import type { Case } from "./model.ts";
import { Plot, chart, chartWidth } from "./plots.ts";
import { seriesOf, type Series } from "./series.ts";
import type { View } from "./view.ts";

const mostBins = 80;

interface Bin {
  series: Series;
  lights: number; // at least
  cells: number;
}

function binned(all: Series[], width: number): Bin[] {
  return all.flatMap((series) =>
    Array.from({ length: Math.ceil(series.values.length / width) }, (_, at) => ({
      series,
      lights: at * width,
      cells: series.values.slice(at * width, (at + 1) * width).reduce((total, value) => total + value, 0),
    })),
  );
}

export function listLengths(view: View, cases: Case[]): HTMLElement {
  const all = seriesOf(cases, (one) => one.raw.occupancy?.lights_per_cluster.histogram);
  const longest = all.reduce((most, series) => Math.max(most, series.values.length), 1);
  const width = Math.ceil(longest / mostBins);
  const bins = binned(all, width);
  const colour = (series: Series) => view.palette(series.cases[0]!).colour;
  const range = (bin: Bin) => (width === 1 ? `${bin.lights}` : `${bin.lights} to ${bin.lights + width - 1}`);
  return figureView({
    id: "list-lengths",
    title: "List lengths",
    lead: `Cells by the number of lights in their lists, over all frames; logarithmic upwards. Methods with the same lists share a line.${width > 1 ? ` ${width} lengths to a step.` : ""}`,
    chart: chart(`Cells by list length of ${all.map((series) => series.label).join("; ")}`, {
      width: chartWidth(),
      height: 280,
      marginLeft: 64,
      x: { label: "lights in the list", domain: [0, longest] },
      y: { type: "log", label: "cells", grid: true, ticks: 5, tickFormat: format.short, domain: [0.8, 2 * bins.reduce((most, bin) => Math.max(most, bin.cells), 1)] },
      marks: [
        Plot.line(bins, { x: "lights", y: ({ cells }: Bin) => cells || NaN, z: ({ series }: Bin) => series.label, curve: "step-after", stroke: ({ series }: Bin) => colour(series), strokeWidth: 1.6 }),
        Plot.dot(all.map((series) => ({ series, lights: series.values.length - 1, cells: bins.filter((bin) => bin.series === series).at(-1)!.cells || 1 })), { x: "lights", y: "cells", symbol: ({ series }: Pick<Bin, "series">) => view.palette(series.cases[0]!).shape, fill: ({ series }: Pick<Bin, "series">) => colour(series), r: 4 }),
        Plot.tip(bins, Plot.pointer({ x: "lights", y: ({ cells }: Bin) => cells || NaN, title: (bin: Bin) => `${bin.series.label}\n${range(bin)} lights: ${format.count(bin.cells)} cells` })),
      ],
    }),
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
