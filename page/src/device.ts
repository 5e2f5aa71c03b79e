// Methods that run on a device (a GPU), and what samples pay there for their lights: by the device's clock, on axes of their
// own, and never ranked beside times of the processor.

import { columnsOf, pairsOf } from "./case_figures.ts";
import { h } from "./dom.ts";
import { figureView } from "./figure.ts";
import * as format from "./format.ts";
import type { Case } from "./model.ts";
import { chart, chartWidth, mostPanels, multiples, Plot, panelsLeftOut } from "./plots.ts";
import type { DeviceTimes, Reading, SetReading, Time, WalkReading } from "./result.ts";
import { ofRuns } from "./runs.ts";
import { logExtent } from "./speed_error.ts";
import type { Column } from "./table.ts";
import type { Section, View } from "./view.ts";

type Timed = { aCase: Case; times: DeviceTimes };
type Read = { aCase: Case; reading: Reading; set: SetReading; walk: WalkReading };

const us = ({ median }: Time) => format.inUs(median);
const timeColumn = (label: string, of: (time: Timed) => Time, about?: string): Column<Timed> => ({
  label,
  ...(about ? { about } : {}),
  value: (row) => us(of(row)),
  show: (row) => format.microseconds(us(of(row))),
});

// Half of the 95 % interval, by the time.
function halfWidth({ median, ci95: [low, high] }: Time): number | null {
  return low === null || high === null || !median ? null : (high - low) / 2 / median;
}

function timedColumns(view: View): Column<Timed>[] {
  const column = columnsOf(view.model.words, ({ aCase }: Timed) => aCase);
  return [
    { label: "method", value: ({ aCase }) => aCase.assigner },
    {
      label: "storage",
      about: "Times are of the device's own lists: another storage is the host's work",
      value: ({ aCase }) => aCase.storage,
    },
    { label: "device", value: ({ times }) => times.device },
    { label: "scene", value: ({ aCase }) => aCase.scene },
    { label: "grid", value: ({ aCase }) => aCase.grid },
    column("device_us", "device µs"),
    {
      label: "±",
      about: "Half of the 95 % interval",
      value: ({ times }) => halfWidth(times.run_ns),
      show: ({ times }) => format.percent(halfWidth(times.run_ns)),
    },
    column("device_floor", "× floor"),
    column("device_warm_us", "warm µs"),
    timeColumn("upload µs", ({ times }) => times.upload_ns),
    timeColumn("readback µs", ({ times }) => times.readback_ns, "No renderer reads lists back"),
    { label: "pairs", value: ({ aCase }) => pairsOf(aCase), show: ({ aCase }) => format.short(pairsOf(aCase)) },
    column("excess", "excess", { format: format.percent }),
    column("missed", "missed", { format: format.count }),
    column("dropped", "dropped", { format: format.count }),
  ];
}

function readColumns(view: View): Column<Read>[] {
  const column = columnsOf(view.model.words, ({ aCase }: Read) => aCase);
  const isFirst = ({ reading, set, walk }: Read) => set.set === reading.set && walk.walk === reading.walk;
  const ofFirst = (more: Column<Read>): Column<Read> => ({
    ...more,
    value: (row) => (isFirst(row) ? more.value(row) : null),
    show: (row) => (isFirst(row) ? more.show!(row) : format.microseconds(null)),
  });
  return [
    { label: "structure", value: ({ aCase }) => `${aCase.assigner} / ${aCase.storage}` },
    { label: "device", value: ({ reading }) => reading.device },
    { label: "scene", value: ({ aCase }) => aCase.scene },
    { label: "grid", value: ({ aCase }) => aCase.grid },
    { label: "samples", value: ({ set }) => set.set },
    { label: "walk", value: ({ walk }) => walk.walk },
    {
      label: "read µs",
      value: ({ walk }) => us(walk.read_ns),
      show: ({ walk }) => format.microseconds(us(walk.read_ns)),
    },
    {
      label: "±",
      about: "Half of the 95 % interval",
      value: ({ walk }) => halfWidth(walk.read_ns),
      show: ({ walk }) => format.percent(halfWidth(walk.read_ns)),
    },
    {
      label: "× exact",
      about: "By the time of reading exact lists in the same storage",
      value: ({ walk }) => walk.exact_ratio ?? null,
      show: ({ walk }) => format.factor(walk.exact_ratio ?? null),
    },
    {
      label: "× nothing",
      about: "By the time of looking up cells and reading no list",
      value: ({ walk }) => walk.nothing_ratio,
      show: ({ walk }) => format.factor(walk.nothing_ratio),
    },
    {
      label: "cold µs",
      value: ({ walk }) => us(walk.cold_ns),
      show: ({ walk }) => format.microseconds(us(walk.cold_ns)),
    },
    { label: "lights", value: ({ set }) => set.lights, show: ({ set }) => format.decimal(set.lights) },
    { label: "reads", value: ({ set }) => set.reads, show: ({ set }) => format.decimal(set.reads) },
    ofFirst(column("device_frame_us", "frame µs")),
    column("missed", "missed", { format: format.count }),
  ];
}

// What a processor's clock measures says nothing of a GPU.
const isSoftware = ({ aCase, times }: Timed) => times.software ?? aCase.run.result.device?.type === "software";
const softwareNote =
  " Software devices compute on the processor: their times are no GPU's, are not sorted, and rank nothing.";

function panel(view: View, rows: Timed[], width: number): Element {
  const points = rows.map(({ aCase, times }) => ({
    aCase,
    us: us(times.run_ns)!,
    low: format.inUs(times.run_ns.ci95[0]) ?? us(times.run_ns)!,
    high: format.inUs(times.run_ns.ci95[1]) ?? us(times.run_ns)!,
    pairs: pairsOf(aCase) ?? 0,
  }));
  type Point = (typeof points)[number];
  const look = ({ aCase }: Point) => view.palette(aCase);
  return chart(`Device time against pairs of ${format.plural(rows.length, "case")}`, {
    width,
    height: Math.round(Math.min(360, Math.max(220, width * 0.45))),
    x: {
      type: "log",
      domain: logExtent(points.map((point) => point.us)),
      label: "device µs",
      grid: true,
      tickFormat: (at: number) => (/^[125]/.test(at.toExponential()) ? format.short(at) : ""),
    },
    y: {
      domain: [0, 1.1 * Math.max(...points.map(({ pairs }) => pairs), 1)],
      label: "pairs",
      tickFormat: format.short,
      grid: true,
      ticks: 5,
    },
    marginTop: 26,
    marginRight: 16,
    marginBottom: 40,
    marginLeft: 60,
    marks: [
      Plot.ruleY(points, {
        x1: "low",
        x2: "high",
        y: "pairs",
        stroke: (point: Point) => look(point).colour,
        strokeOpacity: 0.6,
        strokeWidth: 3,
        clip: true,
      }),
      Plot.dot(points, {
        x: "us",
        y: "pairs",
        r: 4.5,
        symbol: (point: Point) => look(point).shape,
        fill: (point: Point) => (look(point).isFilled ? look(point).colour : "var(--panel)"),
        stroke: (point: Point) => look(point).colour,
        strokeWidth: 1.5,
      }),
      Plot.tip(
        points,
        Plot.pointer({
          x: "us",
          y: "pairs",
          title: ({ aCase, us: at, pairs }: Point) =>
            `${view.named(aCase)}\n${aCase.grid}\n${format.microseconds(at)} µs on the device\n${format.short(pairs)} pairs`,
        }),
      ),
    ],
  });
}

function timedFigure(view: View): HTMLElement | null {
  const rows = view.cases().flatMap((aCase) => (aCase.raw.device ? [{ aCase, times: aCase.raw.device }] : []));
  if (rows.length === 0) return null;
  const drawn = rows.filter(({ times }) => times.run_ns.median !== null);
  const panels = [...Map.groupBy(drawn, ({ aCase, times }) => [aCase.scene, times.device].join(" · "))];
  const width = chartWidth(Math.min(2, panels.length));
  return figureView({
    id: "device-times",
    title: "Methods on a device",
    lead:
      "From uploaded lights to finished lists, by the device's clock; never ranked beside times of the processor. Left is faster; fewer pairs are tighter lists, within one grid. Bars are 95 % intervals." +
      (rows.some(isSoftware) ? softwareNote : "") +
      panelsLeftOut(panels.length),
    ...(panels.length > 0
      ? {
          chart: multiples(
            panels.slice(0, mostPanels).map(([title, some]) => ({ title, chart: panel(view, some, width) })),
          ),
        }
      : {}),
    methods: [...new Map(rows.map(({ aCase }) => [aCase.assigner, view.palette(aCase)]))].map(([label, look]) => ({
      label,
      look,
    })),
    table: () => ({
      caption: "Methods on a device",
      columns: ofRuns(view, timedColumns(view)),
      rows,
      ...(rows.some(isSoftware) ? {} : { sort: { column: 5 + Number(view.hasRuns), descending: false } }),
    }),
    cases: rows.map(({ aCase }) => aCase),
  });
}

function readFigure(view: View): HTMLElement | null {
  const rows = view
    .cases()
    .flatMap((aCase) =>
      (aCase.raw.reading?.sets ?? []).flatMap((set) =>
        set.walks.map((walk): Read => ({ aCase, reading: aCase.raw.reading!, set, walk })),
      ),
    );
  if (rows.length === 0) return null;
  const hasSoftware = rows.some(({ reading }) => reading.software);
  return figureView({
    id: "readings",
    title: "What samples pay on a device",
    lead:
      "Samples look up their cell, walk its lights and add a small attenuation for each, by the device's clock. Lists that lack lights are read fast because they are short: see what is missed." +
      (hasSoftware ? softwareNote : ""),
    table: () => ({
      caption: "What samples pay on a device",
      columns: ofRuns(view, readColumns(view)),
      rows,
      ...(hasSoftware ? {} : { sort: { column: 6 + Number(view.hasRuns), descending: false } }),
    }),
    cases: [...new Set(rows.map(({ aCase }) => aCase))],
  });
}

export const deviceSection: Section = (view) => {
  const figures = [timedFigure(view), readFigure(view)];
  return figures.some(Boolean) ? h("section", { id: "device" }, h("h2", {}, "On a device"), ...figures) : null;
};
