// One setting (scene, camera, grid, storage) in depth: its path, its lists, its costs.

import { cameraPath } from "./camera_path.ts";
import { choice } from "./controls.ts";
import { costs } from "./costs.ts";
import { h } from "./dom.ts";
import { lightsByDepth } from "./lights_by_depth.ts";
import { listLengths } from "./list_lengths.ts";
import type { Case } from "./model.ts";
import type { Section, View } from "./view.ts";

// What all settings have in common says nothing in their names.
function settingNames(view: View, settings: Map<string, Case[]>): [string, string][] {
  const all = [...settings.values()].map((group) => group[0]!);
  const varies = (value: (aCase: Case) => unknown) => new Set(all.map(value)).size > 1;
  const [viewportsVary, storagesVary] = [
    varies((aCase) => String(aCase.raw.viewport)),
    varies((aCase) => aCase.storage),
  ];
  return [...settings].map(([key, [aCase]]) => {
    const { raw, run } = aCase!;
    const name = [
      raw.scene,
      raw.camera,
      aCase!.grid,
      viewportsVary && raw.viewport.join("×"),
      storagesVary && aCase!.storage,
      raw.machine,
      view.model.runs.length > 1 && run.label,
    ];
    return [key, name.filter(Boolean).join(" · ")];
  });
}

export const depthSection: Section = (view, redraw) => {
  const settings = Map.groupBy(view.cases(), (aCase) => aCase.setting);
  if (settings.size === 0) return null;
  const taken = view.cases().find((aCase) => aCase.standing === "taken");
  const [key, control] = choice(view, redraw, "setting", "Setting", settingNames(view, settings), taken?.setting);
  const cases = settings.get(key)!;
  return h(
    "section",
    { id: "depth" },
    h("h2", {}, "One setting in depth"),
    taken?.setting === key &&
      h("p", { class: "note" }, "The setting of what the conclusion takes; others in the list."),
    h("div", { class: "controls" }, control),
    cameraPath(view, cases),
    listLengths(view, cases),
    lightsByDepth(view, cases),
    costs(view, cases),
  );
};
