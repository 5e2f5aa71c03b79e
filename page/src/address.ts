// Filters and choices in the page's address, behind its "#": a reader can send what he sees, and come back to it.

import type { Filters, View } from "./view.ts";

const lists = ["scene", "grid", "run"] as const;

function fragmentOf(view: View): string {
  const { filters, choices } = view,
    standard = view.noFilters();
  const parts = new URLSearchParams();
  for (const key of lists) if (filters[key] !== null && filters[key] !== standard[key]) parts.set(key, filters[key]);
  if (filters.words) parts.set("words", filters.words);
  if (filters.frontOnly) parts.set("front", "1");
  for (const name of filters.hidden) parts.append("hidden", name);
  for (const [id, value] of choices) parts.set(`choice.${id}`, value);
  return parts.toString();
}

// What the model does not have is passed over.
function filtersOf(view: View, parts: URLSearchParams): Filters {
  const { scenes, grids, runs, assigners } = view.model;
  const known = { scene: scenes, grid: grids, run: runs.map((run) => run.label) };
  const filters = view.noFilters();
  for (const key of lists) if (known[key].includes(parts.get(key) ?? "")) filters[key] = parts.get(key);
  return {
    ...filters,
    words: parts.get("words") ?? "",
    frontOnly: parts.get("front") === "1",
    hidden: new Set(parts.getAll("hidden").filter((name) => assigners.includes(name))),
  };
}

// Before anything is drawn: takes what the address says, and keeps the address up to date from then on.
export function followAddress(view: View): void {
  let written = location.hash.slice(1);
  const read = (): Filters | null => {
    if (!location.hash.includes("=")) return null; // the place of a section
    const parts = new URLSearchParams(location.hash.slice(1));
    for (const [key, value] of parts)
      if (key.startsWith("choice.")) view.choices.set(key.slice("choice.".length), value);
    return filtersOf(view, parts);
  };
  view.filters = read() ?? view.filters;
  const write = () => {
    const now = fragmentOf(view);
    if (now === written) return;
    written = now;
    history.replaceState(null, "", `#${now}`);
  };
  view.watch(write);
  view.watchChoices(write);
  addEventListener("hashchange", () => {
    const filters = read();
    if (filters) view.reset(filters);
  });
}
