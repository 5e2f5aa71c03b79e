// Numbers as people read them. Nothing known is a dash.

import type { Maybe } from "./result.ts";

const none = "–";
const grouped = new Intl.NumberFormat("en", { maximumFractionDigits: 0 });

const mostDigits = 4;
const withDigits = Array.from( // making a format takes far longer than using it
  { length: mostDigits + 1 },
  (_, digits) => new Intl.NumberFormat("en", { minimumFractionDigits: digits, maximumFractionDigits: digits }),
);
const compact = new Intl.NumberFormat("en", { notation: "compact", maximumSignificantDigits: 3 });

// Three significant digits, and all of those before the point.
function significant(value: number): string {
  if (value === 0) return "0";
  const digits = Math.max(0, 2 - Math.floor(Math.log10(Math.abs(value))));
  return withDigits[Math.min(digits, mostDigits)]!.format(value);
}

type Format = (value: Maybe) => string;
const ifKnown = (format: (value: number) => string): Format => (value) => (value === null ? none : format(value));

export const count: Format = ifKnown((value) => grouped.format(value));
export const decimal: Format = ifKnown(significant);
export const microseconds: Format = ifKnown((ns) => significant(ns / 1e3)); // of nanoseconds
export const percent: Format = ifKnown((ratio) => `${(100 * ratio).toFixed(1)} %`);
export const share: Format = ifKnown((ratio) => (ratio === 0 ? "0 %" : ratio < 1e-4 ? "<0.01 %" : `${(100 * ratio).toFixed(ratio < 0.01 ? 2 : 1)} %`)); // what is not nothing never looks like it
export const factor: Format = ifKnown((value) => `${significant(value)}×`);
export const bytes: Format = ifKnown((value) => {
  const units = ["B", "KiB", "MiB", "GiB"];
  const power = Math.min(units.length - 1, value < 1024 ? 0 : Math.floor(Math.log2(value) / 10));
  return `${power === 0 ? value : significant(value / 1024 ** power)} ${units[power]}`;
});
export const short: Format = ifKnown((value) => compact.format(value));
