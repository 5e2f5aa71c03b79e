// The ranking: of one scene every case, over all scenes every method on every grid.

import { aboutOf, columnsOf, figure, meaningOf, pairsOf, type Words } from "./case_figures.ts";
import { breakable, h } from "./dom.ts";
import * as format from "./format.ts";
import { copyButton, csv, downloadButton } from "./handover.ts";
import { blocksOf, hasMachines } from "./machines.ts";
import { type Case, isRankedByCost } from "./model.ts";
import { type Mean, type Standing, standings } from "./overall.ts";
import { icon } from "./palette.ts";
import type { FigureName } from "./result.ts";
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

function unlit(row: Case): HTMLElement {
  const { missed_in_cells, missed_outside } = countsThatLackMost(row) ?? {};
  const title =
    missed_outside === undefined
      ? ""
      : `${format.count(missed_in_cells ?? null)} in cells, ${format.count(missed_outside)} outside of the grid`;
  return lost(format.share(figure(row, "unlit")), row.isUnlit, title);
}

const front = (isOnFront: boolean) =>
  isOnFront ? h("span", { class: "front", role: "img", "aria-label": "on the Pareto front" }, "*") : ""; // as in the terminal
const differ = <Row>(rows: Row[], value: (row: Row) => unknown) => new Set(rows.map(value)).size > 1;
const kept = <Row>(columns: (Column<Row> | false)[]) =>
  columns.filter((column): column is Column<Row> => column !== false);

const has = (rows: Case[], name: FigureName) => rows.some((row) => figure(row, name) !== null);

// Method, time and error first: a narrow screen shows no more.
function caseColumns(view: View, rows: Case[]): Column<Case>[] {
  const measured = (value: (row: Case) => unknown) => rows.some((row) => value(row) !== null);
  const hasGrids = differ(rows, (row) => row.grid);
  const column = columnsOf(view.model.words, (row: Case) => row);
  return kept<Case>([
    { label: "method", value: (row) => row.assigner, show: (row) => method(view, row, hasGrids) },
    measured((row) => row.costNs) && {
      label: "cost µs",
      about:
        "What a frame costs, by which the conclusion chooses: making the lists, where that was timed, and upload, reading and shading by the model of the configuration's key cost. None where lights are lost. In brackets and last: samples search the structure, and no GPU has measured such a search",
      value: (row) => (row.isSearched ? null : format.inUs(row.costNs)),
      show: (row) => h("span", { title: costParts(row) }, cost(row)),
    },
    has(rows, "frame_us") &&
      column("frame_us", "frame µs", {
        note: "builds are in it where the grid changes from frame to frame. ~: may be as fast as the next faster one of its scene, as far as their ratio is known",
        show: (row) =>
          h(
            "span",
            { title: interval(row) },
            `${row.ranked?.is_like_above ? "~" : ""}${format.microseconds(row.frameUs)}`,
          ),
      }),
    ...errorColumns(view, rows),
    column("bytes", "bytes"),
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
    ...namesOf(view, rows, hasGrids),
    has(rows, "frame_us") && {
      label: "±",
      about: "Half of the 95 % interval, by the median; both sides where one is above 20 %",
      value: halfInterval,
      show: (row) => (row.frameUs && halfInterval(row) === null ? "unknown" : halfOrBoth(row)),
    },
    ...detailColumns(view, rows),
  ]);
}

// Errors of the lists, and how samples see them.
function errorColumns(view: View, rows: Case[]): (Column<Case> | false)[] {
  const column = columnsOf(view.model.words, (row: Case) => row);
  const drops = rows.some((row) => isLost(row, "dropped"));
  const heading = headingOfSets(rows),
    samples = `samples: ${wordsOfSets(rows, view.model.sampleSets)}`;
  return [
    column("excess", "excess", { format: format.percent, note: pairNote }),
    column("missed", "missed", {
      show: (row) => lost(format.whole(figure(row, "missed")), isLost(row, "missed")),
    }),
    drops &&
      column("dropped", "dropped", {
        show: (row) => lost(format.short(figure(row, "dropped")), isLost(row, "dropped")),
      }),
    drops && {
      label: "lost lx",
      isScreenOnly: true,
      about: "Irradiance that samples lack, mean; of the one that lacks most at the pointer",
      value: (row) => row.lostLux,
      show: (row) => lost(format.decimal(row.lostLux), !!row.lostLux, `at most ${format.decimal(row.worstLux)} lx`),
    },
    has(rows, "unlit") &&
      column("unlit", `unlit${heading}`, {
        note: `their cell lacks them, the storage dropped them, or they are outside of the grid; ${samples}`,
        show: unlit,
      }),
    has(rows, "overshade") &&
      column("overshade", `overshade${heading}`, {
        note: `none where lights are unlit or few are needed; ${samples}`,
      }),
    rows.some((row) => row.isSearched) &&
      column("read_bytes", "read", {
        isScreenOnly: true,
        format: format.readBytes,
        note: "structures that samples search (a hierarchy, masks of bits) have no rank and are on no front: no GPU has measured the search",
      }),
  ];
}

const machineColumn = {
  label: "machine",
  about: "Where it was timed: times of two machines are not compared",
  value: ({ machine }: { machine: string }) => machine || null,
};

// A result, scene, camera, viewport, grid or storage, unless all cases share it.
function namesOf(view: View, rows: Case[], hasGrids: boolean): (Column<Case> | false)[] {
  return [
    view.hasRuns && { label: "result", value: (row) => row.run.label },
    hasMachines(rows) && machineColumn,
    differ(rows, (row) => row.scene) && { label: "scene", value: (row) => row.scene },
    differ(rows, (row) => row.raw.camera) && { label: "camera", value: (row) => row.raw.camera },
    differ(rows, (row) => String(row.raw.viewport)) && {
      label: "viewport",
      value: (row) => row.raw.viewport.join("×"),
    },
    { label: "grid", value: (row) => row.grid, isUnderFirst: hasGrids },
    differ(rows, (row) => row.storage) && { label: "storage", value: (row) => row.storage },
  ];
}

// Most of them are shown on request.
function detailColumns(view: View, rows: Case[]): (Column<Case> | false)[] {
  const column = columnsOf(view.model.words, (row: Case) => row);
  const ofTime = "part of the frame's time";
  return [
    has(rows, "frame_us.max") &&
      column("frame_us.max", "worst µs", {
        isScreenOnly: true,
        note: "its number at the pointer",
        show: (row) => h("span", { title: worst(row) }, format.microseconds(figure(row, "frame_us.max"))),
      }),
    has(rows, "assign_us") && column("assign_us", "assign µs", { isScreenOnly: true, isDetail: true, note: ofTime }),
    has(rows, "convert_us") && column("convert_us", "convert µs", { isScreenOnly: true, isDetail: true, note: ofTime }),
    has(rows, "assign_instructions") && column("assign_instructions", "instr", { isScreenOnly: true }),
    has(rows, "time_per_pair") && column("time_per_pair", "ns/pair", { isScreenOnly: true, isDetail: true }),
    has(rows, "floor_ratio") && column("floor_ratio", "× copy", { isDetail: true }),
    column("pairs_timed", "pairs", {
      isDetail: true,
      about:
        "(cell, light) pairs of a frame, mean: of the timed frames, or of all frames if no frame is timed. Comparable on one grid only",
      value: pairsOf,
      show: (row) => format.short(pairsOf(row)),
    }),
    {
      label: "most pairs",
      isDetail: true,
      about: "Of one of these frames",
      value: mostPairs,
      show: (row) => format.short(mostPairs(row)),
    },
    column("lights_per_cell.p99", "p99", { isDetail: true }),
    column("longest", "longest"),
    column("bytes_recommended", "allocate"),
  ];
}

const pairNote = "a pair is a cell and a light";
const isLost = (row: Case, name: "missed" | "dropped") => (figure(row, name) ?? 0) > 0;
const mostPairs = (row: Case) => row.raw.timing?.pairs?.max ?? figure(row, "pairs");

function cost({ costNs, isSearched }: Case): string {
  const text = format.microseconds(format.inUs(costNs));
  return isSearched && costNs !== null ? `(${text})` : text;
}

function costParts({ costNs, gpuNs }: Case): string {
  if (costNs === null || gpuNs === null) return "";
  const modelled = `${format.microseconds(format.inUs(gpuNs))} µs of upload, reading and shading`;
  return costNs > gpuNs
    ? `${format.microseconds(format.inUs(costNs - gpuNs))} µs to make the lists, ${modelled}`
    : modelled;
}

function halfInterval(row: Case): number | null {
  const [low, high] = row.interval;
  return low === null || high === null || !row.frameUs ? null : (high - low) / 2 / row.frameUs;
}

// As the terminal's table has it.
function halfOrBoth(row: Case): string {
  const [low, high] = row.interval;
  if (low === null || high === null || !row.frameUs) return format.percent(null);
  const below = 1 - low / row.frameUs,
    above = high / row.frameUs - 1;
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
  const about = (name: FigureName, over: string) => aboutOf(view.model.words, name, over);
  const geometric = "geometric mean over the scenes";
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
      about: about("excess", `${geometric} (of listed / true pairs)`),
      value: (row) => row.excess.value,
      show: (row) => mean(row.excess, row, format.percent),
    },
    {
      label: "missed",
      about: about("missed", "sum over all scenes"),
      value: (row) => row.missed,
      show: (row) => lost(format.whole(row.missed), !!row.missed),
    },
    rows.some((row) => row.dropped > 0) && {
      label: "dropped",
      about: about("dropped", "sum over all scenes"),
      value: (row) => row.dropped,
      show: (row) => lost(format.short(row.dropped), row.dropped > 0),
    },
    rows.some((row) => row.unlit !== null) && {
      label: "unlit",
      about: about("unlit", "largest of all scenes"),
      value: (row) => row.unlit,
      show: (row) => lost(format.share(row.unlit), row.isUnlit),
    },
    {
      label: "overshade",
      about: about("overshade", `${geometric}, with their number where it does not compare in all`),
      value: (row) => row.overshade.value,
      show: (row) => mean(row.overshade, row, format.factor),
    },
    {
      label: "bytes",
      about: about("bytes", geometric),
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
      about:
        "By time / best among all methods and grids of a result, and of a machine, those that are filtered out as well",
      value: (row) => row.rank,
    },
    view.hasRuns && { label: "result", value: (row) => row.run },
    rows.some((row) => row.machine) && machineColumn,
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
      about: about("longest", geometric),
      value: (row) => row.longest.value,
      show: (row) => mean(row.longest, row, format.whole),
    },
    {
      label: "most bytes",
      isScreenOnly: true,
      about: about("bytes", "largest of all scenes"),
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

// Heads that need an explanation.
function headsOf(words: Words, isTimed: boolean): Record<string, string> {
  const model = "upload, reading and shading by the model of the configuration's key cost";
  const cost = isTimed ? `making the lists, and ${model}` : `${model}; making the lists was not timed`;
  return {
    "cost µs": cost,
    "cost / best": cost,
    excess: `${meaningOf(words, "excess")} (${pairNote})`,
    missed: meaningOf(words, "missed"),
    unlit: meaningOf(words, "unlit"),
    overshade: `${meaningOf(words, "overshade")} (1 is ideal)`,
  };
}

const frontOf = (view: View) =>
  view.model.cases.every(isRankedByCost)
    ? "cost and bytes"
    : `${view.model.cases.some(({ frameUs }) => frameUs !== null) ? "time, " : ""}bytes and overshade`;

function legend<Row>(view: View, columns: Column<Row>[], rows: Row[]): string {
  const isTimed = columns.some(({ label }) => label === "frame µs" || label === "time / best");
  const words = headsOf(view.model.words, isTimed);
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

// A table of the ranking: one, or one for each machine.
interface Block<Row> {
  title: string;
  rows: Row[];
}

const blocksNote =
  "Times of two machines are not compared: each has a table, with ranks, ratios and a front of its own.";

function ranking<Row extends { isUnlit: boolean }>(
  view: View,
  redraw: () => void,
  caption: string,
  columnsOf: (rows: Row[]) => Column<Row>[],
  blocks: Block<Row>[],
): HTMLElement {
  const isWhole = view.choices.get(allColumns) === "1";
  const rows = blocks.flatMap((block) => block.rows);
  const all = columnsOf(rows);
  const columns = all.filter((column) => isWhole || !column.isDetail);
  const text = () => csv(all, rows);
  return h(
    "section",
    { id: "ranking" },
    h("h2", {}, titleOf(view)),
    h("p", { class: "note" }, legend(view, columns, rows)),
    all.some((column) => column.isDetail) && h("div", { class: "controls" }, wholeControl(view, redraw, isWhole)),
    blocks.some(({ title }) => title) && h("p", { class: "note" }, blocksNote),
    ...blocks.flatMap(({ title, rows: some }) => [
      ...(title ? [h("h3", {}, title)] : []),
      tableView({
        caption: title ? `${caption}, ${title}` : caption,
        columns,
        rows: some,
        sort: sortedBy(columns),
        most: 200,
      }),
    ]),
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
  const isAlone = !view.hasRuns;
  if (scene !== null) {
    const blocks = blocksOf(cases, isAlone).map(({ title, cases: rows }) => ({ title, rows }));
    return ranking(view, redraw, `Cases of ${scene}`, (rows) => caseColumns(view, rows), blocks);
  }
  const blocks = blocksOf(view.casesOfAnyFront(), isAlone)
    .map(({ title, cases: some }) => ({
      title,
      rows: standings(some, view.model.cases).filter((row) => !view.filters.frontOnly || row.fronts > 0),
    }))
    .filter(({ rows }) => rows.length > 0);
  return ranking(view, redraw, "Methods over all scenes", (rows) => overallColumns(view, rows), blocks);
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
