// A cell in words: where it is, how long its list is, which lights are in it and which are lost.

import { h } from "../dom.ts";
import { tableView } from "../table.ts";
import { type Counts, css, marks } from "./colours.ts";
import type { Frame, Light, Mark, Vec3 } from "./details.ts";
import { type Geometry, metres } from "./geometry.ts";

const degrees = (angle: number) => `${Math.round((angle * 180) / Math.PI)}°`;
const plural = (count: number, word: string) => `${count} ${word}${count === 1 ? "" : "s"}`;

function lengths({ reported, truth, falsePositives, falseNegatives }: Counts): string {
  if (reported === 0 && truth === 0) return "Empty: no light is listed and none reaches it.";
  const wrong = [
    falsePositives && plural(falsePositives, "false positive"),
    falseNegatives && plural(falseNegatives, "false negative"),
  ].filter(Boolean);
  return `${plural(reported, "light")} in the list, ${truth} true; ${wrong.length ? wrong.join(", ") : "no error"}.`;
}

function markOf(mark: Mark): HTMLElement {
  const dot = h("span", { class: "swatch" });
  dot.style.background = css(marks[mark]!.colour);
  return h("span", {}, dot, marks[mark]!.word);
}

interface Entry {
  light: Light;
  mark: Mark;
  distance: number;
}

function listView(entries: Entry[]): HTMLElement {
  return tableView<Entry>({
    caption: "Lights of the picked cell",
    columns: [
      { label: "light", value: ({ light }) => light.name },
      { label: "is", value: ({ mark }) => marks[mark]!.word, show: ({ mark }) => markOf(mark) },
      {
        label: "kind",
        value: ({ light }) => (light.spot ? "spot" : "point"),
        show: ({ light }) => (light.spot ? `spot, ±${degrees(light.spot.halfAngle)}` : "point"),
      },
      {
        label: "range m",
        value: ({ light }) => light.range,
        show: ({ light }) => (light.range === Infinity ? "endless" : metres(light.range)),
      },
      {
        label: "from eye m",
        about: "From the eye to the light's place",
        value: ({ distance }) => distance,
        show: ({ distance }) => metres(distance),
      },
    ],
    rows: entries,
    most: 12,
  });
}

export interface Picked {
  cell: Vec3;
  row: number; // its index in the frame's rows; -1: empty
  counts: Counts;
}

export function pickedCell(frame: Frame, geometry: Geometry, { cell, row, counts }: Picked): HTMLElement {
  const [x, y, z] = cell;
  const pairs = row < 0 ? [] : (frame.listOf?.(row) ?? null);
  const entries = pairs
    ?.map((pair): Entry => ({ ...pair, distance: Math.hypot(...pair.light.position) }))
    .sort((a, b) => b.mark - a.mark);
  return h(
    "div",
    { class: "picked-cell" },
    h("h3", {}, `Cell ${x}, ${y}, ${z}`),
    h(
      "p",
      { role: "status" },
      geometry.isHole(x, y, z) ? "A hole: finer cells fill it." : `${geometry.sliceName(z)}. ${lengths(counts)}`,
    ),
    entries === undefined
      ? h("p", { class: "note" }, "The result has no lists of this frame, only their lengths.")
      : entries.length > 0 && listView(entries),
  );
}
