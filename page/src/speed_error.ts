// Speed against error, a panel per scene, with intervals and the front of what nothing else beats in both.

import { capitalised, figure, meaningOf } from "./case_figures.ts";
import { choice, type Option } from "./controls.ts";
import { h } from "./dom.ts";
import { figureView } from "./figure.ts";
import * as format from "./format.ts";
import { hasMachines, machineKey } from "./machines.ts";
import type { Case } from "./model.ts";
import { placed, placements } from "./names.ts";
import { chart, chartWidth, mostPanels, multiples, Plot, panelsLeftOut } from "./plots.ts";
import type { FigureName, Maybe } from "./result.ts";
import type { Section, View } from "./view.ts";

interface Measure {
  label: string;
  name: FigureName | null; // in the program's table
  of: (aCase: Case) => Maybe;
  show: (value: Maybe) => string;
  note?: string;
}

const ofFigure = (name: FigureName, show: Measure["show"], note?: string): Measure => ({
  label: name,
  name,
  of: (aCase) => figure(aCase, name),
  show,
  note,
});

export const measures: Record<string, Measure> = {
  overshade: ofFigure("overshade", format.factor, "of the samples that rank; compares across grids"),
  excess: ofFigure("excess", format.percent, "compares within one grid"),
  cost: {
    label: "frame cost µs",
    name: null,
    of: ({ costNs }) => costNs && costNs / 1e3,
    show: format.microseconds,
    note: "frame time, upload and shading, by the configuration's cost model; compares across grids",
  },
  bytes: ofFigure("bytes", format.short),
  unlit: ofFigure("unlit", format.share),
  missed: ofFigure("missed", format.count),
};

const wordsOf = (view: View, { name, note }: Measure): string =>
  [name && meaningOf(view.model.words, name), note].filter(Boolean).join("; ");

interface Point {
  aCase: Case;
  us: number;
  error: number;
}

export function points(cases: Case[], measure: Measure): Point[] {
  return cases.flatMap((aCase) => {
    const error = measure.of(aCase);
    return aCase.frameUs === null || error === null ? [] : [{ aCase, us: aCase.frameUs, error }];
  });
}

// Of the cases that the table marks, fastest first, and of those only the ones with less error than all that are faster.
function front<T extends { us: number; error: number }>(all: T[]): T[] {
  let least = Infinity;
  return [...all]
    .sort((a, b) => a.us - b.us || a.error - b.error)
    .filter(({ error }) => {
      const isLess = error < least;
      if (isLess) least = error;
      return isLess;
    });
}

function tip(view: View, { aCase, us, error }: Point, measure: Measure): string {
  const [low, high] = aCase.interval;
  const range =
    low === null || high === null
      ? " (interval unknown)"
      : ` (${format.microseconds(low)} to ${format.microseconds(high)})`;
  return `${view.named(aCase)}\n${aCase.grid}\n${format.microseconds(us)} µs${range}\n${measure.label} ${measure.show(error)}`;
}

// Of the interval, in µs.
const ends = ({ aCase, us }: Point): [number, number] => [aCase.interval[0] ?? us, aCase.interval[1] ?? us];

interface Scales {
  x: [number, number];
  y: Upwards;
}

// The scale of errors: linear, or logarithmic where outliers would press the others together.
export interface Upwards {
  domain: [number, number];
  base: number | null; // linear: null; of a logarithmic one 0, or what stands for 0 where there is nothing to lose
}

const outlying = 4; // times the least

// With room below for names. Errors that can be 0 are logarithmic from the least that is not, as far as that is known.
export function upwards(values: number[]): Upwards {
  const [low, high] = limits(values);
  const [least] = limits(values.filter((value) => value > 0));
  if (low < 0 || high <= outlying * least) return { domain: extent(values), base: null };
  if (low > 0) return { domain: [low / (high / low) ** 0.1, high * (high / low) ** 0.1], base: 0 };
  const base = Math.max(least, high / 1e4);
  const room = (high / base) ** 0.12;
  return { domain: [base * (1 / room - 1), high * room], base };
}

// How far up an error stands, from 0 to 1.
function heightOf({ domain, base }: Upwards, value: number): number {
  const along = (error: number) => (base === null ? error : base === 0 ? Math.log(error) : Math.log1p(error / base));
  const bend = (error: number) => (error < 0 ? -along(-error) : along(error));
  return (bend(value) - bend(domain[0])) / (bend(domain[1]) - bend(domain[0]));
}

// 1, 2 and 5 times the powers of ten, without what would touch; of a linear scale those that the chart finds.
function ticksOf({ domain, base }: Upwards): number[] | number {
  if (base === null) return 5;
  const [low, high] = [base === 0 ? domain[0] : base, domain[1]];
  const steps = Array.from(
    { length: Math.ceil(Math.log10(high / low)) + 2 },
    (_, at) => 10 ** (Math.floor(Math.log10(low)) + at),
  );
  const fine = high / low < 1e3 ? [1, 2, 5] : [1];
  const ticks = steps.flatMap((step) => fine.map((factor) => factor * step));
  return [...(base > 0 ? [0] : []), ...ticks.filter((tick) => tick >= low && tick <= high)];
}

const margin = { marginTop: 26, marginRight: 16, marginBottom: 40, marginLeft: 60 };

// A text mark for each placement of the front's names.
function names(best: Point[], all: Point[], { x, y }: Scales, width: number, height: number): Plot.Markish[] {
  const room = {
    x: width - margin.marginLeft - margin.marginRight,
    y: height - margin.marginTop - margin.marginBottom,
  };
  const across = (us: number) => (room.x * Math.log(us / x[0])) / Math.log(x[1] / x[0]);
  const at = (point: Point) => ({
    point,
    text: point.aCase.assigner,
    x: across(point.us),
    y: room.y * (1 - heightOf(y, point.error)),
  });
  const bar = (point: Point) => ({ from: across(ends(point)[0]), to: across(ends(point)[1]), y: at(point).y });
  const found = placed(best.map(at), all.map(at), best.map(bar), {
    right: room.x + margin.marginRight,
    bottom: room.y,
  });
  return placements.map((wanted) =>
    Plot.text(
      found.filter(({ placement }) => placement === wanted).map(({ name }) => name.point),
      {
        x: "us",
        y: "error",
        text: (point: Point) => point.aCase.assigner,
        ...wanted,
        fill: "var(--ink)",
        stroke: "var(--panel)",
        strokeWidth: 4,
      },
    ),
  );
}

export function panel(view: View, all: Point[], measure: Measure, scales: Scales, width: number): Element {
  const isTaken = ({ aCase }: Point) => aCase.standing === "taken";
  const best = all.filter(({ aCase }) => aCase.isOnFront).sort((a, b) => Number(isTaken(b)) - Number(isTaken(a))); // named first
  const others = all.filter(({ aCase }) => !aCase.isOnFront);
  const look = (point: Point) => view.palette(point.aCase);
  const height = Math.round(Math.min(420, Math.max(230, width * 0.5)));
  const interval = {
    x1: (point: Point) => ends(point)[0],
    x2: (point: Point) => ends(point)[1],
    y: "error",
    stroke: (point: Point) => look(point).colour,
    strokeOpacity: 0.6,
    strokeWidth: 3,
  };
  return chart(
    `Frame time against ${measure.label} of ${format.plural(all.length, "case")}; on the front: ${best.map(({ aCase }) => aCase.assigner).join(", ")}`,
    {
      width,
      height,
      x: {
        type: "log",
        domain: scales.x,
        label: "frame µs",
        ticks: width < 500 ? 4 : 8,
        tickFormat: (us: number) => (/^[125]/.test(us.toExponential()) ? format.short(us) : ""), // others would touch
        grid: true,
      },
      y: {
        type: scales.y.base === null ? "linear" : scales.y.base === 0 ? "log" : "symlog",
        ...(scales.y.base ? { constant: scales.y.base } : {}),
        domain: scales.y.domain,
        label: measure.label,
        ticks: ticksOf(scales.y),
        tickFormat: (value: number) => measure.show(value),
        grid: true,
      },
      ...margin,
      marks: [
        Plot.line(front(best), { x: "us", y: "error", curve: "step-after", stroke: "var(--front)", strokeWidth: 1.5 }),
        ...names(best, all, scales, width, height),
        Plot.ruleY(best, interval),
        Plot.ruleY(others, { ...Plot.pointer({ ...interval, px: "us", py: "error" }), clip: true }),
        Plot.dot(best, { x: "us", y: "error", r: 8, stroke: "var(--accent)", strokeWidth: 1.2 }),
        Plot.dot(all, {
          x: "us",
          y: "error",
          r: 4.5,
          symbol: (point: Point) => look(point).shape,
          fill: (point: Point) => (look(point).isFilled ? look(point).colour : "var(--panel)"),
          stroke: (point: Point) => look(point).colour,
          strokeWidth: 1.5,
        }),
        Plot.tip(all, Plot.pointer({ x: "us", y: "error", title: (point: Point) => tip(view, point, measure) })),
      ],
    },
  );
}

function limits(values: number[]): [number, number] {
  return [values.reduce((a, b) => Math.min(a, b), Infinity), values.reduce((a, b) => Math.max(a, b), -Infinity)];
}

export function logExtent(values: number[]): [number, number] {
  const [low, high] = limits(values);
  return [low / 1.3, high * 1.8];
}

// With the intervals that are always drawn.
export const timeExtent = (all: Point[]) =>
  logExtent(all.flatMap((point) => (point.aCase.isOnFront ? [point.us, ...ends(point)] : [point.us])));

// With room below for names.
export function extent(values: number[]): [number, number] {
  const [low, high] = limits(values);
  const room = (high - low || Math.abs(high) || 1) * 0.12;
  return [low - room, high + room];
}

export const speedErrorSection: Section = (view, redraw) => {
  const cases = view.cases();
  const options = Object.entries(measures)
    .filter(([, measure]) => points(cases, measure).length > 0)
    .map(([key, { label }]): Option => [key, label]);
  if (options.length === 0) return null;
  const [key, control] = choice(view, redraw, "speed-error-measure", "Error", options);
  const measure = measures[key]!;
  const all = points(cases, measure);
  const extents = new Map(
    [...Map.groupBy(all, ({ aCase }) => machineKey(aCase))].map(([of, some]) => [of, timeExtent(some)]),
  );
  const isOfSeveral = hasMachines(all.map(({ aCase }) => aCase));
  // No front runs across results and machines.
  const scenes = [
    ...Map.groupBy(all, ({ aCase }) =>
      [aCase.scene, view.hasRuns && aCase.run.label, aCase.machine].filter(Boolean).join(" · "),
    ),
  ];
  const width = chartWidth(Math.min(2, scenes.length));
  const scalesOf = (some: Point[]): Scales => ({
    x: extents.get(machineKey(some[0]!.aCase))!, // the same in all panels of a machine
    y: upwards(some.map(({ error }) => error)),
  });
  const panels = scenes.slice(0, mostPanels).map(([title, some]) => ({
    title,
    chart: panel(view, some, measure, scalesOf(some), width),
  }));
  const keys = [...new Map(all.map(({ aCase }) => [aCase.assigner, view.palette(aCase)]))].map(([label, look]) => ({
    label,
    look,
  }));
  return h(
    "section",
    { id: "speed" },
    h("h2", {}, "Speed against error"),
    figureView({
      id: "speed-error",
      title: `Frame time against ${measure.label}`,
      lead: `Down and left is better. ${capitalised(measure.label)}: ${wordsOf(view, measure)}. A ring: on the Pareto front, as * in the ranking. The grey line joins the ringed marks that no other ringed mark beats in both. Bars are 95 % intervals of the median time of ringed marks, hidden where the mark is wider; those of others show at the pointer. Each panel has its own vertical axis, logarithmic where some marks are far from the others.${isOfSeveral ? " Panels of two machines have axes of their own: their times are not compared." : ""}${panelsLeftOut(scenes.length)}`,
      controls: [control],
      chart: multiples(panels),
      methods: keys,
      table: () => ({
        caption: "Speed and error",
        columns: [
          { label: "method", value: ({ aCase }) => aCase.assigner },
          ...(view.hasRuns ? [{ label: "result", value: ({ aCase }: Point) => aCase.run.label }] : []),
          ...(isOfSeveral ? [{ label: "machine", value: ({ aCase }: Point) => aCase.machine || null }] : []),
          { label: "scene", value: ({ aCase }) => aCase.scene },
          { label: "grid", value: ({ aCase }) => aCase.grid },
          { label: "frame µs", value: ({ us }) => us, show: ({ us }) => format.microseconds(us) },
          {
            label: "low",
            about: "Of the 95 % interval",
            value: ({ aCase }) => aCase.interval[0],
            show: ({ aCase }) => format.microseconds(aCase.interval[0]),
          },
          {
            label: "high",
            about: "Of the 95 % interval",
            value: ({ aCase }) => aCase.interval[1],
            show: ({ aCase }) => format.microseconds(aCase.interval[1]),
          },
          { label: measure.label, value: ({ error }) => error, show: ({ error }) => measure.show(error) },
        ],
        rows: all,
        sort: { column: 3 + Number(view.hasRuns) + Number(isOfSeveral), descending: false },
      }),
      cases: all.map(({ aCase }) => aCase),
    }),
  );
};
