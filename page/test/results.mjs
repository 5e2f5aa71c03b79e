// Results to show: the committed one, a sweep measured on the spot, and as large a one as asked for.

import { execFileSync } from "node:child_process";
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

const root = fileURLToPath(new URL("../../", import.meta.url));
const machine = readdirSync(join(root, "results"), { withFileTypes: true }).find((entry) => entry.isDirectory());

export const committedResult = join(root, "results", machine.name, "quick.json");

// Everything that a result can have, as little of it as will do.
const sweep = {
  name: "sweep",
  scenes: ["street", "hall-512"].map((name) => ({ path: join(root, `scenes/${name}.glb`), frames: 4 })),
  grids: [
    {
      kind: "frustum",
      tiles: { pixels: [[64, 64], [128, 128]] },
      slices: { scheme: ["exponential", "linear"], count: 16, near: 0.1, far: 500 },
    },
  ],
  assigners: ["bounds", "aabb", "aabb-fast"],
  precision: ["float32", "half"],
  stability: { steps: 8 },
  lookup: { samples: 32 },
  shading: { samples: 64 },
  timing: { rounds: 3, min_time_ms: 0, frames: 1 },
};

// A grid that ends too near, and a storage with too little room.
export const lossy = {
  name: "lossy",
  scenes: [{ path: join(root, "scenes/street.glb"), frames: 3 }],
  grids: [
    { kind: "frustum", tiles: { pixels: [64, 64] }, slices: { scheme: "exponential", count: 16, near: 0.1, far: 500 } },
    { kind: "frustum", tiles: { pixels: [64, 64] }, slices: { scheme: "linear", count: 8, near: 0.1, far: 10 } },
  ],
  assigners: ["bounds-fast", "exact-fast"],
  storages: ["packed", { name: "fixed", cap: 2 }],
  limits: { dropped_pairs: null },
  timing: { rounds: 3, min_time_ms: 0, frames: 2 },
};

export function measureSweep(tool, folder, config = sweep) {
  const file = join(folder, `${config.name}.json`), from = join(folder, `${config.name}-config.json`);
  writeFileSync(from, JSON.stringify(config));
  execFileSync(tool, ["run", from, "-q", "-o", file], { stdio: ["ignore", "ignore", "inherit"] });
  return file;
}

// The cases of a result again and again, each time as of another camera, until its text has so many bytes.
export function grown(result, bytes) {
  const once = JSON.stringify(result.cases).length;
  const cases = Array.from({ length: Math.ceil(bytes / once) }, (_, round) =>
    result.cases.map((one) => ({ ...one, id: `${one.id}-${round}`, camera: `${one.camera}-${round}` })),
  );
  return { ...result, cases: cases.flat() };
}
