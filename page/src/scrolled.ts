// A box that scrolls sideways where what it holds is too wide, and says so as long as there is more to the right.

import { type Child, h } from "./dom.ts";

export function scrolled(attributes: Parameters<typeof h>[1], ...children: Child[]): HTMLElement {
  const hint = h("p", { class: "scroll-hint", hidden: true, "aria-hidden": "true" }, "scroll sideways for more →");
  const box = h("div", attributes, hint, ...children);
  const update = () => {
    hint.hidden = box.scrollWidth - box.clientWidth - box.scrollLeft < 2;
  };
  box.addEventListener("scroll", update, { passive: true });
  new ResizeObserver(update).observe(box);
  return box;
}
