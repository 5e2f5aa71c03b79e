// Data leaving the page: to the clipboard, or as a file.

import { h } from "./dom.ts";
import type { Column, Value } from "./table.ts";

function csvField(value: Value): string {
  const text = value === null ? "" : String(value);
  return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

export function csv<Row>(columns: Column<Row>[], rows: Row[]): string {
  const lines = [
    columns.map((column) => column.label),
    ...rows.map((row) => columns.map((column) => column.value(row))),
  ];
  return lines.map((line) => line.map(csvField).join(",")).join("\n") + "\n";
}

function download(name: string, type: string, text: string): void {
  const url = URL.createObjectURL(new Blob([text], { type }));
  h("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

async function copy(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false; // no permission
  }
}

export function copyButton(label: string, text: () => string): HTMLElement {
  const button = h("button", { class: "quiet" }, label);
  button.addEventListener("click", async () => {
    button.textContent = (await copy(text())) ? "Copied" : "The browser does not allow copying";
    setTimeout(() => (button.textContent = label), 1500);
  });
  return button;
}

export function downloadButton(label: string, name: string, type: string, text: () => string): HTMLElement {
  return h("button", { class: "quiet", onclick: () => download(name, type, text()) }, label);
}
