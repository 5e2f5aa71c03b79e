// What of the results is looked at, and who draws it anew when that changes.

import type { Case, Model } from "./model.ts";
import type { Palette } from "./palette.ts";

export interface Filters {
  scene: string | null; // null: over all
  grid: string | null;
  run: string | null;
  words: string;
  frontOnly: boolean;
  hidden: ReadonlySet<string>; // methods
}

export class View {
  filters: Filters;
  readonly choices = new Map<string, string>(); // of controls within sections, by their id
  private readonly watchers: (() => void)[] = [];
  private readonly choiceWatchers: (() => void)[] = [];
  private readonly resetters: (() => void)[] = [];

  constructor(
    readonly model: Model,
    readonly palette: Palette,
  ) {
    this.filters = this.noFilters();
  }

  noFilters(): Filters {
    const { scenes } = this.model;
    return {
      scene: scenes.length === 1 ? scenes[0]! : null,
      grid: null,
      run: null,
      words: "",
      frontOnly: false,
      hidden: new Set(),
    };
  }

  // Of several results each case has to say whose it is.
  get hasRuns(): boolean {
    return this.model.runs.length > 1;
  }
  get hasPresets(): boolean {
    return this.model.runs.some(({ result }) => (result.preset_rankings ?? []).length > 0);
  }
  named(aCase: Case): string {
    return this.hasRuns ? `${aCase.assigner} · ${aCase.run.label}` : aCase.assigner;
  }

  watch(watcher: () => void): void {
    this.watchers.push(watcher);
  }
  watchChoices(watcher: () => void): void {
    this.choiceWatchers.push(watcher);
  }
  // Called where filters change by other means than their controls.
  onReset(resetter: () => void): void {
    this.resetters.push(resetter);
  }

  change(part: Partial<Filters>): void {
    this.filters = { ...this.filters, ...part };
    this.redraw();
  }
  reset(filters = this.noFilters()): void {
    this.filters = filters;
    for (const resetter of this.resetters) resetter();
    this.redraw();
  }

  // Sections draw their own choices; who keeps them is told.
  tellChoice(): void {
    for (const watcher of this.choiceWatchers) watcher();
  }

  redraw(): void {
    for (const watcher of this.watchers) watcher();
  }

  cases(): Case[] {
    return this.casesOfAnyFront().filter((aCase) => !this.filters.frontOnly || aCase.isOnFront);
  }

  // To hold one result against another, whichever of them is looked at.
  casesOfEachRun(): Case[] {
    const { run } = this.filters;
    this.filters.run = null;
    const cases = this.cases();
    this.filters.run = run;
    return cases;
  }

  // A mean over scenes is of the same scenes for all, whichever of them a method is on the front of.
  casesOfAnyFront(): Case[] {
    const { scene, grid, run, words, hidden } = this.filters;
    const wanted = words.toLowerCase().split(/\s+/).filter(Boolean);
    return this.model.cases.filter(
      (aCase) =>
        (scene === null || aCase.scene === scene) &&
        (grid === null || aCase.grid === grid) &&
        (run === null || aCase.run.label === run) &&
        !hidden.has(aCase.assigner) &&
        wanted.every((word) => aCase.raw.name.toLowerCase().includes(word)),
    );
  }
}

// Part of the page that is drawn from a view. null: the results have nothing for it.
export type Section = (view: View, redraw: () => void) => HTMLElement | null;

// Draws a section into a host and keeps it up to date. Focus and opened details outlast redrawing.
export function mount(section: Section, view: View): HTMLElement {
  const host = document.createElement("div");
  const draw = () => {
    const focused = host.contains(document.activeElement) ? document.activeElement!.id : "";
    const open = [...host.querySelectorAll("details[open][id]")].map((details) => details.id);
    const drawn = section(view, draw);
    host.replaceChildren(...(drawn ? [drawn] : []));
    for (const id of open) document.getElementById(id)?.setAttribute("open", "");
    if (focused) document.getElementById(focused)?.focus();
  };
  view.watch(draw);
  draw();
  return host;
}
