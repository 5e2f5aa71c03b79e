// How methods look: a family has one colour and one form, its fast variant is filled, the readable reference hollow.

import type { Case, Model } from "./model.ts";
import { type Shape, shapes } from "./shapes.ts";

// In the order of the colours of style.css. Families that are not here follow in the order of the results.
const known = [
  "exact",
  "sphere-refinement",
  "aabb",
  "bounds",
  "planes",
  "brute-force",
  "distance",
  "cascades",
  "world-grid",
];
const colours = 9; // --method-0 ...

export interface Look {
  colour: string; // a CSS variable: dark mode needs no redrawing
  shape: Shape;
  isFilled: boolean;
}

export type Palette = (method: Pick<Case, "family" | "isFast">) => Look;

export function paletteOf(model: Model): Palette {
  const order = [...known, ...model.families.filter((family) => !known.includes(family))];
  const indices = new Map(order.map((family, at) => [family, at]));
  return ({ family, isFast }) => {
    const index = indices.get(family)!;
    return { colour: `var(--method-${index % colours})`, shape: shapes[index % shapes.length]!, isFilled: isFast };
  };
}

// `isLine`: as a line that has such marks.
export function icon(look: Look, isLine = false): SVGSVGElement {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", isLine ? "-15 -7 30 14" : "-7 -7 14 14");
  svg.setAttribute("class", isLine ? "icon line" : "icon");
  svg.setAttribute("aria-hidden", "true");
  if (isLine) {
    const line = document.createElementNS("http://www.w3.org/2000/svg", "path");
    line.setAttribute("d", "M-15,0H15");
    line.setAttribute("stroke", look.colour);
    line.setAttribute("stroke-width", "1.8");
    svg.append(line);
  }
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  path.setAttribute("d", look.shape.path(50));
  path.setAttribute("stroke", look.colour);
  path.setAttribute("stroke-width", "1.5");
  path.setAttribute("fill", look.isFilled ? look.colour : "var(--panel)");
  svg.append(path);
  return svg;
}
