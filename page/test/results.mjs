// Results to show: the committed one, a sweep measured on the spot, and as large a one as asked for.

import { execFileSync, spawnSync } from "node:child_process";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

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
      tiles: {
        pixels: [
          [64, 64],
          [128, 128],
        ],
      },
      slices: { scheme: ["exponential", "linear"], count: 16, near: 0.1, far: 500 },
    },
  ],
  assigners: ["bounds", "aabb", "aabb-fast"],
  precision: ["float32", "half"],
  stability: { steps: 8 },
  lookup: { samples: 32 },
  shading: { samples: 64 },
  timing: { rounds: 3, min_time_ms: 0, frames: 1, sweep_mib: 4 },
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
  timing: { rounds: 3, min_time_ms: 0, frames: 2, sweep_mib: 4 },
};

// Two presets that lose nothing, one that has too little room, one that needs triangles.
export const presets = {
  name: "presets",
  scenes: [{ path: join(root, "scenes/street.glb"), frames: 2 }],
  viewport: [320, 180],
  presets: ["just-cause-3", "godot", "just-cause-2", "wicked"],
  timing: { measure: false },
};

// `tell` gets the table that the terminal shows.
export function measureSweep(tool, folder, config = sweep, tell = null) {
  const file = join(folder, `${config.name}.json`),
    from = join(folder, `${config.name}-config.json`);
  writeFileSync(from, JSON.stringify(config));
  const { stderr } = spawnSync(tool, ["run", from, ...(tell ? [] : ["-q"]), "-o", file], { encoding: "utf8" });
  if (tell) tell(stderr);
  return file;
}

// Two methods with pictures of two frames, in the folder that is returned beside the result.
export function withPictures(tool, folder) {
  const file = join(folder, "pictured.json"),
    images = join(folder, "pictured");
  execFileSync(
    tool,
    [
      "run",
      join(root, "scenes/mix.glb"),
      "--grid",
      "frustum",
      "--tiles",
      "64",
      "--assigner",
      "aabb-fast,exact-fast",
      "--viewport",
      "320x180",
      "--no-timing",
      "-q",
      "--set",
      "scenes.0.frames=4",
      "--image-frames",
      "0,2",
      "--images",
      images,
      "-o",
      file,
    ],
    { stdio: ["ignore", "ignore", "pipe"] },
  );
  return { file, images };
}

function changed(file, folder, name, change) {
  const result = JSON.parse(readFileSync(file)),
    into = join(folder, `${name}.json`);
  change(result);
  writeFileSync(into, JSON.stringify(result));
  return into;
}

// The first three cases as of a device, which took 30, 10 and 20 us, and reads the lists of the first.
export const onDevice = (file, folder, software = false) =>
  changed(file, folder, software ? "on-software" : "on-device", (result) => {
    const timeOf = (ns) => ({ median: ns, mad: 1, min: ns, p95: ns, ci95: [0.9 * ns, 1.1 * ns], samples: [ns] });
    result.device = {
      name: "Card",
      driver: "driver 1.2",
      vulkan: "1.3.0",
      uuid: "0".repeat(32),
      type: software ? "software" : "discrete GPU",
      subgroup_size: 32,
      timestamp_bits: 64,
      timestamp_period_ns: 1,
      rounds_to_nearest: true,
      max_buffer_bytes: 1e9,
      max_group_size: 1024,
      shared_bytes: 32768,
      arithmetic: {
        rounding: "to_nearest",
        contracts: false,
        reorders: false,
        flushes_denormals: true,
        division_ulp: 1,
        sqrt_ulp: 1,
        log2_ulp: 1,
        log2_error: 0,
      },
    };
    for (const [at, one] of result.cases.slice(0, 3).entries()) {
      const run_ns = timeOf([30e3, 10e3, 20e3][at]);
      delete one.timing;
      one.assigner.on_device = true;
      one.device = {
        device: "Card, driver 1.2",
        software,
        frames_timed: 4,
        dispatches: 3,
        run_ns,
        upload_ns: timeOf(4e3),
        readback_ns: timeOf(5e3),
        floor_ns: timeOf(5e3),
        floor_ratio: run_ns.median / 5e3,
      };
    }
    const walk = (name, ns) => ({
      walk: name,
      read_ns: timeOf(ns),
      cold_ns: timeOf(2 * ns),
      exact_ratio: 1.5,
      nothing_ratio: 3,
    });
    result.cases[0].reading = {
      device: "Card, driver 1.2",
      software,
      frames: 1,
      structure_bytes: 4096,
      frame_ns: 134e3,
      set: "opaque",
      walk: "lane",
      sets: [
        {
          set: "opaque",
          samples: 100,
          lights: 7,
          reads: 8,
          read_bytes: 32,
          divergence: 1,
          differing: 0,
          write_ns: timeOf(1e3),
          nothing_ns: timeOf(2e3),
          walks: [walk("lane", 100e3), walk("light", 90e3)],
        },
      ],
    };
  });

// Times that are known to a half and twice.
export const widened = (file, folder) =>
  changed(file, folder, "wide", ({ cases }) => {
    for (const { timing } of cases) timing.frame_ns.ci95 = [timing.frame_ns.median / 2, 2 * timing.frame_ns.median];
  });

// The first scene's cases once more, as of another camera.
export const withTwoCameras = (file, folder) =>
  changed(file, folder, "cameras", (result) => {
    const again = result.cases.filter((one) => one.scene === result.scenes[0].name);
    result.cases.push(...again.map((one) => ({ ...one, id: `${one.id}-again`, camera: "another" })));
  });

// Ranked by what frames cost; `exact-fast` would cost least, and leaves out lights.
export const rankedByCost = (file, folder) =>
  changed(file, folder, "by-cost", ({ config, cases }) => {
    config.rank_by = "frame_cost";
    for (const [at, one] of cases.entries()) {
      const lit = one.assigner.name !== "exact-fast",
        frame_ns = lit ? 1e6 + at : 1e3;
      one.cost = { frame_ns, assign_ns: 1, gpu_ns: 1, upload_ns: 1, traffic_ns: 0, shade_ns: 1, sets: {}, lit };
    }
  });

// One preset that loses pairs to its limit of lights alone, one whose method loses some as well.
export const limited = (file, folder) =>
  changed(file, folder, "limited", ({ cases }) => {
    const named = (name) => cases.find(({ preset }) => preset === name);
    const { pre_cull } = named("just-cause-2");
    const lose = (name, missed) => {
      const one = named(name);
      one.error = { ...one.error, false_negatives: missed };
      one.pre_cull = { ...pre_cull, lost_pairs: 10, over_limit: { lights: [1], lost_pairs: 5 } };
      one.warnings = ["too_many_lights", "lost_pairs"].map((kind) => ({ kind, text: kind }));
    };
    lose("just-cause-2", 10);
    lose("just-cause-3", 15);
  });

// One method on four of 4 x 4 combinations of tiling and slicing.
export const sparse = (file, folder) =>
  changed(file, folder, "sparse", ({ cases }) => {
    const grids = [...new Set(cases.map(({ grid }) => grid.name))];
    for (const one of cases.filter(({ assigner }) => assigner.name === "bounds")) {
      const size = 2 ** grids.indexOf(one.grid.name);
      one.grid = { ...one.grid, name: `frustum ${8 * size}px x ${size} linear` };
    }
  });

// The same, where everything takes twice as long.
export const onAnotherMachine = (file, folder) =>
  changed(file, folder, "elsewhere", (result) => {
    result.machine.cpu = "another processor";
    for (const { timing } of result.cases)
      for (const time of Object.values(timing)) {
        if (time?.median) time.median *= 2;
        if (time?.ci95) time.ci95 = time.ci95.map((end) => 2 * end);
      }
  });

// What `merge` makes of shards of two machines: half of the grids are of one, on the other everything takes a hundred times
// as long. Both have what the sweep has of conclusions: none.
export const ofTwoMachines = (file, folder) =>
  changed(file, folder, "merged", (result) => {
    const { clock_mhz: _clock, load: _load, ...machine } = result.machine;
    const names = ["machine 1", "machine 2"];
    const cpus = ["fast processor", "slow processor"];
    result.machine = { ...machine, cpu: cpus[0] };
    result.machines = names.map((name, at) => ({
      name,
      machine: { ...machine, cpu: cpus[at] },
      simd_target: result.tool.simd_target,
    }));
    delete result.conclusions;
    const grids = [...new Set(result.cases.map(({ grid }) => grid.name))];
    for (const one of result.cases) {
      const at = 2 * grids.indexOf(one.grid.name) < grids.length ? 0 : 1;
      one.machine = names[at];
      if (at === 0) continue;
      for (const time of Object.values(one.timing)) {
        if (time?.median) time.median *= 100;
        if (time?.ci95) time.ci95 = time.ci95.map((end) => end && 100 * end);
      }
    }
  });

// Of 14 commits; with the seventh all times became longer.
export function historyPage(tool, folder) {
  const history = join(folder, "history.jsonl"),
    page = join(folder, "history.html");
  for (let commit = 0; commit < 14; ++commit) {
    const file = changed(committedResult, folder, "commit", (result) => {
      result.cases = result.cases.slice(0, 3);
      for (const { timing } of result.cases)
        timing.assign_ns.median *= (commit < 7 ? 1 : 1.5) * (1 + 0.001 * ((commit * 3) % 7));
    });
    execFileSync(tool, ["history", "add", file, history, "--commit", `c${commit}`]);
  }
  execFileSync(tool, ["history", "show", history, "-o", page], { stdio: ["ignore", "ignore", "pipe"] });
  return pathToFileURL(page).href;
}

// The cases of a result again and again, each time as of another camera, until its text has so many bytes.
export function grown(result, bytes) {
  const once = JSON.stringify(result.cases).length;
  const cases = Array.from({ length: Math.ceil(bytes / once) }, (_, round) =>
    result.cases.map((one) => ({ ...one, id: `${one.id}-${round}`, camera: `${one.camera}-${round}` })),
  );
  return { ...result, cases: cases.flat() };
}
