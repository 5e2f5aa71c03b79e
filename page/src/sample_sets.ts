// Of which samples a figure is, in the words of the table (src/report/cases/sample_sets.h): the sets that a case is ranked
// by, which are those that cost something; without any, visible surfaces if they are asked for, else the whole view.

import type { CaseResult, Maybe } from "./result.ts";

const words: Record<string, string> = {
  volume: "random points in the view",
  opaque: "visible surfaces",
  transparent: "transparent surfaces",
  fog: "fog froxels",
  mirror: "mirrored points outside of the view",
  anywhere: "random points in the lights' bounds",
};

function countsOf(raw: CaseResult, set: string) {
  return set === "volume" ? raw.shading : (raw.samples as Record<string, CaseResult["shading"]> | undefined)?.[set];
}

export function rankingSets(raw: CaseResult): string[] {
  const paid = Object.keys(raw.cost?.sets ?? {}).filter((set) => countsOf(raw, set));
  if (paid.length > 0) return paid;
  return ["opaque", "volume"].filter((set) => countsOf(raw, set)).slice(0, 1);
}

// Of the set that lacks most.
export function countsThatLackMost(raw: CaseResult) {
  const counts = rankingSets(raw).map((set) => countsOf(raw, set));
  return counts.sort((a, b) => (b?.unlit ?? -1) - (a?.unlit ?? -1))[0];
}

export const unlitAtSets = (raw: CaseResult): Maybe => countsThatLackMost(raw)?.unlit ?? null;

// Lists that leave lights out are short.
export function overshadeAtSets(raw: CaseResult): Maybe {
  if (raw.cost) return raw.cost.lit === false ? null : (raw.cost.overshade ?? null);
  const [set] = rankingSets(raw);
  return set === undefined ? null : (countsOf(raw, set)?.overshade ?? null);
}

// Behind a heading: " (opaque)", " (weighted)"; "" where cases differ, or have points of the view alone.
export function headingOfSets(cases: CaseResult[]): string {
  const headings = new Set(
    cases.map((raw) => {
      const sets = rankingSets(raw);
      if (sets.length === 0 || (sets.join() === "volume" && !raw.samples)) return "";
      return sets.length === 1 ? ` (${sets[0]})` : " (weighted)";
    }),
  );
  return headings.size === 1 ? [...headings][0]! : "";
}

// "visible surfaces, fog froxels".
export function wordsOfSets(cases: CaseResult[]): string {
  const sets = new Set(
    cases.map((raw) =>
      rankingSets(raw)
        .map((set) => words[set] ?? set)
        .join(", "),
    ),
  );
  sets.delete("");
  return [...sets].join("; of others ");
}
