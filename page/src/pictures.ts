// What pixels find in the lists: the pictures of `clusterbench run --images`, one kind and frame at a time.

import { choice, type Option } from "./controls.ts";
import { h } from "./dom.ts";
import type { Case } from "./model.ts";
import type { Picture } from "./result.ts";
import type { Section, View } from "./view.ts";

const kinds: Record<string, string> = {
  lights: "lights per pixel",
  levels: "lights per pixel in steps",
  types: "points and spots",
  "false-positives": "false positives",
  missed: "missed lights",
  lists: "a colour per list",
  depth: "depth",
  strip: "along the path",
};

const frameOf = ({ frame }: Picture) => (frame === null ? "path" : String(frame));

// Some pictures are of many cases: of those that are looked at the first.
function namesOf(view: View, cases: Case[], picture: Picture): string {
  const shown = cases.filter((aCase) => picture.cases.includes(aCase.raw.id));
  if (picture.cases.length > 1) return `${shown[0]!.scene} · ${shown[0]!.raw.camera}`;
  return shown.map((aCase) => `${aCase.raw.name}${view.hasRuns ? ` · ${aCase.run.label}` : ""}`).join(", ");
}

function pictureView(view: View, cases: Case[], picture: Picture): HTMLElement {
  return h(
    "figure",
    {},
    h(
      "a",
      { href: picture.url, download: `${picture.kind}-${frameOf(picture)}.png`, title: "Save this picture" },
      h("img", { src: picture.url, alt: picture.text, loading: "lazy" }),
    ),
    h("figcaption", {}, h("p", { class: "note" }, namesOf(view, cases, picture))),
  );
}

export const picturesSection: Section = (view, redraw) => {
  const cases = view.cases();
  const ids = new Set(cases.map((aCase) => aCase.raw.id));
  const all = view.model.pictures.filter((picture) => picture.cases.some((id) => ids.has(id)));
  if (all.length === 0) return null;
  const offered = Object.entries(kinds).filter(([name]) => all.some(({ kind }) => kind === name));
  const [kind, kindControl] = choice(view, redraw, "pictures-kind", "Picture", offered);
  const ofKind = all.filter((picture) => picture.kind === kind);
  const frames: Option[] = [...new Set(ofKind.map(frameOf))]
    .sort((a, b) => Number(a) - Number(b))
    .map((frame) => [frame, frame]);
  const [frame, frameControl] = choice(view, redraw, "pictures-frame", "Frame", [["all", "all"], ...frames]);
  const shown = ofKind.filter((picture) => frame === "all" || frameOf(picture) === frame);
  return h(
    "section",
    { id: "pictures" },
    h("h2", {}, "What pixels find"),
    h("div", { class: "controls" }, kindControl, frames.length > 1 && frameControl),
    h("div", { class: "pictures" }, ...shown.map((picture) => pictureView(view, cases, picture))),
  );
};
