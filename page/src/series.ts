// Lines of several methods in one chart. Methods whose figures are the same share a line.

import type { Key } from "./figure.ts";
import type { Case } from "./model.ts";
import type { Look } from "./palette.ts";
import type { View } from "./view.ts";

export interface Series {
  cases: Case[];
  label: string; // all their names
  values: number[];
}

export function seriesOf(view: View, cases: Case[], values: (aCase: Case) => number[] | undefined): Series[] {
  const given = cases.flatMap((aCase) => {
    const found = values(aCase);
    return found && found.length > 0 ? [{ aCase, found }] : [];
  });
  const groups = Map.groupBy(given, ({ found }) => found.join(","));
  return [...groups.values()].map((group) => ({
    cases: group.map(({ aCase }) => aCase),
    label: group.map(({ aCase }) => view.named(aCase)).join(", "),
    values: group[0]!.found,
  }));
}

export const lookOf = (view: View, series: Series): Look => view.palette(series.cases[0]!);

// The legend of charts of these lines. A line looks like the first of its methods. A method that shares it in some of the
// charts only has a line of its own in the others, or is told in brackets.
export function keysOf(view: View, all: Series[]): Key[] {
  const leading = new Set(all.map((series) => view.named(series.cases[0]!)));
  return [...Map.groupBy(all, (series) => series.cases[0]!).values()].map((lines) => {
    const names = lines.map((series) => new Set(series.cases.map((aCase) => view.named(aCase))));
    const always = [...names[0]!].filter((name) => names.every((some) => some.has(name)));
    const sometimes = new Set(
      names.flatMap((some) => [...some].filter((name) => !always.includes(name) && !leading.has(name))),
    );
    const more = sometimes.size > 0 ? ` (in some charts ${[...sometimes].join(", ")})` : "";
    return { label: always.join(", ") + more, look: lookOf(view, lines[0]!) };
  });
}

// Where a line has its marks, which tell methods apart whose colours are alike: as many as there is room for, none over
// another line's.
const marksPerLine = 5;

export function markedAt<Entry>(all: Series[], series: Series, entries: Entry[]): Entry[] {
  const shift = (all.indexOf(series) + 0.5) / all.length;
  const marks = Math.min(marksPerLine, entries.length);
  const indices = Array.from({ length: marks }, (_, at) => Math.floor(((at + shift) / marks) * entries.length));
  return [...new Set(indices)].map((index) => entries[index]!);
}

// Options of a chart's marks: as the method looks in the ranking.
export const markOf = <Entry extends { series: Series }>(view: View) => ({
  symbol: ({ series }: Entry) => lookOf(view, series).shape,
  fill: ({ series }: Entry) => (lookOf(view, series).isFilled ? lookOf(view, series).colour : "var(--panel)"),
  stroke: ({ series }: Entry) => lookOf(view, series).colour,
  strokeWidth: 1.3,
  r: 3.5,
});
