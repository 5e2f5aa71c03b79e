// The ranking: of one scene every case, over all scenes every method on every grid.

import { breakable, h } from "./dom.ts";
import * as format from "./format.ts";
import { copyButton, csv, downloadButton } from "./handover.ts";
import { type Case, isRankedByCost } from "./model.ts";
import { type Mean, type Standing, standings } from "./overall.ts";
import { icon } from "./palette.ts";
import { countsThatLackMost, headingOfSets, wordsOfSets } from "./sample_sets.ts";
import { type Column, type Table, tableView } from "./table.ts";
import type { Section, View } from "./view.ts";

// With what the conclusion says of it, and its grid where that has no column beside it.
function method(
  view: View,
  row: Pick<Case, "assigner" | "family" | "isFast" | "grid"> & { standing?: Case["standing"] },
  hasGrid: boolean,
): HTMLElement {
  const { standing } = row;
  return h(
    "span",
    { class: "method" },
    icon(view.palette(row)),
    h(
      "span",
      {},
      standing && h("span", { class: standing, role: "img", "aria-label": standingWords[standing] }),
      breakable(row.assigner),
      hasGrid && h("span", { class: "under" }, breakable(row.grid)),
    ),
  );
}

const standingWords = { taken: "taken by the conclusion", alike: "as good as what the conclusion takes" };

function interval(row: Case): string {
  const [low, high] = row.interval;
  return low === null || high === null
    ? "95 %: unknown"
    : `95 %: ${format.microseconds(low)} to ${format.microseconds(high)} µs`;
}

function worst({ raw }: Case): string {
  const frame = raw.timing?.worst_frame;
  return frame ? `frame ${frame.frame}${frame.pairs === undefined ? "" : `, ${format.count(frame.pairs)} pairs`}` : "";
}

const lost = (text: string, isBad: boolean, title = "") =>
  h("span", { class: isBad && "bad", title: title || null }, text);

function unlit({ raw, unlit, isUnlit }: Case): HTMLElement {
  const { missed_in_cells, missed_outside } = countsThatLackMost(raw) ?? {};
  const title =
    missed_outside === undefined
      ? ""
      : `${format.count(missed_in_cells ?? null)} in cells, ${format.count(missed_outside)} outside of the grid`;
  return lost(format.share(unlit), isUnlit, title);
}

const front = (isOnFront: boolean) =>
  isOnFront ? h("span", { class: "front", role: "img", "aria-label": "on the Pareto front" }, "*") : ""; // as in the terminal
const differ = <Row>(rows: Row[], value: (row: Row) => unknown) => new Set(rows.map(value)).size > 1;
const kept = <Row>(columns: (Column<Row> | false)[]) =>
  columns.filter((column): column is Column<Row> => column !== false);

// Method, time and error first: a narrow screen shows no more.
function caseColumns(view: View, rows: Case[]): Column<Case>[] {
  const measured = (value: (row: Case) => unknown) => rows.some((row) => value(row) !== null);
  const hasGrids = differ(rows, (row) => row.grid);
  return kept<Case>([
    { label: "method", value: (row) => row.assigner, show: (row) => method(view, row, hasGrids) },
    measured((row) => row.costNs) && {
      label: "cost µs",
      about:
        "What a frame costs, by which the conclusion chooses: making the lists, where that was timed, and upload, reading and shading by the model of the configuration's key cost. None where lights are lost. In brackets and last: samples search the structure, and no GPU has measured such a search",
      value: (row) => (row.isSearched ? null : row.costNs),
      show: (row) => h("span", { title: costParts(row) }, cost(row)),
    },
    measured((row) => row.frameNs) && {
      label: "frame µs",
      about:
        "Median time of what a frame takes: assignment and conversion to the storage, with builds where the grid changes from frame to frame. ~: may be as fast as the next faster one of its scene, as far as their ratio is known",
      value: (row) => row.frameNs,
      show: (row) =>
        h(
          "span",
          { title: interval(row) },
          `${row.ranked?.is_like_above ? "~" : ""}${format.microseconds(row.frameNs)}`,
        ),
    },
    {
      label: "excess",
      about: "False positives / true pairs (cell, light)",
      value: (row) => row.excess,
      show: (row) => format.percent(row.excess),
    },
    {
      label: "missed",
      about: "False negatives: lights that reach a cell and are not in its list",
      value: (row) => row.missed,
      show: (row) => lost(format.whole(row.missed), !!row.missed),
    },
    rows.some((row) => row.dropped > 0) && {
      label: "dropped",
      about: "Pairs that the storage had no room for, over all frames",
      value: (row) => row.dropped,
      show: (row) => lost(format.short(row.dropped), row.dropped > 0),
    },
    rows.some((row) => row.dropped > 0) && {
      label: "lost lx",
      isScreenOnly: true,
      about: "Irradiance that samples lack, mean; of the one that lacks most at the pointer",
      value: (row) => row.lostLux,
      show: (row) => lost(format.decimal(row.lostLux), !!row.lostLux, `at most ${format.decimal(row.worstLux)} lx`),
    },
    measured((row) => row.unlit) && {
      label: `unlit${headingOfSets(rows.map(({ raw }) => raw))}`,
      about: `Share of the lights that samples (${wordsOfSets(rows.map(({ raw }) => raw))}) need and are not given: their cell lacks them, the storage dropped them, or they are outside of the grid`,
      value: (row) => row.unlit,
      show: (row) => unlit(row),
    },
    measured((row) => row.overshade) && {
      label: `overshade${headingOfSets(rows.map(({ raw }) => raw))}`,
      about: `Lights given / lights needed, at samples (${wordsOfSets(rows.map(({ raw }) => raw))}); none where lights are unlit or few are needed`,
      value: (row) => row.overshade,
      show: (row) => format.factor(row.overshade),
    },
    rows.some((row) => row.isSearched) && {
      label: "read",
      isScreenOnly: true,
      about:
        "Bytes of the light structure that a sample reads to know its lights. Structures that samples search (a hierarchy, masks of bits) have no rank and are on no front: no GPU has measured the search",
      value: (row) => row.readBytes,
      show: (row) => format.short(row.readBytes),
    },
    {
      label: "bytes",
      about: "High-water mark of headers and indices",
      value: (row) => row.bytes,
      show: (row) => format.short(row.bytes),
    },
    {
      label: "front",
      about:
        "On its scene's Pareto front in frame time, bytes and overshade, or in cost and bytes where the result is ranked by cost: no other case that loses no light is as good in all of them (in time, as far as measured) and better in one",
      value: (row) => (row.isOnFront ? "yes" : null),
      show: (row) => front(row.isOnFront),
    },
    measured((row) => row.rank) && {
      label: rows.every(isRankedByCost) ? "rank by cost" : "rank by time",
      about: "Among all cases of its scene, camera and viewport, those that are filtered out as well",
      value: (row) => row.rank,
    },
    measured((row) => row.ranked?.fastest?.ratio ?? null) && {
      label: "time / fastest",
      isScreenOnly: true,
      about:
        "Frame time by that of the fastest case of its scene, camera and viewport, the median of the ratios of times measured side by side, as clusterbench ratio --across-grids has it, and not the quotient of the two times; its interval at the pointer",
      value: (row) => row.ranked?.fastest?.ratio ?? null,
      show: (row) => h("span", { title: ratio(row) }, format.factor(row.ranked?.fastest?.ratio ?? null)),
    },
    view.hasRuns && { label: "result", value: (row) => row.run.label },
    differ(rows, (row) => row.scene) && { label: "scene", value: (row) => row.scene },
    differ(rows, (row) => row.raw.camera) && { label: "camera", value: (row) => row.raw.camera },
    differ(rows, (row) => String(row.raw.viewport)) && {
      label: "viewport",
      value: (row) => row.raw.viewport.join("×"),
    },
    { label: "grid", value: (row) => row.grid, isUnderFirst: hasGrids },
    differ(rows, (row) => row.storage) && { label: "storage", value: (row) => row.storage },
    measured((row) => row.frameNs) && {
      label: "±",
      about: "Half of the 95 % interval, by the median; both sides where one is above 20 %",
      value: halfInterval,
      show: (row) => (row.frameNs && halfInterval(row) === null ? "unknown" : halfOrBoth(row)),
    },
    measured((row) => row.worstNs) && {
      label: "worst µs",
      isScreenOnly: true,
      about: "The slowest of the timed frames; its number at the pointer",
      value: (row) => row.worstNs,
      show: (row) => h("span", { title: worst(row) }, format.microseconds(row.worstNs)),
    },
    measured((row) => row.assignNs) && {
      label: "assign µs",
      isScreenOnly: true,
      isDetail: true,
      about: "Of the frame's time: assignment, lists included",
      value: (row) => row.assignNs,
      show: (row) => format.microseconds(row.assignNs),
    },
    measured((row) => row.convertNs) && {
      label: "convert µs",
      isScreenOnly: true,
      isDetail: true,
      about: "Of the frame's time: from lists to the storage's layout",
      value: (row) => row.convertNs,
      show: (row) => format.microseconds(row.convertNs),
    },
    measured((row) => row.instructions) && {
      label: "instr",
      isScreenOnly: true,
      about: "Instructions of one frame's assignment",
      value: (row) => row.instructions,
      show: (row) => format.short(row.instructions),
    },
    measured((row) => row.nsPerPair) && {
      label: "ns/pair",
      isScreenOnly: true,
      isDetail: true,
      about: "Frame time by pairs",
      value: (row) => row.nsPerPair,
      show: (row) => format.decimal(row.nsPerPair),
    },
    measured((row) => row.floorRatio) && {
      label: "× copy",
      isDetail: true,
      about: "Assignment time by the time to copy the finished lists once",
      value: (row) => row.floorRatio,
      show: (row) => format.decimal(row.floorRatio),
    },
    {
      label: "pairs",
      isDetail: true,
      about: "(cell, light) pairs per frame, mean of the frames that are timed; comparable on one grid only",
      value: (row) => row.pairs,
      show: (row) => format.short(row.pairs),
    },
    {
      label: "most pairs",
      isDetail: true,
      about: "Of one of these frames",
      value: (row) => row.mostPairs,
      show: (row) => format.short(row.mostPairs),
    },
    {
      label: "p99",
      isDetail: true,
      about: "Lights per cell that 99 % of the cells do not exceed",
      value: (row) => row.p99,
      show: (row) => format.whole(row.p99),
    },
    {
      label: "longest",
      about: "Longest list of the path",
      value: (row) => row.longest,
      show: (row) => format.whole(row.longest),
    },
    {
      label: "allocate",
      about: "What to allocate: high-water mark with margin",
      value: (row) => row.recommended,
      show: (row) => format.short(row.recommended),
    },
  ]);
}

const cost = ({ costNs, isSearched }: Case) =>
  isSearched && costNs !== null ? `(${format.microseconds(costNs)})` : format.microseconds(costNs);

function costParts({ costNs, gpuNs }: Case): string {
  if (costNs === null || gpuNs === null) return "";
  const modelled = `${format.microseconds(gpuNs)} µs of upload, reading and shading`;
  return costNs > gpuNs ? `${format.microseconds(costNs - gpuNs)} µs to make the lists, ${modelled}` : modelled;
}

function halfInterval(row: Case): number | null {
  const [low, high] = row.interval;
  return low === null || high === null || !row.frameNs ? null : (high - low) / 2 / row.frameNs;
}

// As the terminal's table has it.
function halfOrBoth(row: Case): string {
  const [low, high] = row.interval;
  if (low === null || high === null || !row.frameNs) return format.percent(null);
  const below = 1 - low / row.frameNs,
    above = high / row.frameNs - 1;
  return Math.max(below, above) < 0.2
    ? format.percent((below + above) / 2)
    : `-${(100 * below).toFixed(0)}/+${(100 * above).toFixed(0)} %`;
}

function ratio({ ranked }: Case): string {
  const beside = ranked?.fastest;
  return beside ? `${format.factor(beside.ci95[0])} to ${format.factor(beside.ci95[1])}` : "";
}

// A mean that some scenes have no part in says so.
function mean({ value, scenes }: Mean, row: Standing, show: (value: number | null) => string): string {
  return value === null || scenes === row.scenes ? show(value) : `${show(value)} (${scenes} of ${row.scenes})`;
}

function overallColumns(view: View, rows: Standing[]): Column<Standing>[] {
  const timed = rows.some((row) => row.timeByBest.value !== null);
  const hasGrids = differ(rows, (row) => row.grid);
  return kept<Standing>([
    { label: "method", value: (row) => row.assigner, show: (row) => method(view, row, hasGrids) },
    rows.some((row) => row.costByBest.value !== null) && {
      label: "cost / best",
      about:
        "Cost of a frame, by which the conclusions choose, by that of the scene's cheapest case: geometric mean over the scenes",
      value: (row) => row.costByBest.value,
      show: (row) => mean(row.costByBest, row, format.factor),
    },
    timed && {
      label: "time / best",
      about: "Frame time by that of the scene's fastest case that loses no light: geometric mean over the scenes",
      value: (row) => row.timeByBest.value,
      show: (row) => mean(row.timeByBest, row, format.factor),
    },
    {
      label: "excess",
      about: "False positives by true pairs: geometric mean over the scenes (of reported by true pairs)",
      value: (row) => row.excess.value,
      show: (row) => mean(row.excess, row, format.percent),
    },
    {
      label: "missed",
      about: "False negatives, sum over all scenes",
      value: (row) => row.missed,
      show: (row) => lost(format.whole(row.missed), !!row.missed),
    },
    rows.some((row) => row.dropped > 0) && {
      label: "dropped",
      about: "Pairs that storages had no room for, sum over all scenes",
      value: (row) => row.dropped,
      show: (row) => lost(format.short(row.dropped), row.dropped > 0),
    },
    rows.some((row) => row.unlit !== null) && {
      label: "unlit",
      about: "Largest share of needed lights that the samples of a scene lack",
      value: (row) => row.unlit,
      show: (row) => lost(format.share(row.unlit), row.isUnlit),
    },
    {
      label: "overshade",
      about:
        "Lights evaluated by lights needed: geometric mean over the scenes, with their number where it does not compare in all",
      value: (row) => row.overshade.value,
      show: (row) => mean(row.overshade, row, format.factor),
    },
    {
      label: "bytes",
      about: "High-water mark: geometric mean over the scenes",
      value: (row) => row.bytes.value,
      show: (row) => mean(row.bytes, row, format.short),
    },
    {
      label: "on front",
      about: "In how many of its cases it is on the Pareto front in time, bytes and overshade",
      value: (row) => row.fronts,
      show: (row) => `${row.fronts} of ${row.cases.length}`,
    },
    timed && {
      label: "rank by time",
      about: "By time / best among all methods and grids, those that are filtered out as well",
      value: (row) => row.rank,
    },
    view.hasRuns && { label: "result", value: (row) => row.run },
    { label: "grid", value: (row) => row.grid, isUnderFirst: hasGrids },
    differ(rows, (row) => row.storage) && { label: "storage", value: (row) => row.storage },
    differ(rows, (row) => row.scenes) && {
      label: "scenes",
      isScreenOnly: true,
      about: "That the figures are of",
      value: (row) => row.scenes,
    },
    timed && {
      label: "worst",
      isScreenOnly: true,
      about: "Time / best in the scene where it is largest",
      value: (row) => row.worstTimeByBest,
      show: (row) => format.factor(row.worstTimeByBest),
    },
    {
      label: "longest",
      isScreenOnly: true,
      about: "Longest list: geometric mean over the scenes",
      value: (row) => row.longest.value,
      show: (row) => mean(row.longest, row, format.whole),
    },
    {
      label: "most bytes",
      isScreenOnly: true,
      about: "Largest high-water mark of any scene",
      value: (row) => row.mostBytes,
      show: (row) => format.short(row.mostBytes),
    },
  ]);
}

// By the first of these columns that the table has; what lacks light, last.
function sortedBy<Row extends { isUnlit: boolean }>(columns: Column<Row>[]): Table<Row>["sort"] {
  const indices = ["cost µs", "cost / best", "frame µs", "time / best", "instr", "excess"].map((label) =>
    columns.findIndex((column) => column.label === label),
  );
  return { column: indices.find((index) => index >= 0) ?? 0, descending: false, last: (row) => row.isUnlit };
}

// What of the heads is not understood without being told.
function wordsOf(isTimed: boolean): Record<string, string> {
  const model = "upload, reading and shading by the model of the configuration's key cost";
  const cost = isTimed ? `making the lists, and ${model}` : `${model}; making the lists was not timed`;
  return {
    "cost µs": cost,
    "cost / best": cost,
    excess: "false positives / true pairs (cell, light)",
    missed: "lights that reach a cell and are not in its list",
    unlit: "share of the lights that samples need and do not get",
    overshade: "lights in the lists of samples / lights that reach the samples; 1 is ideal",
  };
}

const frontOf = (view: View) =>
  view.model.cases.every(isRankedByCost)
    ? "cost and bytes"
    : `${view.model.cases.some(({ frameNs }) => frameNs !== null) ? "time, " : ""}bytes and overshade`;

function legend<Row>(view: View, columns: Column<Row>[], rows: Row[]): string {
  const words = wordsOf(columns.some(({ label }) => label === "frame µs" || label === "time / best"));
  const explained = columns.flatMap(({ label }) => {
    const [, word] = /^(.*?)(?: \(.*\))?$/.exec(label)!;
    return words[word!] ? [`${word}: ${words[word!]}`] : [];
  });
  const standings = new Set(rows.map((row) => (row as { standing?: Case["standing"] }).standing));
  const best = view.hasPresets ? "costs least of the presets" : "taken by the conclusion";
  return [
    standings.has("taken") && `▶ ${best}.`,
    standings.has("alike") && "≈ as good, as far as these figures can show.",
    columns.some(({ label }) => label === "front") && `* on the Pareto front of ${frontOf(view)}.`,
    `${explained.join("; ")}.`,
  ]
    .filter(Boolean)
    .join(" ");
}

const allColumns = "ranking-all";

// Presets have a ranking of their own.
const titleOf = (view: View) => (view.hasPresets ? "All figures" : "Ranking");

function wholeControl(view: View, redraw: () => void, isWhole: boolean): HTMLElement {
  const input = h("input", { type: "checkbox", id: allColumns, checked: isWhole, onchange: () => change() });
  function change(): void {
    if (input.checked) view.choices.set(allColumns, "1");
    else view.choices.delete(allColumns);
    redraw();
    view.tellChoice();
  }
  return h("label", { class: "control check" }, input, h("span", {}, "All columns"));
}

function ranking<Row extends { isUnlit: boolean }>(
  view: View,
  redraw: () => void,
  caption: string,
  all: Column<Row>[],
  rows: Row[],
): HTMLElement {
  const isWhole = view.choices.get(allColumns) === "1";
  const columns = all.filter((column) => isWhole || !column.isDetail);
  const text = () => csv(all, rows);
  return h(
    "section",
    { id: "ranking" },
    h("h2", {}, titleOf(view)),
    h("p", { class: "note" }, legend(view, columns, rows)),
    all.some((column) => column.isDetail) && h("div", { class: "controls" }, wholeControl(view, redraw, isWhole)),
    tableView({ caption, columns, rows, sort: sortedBy(columns), most: 200 }),
    h(
      "p",
      { class: "tools" },
      copyButton("Copy data", text),
      downloadButton("Download CSV", "ranking.csv", "text/csv", text),
    ),
  );
}

export const rankingSection: Section = (view, redraw) => {
  const cases = view.cases();
  if (cases.length === 0) return nothing(view);
  const { scene } = view.filters;
  if (scene !== null) return ranking(view, redraw, `Cases of ${scene}`, caseColumns(view, cases), cases);
  const rows = standings(view.casesOfAnyFront(), view.model.cases).filter(
    (row) => !view.filters.frontOnly || row.fronts > 0,
  );
  return ranking(view, redraw, "Methods over all scenes", overallColumns(view, rows), rows);
};

function nothing(view: View): HTMLElement {
  const text =
    view.model.cases.length === 0 ? "These results have no cases." : "No cases: none matches all of the filters.";
  const clear = h("button", { class: "quiet", id: "clear-filters", onclick: () => view.reset() }, "Clear the filters");
  return h(
    "section",
    { id: "ranking" },
    h("h2", {}, titleOf(view)),
    h("p", { class: "note", role: "status" }, text, " ", view.model.cases.length > 0 && clear),
  );
}
