// Results of several machines: what has times stands for each machine by itself.

import assert from "node:assert/strict";
import { join } from "node:path";
import { it } from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";
import { buildSync } from "esbuild";
import { folder } from "./browser.mjs";

// Browsers have it, and Node.js from 21 on.
Map.groupBy ??= (all, keyOf) => {
  const groups = new Map();
  for (const one of all) groups.set(keyOf(one), [...(groups.get(keyOf(one)) ?? []), one]);
  return groups;
};

const source = (name) => JSON.stringify(fileURLToPath(new URL(`../src/${name}.ts`, import.meta.url)));
const contents = ["heat_map", "machines", "model", "overall"]
  .map((name) => `export * from ${source(name)};`)
  .join("\n");
const outfile = join(folder(), "page.mjs");
const resolveDir = fileURLToPath(new URL(".", import.meta.url));
buildSync({ stdin: { contents, resolveDir }, bundle: true, format: "esm", outfile });
const { blocksOf, cellsOf, measures, placesOf, placeText, rangesOf, seenBy, standings } = await import(
  pathToFileURL(outfile).href
);

const machineNamed = (name, cpu, cores) => ({ name, machine: { cpu, cores }, simd_target: "AVX3" });
const merged = {
  label: "merged",
  result: {
    machine: { cpu: "Slow CPU", cores: 2 },
    machines: [machineNamed("machine 1", "Slow CPU", 2), machineNamed("machine 2", "Fast CPU", 1)],
    config: {},
    tool: { simd_target: "AVX3" },
  },
};
const plain = {
  label: "plain",
  result: { machine: { cpu: "Third CPU", cores: 4 }, config: {}, tool: { simd_target: "AVX2" } },
};

// A case whose frames take so long.
function timed(run, machine, assigner, pixels, us, more = {}) {
  const name = `frustum ${pixels}px x 16 linear`;
  return {
    run,
    machine,
    scene: "street",
    assigner,
    family: assigner,
    grid: name,
    storage: "packed",
    raw: { camera: "first", viewport: [64, 64], machine: machine || undefined, grid: { kind: "frustum", name } },
    isEligible: true,
    isSearched: false,
    isOnFront: false,
    frameUs: us,
    costNs: 1000 * us,
    figures: { frame_us: us, excess: 0.5, bytes: 100 },
    ...more,
  };
}

const of = (run, machine, factor) => [
  timed(run, machine, "bounds", 64, 1 * factor),
  timed(run, machine, "bounds", 128, 2 * factor),
  timed(run, machine, "aabb", 64, 3 * factor),
];
const both = [...of(merged, "machine 1", 100), ...of(merged, "machine 2", 1)];

it("over all scenes each machine has standings and ranks of its own", () => {
  const rows = standings(both, both);
  assert.equal(rows.length, 6);
  for (const machine of ["machine 1", "machine 2"]) {
    const told = rows
      .filter((row) => row.machine === machine)
      .map((row) => [row.rank, row.timeByBest.value, row.costByBest.value].map(Math.round));
    assert.deepEqual(
      told,
      [1, 2, 3].map((place) => [place, place, place]),
    );
  }
});

it("cases of two machines do not see the same", () => {
  assert.equal(new Set(both.map(seenBy)).size, 2);
});

it("the ranking has a block for each machine, in their order, and what is of none comes last", () => {
  const cases = [...of(plain, "", 1), ...of(merged, "machine 2", 1), ...of(merged, "machine 1", 1)];
  const blocks = blocksOf(cases, false);
  assert.deepEqual(
    blocks.map(({ title }) => title),
    [
      "merged, machine 1: Slow CPU, 2 cores",
      "merged, machine 2: Fast CPU, 1 core",
      "not of a result of several machines, or without times",
    ],
  );
  for (const { cases: some } of blocks) assert.equal(new Set(some.map(({ machine }) => machine)).size, 1);
  assert.equal(blocksOf(both, true)[0].title, "machine 1: Slow CPU, 2 cores");
});

it("results of one machine each stay in one table", () => {
  const blocks = blocksOf([...of(plain, "", 1), ...of({ ...plain, label: "other" }, "", 1)], false);
  assert.deepEqual(
    blocks.map(({ title, cases }) => [title, cases.length]),
    [["", 6]],
  );
});

it("a result's machines are all named, with their processors", () => {
  assert.deepEqual(placesOf(merged).map(placeText), ["machine 1: Slow CPU, 2 cores", "machine 2: Fast CPU, 1 core"]);
  assert.deepEqual(placesOf(plain).map(placeText), ["Third CPU, 4 cores"]);
});

it("maps of times are of one machine each, with colours of its own", () => {
  const cells = cellsOf(both, measures.time);
  assert.deepEqual(
    new Set(cells.map(({ method }) => method)),
    new Set(["bounds", "aabb"].flatMap((method) => [`${method} / machine 1`, `${method} / machine 2`])),
  );
  assert.deepEqual(
    cells.map(({ value }) => Math.round(value)),
    [100, 200, 300, 1, 2, 3],
  );
  assert.deepEqual(
    [...rangesOf(cells).values()].map((range) => range.map(Math.round)),
    [
      [100, 300],
      [1, 3],
    ],
  );
});

it("maps of what is counted are of all machines, in the same colours", () => {
  const cells = cellsOf(both, measures.bytes);
  assert.deepEqual([...new Set(cells.map(({ method }) => method))], ["bounds", "aabb"]);
  assert.equal(rangesOf(cells).size, 1);
});
