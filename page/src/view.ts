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
  filters: Filters = { scene: null, grid: null, run: null, words: "", frontOnly: false, hidden: new Set() };
  readonly choices = new Map<string, string>(); // of controls within sections, by their id
  private readonly watchers: (() => void)[] = [];

  constructor(
    readonly model: Model,
    readonly palette: Palette,
  ) {
    if (model.scenes.length === 1) this.filters.scene = model.scenes[0]!;
  }

  watch(watcher: () => void): void {
    this.watchers.push(watcher);
  }

  change(part: Partial<Filters>): void {
    this.filters = { ...this.filters, ...part };
    this.redraw();
  }

  redraw(): void {
    for (const watcher of this.watchers) watcher();
  }

  cases(): Case[] {
    const { scene, grid, run, words, frontOnly, hidden } = this.filters;
    const wanted = words.toLowerCase().split(/\s+/).filter(Boolean);
    return this.model.cases.filter(
      (one) =>
        (scene === null || one.scene === scene) &&
        (grid === null || one.grid === grid) &&
        (run === null || one.run.label === run) &&
        (!frontOnly || one.isOnFront) &&
        !hidden.has(one.assigner) &&
        wanted.every((word) => one.raw.name.toLowerCase().includes(word)),
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
    const open = [...host.querySelectorAll("details[open][id]")].map((one) => one.id);
    const drawn = section(view, draw);
    host.replaceChildren(...(drawn ? [drawn] : []));
    for (const id of open) document.getElementById(id)?.setAttribute("open", "");
    if (focused) document.getElementById(focused)?.focus();
  };
  view.watch(draw);
  draw();
  return host;
}
