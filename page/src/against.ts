// One result against another: the cases that both have, by their ids.

import { columnsOf, figure } from "./case_figures.ts";
import { choice, type Option } from "./controls.ts";
import { h } from "./dom.ts";
import { figureView } from "./figure.ts";
import * as format from "./format.ts";
import { hasMachines } from "./machines.ts";
import type { Case, Run } from "./model.ts";
import { chart, chartWidth, namesAside, Plot } from "./plots.ts";
import type { Maybe } from "./result.ts";
import type { Column } from "./table.ts";
import type { Section, View } from "./view.ts";

interface Both {
  first: Case;
  second: Case;
  time: Maybe; // second by first; none where a result is of several machines, as `compare` has it
  bytes: Maybe;
}

const by = (second: Maybe, first: Maybe): Maybe => (second === null || !first ? null : second / first);

function bothOf(cases: Case[], first: Run, second: Run): Both[] {
  const others = new Map(cases.filter((aCase) => aCase.run === first).map((aCase) => [aCase.raw.id, aCase]));
  return cases
    .filter((aCase) => aCase.run === second && others.has(aCase.raw.id))
    .map((aCase) => {
      const other = others.get(aCase.raw.id)!;
      return {
        first: other,
        second: aCase,
        time: hasMachines([aCase, other]) ? null : by(aCase.frameUs, other.frameUs),
        bytes: by(figure(aCase, "bytes"), figure(other, "bytes")),
      };
    });
}

const change = (value: Maybe) =>
  value === null ? "–" : `${value >= 1 ? "+" : "−"}${(100 * Math.abs(value - 1)).toFixed(1)} %`;

function ratios(view: View, rows: Both[], first: Run, second: Run): Element {
  const timed = rows.filter((row) => row.time !== null);
  const methods = [...new Set(timed.map((row) => row.second.assigner))];
  const look = (row: Both) => view.palette(row.second);
  const values = timed.map((row) => row.time!);
  const most = 1.1 * values.reduce((far, value) => Math.max(far, value, 1 / value), 1.05);
  return chart(`Frame time of ${second.label} by that of ${first.label}, ${format.plural(timed.length, "case")}`, {
    width: chartWidth(),
    height: 66 + 22 * methods.length,
    ...namesAside(methods, chartWidth(), "method"),
    x: {
      type: "log",
      domain: [1 / most, most],
      label: `frame time, ${second.label} / ${first.label}`,
      ticks: 7,
      tickFormat: (value: number) => format.decimal(value),
      grid: true,
    },
    marks: [
      Plot.ruleX([1], { stroke: "var(--ink-2)" }),
      Plot.dot(timed, {
        x: "time",
        y: (row: Both) => row.second.assigner,
        r: 4.5,
        symbol: (row: Both) => look(row).shape,
        stroke: (row: Both) => look(row).colour,
        fill: (row: Both) => (look(row).isFilled ? look(row).colour : "var(--panel)"),
      }),
      Plot.tip(
        timed,
        Plot.pointer({
          x: "time",
          y: (row: Both) => row.second.assigner,
          title: (row: Both) =>
            `${row.second.raw.name}\n${first.label}: ${format.microseconds(row.first.frameUs)} µs\n${second.label}: ${format.microseconds(row.second.frameUs)} µs\n${change(row.time)}`,
        }),
      ),
    ],
  });
}

const lead =
  "A dot is a case that both results have; left of the line the second is faster. Times of two runs of one program can differ several-fold: hints only. `clusterbench compare` says what has changed.";
const leadOfSeveral =
  "Cases that both results have. Times are left out: one of the results is of several machines. `clusterbench compare` on the results of their shards compares times.";

const timeColumn: Column<Both> = {
  label: "time",
  about: "Change of the frame time",
  value: (row) => row.time,
  show: (row) => change(row.time),
};

export const againstSection: Section = (view, redraw) => {
  if (!view.hasRuns) return null;
  const { runs } = view.model;
  const options = runs.slice(1).map((run): Option => [run.label, run.label]);
  const [key, control] = choice(view, redraw, "against-result", `Against ${runs[0]!.label}`, options);
  const first = runs[0]!,
    second = runs.find((run) => run.label === key)!;
  const rows = bothOf(view.casesOfEachRun(), first, second);
  const heading = h("h2", {}, "One result against another");
  if (rows.length === 0)
    return h(
      "section",
      { id: "against" },
      heading,
      h("div", { class: "controls" }, control),
      h(
        "p",
        { class: "note" },
        `No cases: ${second.label} and ${first.label} have none in common, or none that the filters leave. A level before and after a change: clusterbench run LEVEL --baseline BEFORE.json.`,
      ),
    );
  const isOfSeveral = hasMachines(rows.flatMap((row) => [row.first, row.second]));
  const isTimed = rows.some((row) => row.time !== null);
  const ofFirst = columnsOf(view.model.words, (row: Both) => row.first),
    ofSecond = columnsOf(view.model.words, (row: Both) => row.second);
  return h(
    "section",
    { id: "against" },
    heading,
    figureView({
      id: "against-first",
      title: `${second.label} against ${first.label}`,
      lead: isOfSeveral ? leadOfSeveral : lead,
      controls: [control],
      chart: isTimed ? ratios(view, rows, first, second) : undefined,
      table: () => ({
        caption: `${second.label} against ${first.label}`,
        columns: [
          { label: "method", value: (row) => row.second.assigner },
          ...(isOfSeveral ? [] : [timeColumn]),
          ofFirst("excess", `excess, ${first.label}`, { format: format.percent }),
          ofSecond("excess", `excess, ${second.label}`, { format: format.percent }),
          ...(isOfSeveral
            ? []
            : [ofFirst("frame_us", `frame µs, ${first.label}`), ofSecond("frame_us", `frame µs, ${second.label}`)]),
          {
            label: "bytes",
            about: "Change of the high-water mark",
            value: (row) => row.bytes,
            show: (row) => change(row.bytes),
          },
          { label: "scene", value: (row) => row.second.scene },
          { label: "grid", value: (row) => row.second.grid },
          { label: "storage", value: (row) => row.second.storage },
        ],
        rows,
        sort: { column: 1, descending: true },
      }),
      cases: rows.map((row) => row.second),
    }),
  );
};
