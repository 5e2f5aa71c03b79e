// The sets of samples that figures of samples are of: those that rank a case (src/result/sample_sets.h), which the
// program names.

import type { Case } from "./model.ts";
import type { CaseResult } from "./result.ts";

function countsOf(raw: CaseResult, set: string) {
  return set === "volume" ? raw.shading : (raw.samples as Record<string, CaseResult["shading"]> | undefined)?.[set];
}

// Of the set that lacks most.
export function countsThatLackMost({ raw, sets }: Case) {
  const counts = sets.map((set) => countsOf(raw, set));
  return counts.sort((a, b) => (b?.unlit ?? -1) - (a?.unlit ?? -1))[0];
}

// Behind a heading: " (opaque)", " (weighted)"; "" where cases differ, or have points of the view alone.
export function headingOfSets(cases: Case[]): string {
  const headings = new Set(
    cases.map(({ raw, sets }) => {
      if (sets.length === 0 || (sets.join() === "volume" && !raw.samples)) return "";
      return sets.length === 1 ? ` (${sets[0]})` : " (weighted)";
    }),
  );
  return headings.size === 1 ? [...headings][0]! : "";
}

// "visible surfaces, fog froxels". `words`: of each set.
export function wordsOfSets(cases: Case[], words: Record<string, string>): string {
  const texts = new Set(cases.map(({ sets }) => sets.map((set) => words[set] ?? set).join(", ")));
  texts.delete("");
  return [...texts].join("; of others ");
}
