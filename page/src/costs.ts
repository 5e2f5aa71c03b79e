// Where a frame's time goes: copying the finished lists once, the rest of the assignment, converting to the storage.

import { columnsOf, figure } from "./case_figures.ts";
import { figureView } from "./figure.ts";
import * as format from "./format.ts";
import type { Case } from "./model.ts";
import { chart, chartHeight, chartWidth, namesAside, Plot } from "./plots.ts";
import type { Column } from "./table.ts";
import type { View } from "./view.ts";

interface Part {
  method: string;
  part: string;
  ns: number;
  share: number;
}

const parts = ["write floor", "rest of the assignment", "conversion"];

// The program's own words are for the sum over all frames.
const perFrameWords = {
  tests_done: {
    label: "tests per frame",
    about: "Tests of a light against a cell, a row of cells or a plane, mean of all frames",
  },
  fallbacks: {
    label: "fallbacks per frame",
    about: "Pairs that single precision could not decide, mean of all frames",
  },
};

// The write floor is measured with warm caches: so are the parts that stand beside it, where a result has them.
function partsOf(aCase: Case, name: string): Part[] {
  const { write_floor_ns, warm } = aCase.raw.timing!;
  const { assign_ns, convert_ns } = warm ?? aCase.raw.timing!;
  const [assign, convert, floor] = [assign_ns.median ?? 0, convert_ns?.median ?? 0, write_floor_ns ?? 0];
  const values = [floor, Math.max(0, assign - floor), convert];
  return values.map((ns, at) => ({
    method: name,
    part: parts[at]!,
    ns,
    share: ns / (Math.max(floor, assign) + convert || 1),
  }));
}

export function costs(view: View, cases: Case[]): HTMLElement | null {
  const timed = cases
    .filter((aCase) => aCase.raw.timing && aCase.frameUs !== null)
    .sort((a, b) => a.frameUs! - b.frameUs!);
  if (timed.length === 0) return null;
  const methods = timed.map((aCase) => aCase.assigner);
  const column = columnsOf(view.model.words, (aCase: Case) => aCase);
  const floorUs = (aCase: Case) => format.inUs(figure(aCase, "write_floor"));
  const perFrame = (name: keyof typeof perFrameWords, write: format.Format): Column<Case> => {
    const value = (aCase: Case) => figure(aCase, name)! / aCase.raw.frames;
    const { label, about } = perFrameWords[name];
    return column(name, label, { about, value, show: (aCase) => write(value(aCase)) });
  };
  const { run, machine } = timed[0]!; // a setting is of one result and machine
  const whose = [view.hasRuns && run.label, machine]
    .filter(Boolean)
    .map((name) => ` · ${name}`)
    .join("");
  return figureView({
    id: "costs",
    title: `Where a frame's time goes${whose}`,
    lead: "Write floor: copying the finished lists (or the method's own structure) and headers once, which no method can do without. Conversion: from lists to the storage's layout. Shares are of times with warm caches, as the write floor is; frame times are cold where they were measured. Fastest first.",
    chart: chart(`Shares of write floor, assignment and conversion of ${methods.join(", ")}`, {
      width: chartWidth(),
      height: 66 + chartHeight(24) * new Set(methods).size,
      ...namesAside([...new Set(methods)], chartWidth(), "method"),
      marginRight: 90,
      x: { label: "share of assignment and conversion, %", percent: true, ticks: chartWidth() < 500 ? 2 : 5 },
      color: { domain: parts, range: ["var(--part-0)", "var(--part-1)", "var(--part-2)"], legend: false },
      marks: [
        Plot.barX(
          timed.flatMap((aCase) => partsOf(aCase, aCase.assigner)),
          {
            x: "share",
            y: "method",
            fill: "part",
            inset: 1.5,
            insetLeft: 0.5,
            insetRight: 0.5,
            title: ({ method, part, ns, share }: Part) =>
              `${method}\n${part}: ${format.microseconds(format.inUs(ns))} µs, ${format.percent(share)}`,
          },
        ),
        Plot.text(timed, {
          x: 1,
          y: "assigner",
          text: (aCase: Case) => `${format.microseconds(aCase.frameUs)} µs`,
          textAnchor: "start",
          dx: 6,
          fill: "var(--ink)",
        }),
      ],
    }),
    legend: parts.map((label, at) => ({ label, colour: `var(--part-${at})` })),
    table: () => ({
      caption: "Costs",
      columns: [
        { label: "method", value: (aCase) => view.named(aCase) },
        column("frame_us", "frame µs"),
        column("build_us", "build µs", {
          note: "once per projection; within the assignment where the grid changes from frame to frame",
        }),
        column("assign_us", "assign µs"),
        column("convert_us", "convert µs", { note: "none where a method leaves its own structure" }),
        {
          ...column("write_floor", "write floor µs"),
          value: floorUs,
          show: (aCase) => format.microseconds(floorUs(aCase)),
        },
        perFrame("tests_done", format.count),
        perFrame("fallbacks", format.decimal),
        column("scratch_bytes", "scratch"),
      ],
      rows: timed,
    }),
    cases: timed,
  });
}
