// The result file as the page reads it: a part of `clusterbench schema result`. null is what is not a number.

import type { Details } from "./cells/details.ts";

export type Maybe = number | null;

export interface Spread {
  mean: Maybe;
  p50: Maybe;
  p95: Maybe;
  p99: Maybe;
  max: Maybe;
}

export interface TimeStats {
  median: Maybe;
  mad: Maybe;
  min: Maybe;
  p95: Maybe;
  ci95: [Maybe, Maybe];
}

export interface HighWater {
  high_water: number;
  theoretical_max: number;
  recommended: number;
}

export interface Grid {
  kind: "frustum" | "distance" | "cascades" | "world";
  name: string;
  cells: [number, number, number];
}

export interface StabilityCounts {
  total: number;
  mean: Maybe;
  max: number;
}

export interface Stability {
  steps: number;
  step_m: Maybe;
  step_deg: Maybe;
  window: number;
  from_frame: number;
  drift: boolean;
  path: string;
  grids: number;
  changed: { method: StabilityCounts; truth: StabilityCounts };
  flickers: { method: number; truth: number };
  excess_churn: { pairs: number; ratio: Maybe };
  excess_flickers: { count: number; ratio: Maybe };
}

export interface Precision {
  packing: string;
  label: string;
  position_error_m: { mean: Maybe; max: Maybe };
  extra_pairs: { mean: Maybe; ratio: Maybe };
}

export interface Lookup {
  logarithm: string;
  depth: string;
  needed: number;
  missed: number;
  wrong_samples: number;
  safe_padding_ulps: number;
}

export type FailureKind = "lost_pairs" | "extra_pairs" | "lost_at_samples" | "dropped_pairs";

export interface CaseResult {
  id: string;
  name: string;
  scene: string;
  camera: string;
  viewport: [number, number];
  frames: number;
  grid: Grid;
  assigner: { name: string; label: string; params: object; conservative: boolean; exact: boolean };
  storage: string;
  failures?: { kind: FailureKind; text: string }[];
  loses_lights?: boolean;
  tests_done: number;
  fallbacks?: number;
  occupancy?: {
    pairs: Spread;
    lights_per_cluster: Spread & { histogram: number[] };
    occupied_fraction: Spread;
    worst_frame: number;
    worst_cell: [number, number, number];
    along_path?: { frames_per_entry: number; pairs: number[]; longest_list: number[] };
  };
  buffers: {
    index_entries: HighWater;
    bytes: HighWater;
    header_bytes: number;
    index_bits: number;
    scratch_bytes: number;
    along_path?: { frames_per_entry: number; bytes: number[] };
    overflow: { dropped_pairs: number; cells: number; frames: number };
    worst_frame: number;
  };
  error?: {
    true_pairs: number;
    reported_pairs: number;
    false_positives: number;
    false_negatives: number;
    excess_ratio: Maybe;
    miss_ratio: Maybe;
    deepest_miss: Maybe;
    undecided: number;
  };
  shading?: {
    samples: number;
    missed: number;
    missed_in_cells?: number;
    missed_outside?: number;
    needed: number;
    unlit?: Maybe;
    worst_frame?: { frame: number; missed: number; needed: number };
    overshade: Maybe;
  };
  stability?: Stability;
  precision?: Precision;
  lookup?: Lookup[];
  timing?: {
    frames_timed: number;
    frame_ns?: TimeStats;
    worst_frame?: { frame: number; ns: Maybe; ci95: [Maybe, Maybe]; pairs?: number };
    pairs?: { mean: Maybe; max: number };
    builds_per_frame?: number;
    build_ns: TimeStats;
    assign_ns: TimeStats;
    convert_ns?: TimeStats;
    ns_per_pair: Maybe;
    write_floor_ns: Maybe;
    floor_ratio: Maybe;
    vs?: { assigner: string; ratio: Maybe; ci95: [Maybe, Maybe] };
  };
  count?: { source: string; instructions_per_frame: { assign: number; convert?: number } };
  details?: Details;
}

export interface SceneResult {
  name: string;
  sha256: string;
  lights: { point: number; spot: number; directional: number; box: number };
  frames: number;
  range_rule: { from_intensity: number; cutoff_lux: Maybe; max_range: Maybe; clamped: number };
  warnings: string[];
}

export interface Result {
  schema_version: 1;
  name: string;
  tool: {
    version: string;
    git_sha: string;
    compiler: string;
    flags: string;
    build_type: string;
    simd_target: string;
    libraries: Record<string, string>;
  };
  machine: {
    cpu: string;
    family?: string;
    model?: string;
    stepping?: string;
    caches?: Record<string, number>;
    cores: number;
    ram_bytes: number;
    os: string;
  };
  config: Record<string, unknown>;
  scenes: SceneResult[];
  cases: CaseResult[];
  front: { scene: string; ids: string[] }[];
  skipped: { name: string; reason: string }[];
}

// What src/report/page.cpp puts into the page.
export interface PageData {
  command: string;
  results: { file: string; result: Result }[];
}
