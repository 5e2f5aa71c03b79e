// Tiling × slicing, a map per method: which cut is cheap, which is tight.

import { figure, pairsOf } from "./case_figures.ts";
import { choice } from "./controls.ts";
import { h } from "./dom.ts";
import { figureView } from "./figure.ts";
import * as format from "./format.ts";
import { hasMachines, machineKey } from "./machines.ts";
import type { Case } from "./model.ts";
import { meanOf } from "./overall.ts";
import { chart, columnWidth, multiples, Plot } from "./plots.ts";
import type { Grid, Maybe } from "./result.ts";
import type { Section } from "./view.ts";

export interface Measure {
  label: string;
  of: (aCase: Case) => Maybe;
  show: (value: Maybe) => string;
  isShare?: boolean; // can be 0
  isOfMachine?: boolean; // never compared, nor averaged, between two
}

export const measures: Record<string, Measure> = {
  time: { label: "frame µs", of: (aCase) => aCase.frameUs, show: format.microseconds, isOfMachine: true },
  instructions: {
    label: "instructions",
    of: (aCase) => figure(aCase, "assign_instructions"),
    show: format.short,
    isOfMachine: true,
  },
  overshade: { label: "overshade", of: (aCase) => figure(aCase, "overshade"), show: format.factor },
  excess: { label: "excess", of: (aCase) => figure(aCase, "excess"), show: format.percent, isShare: true },
  bytes: { label: "bytes", of: (aCase) => figure(aCase, "bytes"), show: format.short },
  longest: { label: "longest list", of: (aCase) => figure(aCase, "longest"), show: format.count },
  pairs: { label: "pairs", of: pairsOf, show: format.short },
};

export interface Cell {
  method: string; // with its result, its machine where the measure is of one, the grid's kind and the storage, where there are several
  tiling: string;
  slicing: string;
  machine: string; // whose colours it has; "" where all maps share them
  value: number; // geometric mean over the scenes
  scenes: number;
}

// A grid is named "frustum 64px x 16 exponential 0.1..500": kind, tiling, slicing. Other kinds have neither.
const cut = (grid: Grid) => /^(?:frustum|distance) (\S+) x (.+)$/.exec(grid.name);

const unique = (values: string[]) => [...new Set(values)];

export function cellsOf(cases: Case[], measure: Measure): Cell[] {
  const hasKinds = unique(cases.filter((aCase) => cut(aCase.raw.grid)).map((aCase) => aCase.raw.grid.kind)).length > 1;
  const hasStorages = unique(cases.map((aCase) => aCase.storage)).length > 1;
  const hasRuns = unique(cases.map((aCase) => aCase.run.label)).length > 1;
  const methodOf = (aCase: Case) =>
    [
      aCase.assigner,
      ...(hasRuns ? [aCase.run.label] : []),
      ...(measure.isOfMachine && aCase.machine ? [aCase.machine] : []),
      ...(hasKinds ? [aCase.raw.grid.kind] : []),
      ...(hasStorages ? [aCase.storage] : []),
    ].join(" / ");
  const placed = cases.flatMap((aCase) => {
    const [, tiling, slicing] = cut(aCase.raw.grid) ?? [];
    const value = measure.of(aCase);
    return tiling === undefined || slicing === undefined || value === null ? [] : [{ aCase, tiling, slicing, value }];
  });
  const groups = Map.groupBy(placed, ({ aCase, tiling, slicing }) => [methodOf(aCase), tiling, slicing].join("\n"));
  return [...groups.values()].map((group) => ({
    method: methodOf(group[0]!.aCase),
    tiling: group[0]!.tiling,
    slicing: group[0]!.slicing,
    machine: measure.isOfMachine ? machineKey(group[0]!.aCase) : "",
    ...mean(
      group.map(({ aCase }) => aCase),
      measure,
    ),
  }));
}

// As over all: geometric, each scene counted once. A share that can be 0 is averaged as what is reported by what is true.
function mean(cases: Case[], measure: Measure): { value: number; scenes: number } {
  const plus = measure.isShare ? 1 : 0;
  const { value, scenes } = meanOf(cases, (aCase) => {
    const figure = measure.of(aCase);
    return figure === null || figure + plus <= 0 ? null : figure + plus;
  });
  return { value: value === null ? 0 : value - plus, scenes };
}

// Of "rgb(0, 32, 81)", up to 255.
function luminance(colour: string): number {
  const [red, green, blue] = (colour.match(/[\d.]+/g) ?? []).map(Number);
  return 0.2126 * (red ?? 0) + 0.7152 * (green ?? 0) + 0.0722 * (blue ?? 0);
}

function map(cells: Cell[], measure: Measure, range: [number, number]): Element {
  const color = Plot.scale({ color: { type: "log", scheme: "cividis", domain: range } })!;
  const paint = (cell: Cell) => color.apply(Math.max(cell.value, range[0])) as string;
  const [tilings, slicings] = [unique(cells.map((cell) => cell.tiling)), unique(cells.map((cell) => cell.slicing))];
  const names = 12 + 6.5 * slicings.reduce((most, name) => Math.max(most, name.length), 0);
  return chart(
    `${measure.label} of ${cells.length} combinations of tiling and slicing, the same colours from ${measure.show(range[0])} to ${measure.show(range[1])}`,
    {
      width: names + columnWidth(cells.map((cell) => measure.show(cell.value))) * tilings.length + 8,
      height: 52 + 28 * slicings.length,
      marginLeft: names,
      marginRight: 8,
      marginTop: 48,
      marginBottom: 4,
      x: { domain: tilings, axis: "top", label: "tiling", labelArrow: "none", tickSize: 0 },
      y: { domain: slicings, label: "slicing", labelAnchor: "top", labelArrow: "none", tickSize: 0 },
      marks: [
        Plot.cell(cells, {
          x: "tiling",
          y: "slicing",
          fill: paint,
          inset: 0.5,
          rx: 2,
          title: (cell: Cell) => `${cell.tiling}, ${cell.slicing}: ${measure.show(cell.value)}`,
        }),
        Plot.text(cells, {
          x: "tiling",
          y: "slicing",
          text: (cell: Cell) => measure.show(cell.value),
          fill: (cell: Cell) => (luminance(paint(cell)) > 120 ? "#000" : "#fff"),
        }),
      ],
    },
  );
}

function isHalfFilled(cells: Cell[]): boolean {
  const [tilings, slicings] = [unique(cells.map((cell) => cell.tiling)), unique(cells.map((cell) => cell.slicing))];
  return 2 * cells.length >= tilings.length * slicings.length;
}

// From the least that is not 0 to the most, of the maps that have the same colours: all, or those of a machine.
export function rangesOf(cells: Cell[]): Map<string, [number, number]> {
  const positive = Map.groupBy(
    cells.filter((cell) => cell.value > 0),
    (cell) => cell.machine,
  );
  return new Map(
    [...positive].map(([machine, some]) => [
      machine,
      [
        some.reduce((least, { value }) => Math.min(least, value), Infinity),
        some.reduce((most, { value }) => Math.max(most, value), 0),
      ],
    ]),
  );
}

function coloursText(cells: Cell[], cases: Case[], measure: Measure): string {
  const colours =
    measure.isOfMachine && hasMachines(cases)
      ? "The same colours in all maps of one machine; two machines have colours of their own, since their figures are not compared."
      : "The same colours in all maps.";
  const isUneven = unique(cells.map(({ scenes }) => String(scenes))).length > 1;
  return `${colours}${isUneven ? " Some are means of fewer scenes than others: the table says of how many." : ""}`;
}

export const heatMapSection: Section = (view, redraw) => {
  const cases = view.cases();
  const offered = Object.entries(measures).filter(([, measure]) => cellsOf(cases, measure).length > 0);
  if (offered.length === 0) return null;
  const [key, control] = choice(
    view,
    redraw,
    "heat-map-measure",
    "Colour",
    offered.map(([name, { label }]) => [name, label]),
  );
  const measure = measures[key]!;
  const cells = cellsOf(cases, measure);
  const ranges = rangesOf(cells);
  const all = [...Map.groupBy(cells, (cell) => cell.method)];
  const maps = all.filter(([, some]) => some.length > 1 && isHalfFilled(some) && ranges.has(some[0]!.machine));
  const leftOut = all.length - maps.length;
  if (maps.length === 0) return null; // no sweep of tilings and slicings: the ranking has all
  return h(
    "section",
    { id: "grids" },
    h("h2", {}, "Tiles × slices"),
    figureView({
      id: "heat-map",
      title: `${measure.label} by tiling and slicing`,
      lead: `One map per method${view.filters.scene === null ? ", the geometric mean of all scenes" : ""}. Dark is less. ${coloursText(cells, cases, measure)}${leftOut > 0 ? ` ${format.plural(leftOut, "map")} of one cell or less than half filled ${leftOut === 1 ? "is" : "are"} left out; the table has all.` : ""}`,
      controls: [control],
      chart: multiples(
        maps.map(([title, some]) => ({ title, chart: map(some, measure, ranges.get(some[0]!.machine)!) })),
      ),
      table: () => ({
        caption: `${measure.label} by method, tiling and slicing`,
        columns: [
          { label: "method", value: (cell) => cell.method },
          { label: "tiling", value: (cell) => cell.tiling },
          { label: "slicing", value: (cell) => cell.slicing },
          { label: measure.label, value: (cell) => cell.value, show: (cell) => measure.show(cell.value) },
          { label: "scenes", value: (cell) => cell.scenes },
        ],
        rows: cells,
      }),
      cases,
    }),
  );
};
