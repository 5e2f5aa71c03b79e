// The cases whose results carry details, one at a time.

import { freshSelection } from "./cells/selection.ts";
import { type Space, space } from "./cells/space.ts";
import { cellsView } from "./cells_view.ts";
import { choice } from "./controls.ts";
import { h } from "./dom.ts";
import type { Case } from "./model.ts";
import type { Section, View } from "./view.ts";

const nameOf = (view: View, aCase: Case) =>
  `${aCase.raw.name}${view.model.runs.length > 1 ? ` · ${aCase.run.label}` : ""}`;

const keyOf = (aCase: Case) => `${aCase.run.file}#${aCase.raw.id}`;

// The canvas and what is selected outlast redrawing: a page has few WebGL contexts, and a reader one train of thought.
export function cellsSection(): Section {
  let stage: Space | null | undefined;
  let shown: { aCase: Case; element: HTMLElement | null } | null = null;
  const selection = freshSelection();
  return (view, redraw) => {
    const cases = view.cases().filter((aCase) => aCase.raw.details);
    if (cases.length === 0) return null;
    const [key, control] = choice(
      view,
      redraw,
      "cells-case",
      "Case",
      cases.map((aCase) => [keyOf(aCase), nameOf(view, aCase)]),
    );
    const aCase = cases.find((other) => keyOf(other) === key)!;
    stage = stage === undefined ? space() : stage;
    if (shown?.aCase !== aCase) shown = { aCase, element: cellsView(aCase.raw, stage, selection) };
    return h(
      "section",
      { id: "cells" },
      h("h2", {}, "Cell by cell"),
      h("figure", {}, h("div", { class: "controls" }, control), shown.element),
    );
  };
}
