// The ranking over all scenes: each method on each grid. All means are geometric over the scenes, each scene counted once:
// none outweighs the others by its size, and a ratio of two means is the mean of the ratios. Of a result of several machines
// each has standings and ranks of its own.

import { figure } from "./case_figures.ts";
import { type Case, seenBy } from "./model.ts";
import type { FigureName, Maybe } from "./result.ts";

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
  machine: string; // as the cases'
  cases: Case[];
  scenes: number;
  rank: Maybe; // by timeByBest among the standings of its result and machine, whatever is filtered out
  costByBest: Mean; // none of what samples search, whose cost no GPU has measured
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

// The least that one that is eligible takes; of all where none is.
function leastOf(cases: Case[], figure: (aCase: Case) => Maybe): Map<string, number> {
  const best = new Map<string, number>();
  const whole = new Set(cases.filter((aCase) => aCase.isEligible).map(seenBy));
  for (const aCase of cases) {
    const value = figure(aCase);
    if (value !== null && (aCase.isEligible || !whole.has(seenBy(aCase))))
      best.set(seenBy(aCase), Math.min(best.get(seenBy(aCase)) ?? Infinity, value));
  }
  return best;
}

const bestTimes = (cases: Case[]) => leastOf(cases, (aCase) => aCase.frameUs);

const rankedCost = (aCase: Case) => (aCase.isSearched ? null : aCase.costNs);

interface Least {
  times: Map<string, number>;
  costs: Map<string, number>;
}

const known = (values: Maybe[]) => values.filter((value): value is number => value !== null);
const most = (values: Maybe[]): Maybe => (known(values).length ? Math.max(...known(values)) : null);
const sum = (values: number[]) => values.reduce((total, value) => total + value, 0);
const geometric = (values: number[]) => Math.exp(sum(values.map(Math.log)) / values.length);

// Over the cases of each scene, then over the scenes.
export function meanOf(cases: Case[], figure: (aCase: Case) => Maybe): Mean {
  const scenes = [...Map.groupBy(cases, (aCase) => aCase.scene).values()]
    .map((some) => known(some.map(figure)))
    .filter((some) => some.length > 0);
  return { value: scenes.length ? geometric(scenes.map(geometric)) : null, scenes: scenes.length };
}

function excessOf(cases: Case[]): Mean {
  const { value, scenes } = meanOf(cases, (aCase) => {
    const excess = figure(aCase, "excess");
    return excess === null ? null : 1 + excess;
  });
  return { value: value === null ? null : value - 1, scenes };
}

function standing(cases: Case[], { times, costs }: Least): Standing {
  const timeByBest = (aCase: Case) => aCase.frameUs && aCase.frameUs / times.get(seenBy(aCase))!;
  const costByBest = (aCase: Case) => {
    const cost = rankedCost(aCase);
    return cost && cost / costs.get(seenBy(aCase))!;
  };
  const valuesOf = (name: FigureName) => known(cases.map((aCase) => figure(aCase, name)));
  const missed = valuesOf("missed");
  const first = cases[0]!;
  return {
    assigner: first.assigner,
    family: first.family,
    isFast: first.isFast,
    grid: first.grid,
    storage: first.storage,
    run: first.run.label,
    machine: first.machine,
    cases,
    scenes: new Set(cases.map((aCase) => aCase.scene)).size,
    rank: null,
    costByBest: meanOf(cases, costByBest),
    timeByBest: meanOf(cases, timeByBest),
    worstTimeByBest: most(cases.map(timeByBest)),
    excess: excessOf(cases),
    missed: missed.length ? sum(missed) : null,
    dropped: sum(valuesOf("dropped")),
    unlit: most(valuesOf("unlit")),
    isUnlit: cases.some((aCase) => aCase.isUnlit),
    overshade: meanOf(cases, (aCase) => figure(aCase, "overshade")),
    longest: meanOf(cases, (aCase) => figure(aCase, "longest") || null),
    bytes: meanOf(cases, (aCase) => figure(aCase, "bytes") || null),
    mostBytes: Math.max(...valuesOf("bytes")),
    fronts: cases.filter((aCase) => aCase.isOnFront).length,
  };
}

const keyOf = (aCase: Case) => [aCase.run.label, aCase.machine, aCase.assigner, aCase.grid, aCase.storage].join("\n");

function allStandings(cases: Case[], best: Least): Map<string, Standing> {
  return new Map([...Map.groupBy(cases, keyOf)].map(([key, group]) => [key, standing(group, best)]));
}

// `all`: what times are compared with and ranked among, whatever is filtered out.
export function standings(cases: Case[], all: Case[]): Standing[] {
  const best = { times: bestTimes(all), costs: leastOf(all, rankedCost) };
  const ranked = allStandings(all, best);
  for (const some of Map.groupBy(ranked.values(), (row) => [row.run, row.machine].join("\n")).values())
    some
      .filter((row) => row.timeByBest.value !== null && !row.cases.some((aCase) => aCase.isSearched))
      .sort((a, b) => a.timeByBest.value! - b.timeByBest.value!)
      .forEach((row, at) => {
        row.rank = at + 1;
      });
  return [...allStandings(cases, best)].map(([key, row]) => ({ ...row, rank: ranked.get(key)!.rank }));
}
