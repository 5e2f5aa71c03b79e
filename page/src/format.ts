// Numbers as people read them, the same as in the terminal's table. Nothing known is a dash.

import type { Maybe } from "./result.ts";

const none = "–";
const grouped = new Intl.NumberFormat("en", { maximumFractionDigits: 0 });

export type Format = (value: Maybe) => string;
const ifKnown =
  (format: (value: number) => string): Format =>
  (value) =>
    value === null ? none : format(value);

// With so many digits as printf writes them: of a number half-way between two, the one whose last digit is even.
// toFixed takes the larger. Half-way are odd multiples of half the last digit, which doubles hold at multiples of 2^-(digits+1) only.
export function fixed(value: number, digits: number): string {
  const halves = Math.abs(value) * 2 ** (digits + 1); // times 5^digits: in halves of the last digit
  const halfWay = halves < 2 ** 40 && halves % 2 === 1;
  const text = value.toFixed(digits);
  if (!halfWay || Number(text.at(-1)) % 2 === 0) return text;
  return (value - Math.sign(value) * 0.5 * 10 ** -digits).toFixed(digits);
}

export const inUs = (ns: Maybe): Maybe => (ns === null ? null : ns / 1e3);

export const count: Format = ifKnown((value) => grouped.format(value));
export const whole: Format = ifKnown((value) => fixed(value, 0));
export const decimal: Format = ifKnown((value) => fixed(value, 2));
export const microseconds: Format = ifKnown((us) => fixed(us, us < 10 ? 2 : us < 1000 ? 1 : 0));
export const percent: Format = ifKnown((ratio) => `${fixed(100 * ratio, 1)} %`);
export const share: Format = ifKnown((ratio) =>
  ratio === 0 ? "0 %" : ratio < 1e-4 ? "<0.01 %" : `${fixed(100 * ratio, ratio < 0.01 ? 2 : 1)} %`,
); // what is not nothing never looks like it
export const factor: Format = decimal;
export const short: Format = ifKnown((value) =>
  value < 1e4 ? fixed(value, 0) : value < 1e6 ? `${fixed(value / 1e3, 1)}k` : `${fixed(value / 1e6, 2)}M`,
);

// Bytes that a sample reads, a mean: below 100 with three digits, without zeros at the end.
export const readBytes: Format = ifKnown((value) => {
  if (value >= 100 || value <= 0) return fixed(value, 0);
  return String(Number(fixed(value, 2 - Math.floor(Math.log10(value)))));
});

export const metres: Format = ifKnown((value) => `${Number(value.toPrecision(3))} m`);

// Of a machine, as its makers count.
export const memory: Format = ifKnown((value) => {
  const units = ["B", "KiB", "MiB", "GiB"];
  const power = Math.min(units.length - 1, value < 1024 ? 0 : Math.floor(Math.log2(value) / 10));
  return `${Number((value / 1024 ** power).toPrecision(3))} ${units[power]}`;
});

// "1 case", "2 cases".
export const plural = (number: number, word: string, words = `${word}s`) => `${number} ${number === 1 ? word : words}`;
