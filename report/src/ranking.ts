// The ranking: every case, fastest first.

import { h } from "./dom.ts";
import * as format from "./format.ts";
import type { Case, Model } from "./model.ts";
import { tableView, type Column } from "./table.ts";

function interval(one: Case): string {
  const [low, high] = one.interval;
  return low === null || high === null ? "" : `${format.microseconds(low)} to ${format.microseconds(high)} µs (95 %)`;
}

const columns: Column<Case>[] = [
  { label: "method", value: (one) => one.assigner },
  { label: "scene", value: (one) => one.scene },
  { label: "grid", value: (one) => one.grid },
  {
    label: "assign µs",
    about: "Median time of one frame's assignment, lists included",
    value: (one) => one.assignNs,
    show: (one) => h("span", { title: interval(one) }, format.microseconds(one.assignNs)),
  },
  { label: "excess", about: "False positives by true pairs", value: (one) => one.excess, show: (one) => format.percent(one.excess) },
  { label: "missed", about: "Lights lost", value: (one) => one.missed, show: (one) => format.count(one.missed) },
  { label: "bytes", about: "High-water mark", value: (one) => one.bytes, show: (one) => format.bytes(one.bytes) },
];

export function rankingSection(model: Model): HTMLElement {
  return h(
    "section",
    { id: "ranking" },
    h("h2", {}, "Ranking"),
    tableView({ caption: "Every case, fastest first", columns, rows: model.cases, sort: { column: 3, descending: false }, most: 200 }),
  );
}
