// What is shown: scene, grid, result, words, front, methods. Methods' buttons are the legend of all charts.

import { type Option, select } from "./controls.ts";
import { h } from "./dom.ts";
import { plural } from "./format.ts";
import type { Model } from "./model.ts";
import { icon } from "./palette.ts";
import type { Filters, View } from "./view.ts";

const mostButtons = 8; // more scenes than that are a list

function sceneButtons(view: View): HTMLElement {
  const options: [string | null, string][] = [
    [null, "Over all"],
    ...view.model.scenes.map((scene): [string, string] => [scene, scene]),
  ];
  const radios = options.map(([scene, label]) =>
    h(
      "label",
      { class: "pill" },
      h("input", {
        type: "radio",
        name: "scene",
        value: scene ?? "",
        checked: scene === view.filters.scene,
        onchange: () => view.change({ scene }),
      }),
      h("span", {}, label),
    ),
  );
  return h("fieldset", { class: "pills" }, h("legend", {}, "Scene"), ...radios);
}

function listOf(view: View, id: keyof Filters, label: string, all: string, values: string[]): HTMLElement {
  const options: Option[] = [["", all], ...values.map((value): Option => [value, value])];
  return select(`filter-${id}`, label, options, String(view.filters[id] ?? ""), (value) =>
    view.change({ [id]: value || null }),
  );
}

function scenes(view: View): HTMLElement | null {
  const { scenes: names } = view.model;
  if (names.length === 1) return null;
  return names.length <= mostButtons ? sceneButtons(view) : listOf(view, "scene", "Scene", "Over all", names);
}

function words(view: View): HTMLElement {
  const input = h("input", {
    type: "search",
    id: "filter-words",
    placeholder: "words of a case's name",
    spellcheck: "false",
    value: view.filters.words,
    oninput: () => view.change({ words: input.value }),
  });
  return h("label", { class: "control" }, h("span", {}, "Find"), input);
}

function onlyFront(view: View): HTMLElement {
  const input = h("input", {
    type: "checkbox",
    id: "filter-front",
    checked: view.filters.frontOnly,
    onchange: () => view.change({ frontOnly: input.checked }),
  });
  return h("label", { class: "control check" }, input, h("span", {}, "Pareto front only"));
}

// A method and how it looks, in the order of the palette's families.
function methods(view: View): HTMLElement {
  const looks = new Map(view.model.cases.map((aCase) => [aCase.assigner, view.palette(aCase)]));
  const buttons = view.model.assigners.map((name) => {
    const button = h(
      "button",
      { class: "chip", "aria-pressed": String(!view.filters.hidden.has(name)), onclick: () => toggle(name) },
      icon(looks.get(name)!),
      name,
    );
    return { name, button };
  });
  const all = h(
    "button",
    { class: "quiet", hidden: view.filters.hidden.size === 0, onclick: () => apply(new Set()) },
    "Show all methods",
  );
  function apply(hidden: Set<string>): void {
    for (const { name, button } of buttons) button.setAttribute("aria-pressed", String(!hidden.has(name)));
    all.hidden = hidden.size === 0;
    view.change({ hidden });
  }
  function toggle(name: string): void {
    const hidden = new Set(view.filters.hidden);
    if (!hidden.delete(name)) hidden.add(name);
    apply(hidden);
  }
  return h(
    "div",
    { class: "chips", role: "group", "aria-label": "Methods" },
    ...buttons.map(({ button }) => button),
    all,
  );
}

function countOf(view: View): HTMLElement {
  const status = h("p", { class: "count", role: "status" });
  const update = () => (status.textContent = `${view.cases().length} of ${plural(view.model.cases.length, "case")}`);
  view.watch(update);
  update();
  return status;
}

const results = (view: View, model: Model) =>
  view.hasRuns
    ? listOf(
        view,
        "run",
        "Result",
        "all",
        model.runs.map((run) => run.label),
      )
    : null;
const grids = (view: View, model: Model) =>
  model.grids.length > 1 ? listOf(view, "grid", "Grid", "all", model.grids) : null;

// The bar, made anew where filters change by other means than its controls.
export function filterBar(view: View): HTMLElement {
  const box = h("div");
  const draw = () => box.replaceChildren(bar(view));
  view.onReset(draw);
  draw();
  return box;
}

function bar(view: View): HTMLElement {
  return h(
    "form",
    { class: "filters", "aria-label": "Filters", onsubmit: (event) => event.preventDefault() },
    h(
      "div",
      { class: "row" },
      scenes(view),
      grids(view, view.model),
      results(view, view.model),
      words(view),
      onlyFront(view),
      countOf(view),
    ),
    methods(view),
  );
}
