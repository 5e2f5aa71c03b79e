// A chart with all that belongs to it: title, what it shows, its table, its data and the command that measured it.

import { type Child, h } from "./dom.ts";
import { copyButton, csv, downloadButton } from "./handover.ts";
import type { Case } from "./model.ts";
import { icon, type Look } from "./palette.ts";
import { scrolled } from "./scrolled.ts";
import { type Table, tableView } from "./table.ts";

export interface Figure<Row> {
  id: string;
  title: string;
  lead: Child;
  controls?: HTMLElement[];
  legend?: { label: string; colour: string }[]; // of what the methods' own colours do not tell
  methods?: Key[]; // how methods look in the chart
  hasLines?: boolean; // methods are lines; else marks, whose legend on a screen is the filter bar's buttons
  chart?: Child; // without one the table stands in its place
  table: () => Table<Row>; // made when it is opened
  cases: Case[]; // that the chart shows
}

export interface Key {
  label: string;
  look: Look;
}

const quoted = (word: string) => (/^[\w./=:@%+,-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`);
const escaped = (text: string) => text.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");

function commonStart(texts: string[]): string {
  const first = texts[0] ?? "";
  let length = first.length;
  for (const text of texts) while (!text.startsWith(first.slice(0, length))) --length;
  return first.slice(0, length);
}

// One command per result: its configuration, narrowed to the cases by what their names begin with.
function commandsOf(cases: Case[]): string {
  const runs = [...new Set(cases.map((aCase) => aCase.run))];
  return runs
    .map((run) => {
      const names = cases.filter((aCase) => aCase.run === run).map((aCase) => aCase.raw.name);
      const start = commonStart(names).replace(/[^/]*$/, "");
      const filter = start ? ` --filter ${quoted(`^${escaped(start)}`)}` : "";
      return `clusterbench run ${quoted(`${run.result.name}.json`)}${filter} -o result.json`;
    })
    .join("\n");
}

function figureData<Row>(figure: Figure<Row>): HTMLElement {
  const table = figure.table();
  const text = () => csv(table.columns, table.rows);
  const commands = commandsOf(figure.cases);
  return h(
    "div",
    { class: "figure-data" },
    figure.chart ? tableView({ most: 200, ...table }) : null,
    h(
      "p",
      { class: "tools" },
      copyButton("Copy data", text),
      downloadButton("Download CSV", `${figure.id}.csv`, "text/csv", text),
    ),
    h("p", { class: "note" }, "Measured by this, with the configuration that stands at the end of the page:"),
    h(
      "div",
      { class: "command" },
      h("pre", { tabindex: 0, "aria-label": "Command that measured this" }, commands),
      copyButton("Copy command", () => commands),
    ),
  );
}

function legendView(entries: { label: string; colour: string }[]): HTMLElement {
  const swatch = (colour: string) => {
    const box = h("span", { class: "swatch" });
    box.style.background = colour; // through the object model: the page's policy refuses style attributes
    return box;
  };
  return h("ul", { class: "legend" }, ...entries.map(({ label, colour }) => h("li", {}, swatch(colour), label)));
}

function keysView(keys: Key[], hasLines: boolean): HTMLElement {
  const items = keys.map(({ label, look }) => h("li", { class: "method" }, icon(look, hasLines), label));
  return h("ul", { class: hasLines ? "legend" : "legend paper-only" }, ...items);
}

export function figureView<Row>(figure: Figure<Row>): HTMLElement {
  const details = h(
    "details",
    { id: `${figure.id}-data` },
    h("summary", {}, figure.chart ? "Table, data, command" : "Data, command"),
  );
  details.addEventListener("toggle", () => {
    if (details.open && !details.querySelector(".figure-data")) details.append(figureData(figure));
  });
  return h(
    "figure",
    { id: figure.id },
    h("figcaption", {}, h("h3", {}, figure.title), h("p", {}, figure.lead)),
    figure.controls?.length ? h("div", { class: "controls" }, ...figure.controls) : null,
    figure.legend && legendView(figure.legend),
    figure.methods && keysView(figure.methods, !!figure.hasLines),
    figure.chart ? scrolled({ class: "chart" }, figure.chart) : tableView({ most: 200, ...figure.table() }),
    details,
  );
}
