// What the reader should know before believing a figure. Sentences about cases are in the past tense, which one case
// and several share.

import { figure } from "./case_figures.ts";
import { h } from "./dom.ts";
import { plural } from "./format.ts";
import type { Case, Model, Run } from "./model.ts";
import type { FailureKind, SceneResult, WarningKind } from "./result.ts";
import type { Section } from "./view.ts";

export interface Warning {
  isFailure: boolean;
  text: string;
}

const failures: Record<FailureKind, string> = {
  lost_pairs: "lost lights in spite of being conservative",
  extra_pairs: "reported pairs that are not true in spite of being exact",
  lost_at_samples: "lost lights at samples in spite of being conservative",
  dropped_pairs: "dropped more pairs than the configuration allows",
  wrong_readings: "were read wrongly on the device",
  crashed: "were measured before their plug-in crashed as it was unloaded",
  timed_out: "were measured before their plug-in hung as it was unloaded",
  out_of_memory: "were measured before their plug-in took too much memory as it was unloaded",
  failed: "were measured before their plug-in failed",
};

function counted(cases: Case[], what: string): string {
  const names = cases
    .slice(0, 3)
    .map((aCase) => aCase.raw.name)
    .join("; ");
  return `${plural(cases.length, "case")} ${what}: ${names}${cases.length > 3 ? "; …" : ""}`;
}

function failuresOf(cases: Case[]): Warning[] {
  return Object.entries(failures).flatMap(([kind, what]) => {
    const some = cases.filter(({ raw }) => raw.failures.some((failure) => failure.kind === kind));
    return some.length ? [{ isFailure: true, text: counted(some, what) }] : [];
  });
}

// Cases without figures, which no other section shows.
function brokenOf({ label, result }: Run, isAlone: boolean): Warning[] {
  const name = isAlone ? "" : `${label}: `;
  return (result.broken ?? []).map((broken) => ({
    isFailure: true,
    text: `${name}${broken.name} was not measured to the end: ${broken.reason}.`,
  }));
}

const doubts: Record<WarningKind, string> = {
  dropped_pairs: "dropped lights because the storage was full",
  unlit:
    "left more of the lights that random points in the view need unlit than rounding does, in cells or outside of the grid",
  undecided: "had pairs that stayed undecided, counted as true",
  unchecked: "went without a check against the truth",
  too_many_lights: "had more lights in view than their limit lets in, and lost some",
  repeated_lights: "had lights twice in a list, as a shader left them",
  lost_pairs: "lost lights, as methods that are not conservative may",
};

// Who has lost lights: the method, or what keeps lights from it.
function blamed(aCase: Case): "method" | "limit" | "cull" {
  const { raw } = aCase;
  const missed = figure(aCase, "missed") ?? 0;
  const kept = raw.pre_cull?.lost_pairs ?? 0;
  if (!raw.pre_cull || missed > kept) return "method";
  return raw.pre_cull.over_limit?.lost_pairs ? "limit" : "cull";
}

function losing(kind: WarningKind, all: Case[]): Warning[] {
  const some = all.filter(({ raw }) => raw.warnings.some((warning) => warning.kind === kind));
  const doubt = (cases: Case[], what: string): Warning[] =>
    cases.length ? [{ isFailure: false, text: counted(cases, what) }] : [];
  if (kind !== "lost_pairs") return doubt(some, doubts[kind]);
  const isLimited = ({ raw }: Case) => raw.warnings.some((warning) => warning.kind === "too_many_lights");
  return [
    ...doubt(
      some.filter((aCase) => blamed(aCase) === "method"),
      doubts.lost_pairs,
    ),
    ...doubt(
      some.filter((aCase) => blamed(aCase) === "limit" && !isLimited(aCase)), // of others that is said
      "lost lights to their limit of lights in view",
    ),
    ...doubt(
      some.filter((aCase) => blamed(aCase) === "cull"),
      "lost lights to what culls them before the method",
    ),
  ];
}

function doubtsOf(cases: Case[]): Warning[] {
  return (Object.keys(doubts) as WarningKind[]).flatMap((kind) => losing(kind, cases));
}

function rangeWarnings({ range_rule }: SceneResult): string[] {
  const { from_intensity, cutoff_lux, max_range, clamped } = range_rule;
  return [
    from_intensity > 0 &&
      `${plural(from_intensity, "light")} ${from_intensity === 1 ? "has no range; it ends where it falls" : "have no range; they end where they fall"} to ${cutoff_lux} lux, at most ${max_range} m`,
    clamped > 0 && `${plural(clamped, "range")} ${clamped === 1 ? "was" : "were"} cut to ${max_range} m`,
  ].filter((text) => text !== false);
}

function runWarnings({ label, result, doubts: ofTimes }: Run, isAlone: boolean): Warning[] {
  const name = isAlone ? "" : `${label}: `;
  const build =
    result.tool.build_type === "Release"
      ? []
      : [`${name}measured with a build of type '${result.tool.build_type}', not Release`];
  const scenes = result.scenes.flatMap((scene) =>
    [...scene.warnings, ...rangeWarnings(scene)].map((warning) => `${name}${scene.name}: ${warning}`),
  );
  return [...ofTimes.map((text) => `${name}Times: ${text}`), ...build, ...scenes].map((text) => ({
    isFailure: false,
    text,
  }));
}

export function warningsOf(model: Model): Warning[] {
  return [
    ...failuresOf(model.cases),
    ...model.runs.flatMap((run) => brokenOf(run, model.runs.length === 1)),
    ...doubtsOf(model.cases),
    ...model.runs.flatMap((run) => runWarnings(run, model.runs.length === 1)),
  ];
}

function skippedView(model: Model): HTMLElement | null {
  const all = model.runs.flatMap((run) => run.result.skipped);
  if (all.length === 0) return null;
  const reasons = [...Map.groupBy(all, ({ reason }) => reason)].sort((a, b) => b[1].length - a[1].length);
  return h(
    "details",
    { id: "skipped" },
    h("summary", {}, `${plural(all.length, "combination")} ${all.length === 1 ? "was" : "were"} skipped`),
    h("ul", {}, ...reasons.map(([reason, some]) => h("li", {}, `${some.length} × ${reason}`))),
  );
}

export const warningsSection: Section = ({ model }) => {
  const all = warningsOf(model);
  return h(
    "section",
    { id: "warnings" },
    h("h2", {}, "Warnings"),
    all.length === 0
      ? h(
          "p",
          { class: "note" },
          "None: no list lost a light that it must hold, none overflowed, every pair was decided.",
        )
      : h(
          "ul",
          { class: "warnings" },
          ...all.map(({ isFailure, text }) =>
            h("li", { class: isFailure && "failure" }, h("strong", {}, isFailure ? "Failed. " : "Warning. "), text),
          ),
        ),
    skippedView(model),
  );
};
