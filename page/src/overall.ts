// The ranking over all scenes: each method on each grid, with its time against the best of every scene.

import type { Case } from "./model.ts";
import type { Maybe } from "./result.ts";

export interface Standing {
  assigner: string;
  family: string;
  isFast: boolean;
  grid: string;
  storage: string;
  run: string;
  cases: Case[];
  timeByBest: Maybe; // geometric mean over its cases; below 1 where it is faster than all that lose nothing
  worstTimeByBest: Maybe;
  excess: Maybe; // over the pairs of all cases together
  missed: Maybe;
  dropped: number;
  unlit: Maybe; // largest of a case
  overshade: Maybe; // over the samples of all cases together
  longest: Maybe;
  bytes: number;
  fronts: number; // cases that are on their scene's front
}

// Cases that see the same, whatever cells they use.
const seenBy = (one: Case) => [one.run.label, one.scene, one.raw.camera, one.raw.viewport.join("x"), one.storage].join("\n");

// Of those that lose nothing, where there are any.
function bestTimes(cases: Case[]): Map<string, number> {
  const best = new Map<string, number>();
  const whole = new Set(cases.filter((one) => !one.isOut).map(seenBy));
  for (const one of cases)
    if (one.frameNs !== null && (!one.isOut || !whole.has(seenBy(one)))) best.set(seenBy(one), Math.min(best.get(seenBy(one)) ?? Infinity, one.frameNs));
  return best;
}

const known = (values: Maybe[]) => values.filter((value): value is number => value !== null);
const most = (values: Maybe[]): Maybe => (known(values).length ? Math.max(...known(values)) : null);
const sum = (values: number[]) => values.reduce((total, value) => total + value, 0);
const ratio = (part: number, whole: number): Maybe => (whole > 0 ? part / whole : null);

function standing(cases: Case[], best: Map<string, number>): Standing {
  const ratios = known(cases.map((one) => one.frameNs && one.frameNs / best.get(seenBy(one))!));
  const errors = cases.flatMap((one) => one.raw.error ?? []);
  const shadings = cases.flatMap((one) => (one.raw.shading?.overshade == null ? [] : one.raw.shading));
  const first = cases[0]!;
  return {
    assigner: first.assigner,
    family: first.family,
    isFast: first.isFast,
    grid: first.grid,
    storage: first.storage,
    run: first.run.label,
    cases,
    timeByBest: ratios.length ? Math.exp(sum(ratios.map(Math.log)) / ratios.length) : null,
    worstTimeByBest: most(ratios),
    excess: ratio(sum(errors.map((one) => one.false_positives)), sum(errors.map((one) => one.true_pairs))),
    missed: errors.length ? sum(errors.map((one) => one.false_negatives)) : null,
    dropped: sum(cases.map((one) => one.dropped)),
    unlit: most(cases.map((one) => one.unlit)),
    overshade: ratio(sum(shadings.map((one) => one.overshade! * one.needed)), sum(shadings.map((one) => one.needed))),
    longest: most(cases.map((one) => one.longest)),
    bytes: Math.max(...cases.map((one) => one.bytes)),
    fronts: cases.filter((one) => one.isOnFront).length,
  };
}

// `all`: what times are compared with, whatever is filtered out.
export function standings(cases: Case[], all: Case[]): Standing[] {
  const best = bestTimes(all);
  const groups = Map.groupBy(cases, (one) => [one.run.label, one.assigner, one.grid, one.storage].join("\n"));
  return [...groups.values()].map((group) => standing(group, best));
}
