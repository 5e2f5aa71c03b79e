// The result file by the names that the page has for its parts; `clusterbench schema result` describes them. null is what
// is not a number.

import type { Result } from "./schema_types.ts";

export type { Result };
export type Maybe = number | null;

export type CaseResult = Result["cases"][number];
export type SceneResult = Result["scenes"][number];
export type Grid = CaseResult["grid"];
export type Stability = NonNullable<CaseResult["stability"]>;
export type Precision = NonNullable<CaseResult["precision"]>;
export type Lookup = NonNullable<CaseResult["lookup"]>[number];
export type Details = NonNullable<CaseResult["details"]>;
export type FailureKind = CaseResult["failures"][number]["kind"];
export type WarningKind = CaseResult["warnings"][number]["kind"];

// What src/report/page.cpp puts into the page.
export interface PageData {
  command: string;
  results: { file: string; result: Result }[];
}
