// Pairs, longest lists and bytes along the camera path, with what is to be allocated.

import { columnsOf, figure } from "./case_figures.ts";
import { h } from "./dom.ts";
import { figureView } from "./figure.ts";
import * as format from "./format.ts";
import type { Case } from "./model.ts";
import { chart, chartHeight, chartWidth, Plot } from "./plots.ts";
import type { Maybe } from "./result.ts";
import { keysOf, markedAt, markOf, type Series, seriesOf } from "./series.ts";
import type { View } from "./view.ts";

interface Along {
  title: string;
  values: (aCase: Case) => number[] | undefined;
  show: (value: Maybe) => string;
  allocation?: (aCase: Case) => number;
}

const alongs: Along[] = [
  { title: "pairs", values: (aCase) => aCase.raw.occupancy?.along_path?.pairs, show: format.short },
  { title: "longest list", values: (aCase) => aCase.raw.occupancy?.along_path?.longest_list, show: format.count },
  {
    title: "bytes",
    values: (aCase) => aCase.raw.buffers.along_path?.bytes,
    show: format.short,
    allocation: (aCase) => figure(aCase, "bytes_recommended")!,
  },
];

interface Step {
  series: Series;
  frame: number;
  value: number;
}

function steps(all: Series[], framesPerEntry: number): Step[] {
  return all.flatMap((series) => series.values.map((value, at) => ({ series, frame: at * framesPerEntry, value })));
}

function lines(view: View, along: Along, all: Series[], framesPerEntry: number): Element {
  const colour = (series: Series) => view.palette(series.cases[0]!).colour;
  const data = steps(all, framesPerEntry);
  const allocations = along.allocation
    ? all.map((series) => ({ series, value: along.allocation!(series.cases[0]!) }))
    : [];
  const marks = all.flatMap((series) =>
    markedAt(
      all,
      series,
      data.filter((step) => step.series === series),
    ),
  );
  return chart(`${along.title} frame by frame of ${all.map((series) => series.label).join("; ")}`, {
    width: chartWidth(3),
    height: chartHeight(240),
    marginLeft: 64,
    marginRight: 20,
    x: { label: "frame", ticks: 6, tickFormat: (frame: number) => (Number.isInteger(frame) ? String(frame) : "") },
    y: { zero: true, grid: true, label: along.title, ticks: 5, tickFormat: along.show },
    marks: [
      Plot.ruleY(allocations, {
        y: "value",
        stroke: ({ series }) => colour(series),
        strokeDasharray: "6 4",
        strokeWidth: 1.5,
        title: ({ series, value }) => `allocate ${along.show(value)} for ${series.label}`,
      }),
      Plot.line(data, {
        x: "frame",
        y: "value",
        z: ({ series }: Step) => series.label,
        stroke: ({ series }: Step) => colour(series),
        strokeWidth: 1.8,
      }),
      Plot.dot(marks, { x: "frame", y: "value", ...markOf<Step>(view) }),
      Plot.tip(
        data,
        Plot.pointer({
          x: "frame",
          y: "value",
          title: ({ series, frame, value }: Step) => `${series.label}\nframe ${frame}: ${along.show(value)}`,
        }),
      ),
    ],
  });
}

export function cameraPath(view: View, cases: Case[]): HTMLElement {
  const shown = cases.filter((aCase) => aCase.raw.occupancy?.along_path && aCase.raw.buffers.along_path);
  if (shown.length === 0)
    return h(
      "p",
      { class: "note" },
      "These cases have no lists frame by frame: an earlier version measured them (run it again), or their methods leave structures without cells.",
    );
  const framesPerEntry = shown[0]!.raw.occupancy!.along_path!.frames_per_entry;
  const column = columnsOf(view.model.words, ({ aCase }: { aCase: Case }) => aCase);
  const drawn = alongs.map((along) => ({ along, all: seriesOf(view, shown, along.values) }));
  return figureView({
    id: "camera-path",
    title: "Along the camera path",
    lead: `Dashed: what to allocate, the high-water mark with its margin. Methods with the same figures share a line.${framesPerEntry > 1 ? ` Each point is the largest of ${framesPerEntry} frames.` : ""}`,
    chart: h(
      "div",
      { class: "multiples" },
      ...drawn.map(({ along, all }) => h("div", {}, h("h4", {}, along.title), lines(view, along, all, framesPerEntry))),
    ),
    methods: keysOf(
      view,
      drawn.flatMap(({ all }) => all),
    ),
    hasLines: true,
    table: () => ({
      caption: "Pairs, longest list and bytes frame by frame",
      columns: [
        { label: "method", value: (row) => view.named(row.aCase) },
        { label: "frame", value: (row) => row.frame },
        { label: "pairs", value: (row) => row.pairs, show: (row) => format.count(row.pairs) },
        { label: "longest list", value: (row) => row.longest },
        { label: "bytes", value: (row) => row.bytes, show: (row) => format.count(row.bytes) },
        column("bytes_recommended", "allocate", { format: format.count }),
      ],
      rows: shown.flatMap((aCase) => {
        const { pairs, longest_list } = aCase.raw.occupancy!.along_path!;
        const { bytes } = aCase.raw.buffers.along_path!;
        return pairs.map((value, at) => ({
          aCase,
          frame: at * framesPerEntry,
          pairs: value,
          longest: longest_list[at]!,
          bytes: bytes[at]!,
        }));
      }),
    }),
    cases: shown,
  });
}
