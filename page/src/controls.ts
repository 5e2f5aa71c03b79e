// Form controls with their labels.

import { h } from "./dom.ts";
import type { View } from "./view.ts";

export type Option = [value: string, label: string];

export function select(
  id: string,
  label: string,
  options: Option[],
  chosen: string,
  onChoice: (value: string) => void,
): HTMLElement {
  const control = h(
    "select",
    { id, onchange: () => onChoice(control.value) },
    ...options.map(([value, text]) => h("option", { value, selected: value === chosen }, text)),
  );
  return h("label", { class: "control" }, h("span", {}, label), control);
}

// A select of a section, whose choice the view remembers. Returns the choice, too: the `preferred` option, or the first,
// where the remembered one is gone.
export function choice(
  view: View,
  redraw: () => void,
  id: string,
  label: string,
  options: Option[],
  preferred?: string,
): [string, HTMLElement] {
  const remembered = view.choices.get(id);
  const isOffered = (wanted?: string) => options.some(([value]) => value === wanted);
  const chosen = [remembered, preferred].find(isOffered) ?? options[0]?.[0] ?? "";
  const control = select(id, label, options, chosen, (value) => {
    view.choices.set(id, value);
    redraw();
    view.tellChoice();
  });
  return [chosen, control];
}
