// The page's data by the names that the page has for its parts. null is what is not a number.

import type { FigureWords, Result } from "./schema_types.ts";

export type { FigureWords, FrameCost, PageCase, PageData, Picture, Ranked, Result } from "./schema_types.ts";
export type Maybe = number | null;

export type FigureName = FigureWords["name"]; // a row of src/result/figures/figure_table.cpp
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
export type DeviceTimes = NonNullable<CaseResult["device"]>;
export type Time = DeviceTimes["run_ns"];
export type Reading = NonNullable<CaseResult["reading"]>;
export type SetReading = Reading["sets"][number];
export type WalkReading = SetReading["walks"][number];
export type Details = NonNullable<CaseResult["details"]>;
export type FailureKind = CaseResult["failures"][number]["kind"];
export type WarningKind = CaseResult["warnings"][number]["kind"];
