// Frames of a case cell by cell: in space, slice by slice, and each cell's list.

import { colourOf, shownValue, type What } from "./cells/colours.ts";
import { type Details, type Frame, leftOut, unpacked, type Vec3 } from "./cells/details.ts";
import { canBeEven } from "./cells/even_depth.ts";
import { cellOf, type Geometry, geometryOf } from "./cells/geometry.ts";
import { pickedCell } from "./cells/picked_cell.ts";
import { pictureOf } from "./cells/picture.ts";
import {
  CellRows,
  countsAt,
  freshSelection,
  type LightsShown,
  most,
  type Selection,
  type Show,
  worstCell,
} from "./cells/selection.ts";
import { sliceMap } from "./cells/slice_map.ts";
import { type Space, space } from "./cells/space.ts";
import { legendView, pills, slider } from "./cells/widgets.ts";
import { select } from "./controls.ts";
import { h } from "./dom.ts";
import { count } from "./format.ts";
import type { CaseResult } from "./result.ts";

const sum = (row: Float64Array) => row.reduce((all, value) => all + value, 0);

function summary(frame: Frame, number: number, size: Vec3): string {
  const cells = `${count(frame.cells.length)} of ${count(size[0] * size[1] * size[2])} cells have lights`;
  const pairs = `${count(sum(frame.reported))} pairs reported, ${count(sum(frame.truth))} true`;
  const wrong = `${count(sum(frame.falsePositives))} false positives, ${count(sum(frame.falseNegatives))} false negatives`;
  return `Frame ${number}: ${cells}, ${pairs}; ${wrong}. Longest list: ${count(most(frame, "reported"))}.`;
}

class CellsView {
  readonly element: HTMLElement;
  private readonly frames = new Map<number, CellRows>(); // unpacked so far
  private readonly status = h("p", { role: "status", class: "note" });
  private readonly legend = h("div");
  private readonly mapName = h("h3");
  private readonly map = sliceMap((x, y) => this.pick([x, y, this.selection.cell[2]]));
  private readonly picked = h("div");
  private readonly frameSlider = slider("cells-frame", "Frame", (frame) => this.change({ frame }));
  private readonly leastSlider = slider("cells-least", "With at least", (below) => this.change({ least: below + 1 }));
  private readonly cellSliders = [
    this.cellSlider("column", "Tile column", 0),
    this.cellSlider("row", "Tile row", 1),
    this.cellSlider("slice", "Slice", 2),
  ];
  private readonly even: HTMLElement;

  constructor(
    private readonly aCase: CaseResult,
    private readonly details: Details,
    private readonly stage: Space | null,
    private readonly selection: Selection,
  ) {
    this.even = this.evenBox();
    selection.frame = Math.min(selection.frame, details.frames.length - 1);
    const side = h("div", {}, this.mapName, this.map.element, this.picked);
    this.element = h(
      "div",
      { class: "cells" },
      this.choices(),
      this.pickers(),
      this.status,
      this.legend,
      h("div", { class: "cells-panes" }, this.stagePane(), side),
      leftOut(details) && h("p", { class: "note" }, leftOut(details)),
    );
    this.draw();
    stage?.start();
    new ResizeObserver(() => this.drawMap()).observe(side);
    const drawAnew = () => this.element.isConnected && this.draw(); // the stage may be another view's by now
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", drawAnew);
    new MutationObserver(drawAnew).observe(document.documentElement, { attributeFilter: ["data-theme"] });
  }

  private get rows(): CellRows {
    const at = this.selection.frame;
    const rows = this.frames.get(at) ?? new CellRows(unpacked(this.details.frames[at]!, this.aCase.grid));
    this.frames.set(at, rows);
    return rows;
  }
  private get geometry(): Geometry {
    return geometryOf(this.aCase, this.rows.frame);
  }

  private cellSlider(id: string, label: string, axis: number) {
    return slider(`cells-${id}`, label, (value) =>
      this.pick(this.selection.cell.map((old, at) => (at === axis ? value : old)) as Vec3),
    );
  }
  private evenBox(): HTMLElement {
    const box = h("input", {
      type: "checkbox",
      id: "cells-even",
      checked: this.selection.isEven,
      onchange: () => this.changeDepth(box.checked),
    });
    return h("label", { class: "control" }, box, h("span", {}, "Slices equally deep"));
  }
  private choices(): HTMLElement {
    const { what, show, lights } = this.selection;
    const lists: [What, string][] = [
      ["reported", "Reported"],
      ["true", "True"],
      ["excess", "False positives"],
      ["missing", "False negatives"],
    ];
    const cells: [Show, string][] = [
      ["all", "All cells"],
      ["slice", "One slice"],
      ["tile", "One tile"],
    ];
    const lamps: [LightsShown, string][] = [
      ["cell", "of the picked cell"],
      ["all", "all"],
      ["none", "none"],
    ];
    return h(
      "div",
      { class: "controls" },
      pills("cells-what", "Lists", lists, what, (chosen) => this.change({ what: chosen })),
      ...(this.stage
        ? [
            pills("cells-show", "Cells", cells, show, (chosen) => this.change({ show: chosen })),
            this.leastSlider.element,
            select("cells-lights", "Lights", lamps, lights, (chosen) => this.change({ lights: chosen as LightsShown })),
            this.even,
          ]
        : []),
    );
  }
  private pickers(): HTMLElement {
    return h(
      "div",
      { class: "controls" },
      this.details.frames.length > 1 && this.frameSlider.element,
      ...this.cellSliders.map(({ element }) => element),
      h(
        "button",
        {
          type: "button",
          class: "quiet",
          id: "cells-worst",
          onclick: () => this.pick(worstCell(this.rows.frame, this.geometry, this.selection.what)),
        },
        "Pick the cell with most",
      ),
    );
  }
  private stagePane(): HTMLElement {
    if (!this.stage) return h("p", { class: "note" }, "This browser has no WebGL 2: cells are shown slice by slice.");
    const help =
      "Drag or arrow keys turn, with Shift they move; + and − zoom, and so does the wheel after a click; Home goes back. A click picks a cell.";
    return h("div", {}, this.stage.element, h("p", { class: "note" }, help));
  }

  private pick(cell: Vec3): void {
    this.change({ cell });
  }
  private changeDepth(isEven: boolean): void {
    this.change({ isEven });
    this.stage?.start();
  }
  private change(part: Partial<Selection>): void {
    Object.assign(this.selection, part);
    this.draw();
  }

  private draw(): void {
    const { selection, rows, geometry } = this,
      { frame } = rows;
    const { size } = geometry;
    if (selection.cell.some((value, axis) => value < 0 || value >= size[axis]!))
      selection.cell = worstCell(frame, geometry, "reported");
    const highest = most(frame, selection.what);
    selection.least = Math.min(selection.least, Math.max(highest, 1));

    const number = this.details.frames[selection.frame]!.frame;
    this.status.textContent = summary(frame, number, size);
    this.legend.replaceChildren(legendView(selection.what, highest));
    this.frameSlider.set(this.details.frames.length - 1, selection.frame, String(number));
    this.leastSlider.set(Math.max(highest, 1) - 1, selection.least - 1, count(selection.least));
    for (const [axis, bar] of this.cellSliders.entries())
      bar.set(size[axis]! - 1, selection.cell[axis]!, String(selection.cell[axis]));
    this.even.hidden = !canBeEven(geometry, frame.boundaries);

    const row = rows.rowOf(geometry, ...selection.cell);
    this.picked.replaceChildren(
      pickedCell(frame, geometry, { cell: selection.cell, row, counts: countsAt(frame, row) }),
    );
    this.drawMap();
    this.drawStage();
  }
  private drawMap(): void {
    const { selection, rows, geometry } = this,
      {
        what,
        cell: [column, row, slice],
      } = selection;
    const highest = most(rows.frame, what);
    this.mapName.textContent = `Slice ${slice}: ${geometry.sliceName(slice)}`;
    const colourAt = (x: number, y: number) => {
      const counts = countsAt(rows.frame, rows.rowOf(geometry, x, y, slice));
      return shownValue(what, counts) > 0 ? colourOf(what, counts, highest) : null;
    };
    this.map.draw(geometry, slice, [column, row], colourAt, `Map of slice ${slice}, tile ${column}, ${row} is picked`);
  }
  private drawStage(): void {
    if (!this.stage) return;
    const { rows, geometry } = this;
    const picture = pictureOf(rows, geometry, this.selection, this.stage.ink());
    const onPick = (instance: number) =>
      instance >= 0 && this.pick(cellOf(geometry.size, rows.frame.cells[picture.shown[instance]!]!));
    this.stage.show({ ...picture, onPick });
  }
}

// null for a case without details. The stage (null: no WebGL) and the selection may be used again for the next case.
export function cellsView(
  aCase: CaseResult,
  stage: Space | null = space(),
  selection: Selection = freshSelection(),
): HTMLElement | null {
  const { details } = aCase;
  if (!details) return null;
  if (details.frames.length === 0) return h("p", { class: "note" }, leftOut(details));
  return new CellsView(aCase, details, stage, selection).element;
}
