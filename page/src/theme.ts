// Light, dark, or as the system has it. Remembered where the browser lets a file remember.

import { select } from "./controls.ts";

const key = "clusterbench-theme";

function remembered(): string {
  try {
    return localStorage.getItem(key) ?? "";
  } catch {
    return "";
  }
}

function apply(theme: string): void {
  document.documentElement.dataset["theme"] = theme;
  try {
    localStorage.setItem(key, theme);
  } catch {
    // then only this page has it
  }
}

export function themeControl(): HTMLElement {
  const theme = remembered();
  apply(theme);
  return select(
    "theme",
    "Theme",
    [
      ["", "system"],
      ["light", "light"],
      ["dark", "dark"],
    ],
    theme,
    apply,
  );
}
