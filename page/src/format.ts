// Numbers as people read them, the same as in the terminal's table. Nothing known is a dash.

import type { Maybe } from "./result.ts";

const none = "–";
const grouped = new Intl.NumberFormat("en", { maximumFractionDigits: 0 });

type Format = (value: Maybe) => string;
const ifKnown = (format: (value: number) => string): Format => (value) => (value === null ? none : format(value));

export const count: Format = ifKnown((value) => grouped.format(value));
export const whole: Format = ifKnown((value) => value.toFixed(0));
export const decimal: Format = ifKnown((value) => value.toFixed(2));
export const microseconds: Format = ifKnown((ns) => (ns / 1e3).toFixed(ns < 1e4 ? 2 : ns < 1e6 ? 1 : 0)); // of nanoseconds
export const percent: Format = ifKnown((ratio) => `${(100 * ratio).toFixed(1)} %`);
export const share: Format = ifKnown((ratio) => (ratio === 0 ? "0 %" : ratio < 1e-4 ? "<0.01 %" : `${(100 * ratio).toFixed(ratio < 0.01 ? 2 : 1)} %`)); // what is not nothing never looks like it
export const factor: Format = decimal;
export const short: Format = ifKnown((value) => (value < 1e4 ? value.toFixed(0) : value < 1e6 ? `${(value / 1e3).toFixed(1)}k` : `${(value / 1e6).toFixed(2)}M`));
export const metres: Format = ifKnown((value) => `${Number(value.toPrecision(3))} m`);

// Of a machine, as its makers count.
export const memory: Format = ifKnown((value) => {
  const units = ["B", "KiB", "MiB", "GiB"];
  const power = Math.min(units.length - 1, value < 1024 ? 0 : Math.floor(Math.log2(value) / 10));
  return `${Number((value / 1024 ** power).toPrecision(3))} ${units[power]}`;
});
