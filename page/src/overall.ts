// The ranking over all scenes: each method on each grid. All means are geometric over the scenes, each scene counted once:
// none outweighs the others by its size, and a ratio of two means is the mean of the ratios.

import { seenBy, type Case } from "./model.ts";
import type { Maybe } from "./result.ts";

export interface Mean {
  value: Maybe;
  scenes: number; // that have a figure
}

export interface Standing {
  assigner: string;
  family: string;
  isFast: boolean;
  grid: string;
  storage: string;
  run: string;
  cases: Case[];
  scenes: number;
  rank: Maybe; // by timeByBest among the standings of its result, whatever is filtered out
  timeByBest: Mean; // below 1 where it is faster than all that may stand on a front
  worstTimeByBest: Maybe;
  excess: Mean; // of reported by true pairs, less 1
  missed: Maybe; // sum
  dropped: number; // sum
  unlit: Maybe; // largest of a case
  isUnlit: boolean;
  overshade: Mean;
  longest: Mean;
  bytes: Mean;
  mostBytes: number;
  fronts: number; // cases that are on their scene's front
}

// The fastest that is eligible; of all where none is.
export function bestTimes(cases: Case[]): Map<string, number> {
  const best = new Map<string, number>();
  const whole = new Set(cases.filter((one) => one.isEligible).map(seenBy));
  for (const one of cases)
    if (one.frameNs !== null && (one.isEligible || !whole.has(seenBy(one)))) best.set(seenBy(one), Math.min(best.get(seenBy(one)) ?? Infinity, one.frameNs));
  return best;
}

const known = (values: Maybe[]) => values.filter((value): value is number => value !== null);
const most = (values: Maybe[]): Maybe => (known(values).length ? Math.max(...known(values)) : null);
const sum = (values: number[]) => values.reduce((total, value) => total + value, 0);
const geometric = (values: number[]) => Math.exp(sum(values.map(Math.log)) / values.length);

// Over the cases of each scene, then over the scenes.
export function meanOf(cases: Case[], figure: (one: Case) => Maybe): Mean {
  const scenes = [...Map.groupBy(cases, (one) => one.scene).values()].map((some) => known(some.map(figure))).filter((some) => some.length > 0);
  return { value: scenes.length ? geometric(scenes.map(geometric)) : null, scenes: scenes.length };
}

function excessOf(cases: Case[]): Mean {
  const { value, scenes } = meanOf(cases, (one) => (one.excess === null ? null : 1 + one.excess));
  return { value: value === null ? null : value - 1, scenes };
}

function standing(cases: Case[], best: Map<string, number>): Standing {
  const timeByBest = (one: Case) => one.frameNs && one.frameNs / best.get(seenBy(one))!;
  const missed = known(cases.map((one) => one.missed));
  const first = cases[0]!;
  return {
    assigner: first.assigner,
    family: first.family,
    isFast: first.isFast,
    grid: first.grid,
    storage: first.storage,
    run: first.run.label,
    cases,
    scenes: new Set(cases.map((one) => one.scene)).size,
    rank: null,
    timeByBest: meanOf(cases, timeByBest),
    worstTimeByBest: most(cases.map(timeByBest)),
    excess: excessOf(cases),
    missed: missed.length ? sum(missed) : null,
    dropped: sum(cases.map((one) => one.dropped)),
    unlit: most(cases.map((one) => one.unlit)),
    isUnlit: cases.some((one) => one.isUnlit),
    overshade: meanOf(cases, (one) => one.overshade),
    longest: meanOf(cases, (one) => one.longest || null),
    bytes: meanOf(cases, (one) => one.bytes || null),
    mostBytes: Math.max(...cases.map((one) => one.bytes)),
    fronts: cases.filter((one) => one.isOnFront).length,
  };
}

const keyOf = (one: Case) => [one.run.label, one.assigner, one.grid, one.storage].join("\n");

function allStandings(cases: Case[], best: Map<string, number>): Map<string, Standing> {
  return new Map([...Map.groupBy(cases, keyOf)].map(([key, group]) => [key, standing(group, best)]));
}

// `all`: what times are compared with and ranked among, whatever is filtered out.
export function standings(cases: Case[], all: Case[]): Standing[] {
  const best = bestTimes(all);
  const ranked = allStandings(all, best);
  for (const some of Map.groupBy(ranked.values(), (one) => one.run).values())
    some
      .filter((one) => one.timeByBest.value !== null)
      .sort((a, b) => a.timeByBest.value! - b.timeByBest.value!)
      .forEach((one, at) => (one.rank = at + 1));
  return [...allStandings(cases, best)].map(([key, one]) => ({ ...one, rank: ranked.get(key)!.rank }));
}
