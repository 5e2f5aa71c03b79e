// Tiles that react to a full buffer, and lists that have no room in one, each beside the same case without.

import { h } from "./dom.ts";
import { figureView } from "./figure.ts";
import * as format from "./format.ts";
import type { Case } from "./model.ts";
import type { Fallback, React, Saved } from "./result.ts";
import { ofRuns } from "./runs.ts";
import type { Column } from "./table.ts";
import type { Section } from "./view.ts";

type Of<Part> = { aCase: Case; part: Part };

function names<Part>(): Column<Of<Part>>[] {
  return [
    { label: "method", value: ({ aCase }) => aCase.assigner },
    { label: "storage", value: ({ aCase }) => aCase.storage },
    { label: "scene", value: ({ aCase }) => aCase.scene },
    { label: "grid", value: ({ aCase }) => aCase.grid },
  ];
}

function counted<Part>(label: string, about: string, of: (part: Part) => number): Column<Of<Part>> {
  return { label, about, value: ({ part }) => of(part), show: ({ part }) => format.count(of(part)) };
}

// Shares that are saved; below 0 it costs.
function shares<Part extends { saved?: Saved }>(): Column<Of<Part>>[] {
  const share = (label: string, about: string, of: (saved: Saved) => number | null): Column<Of<Part>> => ({
    label,
    about,
    value: ({ part }) => (part.saved ? of(part.saved) : null),
    show: ({ part }) => format.percent(part.saved ? of(part.saved) : null),
  });
  return [
    share("entries saved", "High-water mark of the entries to allocate", (saved) => saved.index_entries),
    share(
      "evaluated saved",
      "Lights that samples loop over, of the first set",
      (saved) => Object.values(saved.evaluated)[0] ?? null,
    ),
  ];
}

const tileColumns: Column<Of<React>>[] = [
  ...names<React>(),
  counted("reacted", "Frames with other tiles than asked for", (part) => part.frames.reacted),
  counted("over", "Frames that need more than there is room for", (part) => part.frames.over),
  counted("changed", "Frames with other tiles than the frame before", (part) => part.moves.changed),
  ...shares<React>(),
];

const listColumns: Column<Of<Fallback>>[] = [
  ...names<Fallback>(),
  counted("frames", "With a cell that reads all lights for want of room", (part) => part.frames),
  counted("cells", "That read all lights, over all frames", (part) => part.cells),
  ...shares<Fallback>(),
];

export const reactSection: Section = (view) => {
  const tiles = view.cases().flatMap((aCase) => (aCase.raw.react ? [{ aCase, part: aCase.raw.react }] : []));
  const lists = view.cases().flatMap((aCase) => (aCase.raw.fallback ? [{ aCase, part: aCase.raw.fallback }] : []));
  if (tiles.length + lists.length === 0) return null;
  const figure = <Part>(id: string, title: string, lead: string, columns: Column<Of<Part>>[], rows: Of<Part>[]) =>
    rows.length === 0
      ? []
      : [
          figureView({
            id,
            title,
            lead,
            table: () => ({
              caption: title,
              columns: ofRuns(view, columns),
              rows,
              sort: { column: view.hasRuns ? 5 : 4, descending: true },
            }),
            cases: rows.map(({ aCase }) => aCase),
          }),
        ];
  return h(
    "section",
    { id: "react" },
    h("h2", {}, "Where buffers are too small"),
    ...figure(
      "react-table",
      "Tiles that react",
      "Each case beside the same in the tiles asked for. Below 0 it costs.",
      tileColumns,
      tiles,
    ),
    ...figure(
      "fallback-table",
      "Lists without room",
      "Each case beside the same with room for all lists. Below 0 it costs.",
      listColumns,
      lists,
    ),
  );
};
