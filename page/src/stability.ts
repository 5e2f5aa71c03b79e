// How lists change along finely sampled steps of the camera, beside how the truth does.

import { columnsOf } from "./case_figures.ts";
import { h } from "./dom.ts";
import { figureView } from "./figure.ts";
import * as format from "./format.ts";
import type { Case } from "./model.ts";
import type { Stability } from "./result.ts";
import { ofRuns } from "./runs.ts";
import type { Column } from "./table.ts";
import type { Section, View } from "./view.ts";

type Row = { aCase: Case; stability: Stability };

function columnsIn(view: View): Column<Row>[] {
  const column = columnsOf(view.model.words, ({ aCase }: Row) => aCase);
  return [
    { label: "method", value: ({ aCase }) => aCase.assigner },
    { label: "scene", value: ({ aCase }) => aCase.scene },
    { label: "grid", value: ({ aCase }) => aCase.grid },
    { label: "steps", value: ({ stability }) => stability.steps },
    column("changed_pairs", "changes per step", { format: format.decimal }),
    {
      label: "truth's",
      about: "Changes of the true lists per step",
      value: ({ stability }) => stability.changed.truth.mean,
      show: ({ stability }) => format.decimal(stability.changed.truth.mean),
    },
    {
      label: "excess churn",
      about: "Changes beyond the truth's, by the truth's",
      value: ({ stability }) => stability.excess_churn.ratio,
      show: ({ stability }) => format.percent(stability.excess_churn.ratio),
    },
    column("flickers", "flickers", { format: format.count }),
    {
      label: "truth's flickers",
      value: ({ stability }) => stability.flickers.truth,
      show: ({ stability }) => format.count(stability.flickers.truth),
    },
    {
      label: "most in a step",
      value: ({ stability }) => stability.changed.method.max,
      show: ({ stability }) => format.count(stability.changed.method.max),
    },
  ];
}

export const stabilitySection: Section = (view) => {
  const rows = view
    .cases()
    .flatMap((aCase) => (aCase.raw.stability ? [{ aCase, stability: aCase.raw.stability }] : []));
  if (rows.length === 0) return null;
  const paths = [...new Set(rows.map(({ aCase, stability }) => `${aCase.scene}: ${stability.path}`))];
  return h(
    "section",
    { id: "stability" },
    h("h2", {}, "Stability"),
    figureView({
      id: "stability-table",
      title: "Changes and flickers along small steps of the camera",
      lead: `${paths.slice(0, 6).join(". ")}.`,
      table: () => ({
        caption: "Stability",
        columns: ofRuns(view, columnsIn(view)),
        rows,
        sort: { column: view.hasRuns ? 7 : 6, descending: false },
      }),
      cases: rows.map(({ aCase }) => aCase),
    }),
  );
};
