// Which engine's scheme suits this level, and why.

import { columnsOf, figure } from "./case_figures.ts";
import { type Child, h, withCode } from "./dom.ts";
import { figureView } from "./figure.ts";
import * as format from "./format.ts";
import type { Case } from "./model.ts";
import type { Result } from "./result.ts";
import { ofRuns } from "./runs.ts";
import type { Column } from "./table.ts";
import type { Section, View } from "./view.ts";

type Ranking = NonNullable<Result["preset_rankings"]>[number];
type Line = Ranking["cases"][number];
type Facts = NonNullable<Result["presets"]>[number];

interface Row {
  aCase: Case;
  line: Line;
  place: number; // in its ranking, from 1
  isBest: boolean;
  facts: Facts | null;
}

function placeText(line: Line, place: number): string {
  if (line.place === undefined) return String(place); // an older result
  if (line.standing === "lists") return String(line.place);
  return line.standing === "searched" ? `s${line.place}` : "–";
}

// Of a few lights a share says nothing.
function unlitOf({ line }: Row): number | null {
  return line.standing === "unknown" ? null : (line.unlit ?? null);
}

function columnsIn(view: View): Column<Row>[] {
  const column = columnsOf(view.model.words, ({ aCase }: Row) => aCase);
  return [
    {
      label: "preset",
      value: ({ line }) => line.preset,
      show: ({ line, isBest, facts }) =>
        h("span", { title: facts?.summary }, isBest ? `▶ ${line.preset}` : line.preset),
    },
    {
      label: "place",
      about:
        "The same where the model cannot tell costs apart. s: samples search the structure, ranked apart. –: samples lack lights, or are too few to say that none is lacking",
      value: ({ place }) => place,
      show: ({ line, place }) => placeText(line, place),
    },
    {
      label: "GPU µs",
      about: "Upload, reading and shading of a frame by the configuration's model (cost)",
      value: ({ line }) => format.inUs(line.gpu_ns),
      show: ({ line }) => format.microseconds(format.inUs(line.gpu_ns)),
    },
    {
      label: "upload µs",
      isScreenOnly: true,
      about: "Of the lists, where the engine makes them on the CPU",
      value: ({ line }) => format.inUs(line.upload_ns ?? null),
      show: ({ line }) => format.microseconds(format.inUs(line.upload_ns ?? null)),
    },
    {
      label: "read µs",
      isScreenOnly: true,
      about: "What samples read to know their lights",
      value: ({ line }) => format.inUs(line.read_ns ?? null),
      show: ({ line }) => format.microseconds(format.inUs(line.read_ns ?? null)),
    },
    {
      label: "lights / sample",
      about: "That a shader loops over, on average",
      value: ({ line }) => line.lights_per_sample,
      show: ({ line }) => format.decimal(line.lights_per_sample),
    },
    column("longest", "longest", { isScreenOnly: true }),
    column("bytes", "bytes"),
    column("dropped", "dropped", { isScreenOnly: true, note: "seen or not" }),
    {
      label: "missed in view",
      isScreenOnly: true,
      about:
        "True pairs that its method or a limit of lights leaves out, without those of lights beside the view, which the table of all figures counts too",
      value: ({ line }) => line.missed_in_view ?? null,
      show: ({ line }) => format.whole(line.missed_in_view ?? null),
    },
    {
      label: "unlit",
      about: "Share of the lights that samples need and are not given: it decides",
      value: (row) => unlitOf(row),
      show: (row) => format.share(unlitOf(row)),
    },
    column("assign_us", "assign µs", {
      isScreenOnly: true,
      note: "on one core, of engines that assign on the CPU: of others a time here would not be theirs",
      value: ({ aCase, facts }) => (facts?.assigns_on === "gpu" ? null : figure(aCase, "assign_us")),
      show: ({ aCase, facts }) =>
        facts?.assigns_on === "gpu" ? "GPU" : format.microseconds(figure(aCase, "assign_us")),
    }),
    {
      label: "machine",
      isScreenOnly: true,
      about: "Where the assignment was timed",
      value: ({ aCase }) => aCase.machine || null,
    },
    { label: "why", value: ({ line }) => line.why, show: ({ line }) => h("span", {}, line.why) },
  ];
}

const evidenceTexts: Record<string, string> = {
  ran: "ran: compared with the lists of the engine's code",
  read: "read: its code or what its authors published",
  memory: "memory: neither; no reason to take one engine over another",
};

const evidenceText = ({ evidence }: Facts) => (evidence === undefined ? null : (evidenceTexts[evidence] ?? evidence));

const factColumns: Column<Facts>[] = [
  { label: "preset", value: (facts) => facts.name },
  { label: "engine", value: (facts) => facts.engine },
  { label: "version", about: "Of the engine, that the preset follows", value: (facts) => facts.version ?? null },
  { label: "evidence", about: "How its scheme is known", value: evidenceText },
  { label: "scheme", isScreenOnly: true, value: (facts) => facts.summary },
  { label: "read in", isScreenOnly: true, value: (facts) => facts.source },
  { label: "approximated here", value: (facts) => facts.approximated || null },
  { label: "unverified", value: (facts) => facts.unverified || null },
];

const sentence = (text: string) => `${text.charAt(0).toUpperCase()}${text.slice(1)}.`;

function rowsOf(ranking: Ranking, cases: Case[], facts: Facts[]): Row[] {
  return ranking.cases.flatMap((line, at) => {
    const aCase = cases.find(({ raw }) => raw.id === line.id);
    const known = facts.find(({ name }) => name === line.preset) ?? null;
    return aCase ? [{ aCase, line, place: at + 1, isBest: ranking.best === line.id, facts: known }] : [];
  });
}

const shownColumns = (view: View, rows: Row[]) =>
  columnsIn(view).filter(({ value }) => rows.some((row) => value(row) !== null));

// The conclusion first, where the page does not begin with it; then how lines come to their places.
function leadOf(ranking: Ranking, isAlone: boolean): Child {
  const rule =
    "▶ costs the GPU least of the lists whose samples lack at most 0.1 % of the lights that they need. A place is 1 + how many are known to cost less: by over 5 %, and at prices of half and twice those of the key cost too. Those that lack more come last, behind those whose samples need fewer than 1000 lights, too few to say so.";
  const seen = ranking.lights_in_view;
  const inView =
    seen?.max == null ? "" : ` Lights in view: ${format.decimal(seen.mean)} on average, ${seen.max} at most.`;
  const text = isAlone || ranking.text === undefined ? "" : `${sentence(ranking.text)} `;
  return h("span", {}, ...withCode(`${text}${rule}${inView}`));
}

function rankingFigures(view: View): HTMLElement[] {
  return view.model.runs.flatMap((run, at) => {
    const cases = view.cases().filter((aCase) => aCase.run === run);
    return (run.result.preset_rankings ?? []).flatMap((ranking, index) => {
      const rows = rowsOf(ranking, cases, run.result.presets ?? []);
      if (rows.length === 0) return [];
      const title = `${ranking.scene}, ${ranking.camera}, ${ranking.viewport.join(" × ")}`;
      return figureView({
        id: `presets-${at}-${index}`,
        title,
        lead: leadOf(ranking, view.model.runs.length === 1 && run.result.preset_rankings?.length === 1),
        table: () => ({ caption: `Presets: ${title}`, columns: ofRuns(view, shownColumns(view, rows)), rows }),
        cases: rows.map(({ aCase }) => aCase),
      });
    });
  });
}

function skippedList(view: View): HTMLElement | null {
  const skipped = view.model.runs.flatMap(({ result }) => result.skipped.filter(({ preset }) => preset));
  if (skipped.length === 0) return null;
  return h("ul", { class: "note" }, ...skipped.map(({ name, reason }) => h("li", {}, `${name}: ${reason}.`)));
}

function factsFigure(view: View, rankings: HTMLElement[]): HTMLElement | null {
  const all = new Map(view.model.runs.flatMap(({ result }) => (result.presets ?? []).map((one) => [one.name, one])));
  if (rankings.length === 0 || all.size === 0) return null;
  return figureView({
    id: "preset-sources",
    title: "Where the presets come from",
    lead: "What was read of each engine, and what of it is not the same here.",
    table: () => ({ caption: "Presets", columns: factColumns, rows: [...all.values()] }),
    cases: view.cases().filter(({ raw }) => raw.preset !== undefined),
  });
}

export const presetsSection: Section = (view) => {
  const rankings = rankingFigures(view);
  if (rankings.length === 0) return null;
  return h(
    "section",
    { id: "presets" },
    h("h2", {}, "Which engine's scheme suits this level"),
    ...rankings,
    skippedList(view),
    factsFigure(view, rankings),
  );
};
