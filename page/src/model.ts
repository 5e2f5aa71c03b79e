// The page's own view of its results: every case of every result in one list, with the figures that tables and charts
// share.

import { type Figures, figure, type Words } from "./case_figures.ts";
import { inUs } from "./format.ts";
import type { CaseResult, FrameCost, Maybe, PageCase, PageData, Picture, Ranked, Result } from "./result.ts";

export interface Run {
  file: string;
  label: string; // the file's name, with as much of its path as tells it from the others
  result: Result;
  doubts: string[]; // what speaks against its times
}

export type Standing = "taken" | "alike"; // alike: not known to cost more than what is taken

export interface Case {
  raw: CaseResult;
  run: Run;
  machine: string; // whose times it has, of a result of several machines; "" of others, and without times
  scene: string;
  grid: string; // its name, or "no grid"
  assigner: string; // with its preset, and the parameters that differ from their defaults
  family: string; // a method and its fast variant are one family
  isFast: boolean;
  storage: string; // and lights, where they are packed
  setting: string; // what cases must share to be compared pair by pair
  isOnFront: boolean;
  isEligible: boolean; // for the front, and to be what others are compared with
  isSearched: boolean; // at each sample, which no GPU has measured: ranked apart
  isUnlit: boolean; // leaves more lights unlit than rounding does
  rank: Maybe; // by frame time, or cost, among all cases that see the same, whatever is filtered out
  figures: Figures; // by their names in the program's table, those that the case has
  sets: string[]; // of samples, that figures of samples are of
  frameUs: Maybe; // assignment and conversion
  costNs: Maybe; // of a frame with its shading; without times what the GPU does. None where lights are lost
  gpuNs: Maybe; // of it what is modelled
  standing: Standing | null; // what conclusions say of it
  interval: [Maybe, Maybe]; // of frameUs
  ranked: Ranked | null; // beside the fastest and the next faster one
  lostLux: Maybe; // on visible surfaces if they are asked for, else in the whole view; mean
  worstLux: Maybe; // of the sample that loses most
}

export interface Model {
  command: string;
  runs: Run[];
  cases: Case[];
  scenes: string[];
  grids: string[];
  assigners: string[];
  families: string[];
  words: Words;
  sampleSets: Record<string, string>; // words for each
  pictures: Picture[];
}

const unique = (values: string[]) => [...new Set(values)];

// The shortest ends of paths that tell them apart.
function labels(files: string[]): string[] {
  const parts = files.map((file) => file.replace(/\.json$/, "").split("/"));
  const tail = (at: number, length: number) => parts[at]!.slice(-length).join("/");
  return files.map((file, at) => {
    for (let length = 1; length <= parts[at]!.length; ++length)
      if (files.every((other, index) => other === file || tail(index, length) !== tail(at, length)))
        return tail(at, length);
    return file;
  });
}

// What a result's conclusions, and its rankings of presets, say of their cases.
function standingsOf({ conclusions, preset_rankings }: Result): Map<string, Standing> {
  const made = new Map<string, Standing>();
  for (const { take, alike } of conclusions ?? []) {
    for (const id of alike) made.set(id, "alike");
    if (take !== null) made.set(take, "taken");
  }
  for (const { best, alike } of preset_rankings ?? []) {
    for (const id of alike ?? []) made.set(id, "alike");
    if (best !== null) made.set(best, "taken");
  }
  return made;
}

interface Known {
  front: Set<string>;
  standings: Map<string, Standing>;
  ranked: Map<string, Ranked>;
  costs: Map<string, FrameCost>;
}

// A structure whose samples and lights need no cells, such as a hierarchy. Its result names the grid that it was measured beside.
const isWithoutGrid = (raw: CaseResult) =>
  raw.storage === "own" && raw.occupancy === undefined && raw.cells_not_compared === undefined;

function toCase(raw: CaseResult, { figures, sets }: PageCase, run: Run, known: Known): Case {
  const { front, standings, costs } = known;
  const ranked = known.ranked.get(raw.id) ?? null;
  const kept = raw.storage === "own" ? (/\/own lists(\/|$)/.test(raw.name) ? "own lists" : "no lists") : raw.storage;
  const packed = raw.precision && raw.precision.packing !== "float32" ? `${kept}, ${raw.precision.label}` : kept;
  const storage = raw.pre_cull ? `${packed}, after ${raw.pre_cull.label}` : packed;
  const seen = raw.samples?.opaque ?? raw.shading;
  const [low, high] = raw.timing?.frame_ns.ci95 ?? [null, null];
  const grid = isWithoutGrid(raw) ? "no grid" : raw.grid.name;
  return {
    raw,
    run,
    machine: raw.machine ?? "",
    scene: raw.scene,
    grid,
    assigner: raw.preset ? `${raw.preset}: ${raw.assigner.label}` : raw.assigner.label,
    family: raw.assigner.name.replace(/-fast$/, ""),
    isFast: raw.assigner.name.endsWith("-fast"),
    storage,
    setting: [run.label, raw.scene, raw.camera, raw.viewport.join("×"), grid, storage, raw.machine ?? []]
      .flat()
      .join(" · "),
    isOnFront: front.has(raw.id),
    isEligible: raw.eligible && !raw.samples_search,
    isSearched: raw.samples_search === true,
    isUnlit: raw.warnings.some(({ kind }) => kind === "unlit"),
    rank: null,
    figures,
    sets,
    frameUs: figure({ figures }, "frame_us"),
    costNs: costs.get(raw.id)?.ns ?? null,
    gpuNs: costs.get(raw.id)?.gpu_ns ?? null,
    standing: standings.get(raw.id) ?? null,
    interval: [inUs(low), inUs(high)],
    ranked,
    lostLux: seen?.lost_lux ?? null,
    worstLux: seen?.darkest?.lost_lux ?? (seen ? 0 : null),
  };
}

// Cases that see the same, whatever cells they use. Of several results each is by itself: they can be of other machines,
// as those of a merged result.
export const seenBy = (aCase: Case) =>
  [aCase.run.label, aCase.scene, aCase.raw.camera, aCase.raw.viewport.join("x"), aCase.raw.machine ?? ""].join("\n");

export const isRankedByCost = (aCase: Case) => aCase.run.result.config.rank_by === "frame_cost";

function rankAll(cases: Case[]): void {
  const ranked = (aCase: Case) => (aCase.isSearched ? null : isRankedByCost(aCase) ? aCase.costNs : aCase.frameUs);
  for (const seen of Map.groupBy(
    cases.filter((aCase) => ranked(aCase) !== null),
    seenBy,
  ).values())
    seen
      .sort((a, b) => ranked(a)! - ranked(b)!)
      .forEach((aCase, at) => {
        aCase.rank = at + 1;
      });
}

export function modelOf(data: PageData): Model {
  const names = labels(data.results.map(({ file }) => file));
  const runs = data.results.map(({ file, result, doubts }, at) => ({ file, label: names[at]!, result, doubts }));
  const cases = runs.flatMap((run, at) => {
    const { cases: numbers, ratios, costs } = data.results[at]!;
    const known: Known = {
      front: new Set(run.result.pareto_front.flatMap(({ ids }) => ids)),
      standings: standingsOf(run.result),
      ranked: new Map(ratios.map((ratio) => [ratio.id, ratio])),
      costs: new Map(costs.map((cost) => [cost.id, cost])),
    };
    return run.result.cases.map((raw, index) => toCase(raw, numbers[index]!, run, known));
  });
  rankAll(cases);
  return {
    command: data.command,
    runs,
    cases,
    scenes: unique(cases.map((aCase) => aCase.scene)),
    grids: unique(cases.map((aCase) => aCase.grid)),
    assigners: unique(cases.map((aCase) => aCase.assigner)),
    families: unique(cases.map((aCase) => aCase.family)),
    words: new Map(data.figures.map((row) => [row.name, row])),
    sampleSets: data.sample_sets,
    pictures: data.pictures,
  };
}
