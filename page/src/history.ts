// The page of `clusterbench history show`: a chart for each series that varies, with the commits at which it changed.

import { h } from "./dom.ts";
import { plural } from "./format.ts";
import { chart, Plot } from "./plots.ts";
import { themeControl } from "./theme.ts";

interface Change {
  index: number; // of the first commit after it
  text: string; // a sentence
  direction: "better" | "worse" | "";
}

interface Series {
  metric: string;
  unit: string;
  case: string;
  machine: string; // "" for what is counted
  since: string; // the commit from which on the case has other settings, or ""
  commits: string[];
  values: number[];
  changes: Change[];
}

// What src/report/history/history_page.cpp puts into the page.
interface HistoryData {
  entries: number;
  count: number; // of series, those that never changed included
  lights: string[]; // sentences: where a scene or its lights have changed
  series: Series[];
}

const mostAtOnce = 60; // charts, until more are asked for
const five = (value: number) => String(Number(value.toPrecision(5)));

function drawn(series: Series): Element {
  const points = series.values.map((value, at) => ({ at, value, commit: series.commits[at]! }));
  const changes = series.changes.map((change) => ({ ...change, x: change.index - 0.5 }));
  const name = `${series.metric} in ${series.unit} of ${series.case}, ${plural(points.length, "value")} from ${five(Math.min(...series.values))} to ${five(Math.max(...series.values))}`;
  return chart(name, {
    width: 380,
    height: 170,
    marginLeft: 62,
    marginBottom: 34,
    x: {
      label: "commit",
      ticks: Math.min(5, points.length),
      tickFormat: (at: number) => series.commits[at]?.slice(0, 8) ?? "",
      domain: [0, Math.max(1, points.length - 1)],
    },
    y: { label: series.unit, ticks: 4, grid: true, tickFormat: "~s" },
    marks: [
      Plot.ruleX(changes, {
        x: "x",
        stroke: (change: Change) =>
          change.direction === "worse"
            ? "var(--bad)"
            : change.direction === "better"
              ? "var(--method-1)"
              : "var(--ink-2)",
        strokeDasharray: "4 3",
        strokeWidth: 1.5,
      }),
      Plot.line(points, { x: "at", y: "value", stroke: "var(--method-2)", strokeWidth: 1.8 }),
      Plot.dot(points, { x: "at", y: "value", fill: "var(--method-2)", r: 3 }),
      Plot.tip(
        points,
        Plot.pointer({
          x: "at",
          y: "value",
          title: ({ commit, value }: (typeof points)[number]) => `${commit}\n${five(value)} ${series.unit}`,
        }),
      ),
    ],
  });
}

function figure(series: Series): HTMLElement {
  const { values, unit, machine, since } = series;
  const facts = [
    `${five(values[0]!)} to ${five(values.at(-1)!)} ${unit}${machine && ` on ${machine}`}`,
    since && `other settings than before, from ${since} on`,
  ].filter(Boolean);
  return h(
    "figure",
    {},
    h("figcaption", {}, h("h2", {}, series.metric), h("p", {}, series.case), h("p", {}, facts.join("; "))),
    h("div", { class: "chart" }, drawn(series) as HTMLElement),
    series.changes.length > 0 &&
      h(
        "ul",
        { class: "changes" },
        ...series.changes.map((change) => h("li", { class: change.direction }, change.text)),
      ),
  );
}

function show({ entries, count, lights, series }: HistoryData): void {
  const changes = series.reduce((sum, { changes }) => sum + changes.length, 0);
  const figures = h("div", { class: "series" });
  const more = h("button", { class: "more", onclick: () => add() });
  let shown = 0;
  function add(): void {
    figures.append(...series.slice(shown, shown + mostAtOnce).map(figure));
    shown = Math.min(series.length, shown + mostAtOnce);
    more.hidden = shown === series.length;
    more.textContent = `Show more of the ${series.length} charts`;
  }
  add();
  document.title = "clusterbench history";
  document.body.prepend(
    h("header", {}, h("div", { class: "title" }, h("h1", {}, "clusterbench history"), h("p", {}), themeControl())),
    h(
      "main",
      {},
      h(
        "p",
        { class: "summary" },
        `${plural(entries, "result")}, ${plural(count, "series", "series")}, ${plural(changes, "change")} (dashed lines). Axes begin at the lowest value, not at 0. ${count - series.length} series never changed and are not drawn.`,
      ),
      lights.length > 0 && h("ul", { class: "changes" }, ...lights.map((change) => h("li", {}, change))),
      figures,
      more,
    ),
  );
}

show(JSON.parse(document.getElementById("results")!.textContent!) as HistoryData);
document.documentElement.dataset["ready"] = String(Math.round(performance.now())); // ms, for tests
