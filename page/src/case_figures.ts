// Figures of cases, with units and meanings, as the program's table has them (src/result/figures/figure_table.cpp). A new
// column of a table is one line with the figure's name.

import * as format from "./format.ts";
import type { Case } from "./model.ts";
import type { FigureName, FigureWords, Maybe } from "./result.ts";
import type { Column } from "./table.ts";

export type Figures = Partial<Record<FigureName, number>>;
export type Words = ReadonlyMap<FigureName, FigureWords>;

export const figure = ({ figures }: Pick<Case, "figures">, name: FigureName): Maybe => figures[name] ?? null;

// Of the timed frames, or of all frames if no frame is timed.
export const pairsOf = (aCase: Case): Maybe => figure(aCase, "pairs_timed") ?? figure(aCase, "pairs.mean");

// How the page writes a number of a unit, where a column has no format of its own.
const formats: Record<string, format.Format> = {
  us: format.microseconds,
  ratio: format.factor,
  bytes: format.short,
  entries: format.short,
  pairs: format.short,
  tests: format.short,
  instructions: format.short,
  cycles: format.short,
  lights: format.whole,
};

export const capitalised = (text: string) => `${text.charAt(0).toUpperCase()}${text.slice(1)}`;

export const meaningOf = (words: Words, name: FigureName): string => words.get(name)!.meaning;

// The figure's meaning, and a note on how to read it.
export function aboutOf(words: Words, name: FigureName, note?: string): string {
  const about = capitalised(meaningOf(words, name));
  return note ? `${about}. ${capitalised(note)}` : about;
}

export interface FigureColumn<Row> extends Partial<Column<Row>> {
  note?: string; // what the meaning does not say
  format?: format.Format;
}

// Columns of figures of a row's case.
export function columnsOf<Row>(words: Words, caseOf: (row: Row) => Case) {
  return (name: FigureName, label: string, more: FigureColumn<Row> = {}): Column<Row> => {
    const { note, format: own, ...column } = more;
    const write = own ?? formats[words.get(name)!.unit] ?? format.decimal;
    const value = (row: Row) => figure(caseOf(row), name);
    return { label, about: aboutOf(words, name, note), value, show: (row) => write(value(row)), ...column };
  };
}
