// Lines of several methods in one chart. Methods whose figures are the same share a line.

import type { Case } from "./model.ts";
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
