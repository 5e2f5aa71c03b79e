// A table that sorts by any of its columns, by mouse and keyboard.

import { breakable, type Child, h } from "./dom.ts";
import { scrolled } from "./scrolled.ts";

export type Value = number | string | null;

export interface Column<Row> {
  label: string;
  about?: string; // what it is, for those who hover or listen
  value: (row: Row) => Value; // sorted by, copied and downloaded
  show?: (row: Row) => Child; // displayed in place of the value
  isDetail?: boolean; // shown on request
  isScreenOnly?: boolean; // left out on paper, which says so
  isUnderFirst?: boolean; // stands under the first column where there is no room beside it
}

export interface Table<Row> {
  caption: string;
  columns: Column<Row>[];
  rows: Row[];
  sort?: { column: number; descending: boolean; last?: (row: Row) => boolean }; // last: stands behind the others at first
  most?: number; // rows shown until all are asked for
}

type Sort<Row> = NonNullable<Table<Row>["sort"]>;

const isNumeric = <Row>(column: Column<Row>, rows: Row[]) => rows.some((row) => typeof column.value(row) === "number");

// Nothing known comes last whichever way a column is sorted.
function compare(a: Value, b: Value): number {
  if (a === null || b === null) return 0;
  return typeof a === "number" && typeof b === "number"
    ? a - b
    : String(a).localeCompare(String(b), "en", { numeric: true });
}

function sorted<Row>(rows: Row[], column: Column<Row>, { descending, last = () => false }: Sort<Row>): Row[] {
  const part = (row: Row) => (last(row) ? 2 : column.value(row) === null ? 1 : 0);
  return [...rows].sort(
    (a, b) => part(a) - part(b) || (descending ? -1 : 1) * compare(column.value(a), column.value(b)),
  );
}

const classesOf = <Row>(column: Column<Row>, numeric: boolean) =>
  [numeric && "number", column.isScreenOnly && "screen-only", column.isUnderFirst && "under-first"]
    .filter(Boolean)
    .join(" ") || null;

function cell<Row>(column: Column<Row>, row: Row, isHeader: boolean, numeric: boolean): HTMLElement {
  const shown = column.show ? column.show(row) : column.value(row);
  const text = shown === null || shown === undefined ? "–" : shown;
  const content = typeof text === "object" ? text : numeric ? String(text) : breakable(String(text));
  return isHeader ? h("th", { scope: "row" }, content) : h("td", { class: classesOf(column, numeric) }, content);
}

export function tableView<Row>(table: Table<Row>): HTMLElement {
  const { columns } = table;
  const numeric = columns.map((column) => isNumeric(column, table.rows));
  let sort: Sort<Row> | null = table.sort ?? null;
  let most = table.most ?? Infinity;

  const body = h("tbody");
  const more = h("button", { class: "more", onclick: () => showAll() });
  const heads = columns.map((column, at) =>
    h(
      "th",
      { scope: "col", class: classesOf(column, numeric[at]!), title: column.about },
      h("button", { onclick: () => sortBy(at) }, column.label),
    ),
  );

  function draw(): void {
    const rows = sort ? sorted(table.rows, columns[sort.column]!, sort) : table.rows;
    body.replaceChildren(
      ...rows
        .slice(0, most)
        .map((row) => h("tr", {}, ...columns.map((column, at) => cell(column, row, at === 0, numeric[at]!)))),
    );
    heads.forEach((head, at) => {
      if (sort?.column === at) head.setAttribute("aria-sort", sort.descending ? "descending" : "ascending");
      else head.removeAttribute("aria-sort");
    });
    more.hidden = rows.length <= most;
    more.textContent = `Show all ${rows.length} rows`;
  }
  function sortBy(column: number): void {
    sort = { column, descending: sort?.column === column && !sort.descending };
    draw();
  }
  function showAll(): void {
    most = Infinity;
    draw();
  }

  draw();
  const leftOut = columns.filter((column) => column.isScreenOnly).map(({ label }) => label);
  return scrolled(
    { class: "table", tabindex: 0, role: "region", "aria-label": table.caption },
    h("table", {}, h("caption", {}, table.caption), h("thead", {}, h("tr", {}, ...heads)), body),
    more,
    leftOut.length > 0 &&
      h("p", { class: "note paper-only" }, `Columns that only the page on a screen shows: ${leftOut.join(", ")}.`),
  );
}
