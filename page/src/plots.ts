// What all charts share.

import * as Plot from "@observablehq/plot";
import { h } from "./dom.ts";

export { Plot };

const fewestPixels = 280;

// Room for one of `columns` charts side by side, as style.css lays them out.
export function chartWidth(columns = 1): number {
  const page = Math.min(document.documentElement.clientWidth - 48, 1432) - 34; // less a figure's own frame
  const most = Math.max(1, Math.min(columns, Math.floor(page / 360)));
  return Math.max(fewestPixels, Math.floor((page - 24 * (most - 1)) / most));
}

// One chart. `says` is what it would say to someone who cannot see it.
export function chart(says: string, options: Plot.PlotOptions): Element {
  const drawn = Plot.plot({
    className: "plot", // its style's hash is in the page's policy
    marginTop: 26,
    marginRight: 16,
    marginBottom: 40,
    ...options,
  });
  for (const part of drawn.querySelectorAll("[aria-label]")) part.removeAttribute("aria-label"); // "dot", "rule": noise
  drawn.setAttribute("role", "img");
  drawn.setAttribute("aria-label", says);
  return drawn;
}

// The same chart for several things, each under its name.
export function multiples(panels: { title: string; chart: Element }[]): HTMLElement {
  return h(
    "div",
    { class: "multiples" },
    ...panels.map((panel) => h("div", {}, h("h4", {}, panel.title), panel.chart)),
  );
}
