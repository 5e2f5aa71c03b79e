// What all charts share.

import * as Plot from "@observablehq/plot";
import { h } from "./dom.ts";

export { Plot };

const paper = 680; // of A4 between the margins of style.css
let isOnPaper = false;

// Charts are drawn anew for paper: those of a wide screen would be too small to read there.
export function drawForPaper(isPaper: boolean): void {
  isOnPaper = isPaper;
}

// Pixels that one column of a map takes, with room for these texts.
export function columnWidth(texts: string[]): number {
  const longest = texts.reduce((most, text) => Math.max(most, text.length), 0);
  return Math.max(isOnPaper ? 40 : 84, 14 + 8 * longest); // cells leave a tenth of it free
}

// Room for one of `columns` charts side by side, as style.css lays them out.
export function chartWidth(columns = 1): number {
  const page = isOnPaper ? paper : Math.min(document.documentElement.clientWidth - 48, 1432) - 34; // less a figure's frame
  const fewest = isOnPaper ? 200 : 280;
  const most = Math.max(1, Math.min(columns, Math.floor(page / (isOnPaper ? 220 : 360))));
  return Math.max(fewest, Math.floor((page - 24 * (most - 1)) / most));
}

// Lower on paper, so that a page holds more of them: what does not fit leaves the rest of its page empty.
export const chartHeight = (height: number) => Math.round(isOnPaper ? 0.66 * height : height);

// The scale of names to the left of a chart, with as much of them as half of its width holds, under the axis' label.
export function namesAside(
  names: string[],
  width: number,
  label: string,
): { y: Plot.ScaleOptions; marginLeft: number } {
  const letter = 6.6;
  const longest = names.reduce((most, name) => Math.max(most, name.length), 0);
  const most = Math.min(longest, Math.floor(width / 2 / letter) - 2);
  const tickFormat = (name: string) => (name.length > most ? `…${name.slice(1 - most)}` : name);
  return {
    y: { domain: names, label, labelAnchor: "top", labelArrow: "none", tickSize: 0, tickFormat },
    marginLeft: Math.max(60, 14 + letter * most),
  };
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
  const removeLabels = () => {
    for (const part of drawn.querySelectorAll("[aria-label]")) part.removeAttribute("aria-label"); // "dot", "rule": noise
  };
  removeLabels();
  new MutationObserver(removeLabels).observe(drawn, { childList: true, subtree: true }); // tips come with the pointer
  drawn.setAttribute("role", "img");
  drawn.setAttribute("aria-label", says);
  return drawn;
}

export const mostPanels = 12;
// Behind a figure's lead, where not all panels are drawn.
export const panelsLeftOut = (count: number): string =>
  count > mostPanels ? ` The first ${mostPanels} of ${count}; choose a scene above for the others.` : "";

// The same chart for several things, each under its name.
export function multiples(panels: { title: string; chart: Element }[]): HTMLElement {
  return h(
    "div",
    { class: "multiples" },
    ...panels.map((panel) => h("div", {}, h("h4", {}, panel.title), panel.chart)),
  );
}
