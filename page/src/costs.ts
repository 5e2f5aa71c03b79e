// Where a frame's time goes: copying the finished lists once, the rest of the assignment, converting to the storage.

import { figureView } from "./figure.ts";
import * as format from "./format.ts";
import type { Case } from "./model.ts";
import { chart, chartHeight, chartWidth, namesAside, Plot } from "./plots.ts";
import type { View } from "./view.ts";

interface Part {
  method: string;
  part: string;
  ns: number;
  share: number;
}

const parts = ["write floor", "rest of the assignment", "conversion"];

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
    .filter((aCase) => aCase.raw.timing && aCase.frameNs !== null)
    .sort((a, b) => a.frameNs! - b.frameNs!);
  if (timed.length === 0) return null;
  const methods = timed.map((aCase) => aCase.assigner);
  const whose = view.hasRuns ? ` · ${timed[0]!.run.label}` : ""; // a setting is of one result
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
              `${method}\n${part}: ${format.microseconds(ns)} µs, ${format.percent(share)}`,
          },
        ),
        Plot.text(timed, {
          x: 1,
          y: "assigner",
          text: (aCase: Case) => `${format.microseconds(aCase.frameNs)} µs`,
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
        {
          label: "frame µs",
          about: "Assignment and conversion",
          value: (aCase) => aCase.frameNs,
          show: (aCase) => format.microseconds(aCase.frameNs),
        },
        {
          label: "build µs",
          about: "Once per projection; within the assignment where the grid changes from frame to frame",
          value: (aCase) => aCase.raw.timing!.build_ns.median,
          show: (aCase) => format.microseconds(aCase.raw.timing!.build_ns.median),
        },
        { label: "assign µs", value: (aCase) => aCase.assignNs, show: (aCase) => format.microseconds(aCase.assignNs) },
        {
          label: "convert µs",
          about: "None where a method leaves its own structure",
          value: (aCase) => aCase.raw.timing!.convert_ns?.median ?? null,
          show: (aCase) => format.microseconds(aCase.raw.timing!.convert_ns?.median ?? null),
        },
        {
          label: "write floor µs",
          value: (aCase) => aCase.raw.timing!.write_floor_ns,
          show: (aCase) => format.microseconds(aCase.raw.timing!.write_floor_ns),
        },
        {
          label: "tests per frame",
          about: "Cells, rows, lights or planes that the method looks at one by one",
          value: (aCase) => aCase.raw.tests_done / aCase.raw.frames,
          show: (aCase) => format.count(aCase.raw.tests_done / aCase.raw.frames),
        },
        {
          label: "fallbacks per frame",
          about: "Pairs decided at greater cost than single precision",
          value: (aCase) => aCase.raw.fallbacks / aCase.raw.frames,
          show: (aCase) => format.decimal(aCase.raw.fallbacks / aCase.raw.frames),
        },
        {
          label: "scratch",
          about: "The method's own memory",
          value: (aCase) => aCase.raw.buffers.scratch_bytes,
          show: (aCase) => format.short(aCase.raw.buffers.scratch_bytes),
        },
      ],
      rows: timed,
    }),
    cases: timed,
  });
}
