// What packed lights lose, and what a shader's own lookup loses.

import { columnsOf } from "./case_figures.ts";
import { h } from "./dom.ts";
import { figureView } from "./figure.ts";
import * as format from "./format.ts";
import type { Case } from "./model.ts";
import type { Lookup, Precision } from "./result.ts";
import { ofRuns } from "./runs.ts";
import type { Column } from "./table.ts";
import type { Section, View } from "./view.ts";

type Packed = { aCase: Case; precision: Precision };
type Looked = { aCase: Case; lookup: Lookup };

function packedColumns(view: View): Column<Packed>[] {
  const column = columnsOf(view.model.words, ({ aCase }: Packed) => aCase);
  return [
    { label: "method", value: ({ aCase }) => aCase.assigner },
    { label: "storage", value: ({ aCase }) => aCase.raw.storage },
    { label: "scene", value: ({ aCase }) => aCase.scene },
    { label: "grid", value: ({ aCase }) => aCase.grid },
    { label: "lights", value: ({ precision }) => precision.label },
    column("missed", "missed", { format: format.count }),
    column("deepest_miss", "deepest", { format: format.percent }),
    {
      label: "extra pairs",
      about: "Against float32",
      value: ({ precision }) => precision.extra_pairs?.ratio ?? null,
      show: ({ precision }) => format.percent(precision.extra_pairs?.ratio ?? null),
    },
    {
      label: "place off by",
      about: "At most",
      value: ({ precision }) => precision.position_error_m.max,
      show: ({ precision }) => format.metres(precision.position_error_m.max),
    },
  ];
}

const lookedColumns: Column<Looked>[] = [
  { label: "method", value: ({ aCase }) => aCase.assigner },
  {
    label: "storage",
    about: "What the lookup asks, with how its lights are packed; own: a light structure of the method's own",
    value: ({ aCase }) => aCase.storage,
  },
  { label: "scene", value: ({ aCase }) => aCase.scene },
  { label: "grid", value: ({ aCase }) => aCase.grid },
  { label: "logarithm", value: ({ lookup }) => lookup.logarithm },
  { label: "depth", value: ({ lookup }) => lookup.depth },
  { label: "needed", value: ({ lookup }) => lookup.needed, show: ({ lookup }) => format.count(lookup.needed) },
  { label: "missed", value: ({ lookup }) => lookup.missed, show: ({ lookup }) => format.count(lookup.missed) },
  {
    label: "wrong samples",
    value: ({ lookup }) => lookup.wrong_samples,
    show: ({ lookup }) => format.count(lookup.wrong_samples),
  },
  {
    label: "safe padding, ulps",
    value: ({ lookup }) => lookup.safe_padding_ulps,
    show: ({ lookup }) => format.count(lookup.safe_padding_ulps),
  },
];

function packedFigure(view: View): HTMLElement | null {
  const rows = view
    .cases()
    .flatMap((aCase) => (aCase.raw.precision ? [{ aCase, precision: aCase.raw.precision }] : []));
  if (rows.length === 0) return null;
  return figureView({
    id: "packed-lights",
    title: "Packed lights",
    lead: "The same methods on lights that were packed before the assigner saw them, against the same truth.",
    table: () => ({ caption: "Packed lights", columns: ofRuns(view, packedColumns(view)), rows }),
    cases: rows.map(({ aCase }) => aCase),
  });
}

function lookupFigure(view: View): HTMLElement | null {
  const rows = view.cases().flatMap((aCase) => (aCase.raw.lookup ?? []).map((lookup) => ({ aCase, lookup })));
  if (rows.length === 0) return null;
  return figureView({
    id: "lookup",
    title: "A shader's lookup",
    lead: "Samples whose single-precision lookup picks a cell whose list lacks a light that reaches them.",
    table: () => ({ caption: "A shader's lookup", columns: ofRuns(view, lookedColumns), rows }),
    cases: rows.map(({ aCase }) => aCase),
  });
}

export const precisionSection: Section = (view) => {
  const figures = [packedFigure(view), lookupFigure(view)];
  return figures.some(Boolean) ? h("section", { id: "precision" }, h("h2", {}, "Precision"), ...figures) : null;
};
