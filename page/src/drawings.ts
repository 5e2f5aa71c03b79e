// The drawings of the documents, from the same charts as the page's: charts.mjs calls them and keeps the SVG.

import { figure } from "./case_figures.ts";
import { h } from "./dom.ts";
import * as format from "./format.ts";
import { type Case, type Model, modelOf } from "./model.ts";
import { icon, paletteOf } from "./palette.ts";
import { chart, Plot } from "./plots.ts";
import type { PageData } from "./result.ts";
import { extent, logExtent, measures, panel, points, timeExtent } from "./speed_error.ts";
import { View } from "./view.ts";

const gap = 36;
const titleHeight = 22;

const viewOf = (data: PageData): View => {
  const model = modelOf(data);
  return new View(model, paletteOf(model));
};

// A picture cannot read the page's colours.
function withColours(text: string): string {
  const probe = h("span");
  document.body.append(probe);
  const short = text.replace(/\d+\.\d{3,}/g, (number) => String(Math.round(100 * Number(number)) / 100));
  return short.replace(/var\((--[\w-]+)\)/g, (_, name: string) => {
    probe.style.color = `var(${name})`;
    return getComputedStyle(probe).color;
  });
}

const textAt = (x: number, y: number, text: string, more = "") => {
  const shown = text.replaceAll("&", "&amp;").replaceAll("<", "&lt;");
  return `<text x="${x}" y="${y}" fill="var(--ink)" ${more}>${shown}</text>`;
};
const placedAt = (x: number, y: number, part: Element) => {
  part.setAttribute("x", String(x));
  part.setAttribute("y", String(y));
  return new XMLSerializer().serializeToString(part);
};

interface Panel {
  title: string;
  chart: Element;
}

// `title`: lines.
function picture(title: string[], panels: Panel[], columns: number, methods: Map<string, Element>): string {
  const size = (part: Element, side: string) => Number(part.getAttribute(side));
  const width = size(panels[0]!.chart, "width"),
    height = size(panels[0]!.chart, "height");
  const whole = columns * width + (columns - 1) * gap;
  const rows = Math.ceil(panels.length / columns),
    top = 16 + 18 * title.length,
    legendTop = top + rows * (height + titleHeight + 12) + 14;
  const perLine = Math.floor(whole / 210);
  const parts = panels.flatMap((drawn, at) => {
    const x = (at % columns) * (width + gap),
      y = top + Math.floor(at / columns) * (height + titleHeight + 12);
    return [textAt(x + 8, y + 14, drawn.title, 'font-weight="bold"'), placedAt(x, y + titleHeight, drawn.chart)];
  });
  const names = [...methods].map(([name, mark], at) => {
    const x = 8 + (at % perLine) * 210,
      y = legendTop + 20 * Math.floor(at / perLine);
    mark.setAttribute("width", "12");
    mark.setAttribute("height", "12");
    return placedAt(x, y - 10, mark) + textAt(x + 18, y, name);
  });
  const bottom = legendTop + 20 * Math.ceil(methods.size / perLine);
  return withColours(
    `<svg xmlns="http://www.w3.org/2000/svg" width="${whole}" height="${bottom}" viewBox="0 0 ${whole} ${bottom}" font-family="sans-serif" font-size="12">` +
      `<rect width="100%" height="100%" fill="var(--panel)"/>${title.map((line, at) => textAt(8, 18 + 18 * at, line)).join("")}${parts.join("")}${names.join("")}</svg>\n`,
  );
}

const legendOf = (view: View, model: Model) =>
  new Map(model.cases.map((aCase) => [aCase.assigner, icon(view.palette(aCase)) as Element]));

// Of the cases that have cells, a panel per scene.
function speedError(data: PageData): string {
  const view = viewOf(data),
    measure = measures["excess"]!;
  const all = points(view.model.cases, measure);
  const x = timeExtent(all);
  const panels = [...Map.groupBy(all, ({ aCase }) => aCase.scene)].map(([title, some]) => ({
    title,
    chart: panel(view, some, measure, { x, y: { domain: extent(some.map(({ error }) => error)), base: null } }, 470),
  }));
  return picture(
    [
      "time to make a frame's lists in µs (left is faster) against excess: false positives in % of the true pairs (lower is tighter)",
      "filled: SIMD; ring: on the Pareto front of time, bytes and overshade (its samples may lack up to 0.1 % of their lights)",
      "grey line: the ringed marks that no other ringed mark beats in both; bars: 95 % intervals of these times, hidden where the mark is wider",
    ],
    panels,
    2,
    legendOf(view, { ...view.model, cases: all.map(({ aCase }) => aCase) }),
  );
}

interface Curve {
  label: string;
  data: PageData; // of a page of one result
  sizes: Record<string, number>; // by the id of a case
}

const assignUs = (aCase: Case) => figure(aCase, "assign_us");

function scaling(curves: Curve[]): string {
  const views = curves.map(({ data }) => viewOf(data));
  const times = views.flatMap((view) => view.model.cases.map(assignUs).filter((us) => us !== null));
  const y = logExtent(times);
  const panels = curves.map(({ label, sizes }, at) => {
    const view = views[at]!;
    const rows = view.model.cases
      .filter((aCase) => assignUs(aCase) !== null && aCase.raw.id in sizes)
      .map((aCase) => ({ aCase, size: sizes[aCase.raw.id]!, us: assignUs(aCase)! }));
    const look = ({ aCase }: { aCase: Case }) => view.palette(aCase);
    return {
      title: label,
      chart: chart(label, {
        width: 350,
        height: 330,
        marginLeft: 56,
        x: { type: "log", label, ticks: 4, tickFormat: format.short, grid: true },
        y: { type: "log", domain: y, label: "assign µs", ticks: 6, tickFormat: format.short, grid: true },
        marks: [
          Plot.line(rows, {
            x: "size",
            y: "us",
            z: (row: (typeof rows)[number]) => row.aCase.assigner,
            sort: "size",
            stroke: (row: (typeof rows)[number]) => look(row).colour,
            strokeWidth: 1.5,
            strokeDasharray: "none",
          }),
          Plot.dot(rows, {
            x: "size",
            y: "us",
            r: 4,
            symbol: (row: (typeof rows)[number]) => look(row).shape,
            stroke: (row: (typeof rows)[number]) => look(row).colour,
            fill: (row: (typeof rows)[number]) => (look(row).isFilled ? look(row).colour : "var(--panel)"),
          }),
        ],
      }),
    };
  });
  const legend = new Map(views.flatMap((view) => [...legendOf(view, view.model)]));
  return picture(
    ["time of the assignment per frame, by lights, cells and range (both axes logarithmic)"],
    panels,
    3,
    legend,
  );
}

Object.assign(globalThis, { drawings: { "speed-error": speedError, scaling } });
