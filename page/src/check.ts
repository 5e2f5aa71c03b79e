// The page of `clusterbench check`: verdicts, and the cells that lose lights in space with their lists.

import type { Frame, Light, Mark, Vec3 } from "./cells/details.ts";
import { cellOf, type Geometry, metres } from "./cells/geometry.ts";
import { pickedCell } from "./cells/picked_cell.ts";
import { pictureOf } from "./cells/picture.ts";
import { CellRows, countsAt, freshSelection, type LightsShown, type Selection } from "./cells/selection.ts";
import { space } from "./cells/space.ts";
import { pills } from "./cells/widgets.ts";
import { select } from "./controls.ts";
import { h } from "./dom.ts";
import { count, plural } from "./format.ts";
import type { CheckPage } from "./schema_types.ts";
import { tableView } from "./table.ts";
import { themeControl } from "./theme.ts";

type PageFrame = CheckPage["frames"][number];
type PageCell = PageFrame["sets"][number]["cells"][number];
type Colouring = "count" | "reach";

function geometryOf({ grid, checked }: PageFrame): Geometry {
  const { shape, x, y, z } = grid;
  const isWorld = checked.grid_kind === "world";
  const ordered = (a: number, b: number): [number, number] => (a < b ? [a, b] : [b, a]);
  const ends = (k: number) => ordered(Math.abs(z[k]!), Math.abs(z[k + 1]!));
  return {
    shape,
    size: [x.length - 1, y.length - 1, z.length - 1],
    block: (i, j, k) => [x[i]!, x[i + 1]!, ...ordered(y[j]!, y[j + 1]!), ...ordered(z[k]!, z[k + 1]!)],
    isHole: () => false,
    topDown: !isWorld,
    sliceName: (k) =>
      isWorld
        ? `z ${metres(z[k]!)} to ${metres(z[k + 1]!)} m from the grid's origin`
        : `${metres(ends(k)[0])} to ${metres(ends(k)[1])} m ${shape === "shells" ? "from the eye" : "deep"}`,
    rotation: grid.rotation,
    origin: grid.origin,
  };
}

function lightsOf({ lights }: PageFrame): Map<number, Light> {
  return new Map(
    lights.map((light) => [
      light.index,
      {
        name: String(light.index),
        position: light.position as Vec3,
        range: light.range_m ?? Infinity,
        spot: light.direction ? { axis: light.direction as Vec3, halfAngle: light.half_angle_rad! } : null,
      },
    ]),
  );
}

// The cells as the view of a case has them; `weight` in the place of the number of lost lights.
function frameOf(page: PageFrame, cells: PageCell[], weight: (cell: PageCell) => number): Frame {
  const lights = lightsOf(page);
  const numbers = (value: (cell: PageCell) => number) => Float64Array.from(cells, value);
  const marked = (indices: number[], mark: Mark) => indices.map((index) => ({ light: lights.get(index)!, mark }));
  return {
    camera: { sides: page.sides, orthographic: page.orthographic, far_m: null } as unknown as Frame["camera"],
    boundaries: page.checked.grid_kind === "world" ? [] : page.grid.z.map(Math.abs),
    tiles: undefined,
    box: undefined,
    cells: numbers((cell) => cell.index),
    reported: numbers((cell) => cell.listed.length),
    truth: numbers((cell) => cell.listed.length - cell.excess.length + cell.lost.length),
    falsePositives: numbers((cell) => cell.excess.length),
    falseNegatives: numbers(weight),
    lights: [...lights.values()],
    listOf: (row) => {
      const { listed, lost, excess } = cells[row]!;
      const isExcess = new Set(excess);
      const right = listed.filter((index) => !isExcess.has(index));
      return [...marked(lost, 2), ...marked(excess, 1), ...marked(right, 0)];
    },
  } as Frame;
}

const weights: Record<Colouring, (cell: PageCell) => number> = {
  count: (cell) => cell.lost.length,
  reach: (cell) => Math.max(1, Math.ceil(cell.reach_percent)),
};
const legends: Record<Colouring, string> = {
  count: "Brighter: more lights are lost in the cell",
  reach: "Brighter: a lost light reaches deeper into the cell, in percent of its range",
};

function legend(colouring: Colouring, highest: number): HTMLElement {
  const bar = h("span", { class: "scale" });
  bar.style.background = "linear-gradient(to right, rgb(150 20 110), rgb(205 50 150), rgb(245 110 195))";
  const unit = colouring === "reach" ? " %" : "";
  return h("p", { class: "legend" }, `${legends[colouring]}: 1${unit}`, bar, `${count(highest)}${unit}`);
}

// A set of a frame whose cells lose lights.
class LosingCells {
  readonly element: HTMLElement;
  private readonly stage = space();
  private readonly selection: Selection = { ...freshSelection(), what: "missing", lights: "cell" };
  private readonly geometry: Geometry;
  private readonly frames: Record<Colouring, Frame>;
  private readonly legendPlace = h("div");
  private readonly picked = h("div");
  private colouring: Colouring = "count";

  constructor(
    page: PageFrame,
    private readonly cells: PageCell[],
  ) {
    this.geometry = geometryOf(page);
    this.frames = { count: frameOf(page, cells, weights.count), reach: frameOf(page, cells, weights.reach) };
    this.selection.cell = cellOf(this.geometry.size, cells[0]!.index);
    this.element = h(
      "div",
      { class: "cells" },
      this.controls(),
      this.legendPlace,
      h(
        "div",
        { class: "cells-panes" },
        this.stagePane(),
        h("div", {}, this.picked, h("h3", {}, "Cells that lose lights"), this.table()),
      ),
    );
    this.draw();
    this.stage?.start();
    const drawAnew = () => this.element.isConnected && this.draw();
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", drawAnew);
    new MutationObserver(drawAnew).observe(document.documentElement, { attributeFilter: ["data-theme"] });
  }

  private controls(): HTMLElement {
    const colourings: [Colouring, string][] = [
      ["count", "Lights lost"],
      ["reach", "How deep"],
    ];
    const lamps: [LightsShown, string][] = [
      ["cell", "of the picked cell"],
      ["all", "all of these cells"],
      ["none", "none"],
    ];
    const { lights, isEven } = this.selection;
    const even = h("input", {
      type: "checkbox",
      id: "check-even",
      checked: isEven,
      onchange: () => {
        this.change({ isEven: even.checked });
        this.stage?.start();
      },
    });
    return h(
      "div",
      { class: "controls" },
      pills("check-colour", "Colour", colourings, this.colouring, (chosen) => {
        this.colouring = chosen;
        this.draw();
      }),
      select("check-lights", "Lights", lamps, lights, (chosen) => this.change({ lights: chosen as LightsShown })),
      h("label", { class: "control" }, even, h("span", {}, "Slices equally deep")),
    );
  }

  private stagePane(): HTMLElement {
    if (!this.stage) return h("p", { class: "note" }, "This browser has no WebGL 2: cells are shown as a table.");
    const help =
      "Drag or arrow keys turn, with Shift they move; + and − zoom, and so does the wheel after a click; Home goes back. A click picks a cell. Shown are only cells that lose lights.";
    return h("div", {}, this.stage.element, h("p", { class: "note" }, help));
  }

  private table(): HTMLElement {
    const place = (cell: PageCell) => cellOf(this.geometry.size, cell.index);
    const pick = (cell: PageCell) =>
      h("button", { class: "quiet", onclick: () => this.change({ cell: place(cell) }) }, place(cell).join(", "));
    return tableView<PageCell>({
      caption: "Cells that lose lights",
      columns: [
        { label: "cell", value: ({ index }) => index, show: pick },
        { label: "lost", value: ({ lost }) => lost.length },
        {
          label: "reaches in %",
          value: ({ reach_percent }) => reach_percent,
          show: (cell) => metres(cell.reach_percent),
        },
        { label: "in the list", value: ({ listed }) => listed.length },
      ],
      rows: this.cells,
      most: 10,
    });
  }

  private change(part: Partial<Selection>): void {
    Object.assign(this.selection, part);
    this.draw();
  }

  private draw(): void {
    const { geometry, selection } = this;
    const frame = this.frames[this.colouring];
    const row = new CellRows(this.frames.count).rowOf(geometry, ...selection.cell);
    const counts = countsAt(this.frames.count, row);
    this.legendPlace.replaceChildren(legend(this.colouring, Math.max(...frame.falseNegatives)));
    this.picked.replaceChildren(pickedCell(this.frames.count, geometry, { cell: selection.cell, row, counts }));
    if (!this.stage) return;
    const picture = pictureOf(new CellRows(frame), geometry, selection, this.stage.ink());
    const onPick = (instance: number) =>
      instance >= 0 && this.change({ cell: cellOf(geometry.size, frame.cells[picture.shown[instance]!]!) });
    this.stage.show({ ...picture, onPick });
  }
}

const verdicts: Record<string, string> = {
  right: "right: no light is lost",
  rounding: "lost within rounding",
  empty: "nothing was checked: no light reaches a cell",
  twice: "lights twice in a list",
  lost: "lights are lost",
  misread: "probably misread: another description of the dump fits far better",
  unreadable: "no lists: values cannot be right",
};

function setFacts(set: PageFrame["checked"]["sets"][number]): HTMLElement {
  const { error } = set;
  const other = set.other_reading;
  const lines = [
    error &&
      `${count(error.lost_pairs)} of ${count(error.true_pairs)} true pairs are lost, ${count(error.false_positives)} of ${count(error.listed_pairs)} listed ones are for nothing`,
    other &&
      `with ${[other.order, other.lists, other.camera, other.lights].filter(Boolean).join(" and ")} it would be ${count(other.lost_pairs)}`,
    error &&
      error.lost_in_full_lists > 0 &&
      `${count(error.lost_in_full_lists)} of the lost ones are in cells whose list is full`,
    ...set.reading.faults.map((fault) => fault.message),
    ...set.reading.twice.map((fault) => fault.message),
    set.reading.likely_reading,
    `${count(set.bytes)} bytes, longest list ${count(set.longest_list)}`,
  ];
  return h("ul", { class: "changes" }, ...lines.filter(Boolean).map((line) => h("li", {}, line!)));
}

function setView(page: PageFrame, at: number): HTMLElement {
  const checked = page.checked.sets[at]!,
    { cells, cells_left_out: leftOut } = page.sets[at]!;
  return h(
    "section",
    {},
    h("h2", {}, `${checked.name}: ${verdicts[checked.verdict] ?? checked.verdict}`),
    setFacts(checked),
    cells.length > 0 && new LosingCells(page, cells).element,
    leftOut > 0 && h("p", { class: "note" }, `${plural(leftOut, "further cell")} had no room in the page.`),
  );
}

function show(data: CheckPage): void {
  const place = h("main");
  const names = data.frames.map(({ checked }, at): [string, string] => [
    String(at),
    `${checked.name}: ${checked.sets.map(({ verdict }) => verdict).join(", ")}`,
  ]);
  function draw(frame: number): void {
    const page = data.frames[frame]!,
      { checked } = page;
    const grid = `${checked.grid_kind} grid of ${checked.cells.join(" × ")} cells, ${plural(checked.points, "point light")}, ${plural(checked.spots, "spot light")}`;
    const choice =
      names.length > 1 && select("check-frame", "Frame", names, String(frame), (chosen) => draw(Number(chosen)));
    place.replaceChildren(
      ...[choice].filter((part) => part !== false),
      h("p", { class: "summary" }, `${checked.name}${checked.engine && ` (${checked.engine})`}: ${grid}.`),
      ...page.sets.map((_, at) => setView(page, at)),
    );
  }
  const worst = data.frames.findIndex(({ checked }) => checked.sets.some(({ verdict }) => verdict === data.verdict));
  draw(Math.max(0, worst));
  document.title = "clusterbench check";
  document.body.prepend(
    h(
      "header",
      {},
      h(
        "div",
        { class: "title" },
        h("h1", {}, "clusterbench check"),
        h("p", {}, verdicts[data.verdict] ?? data.verdict),
        themeControl(),
      ),
      h("p", { class: "note" }, "Made by ", h("code", {}, data.command)),
    ),
    place,
  );
}

show(JSON.parse(document.getElementById("results")!.textContent!) as CheckPage);
document.documentElement.dataset["ready"] = String(Math.round(performance.now())); // ms, for tests
