// The page of `clusterbench check` in a browser with WebGL in software, and in one without: node --test test/, with
// CLUSTERBENCH naming the built tool.

import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { after, afterEach, before, describe, it } from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";
import { chromiumPath, folder, launch, open as openPage, webGlInSoftware } from "./browser.mjs";

if (!chromiumPath) {
  console.log("skipped: there is no Chromium (scripts/setup test installs it)");
  process.exit(0);
}
const tool = process.env.CLUSTERBENCH;
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const scene = join(dirname(fileURLToPath(import.meta.url)), "../../scenes/street.glb");

// Exact lists in a grid of each kind, of which the two longest are emptied. Returns the dumps by kind.
function brokenDumps(place) {
  const config = join(place, "config.json");
  const slices = { scheme: "exponential", count: 12, near: 0.1, far: 100 };
  writeFileSync(
    config,
    JSON.stringify({
      scenes: [{ path: scene, camera: "walk", frames: 1 }],
      grids: [
        { kind: "frustum", tiles: { count: [12, 7] }, slices },
        { kind: "distance", tiles: { count: [12, 7] }, slices },
        { kind: "world", cells: [12, 4, 12] },
      ],
      assigners: ["exact-fast", "distance-fast", "world-grid-fast"],
    }),
  );
  const dumps = join(place, "dumps");
  execFileSync(tool, ["run", config, "--write-dump", dumps, "--dump-frames", "1"], {
    stdio: ["ignore", "ignore", "pipe"],
  });
  return readdirSync(dumps)
    .filter((name) => name.endsWith(".json"))
    .map((name) => breakOne(join(dumps, name)));
}

function breakOne(path) {
  const dump = JSON.parse(readFileSync(path, "utf8"));
  const file = join(dirname(path), dump.buffers.headers.file);
  const rows = readFileSync(file),
    stride = dump.lists[0].rows.stride;
  const length = (row) => rows.readUInt16LE(stride * row + 4) + rows.readUInt16LE(stride * row + 6);
  const emptied = [...Array(rows.length / stride).keys()].sort((a, b) => length(b) - length(a)).slice(0, 2);
  const lost = Object.fromEntries(emptied.map((row) => [row, length(row)]));
  for (const row of emptied) rows.writeUInt32LE(0, stride * row + 4);
  writeFileSync(file, rows);
  return { path, kind: dump.grid.kind, lost };
}

const pages = {};
let withWebGl, without, broken;
before(async () => {
  const place = folder();
  broken = brokenDumps(place);
  const make = (name, dumps, code) => {
    const into = join(place, `${name}.html`);
    const done = spawnSync(tool, ["check", "--methods", "none", ...dumps, "--page", into], { encoding: "utf8" });
    assert.equal(done.status, code, done.stdout + done.stderr);
    pages[name] = pathToFileURL(into).href;
  };
  for (const { path, kind } of broken) make(kind, [path], 1);
  make("all", [dirname(broken[0].path)], 1);
  const right = join(place, "right");
  const run = [
    "run",
    scene,
    "--grid",
    "frustum",
    "--assigner",
    "exact-fast",
    "--write-dump",
    right,
    "--dump-frames",
    "1",
  ];
  execFileSync(tool, run, { stdio: ["ignore", "ignore", "pipe"] });
  make("right", [right], 0);
  withWebGl = await launch(webGlInSoftware);
  without = await launch(["--disable-3d-apis"]);
});
afterEach(() =>
  Promise.all([withWebGl, without].flatMap((browser) => browser.contexts().map((context) => context.close()))),
);
after(() => Promise.all([withWebGl?.close(), without?.close()]));

// What this software renderer warns of is no fault of the page.
const open = (browser, url, options) => openPage(browser, url, { levels: ["error"], ...options });
const text = (page, selector) => page.locator(selector).first().innerText();
const settle = (page) =>
  page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
async function picture(page) {
  await settle(page);
  return (await page.locator("#cells-3d").screenshot()).toString("base64");
}
async function changes(page, deed) {
  const earlier = await picture(page);
  await deed();
  return (await picture(page)) !== earlier;
}

describe("the page of a check", () => {
  it("shows the cells that lose lights, and only those, on every kind of grid", async () => {
    assert.equal(broken.length, 3);
    for (const { kind, lost } of broken) {
      const page = await open(withWebGl, pages[kind]);
      assert.match(await text(page, "h2"), /lists: lights are lost/);
      const rows = await page
        .locator(".table")
        .last()
        .locator("tbody tr")
        .evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.innerText)));
      // The methods of the other kinds list a few lights for nothing, which are not lost then.
      const most = Object.values(lost).sort((a, b) => a - b);
      const told = rows.map((row) => Number(row[1])).sort((a, b) => a - b);
      assert.equal(told.length, 2);
      if (kind === "frustum") assert.deepEqual(told, most);
      for (const at of [0, 1])
        assert.ok(told[at] <= most[at] && told[at] >= most[at] - 3, `${kind}: ${told} of ${most}`);
      assert.ok(rows.every((row) => row[3] === "0"));
      assert.deepEqual(page.faults, []);
    }
  });

  it("tells the lists of a cell that is picked in the table or in the picture", async () => {
    const page = await open(withWebGl, pages.frustum);
    const { lost } = broken.find(({ kind }) => kind === "frustum");
    const buttons = page.locator(".table").last().locator("tbody button");
    const named = await buttons.allInnerTexts();
    for (const [at, name] of named.entries()) {
      await buttons.nth(at).click();
      assert.equal(await text(page, ".picked-cell h3"), `Cell ${name}`);
      const [x, y, z] = name.split(", ").map(Number);
      const count = lost[x + 12 * (y + 7 * z)];
      assert.match(
        await text(page, ".picked-cell p"),
        new RegExp(`0 lights in the list, ${count} true; ${count} false negatives?`),
      );
      assert.match(await text(page, ".picked-cell tbody tr"), /false negative/);
    }
    const canvas = page.locator("#cells-3d");
    await canvas.scrollIntoViewIfNeeded();
    const { x, y, width, height } = await canvas.boundingBox();
    await buttons.nth(0).click();
    const seen = new Set();
    for (let i = 1; i < 24; ++i)
      for (let j = 1; j < 14; ++j) {
        await page.mouse.click(x + (i / 24) * width, y + (j / 14) * height);
        seen.add(await text(page, ".picked-cell h3"));
        if (seen.size === 2) return;
      }
    assert.fail(`clicks found ${[...seen]}`);
  });

  it("changes with every control", async () => {
    const page = await open(withWebGl, pages.frustum);
    assert.ok(await changes(page, () => page.locator("#check-lights").selectOption("none")), "no lights");
    assert.ok(await changes(page, () => page.locator("#check-lights").selectOption("all")), "all lights");
    assert.ok(await changes(page, () => page.locator("#check-even").uncheck()), "even depth");
    await page.locator("#check-colour-reach").check({ force: true });
    assert.match(await text(page, ".legend"), /reaches deeper[\s\S]*100 %/);
    assert.deepEqual(page.faults, []);
  });

  it("has a choice of frames, and begins with one of the worst verdict", async () => {
    const page = await open(withWebGl, pages.all);
    assert.equal(await page.locator("#check-frame option").count(), 3);
    const first = await text(page, ".summary");
    await page.locator("#check-frame").selectOption("2");
    assert.notEqual(await text(page, ".summary"), first);
    assert.deepEqual(page.faults, []);
  });

  it("says that nothing is lost where nothing is", async () => {
    const page = await open(withWebGl, pages.right);
    assert.match(await text(page, "h2"), /right: no light is lost/);
    assert.equal(await page.locator("#cells-3d").count(), 0);
    assert.deepEqual(page.faults, []);
  });

  it("keeps to tables where there is no WebGL", async () => {
    const page = await open(without, pages.frustum);
    assert.match(await text(page, ".cells"), /no WebGL 2/);
    assert.match(await text(page, ".picked-cell p"), /false negative/);
    assert.deepEqual(page.faults, []);
  });

  for (const colorScheme of ["light", "dark"])
    it(`can be read by all in ${colorScheme} colours`, async () => {
      const page = await open(withWebGl, pages.frustum, { colorScheme });
      await page.evaluate(axe);
      const { violations } = await page.evaluate(() => globalThis.axe.run());
      assert.deepEqual(
        violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html).join("; ")}`),
        [],
      );
    });
});
