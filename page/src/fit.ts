// What slices that follow each frame save and risk, beside the same grid without.

import { h } from "./dom.ts";
import { figureView } from "./figure.ts";
import * as format from "./format.ts";
import type { Case } from "./model.ts";
import type { Fit, Maybe } from "./result.ts";
import { ofRuns } from "./runs.ts";
import type { Column } from "./table.ts";
import type { Section } from "./view.ts";

type Row = { aCase: Case; fit: Fit };

// A share that is saved.
function saved(label: string, about: string, of: (fit: Fit) => Maybe | undefined): Column<Row> {
  return {
    label,
    about,
    value: ({ fit }) => of(fit) ?? null,
    show: ({ fit }) => format.percent(of(fit) ?? null),
  };
}

const columns: Column<Row>[] = [
  { label: "method", value: ({ aCase }) => aCase.assigner },
  { label: "storage", value: ({ aCase }) => aCase.storage },
  { label: "scene", value: ({ aCase }) => aCase.scene },
  { label: "grid", value: ({ aCase }) => aCase.grid },
  {
    label: "ends at",
    about: "Last boundary, mean of the frames",
    value: ({ fit }) => fit.far.mean,
    show: ({ fit }) => format.metres(fit.far.mean),
  },
  saved("pairs saved", "Of the same grid that does not follow", (fit) => fit.saved.pairs),
  saved("excess saved", "False positives", (fit) => fit.saved.false_positives),
  saved("entries saved", "High-water mark of the entries to allocate", (fit) => fit.saved.index_entries),
  saved(
    "evaluated saved",
    "Lights that samples loop over, of the first set",
    (fit) => Object.values(fit.saved.evaluated)[0],
  ),
  {
    label: "new grids",
    about: "Frames with another grid than the frame before",
    value: ({ fit }) => fit.moves.changed,
    show: ({ fit }) => format.count(fit.moves.changed),
  },
  {
    label: "lists rewritten",
    about: "Share of the lists that differ from the frame before's",
    value: ({ fit }) => fit.fitted.lists_changed ?? null,
    show: ({ fit }) => format.percent(fit.fitted.lists_changed ?? null),
  },
  {
    label: "without fit",
    about: "The same share in the grid that does not follow",
    value: ({ fit }) => fit.unfitted.lists_changed ?? null,
    show: ({ fit }) => format.percent(fit.unfitted.lists_changed ?? null),
  },
];

export const fitSection: Section = (view) => {
  const rows = view.cases().flatMap((aCase) => (aCase.raw.fit ? [{ aCase, fit: aCase.raw.fit }] : []));
  if (rows.length === 0) return null;
  return h(
    "section",
    { id: "fit" },
    h("h2", {}, "Slices that follow"),
    figureView({
      id: "fit-table",
      title: "What following saves and risks",
      lead: "Each case beside the same in the grid that does not follow. Below 0 it costs.",
      table: () => ({
        caption: "Slices that follow",
        columns: ofRuns(view, columns),
        rows,
        sort: { column: view.hasRuns ? 9 : 8, descending: true },
      }),
      cases: rows.map(({ aCase }) => aCase),
    }),
  );
};
