// The page: reads the results that stand in it and puts the sections in order.

import { followAddress } from "./address.ts";
import { againstSection } from "./against.ts";
import { cellsSection } from "./cells_section.ts";
import { depthSection } from "./depth.ts";
import { deviceSection } from "./device.ts";
import { h } from "./dom.ts";
import { filterBar } from "./filter_bar.ts";
import { fitSection } from "./fit.ts";
import { contents, header } from "./header.ts";
import { heatMapSection } from "./heat_map.ts";
import { modelOf } from "./model.ts";
import { paletteOf } from "./palette.ts";
import { picturesSection } from "./pictures.ts";
import { drawForPaper } from "./plots.ts";
import { precisionSection } from "./precision.ts";
import { presetsSection } from "./presets.ts";
import { rankingSection } from "./ranking.ts";
import { reactSection } from "./react.ts";
import type { PageData } from "./result.ts";
import { setupSection } from "./setup.ts";
import { speedErrorSection } from "./speed_error.ts";
import { stabilitySection } from "./stability.ts";
import { mount, View } from "./view.ts";
import { warningsSection } from "./warnings.ts";

const sections = [
  presetsSection, // where there are any they are what is asked
  rankingSection,
  againstSection,
  speedErrorSection,
  deviceSection,
  heatMapSection,
  depthSection,
  picturesSection,
  cellsSection(),
  stabilitySection,
  fitSection,
  reactSection,
  precisionSection,
  warningsSection,
  setupSection,
];

function redrawOnResize(view: View): void {
  let width = document.documentElement.clientWidth;
  let waiting = 0;
  window.addEventListener("resize", () => {
    clearTimeout(waiting);
    waiting = setTimeout(() => {
      if (width === document.documentElement.clientWidth) return;
      width = document.documentElement.clientWidth;
      view.redraw();
    }, 150);
  });
}

function redrawForPrint(view: View): void {
  const draw = (isPaper: boolean) => {
    drawForPaper(isPaper);
    for (const details of document.querySelectorAll<HTMLDetailsElement>("details.conclusion")) details.open = isPaper;
    view.redraw();
  };
  window.addEventListener("beforeprint", () => draw(true));
  window.addEventListener("afterprint", () => draw(false));
}

function show(data: PageData): void {
  const model = modelOf(data);
  const view = new View(model, paletteOf(model));
  followAddress(view);
  document.title = `${model.runs.map((run) => run.result.name).join(", ")} – clusterbench report`;
  const main = h("main", { id: "main" });
  document.body.prepend(
    h("a", { class: "skip", href: view.hasPresets ? "#presets" : "#ranking" }, "Skip to the ranking"),
    header(model),
    filterBar(view),
    main,
  );
  main.append(...sections.map((section) => mount(section, view)));
  main.before(contents(main));
  redrawOnResize(view);
  redrawForPrint(view);
}

show(JSON.parse(document.getElementById("results")!.textContent!) as PageData);
document.documentElement.dataset["ready"] = String(Math.round(performance.now())); // ms, for tests
