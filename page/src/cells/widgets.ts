// Controls of the view of cells that the rest of the page does not have.

import { h } from "../dom.ts";
import { count } from "../format.ts";
import { legendOf, type What } from "./colours.ts";

export function pills<Value extends string>(
  id: string,
  legend: string,
  options: [Value, string][],
  chosen: Value,
  onChoice: (value: Value) => void,
): HTMLElement {
  const radios = options.map(([value, label]) =>
    h(
      "label",
      { class: "pill" },
      h("input", {
        type: "radio",
        name: id,
        id: `${id}-${value}`,
        value,
        checked: value === chosen,
        onchange: () => onChoice(value),
      }),
      h("span", {}, label),
    ),
  );
  return h("fieldset", { class: "pills" }, h("legend", {}, legend), ...radios);
}

export interface Slider {
  element: HTMLElement;
  set: (last: number, value: number, text: string) => void; // values are 0..last
}

export function slider(id: string, label: string, onInput: (value: number) => void): Slider {
  const input = h("input", { type: "range", id, min: 0, step: 1, oninput: () => onInput(Number(input.value)) });
  const output = h("output", { for: id });
  return {
    element: h("label", { class: "control slider" }, h("span", {}, label), input, output),
    set: (last, value, text) => {
      input.max = String(last);
      input.value = String(value);
      input.disabled = last === 0;
      input.setAttribute("aria-valuetext", text);
      output.textContent = text;
    },
  };
}

export function legendView(what: What, highest: number): HTMLElement {
  const { label, colours } = legendOf(what);
  if (highest === 0) return h("p", { class: "legend" }, `No cell has ${label}.`);
  const bar = h("span", { class: "scale" });
  bar.style.background = `linear-gradient(to right, ${colours.join(", ")})`;
  const middle = Math.round(Math.sqrt(highest)); // the scale is logarithmic
  const isBetween = middle > 1 && middle < highest;
  return h(
    "p",
    { class: "legend" },
    h(
      "span",
      {},
      `${label[0]!.toUpperCase()}${label.slice(1)}: 1`,
      bar,
      count(highest),
      isBetween && ` (in the middle ${count(middle)})`,
    ),
  );
}
