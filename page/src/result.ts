// The result file by the names that the page has for its parts; `clusterbench schema result` describes them. null is what
// is not a number.

import type { Result } from "./schema_types.ts";

export type { Result };
export type Maybe = number | null;

export type CaseResult = Result["cases"][number];
export type SceneResult = Result["scenes"][number];
export type Grid = CaseResult["grid"];
export type Stability = NonNullable<CaseResult["stability"]>;
export type Fit = NonNullable<CaseResult["fit"]>;
export type React = NonNullable<CaseResult["react"]>;
export type Fallback = NonNullable<CaseResult["fallback"]>;
export type Saved = Fit["saved"];
export type Precision = NonNullable<CaseResult["precision"]>;
export type Lookup = NonNullable<CaseResult["lookup"]>[number];
export type Details = NonNullable<CaseResult["details"]>;
export type FailureKind = CaseResult["failures"][number]["kind"];
export type WarningKind = CaseResult["warnings"][number]["kind"];

// What src/report/page/page.cpp puts into the page.
export interface PageData {
  command: string;
  results: { file: string; result: Result; doubts: string[]; ratios: Ranked[]; costs: FrameCost[] }[];
  pictures: Picture[];
}

// Of a case that loses nothing: making its lists (where timed), upload, reading and shading by the configuration's model.
// By this the conclusions choose.
export interface FrameCost {
  id: string;
  ns: number;
  gpu_ns: number; // of it what is modelled
}

// Of what pixels find in the lists of some cases, in a frame or along the path (null).
export interface Picture {
  kind: string;
  frame: number | null;
  cases: string[]; // their ids
  text: string; // for those who do not see it
  url: string;
}

// Frame time by that of another case that was measured beside it.
export interface Beside {
  id: string;
  ratio: Maybe;
  ci95: [Maybe, Maybe];
}

// A timed case beside the fastest of its scene, camera and viewport, and beside the next faster one.
export interface Ranked {
  id: string;
  fastest: Beside | null;
  above: Beside | null;
  is_like_above: boolean; // may be as fast, as far as their ratio is known
}
