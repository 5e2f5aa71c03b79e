// Lines of several methods in one chart. Methods whose figures are the same share a line.

import type { Case } from "./model.ts";
import type { View } from "./view.ts";

export interface Series {
  cases: Case[];
  label: string; // all their names
  values: number[];
}

export function seriesOf(view: View, cases: Case[], values: (one: Case) => number[] | undefined): Series[] {
  const given = cases.flatMap((one) => {
    const found = values(one);
    return found && found.length > 0 ? [{ one, found }] : [];
  });
  const groups = Map.groupBy(given, ({ found }) => found.join(","));
  return [...groups.values()].map((group) => ({
    cases: group.map(({ one }) => one),
    label: group.map(({ one }) => view.named(one)).join(", "),
    values: group[0]!.found,
  }));
}
