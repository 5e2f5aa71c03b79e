// The ranking: of one scene every case, over all scenes every method on every grid.

import { h } from "./dom.ts";
import * as format from "./format.ts";
import { copyButton, csv, downloadButton } from "./handover.ts";
import type { Case } from "./model.ts";
import { standings, type Mean, type Standing } from "./overall.ts";
import { icon } from "./palette.ts";
import { tableView, type Column, type Table } from "./table.ts";
import type { Section, View } from "./view.ts";

function method(view: View, one: Pick<Case, "assigner" | "family" | "isFast">): HTMLElement {
  return h("span", { class: "method" }, icon(view.palette(one)), one.assigner);
}

function interval(one: Case): string {
  const [low, high] = one.interval;
  return low === null || high === null ? "95 %: unknown" : `95 %: ${format.microseconds(low)} to ${format.microseconds(high)} µs`;
}

function worst({ raw }: Case): string {
  const frame = raw.timing?.worst_frame;
  return frame ? `frame ${frame.frame}${frame.pairs === undefined ? "" : `, ${format.count(frame.pairs)} pairs`}` : "";
}

const lost = (text: string, isBad: boolean, title = "") => h("span", { class: isBad && "bad", title: title || null }, text);

function unlit({ raw, unlit, isUnlit }: Case): HTMLElement {
  const { missed_in_cells, missed_outside } = raw.shading ?? {};
  const title = missed_outside === undefined ? "" : `${format.count(missed_in_cells ?? null)} in cells, ${format.count(missed_outside)} outside of the grid`;
  return lost(format.share(unlit), isUnlit, title);
}

const front = (isOnFront: boolean) => (isOnFront ? h("span", { class: "front", role: "img", "aria-label": "yes" }, "●") : "");
const differ = <Row>(rows: Row[], value: (row: Row) => unknown) => new Set(rows.map(value)).size > 1;
const kept = <Row>(columns: (Column<Row> | false)[]) => columns.filter((column): column is Column<Row> => column !== false);

// Method, time and error first: a narrow screen shows no more.
function caseColumns(view: View, rows: Case[]): Column<Case>[] {
  const measured = (value: (one: Case) => unknown) => rows.some((one) => value(one) !== null);
  return kept<Case>([
    { label: "method", value: (one) => one.assigner, show: (one) => method(view, one) },
    measured((one) => one.frameNs) && { label: "frame µs", about: "Median time of what a frame takes: assignment and conversion to the storage, with builds where the grid changes from frame to frame. ~: may be as fast as the next faster one of its scene, as far as their ratio is known", value: (one) => one.frameNs, show: (one) => h("span", { title: interval(one) }, `${one.ranked?.is_like_above ? "~" : ""}${format.microseconds(one.frameNs)}`) },
    { label: "excess", about: "False positives by true pairs", value: (one) => one.excess, show: (one) => format.percent(one.excess) },
    { label: "missed", about: "False negatives: lights that reach a cell and are not in its list", value: (one) => one.missed, show: (one) => lost(format.whole(one.missed), !!one.missed) },
    rows.some((one) => one.dropped > 0) && { label: "dropped", about: "Pairs that the storage had no room for, over all frames", value: (one) => one.dropped, show: (one) => lost(format.short(one.dropped), one.dropped > 0) },
    measured((one) => one.unlit) && { label: "unlit", about: "Share of the lights that samples need and are not given: their cell lacks them, the storage dropped them, or they are outside of the grid", value: (one) => one.unlit, show: (one) => unlit(one) },
    measured((one) => one.overshade) && { label: "overshade", about: "Lights evaluated by lights needed, at the samples; none where lights are unlit or few are needed", value: (one) => one.overshade, show: (one) => format.factor(one.overshade) },
    { label: "bytes", about: "High-water mark of headers and indices", value: (one) => one.bytes, show: (one) => format.short(one.bytes) },
    { label: "front", about: "On its scene's Pareto front in frame time, bytes and overshade: nothing that loses no light is better, beyond the interval of the ratio of their times", value: (one) => (one.isOnFront ? "yes" : null), show: (one) => front(one.isOnFront) },
    measured((one) => one.rank) && { label: "rank", about: "By frame time among all cases of its scene, camera and viewport, those that are filtered out as well", value: (one) => one.rank },
    measured((one) => one.ranked?.fastest?.ratio ?? null) && { label: "/ fastest", about: "Frame time by that of the fastest case of its scene, camera and viewport, measured beside it, as clusterbench ratio --across-grids has it; its interval at the pointer", value: (one) => one.ranked?.fastest?.ratio ?? null, show: (one) => h("span", { title: ratio(one) }, format.factor(one.ranked?.fastest?.ratio ?? null)) },
    view.hasRuns && { label: "result", value: (one) => one.run.label },
    differ(rows, (one) => one.scene) && { label: "scene", value: (one) => one.scene },
    differ(rows, (one) => one.raw.camera) && { label: "camera", value: (one) => one.raw.camera },
    differ(rows, (one) => String(one.raw.viewport)) && { label: "viewport", value: (one) => one.raw.viewport.join("×") },
    { label: "grid", value: (one) => one.grid },
    differ(rows, (one) => one.storage) && { label: "storage", value: (one) => one.storage },
    measured((one) => one.frameNs) && { label: "±", about: "Half of the 95 % interval, by the median; both sides where one is above 20 %", value: halfInterval, show: (one) => (one.frameNs && halfInterval(one) === null ? "unknown" : halfOrBoth(one)) },
    measured((one) => one.worstNs) && { label: "worst µs", about: "The slowest of the timed frames; its number at the pointer", value: (one) => one.worstNs, show: (one) => h("span", { title: worst(one) }, format.microseconds(one.worstNs)) },
    measured((one) => one.assignNs) && { label: "assign µs", isDetail: true, about: "Of the frame's time: assignment, lists included", value: (one) => one.assignNs, show: (one) => format.microseconds(one.assignNs) },
    measured((one) => one.convertNs) && { label: "convert µs", isDetail: true, about: "Of the frame's time: from lists to the storage's layout", value: (one) => one.convertNs, show: (one) => format.microseconds(one.convertNs) },
    measured((one) => one.instructions) && { label: "instr", about: "Instructions of one frame's assignment", value: (one) => one.instructions, show: (one) => format.short(one.instructions) },
    measured((one) => one.nsPerPair) && { label: "ns/pair", isDetail: true, about: "Frame time by pairs", value: (one) => one.nsPerPair, show: (one) => format.decimal(one.nsPerPair) },
    measured((one) => one.floorRatio) && { label: "× copy", isDetail: true, about: "Assignment time by the time to copy the finished lists once", value: (one) => one.floorRatio, show: (one) => format.decimal(one.floorRatio) },
    { label: "pairs", isDetail: true, about: "(cell, light) pairs per frame, mean of the frames that are timed; comparable on one grid only", value: (one) => one.pairs, show: (one) => format.short(one.pairs) },
    { label: "most pairs", isDetail: true, about: "Of one of these frames", value: (one) => one.mostPairs, show: (one) => format.short(one.mostPairs) },
    { label: "p99", isDetail: true, about: "Lights per cell that 99 % of the cells do not exceed", value: (one) => one.p99, show: (one) => format.whole(one.p99) },
    { label: "longest", about: "Longest list of the path", value: (one) => one.longest, show: (one) => format.whole(one.longest) },
    { label: "allocate", about: "What to allocate: high-water mark with margin", value: (one) => one.recommended, show: (one) => format.short(one.recommended) },
  ]);
}

function halfInterval(one: Case): number | null {
  const [low, high] = one.interval;
  return low === null || high === null || !one.frameNs ? null : (high - low) / 2 / one.frameNs;
}

// As the terminal's table has it.
function halfOrBoth(one: Case): string {
  const [low, high] = one.interval;
  if (low === null || high === null || !one.frameNs) return format.percent(null);
  const below = 1 - low / one.frameNs, above = high / one.frameNs - 1;
  return Math.max(below, above) < 0.2 ? format.percent((below + above) / 2) : `-${(100 * below).toFixed(0)}/+${(100 * above).toFixed(0)} %`;
}

function ratio({ ranked }: Case): string {
  const beside = ranked?.fastest;
  return beside ? `${format.factor(beside.ci95[0])} to ${format.factor(beside.ci95[1])}` : "";
}

// A mean that some scenes have no part in says so.
function mean({ value, scenes }: Mean, one: Standing, show: (value: number | null) => string): string {
  return value === null || scenes === one.scenes ? show(value) : `${show(value)} (${scenes} of ${one.scenes})`;
}

function overallColumns(view: View, rows: Standing[]): Column<Standing>[] {
  const timed = rows.some((one) => one.timeByBest.value !== null);
  return kept<Standing>([
    { label: "method", value: (one) => one.assigner, show: (one) => method(view, one) },
    timed && { label: "time / best", about: "Frame time by that of the scene's fastest case that loses no light: geometric mean over the scenes", value: (one) => one.timeByBest.value, show: (one) => mean(one.timeByBest, one, format.factor) },
    { label: "excess", about: "False positives by true pairs: geometric mean over the scenes (of reported by true pairs)", value: (one) => one.excess.value, show: (one) => mean(one.excess, one, format.percent) },
    { label: "missed", about: "False negatives, sum over all scenes", value: (one) => one.missed, show: (one) => lost(format.whole(one.missed), !!one.missed) },
    rows.some((one) => one.dropped > 0) && { label: "dropped", about: "Pairs that storages had no room for, sum over all scenes", value: (one) => one.dropped, show: (one) => lost(format.short(one.dropped), one.dropped > 0) },
    rows.some((one) => one.unlit !== null) && { label: "unlit", about: "Largest share of needed lights that the samples of a scene lack", value: (one) => one.unlit, show: (one) => lost(format.share(one.unlit), one.isUnlit) },
    { label: "overshade", about: "Lights evaluated by lights needed: geometric mean over the scenes, with their number where it does not compare in all", value: (one) => one.overshade.value, show: (one) => mean(one.overshade, one, format.factor) },
    { label: "bytes", about: "High-water mark: geometric mean over the scenes", value: (one) => one.bytes.value, show: (one) => mean(one.bytes, one, format.short) },
    { label: "on front", about: "In how many of its cases it is on the Pareto front in time, bytes and overshade", value: (one) => one.fronts, show: (one) => `${one.fronts} of ${one.cases.length}` },
    timed && { label: "rank", about: "By time / best among all methods and grids, those that are filtered out as well", value: (one) => one.rank },
    view.hasRuns && { label: "result", value: (one) => one.run },
    { label: "grid", value: (one) => one.grid },
    differ(rows, (one) => one.storage) && { label: "storage", value: (one) => one.storage },
    differ(rows, (one) => one.scenes) && { label: "scenes", about: "That the figures are of", value: (one) => one.scenes },
    timed && { label: "worst", about: "Time / best in the scene where it is largest", value: (one) => one.worstTimeByBest, show: (one) => format.factor(one.worstTimeByBest) },
    { label: "longest", about: "Longest list: geometric mean over the scenes", value: (one) => one.longest.value, show: (one) => mean(one.longest, one, format.whole) },
    { label: "most bytes", about: "Largest high-water mark of any scene", value: (one) => one.mostBytes, show: (one) => format.short(one.mostBytes) },
  ]);
}

// By the first of these columns that the table has.
function sortedBy<Row>(columns: Column<Row>[]): Table<Row>["sort"] {
  const places = ["frame µs", "time / best", "instr", "excess"].map((label) => columns.findIndex((column) => column.label === label));
  return { column: places.find((place) => place >= 0) ?? 0, descending: false };
}

const allColumns = "ranking-all";

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

function ranking<Row>(view: View, redraw: () => void, caption: string, all: Column<Row>[], rows: Row[]): HTMLElement {
  const isWhole = view.choices.get(allColumns) === "1";
  const columns = all.filter((column) => isWhole || !column.isDetail);
  const text = () => csv(all, rows);
  return h(
    "section",
    { id: "ranking" },
    h("h2", {}, "Ranking"),
    all.some((column) => column.isDetail) && h("div", { class: "controls" }, wholeControl(view, redraw, isWhole)),
    tableView({ caption, columns, rows, sort: sortedBy(columns), most: 200 }),
    h("p", { class: "tools" }, copyButton("Copy data", text), downloadButton("Download CSV", "ranking.csv", "text/csv", text)),
  );
}

export const rankingSection: Section = (view, redraw) => {
  const cases = view.cases();
  if (cases.length === 0) return nothing(view);
  const { scene } = view.filters;
  if (scene !== null) return ranking(view, redraw, `Cases of ${scene}`, caseColumns(view, cases), cases);
  const rows = standings(view.casesOfAnyFront(), view.model.cases).filter((one) => !view.filters.frontOnly || one.fronts > 0);
  return ranking(view, redraw, "Methods over all scenes", overallColumns(view, rows), rows);
};

function nothing(view: View): HTMLElement {
  const text = view.model.cases.length === 0 ? "These results have no cases." : "No cases: none matches all of the filters.";
  const clear = h("button", { class: "quiet", id: "clear-filters", onclick: () => view.reset() }, "Clear the filters");
  return h("section", { id: "ranking" }, h("h2", {}, "Ranking"), h("p", { class: "note", role: "status" }, text, " ", view.model.cases.length > 0 && clear));
}
