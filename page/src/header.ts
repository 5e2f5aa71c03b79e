// Title, what was measured where, whether to worry, and the way to the sections.

import { h, withCode } from "./dom.ts";
import { plural } from "./format.ts";
import { placesOf, placeText } from "./machines.ts";
import type { Model } from "./model.ts";
import type { Result } from "./result.ts";
import { themeControl } from "./theme.ts";
import { warningsOf } from "./warnings.ts";

type PresetRanking = NonNullable<Result["preset_rankings"]>[number];

function verdict(model: Model): HTMLElement {
  const all = warningsOf(model);
  const failures = all.filter((warning) => warning.isFailure).length;
  const text = failures ? plural(failures, "failure") : all.length ? plural(all.length, "warning") : "No warnings";
  return h("a", { href: "#warnings", class: failures ? "bad" : "" }, text);
}

// What to do, in the words of the table's last lines.
function conclusions(model: Model): HTMLElement[] {
  const most = 6;
  const all = model.runs.flatMap((run) =>
    [
      ...(run.result.preset_rankings ?? []).flatMap(presetsText),
      ...(run.result.conclusions ?? []).map(({ text }) => text),
    ].map((text) => (model.runs.length > 1 ? `${run.label}: ${text}` : text)),
  );
  const more = all.length - most;
  return [
    ...[...all.slice(0, most), ...(more > 0 ? [`and ${plural(more, "more conclusion")} in the results`] : [])].map(
      conclusionView,
    ),
    ...(all.some(hasRandomDepths) ? [randomDepths()] : []),
  ];
}

// What can turn a choice round is said in the open, and once.
const hasRandomDepths = (conclusion: string) => /random depths|depths are random/.test(conclusion);
const randomDepths = () =>
  h(
    "p",
    { class: "caveat" },
    ...withCode(
      "Shading is at random depths, where no surface is. Real surfaces can change the choice: `--set 'samples.opaque={}'` takes those of a level with triangles, `--set samples.opaque.ground=lowest` a floor.",
    ),
  );

function presetsText({ scene, camera, viewport, text }: PresetRanking): string[] {
  return text === undefined ? [] : [`${scene}, camera ${camera}, ${viewport.join("x")}: ${text}.`];
}

// One line: what to take. What it costs and how sure that is stands behind it.
function conclusionView(text: string): HTMLElement {
  const [, line, rest] = /^(.*?[^.;])[.;] +(.*)$/s.exec(text) ?? [];
  return line && rest
    ? h("details", { class: "conclusion" }, h("summary", {}, ...withCode(line)), h("p", {}, ...withCode(rest)))
    : h("p", { class: "conclusion" }, ...withCode(text));
}

// Names are those of one result: of several, each says whose it is.
function machinesOf({ runs }: Model): string[] {
  const most = 3;
  const all = runs.flatMap((run) =>
    placesOf(run).map((place) => `${place.name && runs.length > 1 ? `${run.label}, ` : ""}${placeText(place)}`),
  );
  const machines = [...new Set(all)];
  const more = machines.length - most;
  return more > 0 ? [...machines.slice(0, most), `${plural(more, "more machine")}`] : machines;
}

export function header(model: Model): HTMLElement {
  const machines = machinesOf(model);
  return h(
    "header",
    {},
    h(
      "div",
      { class: "title" },
      h(
        "h1",
        {},
        model.runs
          .map((run) => run.result.name)
          .filter((name, at, all) => all.indexOf(name) === at)
          .join(", ") || "clusterbench",
      ),
      h("p", {}, "clusterbench report"),
      themeControl(),
    ),
    ...conclusions(model),
    h(
      "p",
      { class: "summary" },
      `${plural(model.cases.length, "case")} in ${plural(model.scenes.length, "scene")} on ${machines.join("; ")}. `,
      verdict(model),
      ".",
    ),
  );
}

// The address keeps the filters.
function goTo(event: Event, id: string): void {
  event.preventDefault();
  document.getElementById(id)?.scrollIntoView();
}

export function contents(main: HTMLElement): HTMLElement {
  const sections = [...main.querySelectorAll("section[id]")];
  return h(
    "nav",
    { "aria-label": "Sections" },
    ...sections.map((section) =>
      h(
        "a",
        { href: `#${section.id}`, onclick: (event) => goTo(event, section.id) },
        section.querySelector("h2")!.textContent,
      ),
    ),
  );
}
