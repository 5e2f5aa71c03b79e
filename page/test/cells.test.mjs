// The view of cells in a browser with WebGL in software, and in one without: node --test test/, with CLUSTERBENCH naming the
// built tool.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { after, afterEach, before, describe, it } from "node:test";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";
import { chromiumPath, folder, launch, makePage, open as openPage, webGlInSoftware } from "./browser.mjs";

if (!chromiumPath) {
  console.log("skipped: there is no Chromium (scripts/setup test installs it)");
  process.exit(0);
}
const tool = process.env.CLUSTERBENCH;
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const place = folder();
const scene = join(dirname(fileURLToPath(import.meta.url)), "../../scenes/street.glb");

// Every kind of grid, and a method that loses lights.
function measure(name, details) {
  const config = join(place, `${name}-config.json`),
    result = join(place, `${name}.json`);
  const slices = { scheme: "exponential", count: 24, near: 0.1, far: 200 };
  writeFileSync(
    config,
    JSON.stringify({
      name,
      scenes: [{ path: scene, frames: 24 }],
      grids: [
        { kind: "frustum", tiles: { count: [16, 8] }, slices },
        { kind: "distance", tiles: { pixels: [128, 128] }, slices },
        { kind: "cascades", levels: 4 },
        { kind: "world", cells: [16, 4, 16] },
      ],
      assigners: ["naive-refinement", "distance", "cascades", "world-grid"],
      details,
      shading: { samples: 0 },
      timing: { measure: false },
    }),
  );
  execFileSync(tool, ["run", config, "-o", result], { stdio: ["ignore", "ignore", "pipe"] });
  return result;
}

const pages = {};
let withWebGl, without, result;
before(async () => {
  const file = measure("cells", { frames: 3 });
  result = JSON.parse(readFileSync(file, "utf8"));
  pages.cells = makePage(tool, [file], join(place, "cells.html"));
  pages.bounded = makePage(tool, [measure("bounded", { frames: 3, max_bytes: 60000 })], join(place, "bounded.html"));
  withWebGl = await launch(webGlInSoftware);
  without = await launch(["--disable-3d-apis"]);
});
afterEach(() =>
  Promise.all([withWebGl, without].flatMap((browser) => browser.contexts().map((context) => context.close()))),
);
after(() => Promise.all([withWebGl?.close(), without?.close()]));

// What this software renderer warns of is no fault of the page.
const open = (browser, url, options) => openPage(browser, url, { levels: ["error"], ...options });

// How many pixels of a canvas have which colours, as it stands on the screen.
async function colours(page, selector) {
  const picture = await page.locator(selector).screenshot();
  return page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const image = await createImageBitmap(new Blob([bytes]));
    const pen = new OffscreenCanvas(image.width, image.height).getContext("2d");
    pen.drawImage(image, 0, 0);
    const data = new Uint32Array(pen.getImageData(0, 0, image.width, image.height).data.buffer),
      counts = new Map();
    for (const pixel of data) counts.set(pixel, (counts.get(pixel) ?? 0) + 1);
    return { total: data.length, distinct: counts.size, most: Math.max(...counts.values()) };
  }, picture.toString("base64"));
}

const settle = (page) =>
  page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
async function picture(page, selector = "#cells-3d") {
  await settle(page);
  return (await page.locator(selector).screenshot()).toString("base64");
}
const set = (page, selector, value) => page.locator(selector).fill(String(value));
const text = (page, selector) => page.locator(selector).first().innerText();

// Does what is done change the picture?
async function changes(page, deed, selector) {
  const earlier = await picture(page, selector);
  await deed();
  return (await picture(page, selector)) !== earlier;
}

// The page's own modules, outside of a browser.
async function modules() {
  const contents = ["details", "geometry", "numbers"]
    .map((name) => `export * from "./src/cells/${name}.ts";`)
    .join("\n");
  const resolveDir = join(dirname(fileURLToPath(import.meta.url)), "..");
  const made = await build({
    stdin: { contents, resolveDir, loader: "ts" },
    bundle: true,
    format: "esm",
    write: false,
  });
  return import(`data:text/javascript;base64,${Buffer.from(made.outputFiles[0].text).toString("base64")}`);
}

describe("the most lights over depth", () => {
  it("are those of the fullest cells of each slice, on every kind of grid with slices", async () => {
    const { geometryOf, unpacked } = await modules();
    for (const one of result.cases) {
      const longest = one.occupancy.longest_by_slice;
      if (one.grid.kind === "world") {
        assert.equal(longest, undefined);
        continue;
      }
      assert.equal(Math.max(...longest), one.occupancy.lights_per_cell.max, one.name);
      for (const frame of one.details.frames) {
        const cells = unpacked(frame, one.grid);
        const { size } = geometryOf(one, cells);
        cells.cells.forEach((index, row) => {
          const slice = Math.floor(index / (size[0] * size[1]));
          assert.ok(cells.reported[row] <= longest[slice], `${one.name}: slice ${slice}`);
        });
      }
    }
  });

  it("stand in the chart's table with from where to where each slice reaches", async () => {
    const page = await open(without, pages.cells);
    const options = await page
      .locator("#depth select")
      .first()
      .locator("option")
      .evaluateAll((all) => all.map((one) => one.value));
    let seen = 0;
    for (const option of options) {
      await page.locator("#depth select").first().selectOption(option);
      const text = await page
        .locator("#depth select")
        .first()
        .evaluate((list) => list.selectedOptions[0].innerText);
      const one = result.cases.find(({ grid, camera }) => text.includes(grid.name) && text.includes(camera));
      if (one.grid.kind === "world") {
        assert.equal(await page.locator("#lights-by-depth").count(), 0);
        continue;
      }
      const details = page.locator("#lights-by-depth details"); // once opened it stays so
      if (!(await details.evaluate((one) => one.open))) await details.locator("summary").click();
      await page.locator("#lights-by-depth tbody tr").first().waitFor();
      const rows = await page
        .locator("#lights-by-depth tbody tr")
        .evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.innerText)));
      const cases = result.cases.filter(({ grid, camera }) => grid.name === one.grid.name && camera === one.camera);
      for (const { occupancy } of cases) {
        const lights = occupancy.longest_by_slice.filter((most) => most > 0);
        assert.ok(rows.length >= lights.length);
        for (const most of lights) assert.ok(rows.some((row) => Number(row[3]) === most));
      }
      if (one.grid.slices) {
        const metres = (value) => `${Number(value.toPrecision(3))}`;
        const slice = one.occupancy.longest_by_slice.findIndex((most) => most > 0);
        const [near, far] = one.grid.slices.boundaries.slice(slice, slice + 2).map(metres);
        assert.ok(
          rows.some((row) => row[1] === near && row[2] === far),
          `${near} to ${far}`,
        );
      }
      ++seen;
    }
    assert.ok(seen > 1);
  });
});

describe("the view of cells", () => {
  it("puts cells where their lights reach them, on every kind of grid", async () => {
    const { unpacked, geometryOf, cellOf, inView, indexOf } = await modules();
    const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    for (const one of result.cases) {
      let pairs = 0;
      for (const packed of one.details.frames) {
        const frame = unpacked(packed, one.grid),
          geometry = geometryOf(one, frame);
        frame.cells.forEach((cell, at) => {
          const place = cellOf(geometry.size, cell);
          assert.equal(indexOf(geometry.size, ...place), cell);
          assert.ok(!geometry.isHole(...place));
          const block = geometry.block(...place);
          const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((bits) =>
            inView(geometry, [block[bits & 1], block[2 + ((bits >> 1) & 1)], block[4 + (bits >> 2)]]),
          );
          const centre = [0, 1, 2].map((axis) => corners.reduce((sum, corner) => sum + corner[axis] / 8, 0));
          const radius = 1.02 * Math.max(...corners.map((corner) => distance(corner, centre)));
          for (const { light, mark } of frame.listOf(at)) {
            if (mark === 1) continue;
            assert.ok(
              distance(light.position, centre) <= light.range + radius,
              `${one.name}: ${light.name} in cell ${place}`,
            );
            ++pairs;
          }
        });
      }
      assert.ok(pairs > 1000, one.name);
    }
  });

  it("draws every kind of grid", async () => {
    const page = await open(withWebGl, pages.cells);
    const cases = await page.locator("#cells-case option").all();
    assert.equal(cases.length, 4);
    for (const one of cases) {
      await page.locator("#cells-case").selectOption(await one.getAttribute("value"));
      await settle(page);
      const seen = await colours(page, "#cells-3d");
      assert.ok(
        seen.distinct > 100 && seen.most < 0.95 * seen.total,
        `${await one.innerText()}: ${JSON.stringify(seen)}`,
      );
    }
    assert.deepEqual(page.faults, []);
  });

  it("changes with every control", async () => {
    const page = await open(withWebGl, pages.cells);
    for (const [selector, value] of [
      ["#cells-frame", 1],
      ["#cells-column", 3],
      ["#cells-row", 6],
      ["#cells-slice", 15],
      ["#cells-least", 4],
    ])
      assert.ok(await changes(page, () => set(page, selector, value)), selector);
    for (const selector of [
      "#cells-show-slice",
      "#cells-show-tile",
      "#cells-show-all",
      "#cells-what-excess",
      "#cells-what-missing",
      "#cells-what-true",
    ])
      assert.ok(await changes(page, () => page.locator(selector).check({ force: true })), selector);
    assert.ok(await changes(page, () => page.locator("#cells-lights").selectOption("all")), "lights");
    assert.ok(await changes(page, () => page.locator("#cells-even").uncheck()), "even depth");
    assert.deepEqual(page.faults, []);
  });

  it("turns, moves, zooms and comes back by keys", async () => {
    const page = await open(withWebGl, pages.cells);
    await page.locator("#cells-3d").focus();
    const start = await picture(page);
    for (const key of ["ArrowLeft", "ArrowUp", "Shift+ArrowRight", "+", "-", "ArrowDown"])
      assert.ok(await changes(page, () => page.keyboard.press(key)), key);
    await page.keyboard.press("Home");
    assert.equal(await picture(page), start);
  });

  it("turns by the mouse, and a click picks the cell that is seen there", async () => {
    const page = await open(withWebGl, pages.cells);
    const canvas = page.locator("#cells-3d");
    await canvas.scrollIntoViewIfNeeded();
    const { x, y, width, height } = await canvas.boundingBox();
    const middle = [x + 0.42 * width, y + 0.55 * height];
    assert.ok(
      await changes(page, async () => {
        await page.mouse.move(...middle);
        await page.mouse.down();
        await page.mouse.move(middle[0] + 40, middle[1] - 20, { steps: 3 });
        await page.mouse.up();
      }),
    );
    const before = await text(page, ".picked-cell h3");
    await page.mouse.click(...middle);
    assert.notEqual(await text(page, ".picked-cell h3"), before);
    assert.match(await text(page, ".picked-cell p"), /light/);
  });

  it("tells of a cell what the result says", async () => {
    const page = await open(withWebGl, pages.cells);
    await page.locator("#cells-what-missing").check({ force: true });
    await set(page, "#cells-frame", 2);
    await page.locator("#cells-worst").click();
    assert.match(await text(page, ".picked-cell p"), /1 false negative/);
    assert.match(await text(page, ".picked-cell tbody tr"), /false negative/);
    const { false_negatives: missed } = result.cases[0].error;
    assert.ok(missed > 0);
    const frame = result.cases[0].details.frames[2];
    assert.ok(
      (await text(page, "#cells .cells > .note")).startsWith(
        `Frame ${frame.frame}: ${frame.cells.count.toLocaleString("en")} of 3,072 cells`,
      ),
    );
  });

  it("picks a tile on the map of a slice", async () => {
    const page = await open(withWebGl, pages.cells);
    await set(page, "#cells-slice", 12);
    const map = page.locator(".slice-map");
    await map.scrollIntoViewIfNeeded();
    const { width, height } = await map.boundingBox();
    await map.click({ position: { x: (2.5 / 16) * width, y: (1.5 / 8) * height } });
    assert.equal(await text(page, ".picked-cell h3"), "Cell 2, 1, 12");
    assert.equal(await page.locator("#cells-column").inputValue(), "2");
  });

  it("says what had no room", async () => {
    const page = await open(withWebGl, pages.bounded);
    assert.match(await text(page, "#cells"), /left out: max_bytes 60000 has no room/);
    assert.deepEqual(page.faults, []);
  });

  it("keeps to slices where there is no WebGL", async () => {
    const page = await open(without, pages.cells);
    assert.equal(await page.locator("#cells-3d").count(), 0);
    assert.match(await text(page, "#cells"), /no WebGL 2/);
    assert.ok(await changes(page, () => set(page, "#cells-slice", 5), ".slice-map"));
    assert.ok(await changes(page, () => set(page, "#cells-frame", 1), ".slice-map"));
    assert.ok((await colours(page, ".slice-map")).distinct > 3);
    assert.deepEqual(page.faults, []);
  });

  for (const [name, colorScheme] of [
    ["with", "light"],
    ["without", "dark"],
  ])
    it(`is accessible ${name} WebGL in ${colorScheme}`, async () => {
      const page = await open(name === "with" ? withWebGl : without, pages.cells, { colorScheme });
      await page.evaluate(axe);
      const found = await page.evaluate(() => globalThis.axe.run("#cells"));
      assert.deepEqual(
        found.violations.map((one) => `${one.id}: ${one.nodes.map((node) => node.target).join("; ")}`),
        [],
      );
    });
});
