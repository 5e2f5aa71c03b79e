// The page in a browser, as `clusterbench report` writes it: node --test test/, with CLUSTERBENCH naming the built tool.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { after, afterEach, before, describe, it } from "node:test";
import { chromiumPath, folder, launch, makePage, open as openPage, pageData } from "./browser.mjs";
import {
  committedResult,
  historyPage,
  limited,
  lossy,
  measureSweep,
  ofTwoMachines,
  onAnotherMachine,
  presets,
  rankedByCost,
  sparse,
  widened,
  withPictures,
  withTwoCameras,
} from "./results.mjs";

if (!chromiumPath) {
  console.log("skipped: there is no Chromium (scripts/setup test installs it)");
  process.exit(0);
}
const tool = process.env.CLUSTERBENCH;
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const place = folder();
const pages = {};

let browser, sweepFile, lossyTable;
before(async () => {
  pages.quick = makePage(tool, [committedResult], join(place, "quick.html"));
  sweepFile = measureSweep(tool, place);
  pages.sweep = makePage(tool, [sweepFile], join(place, "sweep.html"));
  const lossyFile = measureSweep(tool, place, lossy, (table) => (lossyTable = table));
  pages.lossy = makePage(tool, [lossyFile], join(place, "lossy.html"));
  const presetsFile = measureSweep(tool, place, presets);
  pages.presets = makePage(tool, [presetsFile], join(place, "presets.html"));
  pages.limited = makePage(tool, [limited(presetsFile, place)], join(place, "limited.html"));
  pages.sparse = makePage(tool, [sparse(sweepFile, place)], join(place, "sparse.html"));
  pages.wide = makePage(tool, [widened(committedResult, place)], join(place, "wide.html"));
  pages.cameras = makePage(tool, [withTwoCameras(committedResult, place)], join(place, "cameras.html"));
  pages.against = makePage(tool, [sweepFile, onAnotherMachine(sweepFile, place)], join(place, "against.html"));
  const mergedFile = ofTwoMachines(sweepFile, place);
  pages.merged = makePage(tool, [mergedFile], join(place, "merged.html"));
  pages.mergedAgainst = makePage(tool, [sweepFile, mergedFile], join(place, "merged-against.html"));
  const pictured = withPictures(tool, place);
  pages.pictures = makePage(tool, [pictured.file], join(place, "pictures.html"), "--images", pictured.images);
  pages.byCost = makePage(tool, [rankedByCost(committedResult, place)], join(place, "by-cost.html"));
  pages.history = historyPage(tool, place);
  pages.two = makePage(tool, [committedResult, sweepFile], join(place, "two.html"));
  browser = await launch();
});
afterEach(() => Promise.all(browser.contexts().map((context) => context.close())));
after(() => browser?.close());

const open = (url, options) => openPage(browser, url, options);

// Of all that match, as soon as there are any: tables of figures are made a moment after they are opened.
async function textsOf(page, selector) {
  await page.locator(selector).first().waitFor({ state: "attached" });
  return page.locator(selector).allInnerTexts();
}
const methods = (page) => textsOf(page, "#ranking tbody th");
const column = async (page, label) => {
  const labels = (await textsOf(page, "#ranking thead th")).map((text) => text.replace(/ [↑↓]$/, ""));
  return textsOf(page, `#ranking tbody td:nth-child(${labels.indexOf(label) + 1})`);
};
const numbers = (texts) => texts.map((text) => Number(text.replace(/[^\d.]/g, "")));
const inTable = async (page, selector = "#ranking") => {
  const labels = (await textsOf(page, `${selector} thead th`)).map((text) => text.replace(/ [↑↓]$/, ""));
  const rows = await page
    .locator(`${selector} tbody tr`)
    .evaluateAll((all) => all.map((row) => [...row.children].map((cell) => cell.innerText)));
  return rows.map((row) => Object.fromEntries(row.map((text, at) => [labels[at], text])));
};
const isAscending = (values) => values.every((value, at) => at === 0 || values[at - 1] <= value);

// Of table rows and marks of charts that differ in nothing but texts and numbers, two stay: axe takes a minute for hundreds.
const dropRepeated = (page) =>
  page.evaluate(() => {
    const differs = new Set("id href for title d x y x1 x2 y1 y2 cx cy width height".split(" "));
    const shape = (element) => {
      const attributes = [...element.attributes].map(({ name, value }) =>
        differs.has(name) || /^(aria-label|data-|transform)/.test(name) ? name : `${name}=${value}`,
      );
      return `<${[element.tagName, ...attributes].join(" ")}>${[...element.children].map(shape).join("")}/`;
    };
    const seen = new Map();
    for (const one of document.querySelectorAll("tbody > tr, svg g > *")) {
      if (!seen.has(one.parentElement)) seen.set(one.parentElement, new Map());
      const counts = seen.get(one.parentElement);
      const key = shape(one);
      counts.set(key, (counts.get(key) ?? 0) + 1);
      if (counts.get(key) > 2) one.remove();
    }
  });

async function violations(page) {
  await dropRepeated(page);
  await page.evaluate(axe);
  const found = await page.evaluate(() => globalThis.axe.run(document));
  return found.violations.map((one) => `${one.id}: ${one.nodes.map((node) => node.target).join("; ")}`);
}

async function openAll(page) {
  for (const summary of await page.locator("summary").all()) await summary.click();
  await page.waitForFunction(() => !document.querySelector("figure > details[open]:not(:has(.figure-data))"));
}

describe("the page", () => {
  for (const [name, colorScheme] of [
    ["quick", "dark"],
    ["sweep", "light"],
    ["two", "light"],
    ["against", "dark"],
    ["merged", "light"],
    ["pictures", "light"],
    ["presets", "light"],
    ["history", "light"],
  ])
    it(`of ${name} in ${colorScheme} asks for nothing, errs nowhere and is accessible`, async () => {
      const page = await open(pages[name], { colorScheme });
      await openAll(page);
      assert.deepEqual(await violations(page), []);
      assert.deepEqual(page.faults, []);
    });

  it("refuses a script that is not its own", async () => {
    const page = await open(pages.quick);
    await page.evaluate(() => {
      const script = document.createElement("script");
      script.textContent = "document.title = 'taken over'";
      document.body.append(script);
    });
    assert.notEqual(await page.title(), "taken over");
    assert.match(page.faults.join("\n"), /Content Security Policy/);
  });

  it("follows the system into dark mode, and the reader out of it", async () => {
    const page = await open(pages.quick, { colorScheme: "dark" });
    const brightness = () =>
      page.evaluate(() => Number(getComputedStyle(document.documentElement).backgroundColor.match(/\d+/)[0]));
    assert.ok((await brightness()) < 60);
    await page.selectOption("#theme", "light");
    assert.ok((await brightness()) > 200);
  });
});

describe("presets", () => {
  it("stand in one table, best first, with a sentence each", async () => {
    const page = await open(pages.presets);
    const rows = await page.locator("#presets-0-0 tbody tr").allInnerTexts();
    assert.equal(rows.length, 3);
    assert.match(rows[0], /^▶ just-cause-3.*loses nothing; costs least: [\d.]+ lights per sample/s);
    assert.match(rows[1], /^godot\s+s1.*; costs least of those that samples search: /s);
    assert.match(
      rows[2],
      /^just-cause-2.*samples \(random points in the view\) lack .*drops \d+ lights .*room for 4 lights per cell/s,
    );
  });

  it("that could not be measured say why, and all where they come from", async () => {
    const page = await open(pages.presets);
    assert.match(await page.locator("#presets > ul").innerText(), /wicked: .*needs a depth buffer/);
    assert.match(await page.locator("#preset-sources tbody").innerText(), /wicked\s+Wicked Engine/);
    assert.match(await page.locator("#preset-sources thead").innerText(), /version\s+evidence/i);
    assert.match(await page.locator("#preset-sources tbody").innerText(), /Wicked Engine\s+0\.72 of 2026\s+read: /);
    assert.equal(await page.locator("#preset-sources tbody tr").count(), 4);
  });

  it("stand first, with their conclusion as the headline, and all figures below with what lacks light last", async () => {
    const page = await open(pages.presets);
    assert.deepEqual((await textsOf(page, "main h2")).slice(0, 2), [
      "Which engine's scheme suits this level",
      "All figures",
    ]);
    assert.match(await page.locator(".conclusion").first().innerText(), /^street, camera .*: take just-cause-3/);
    assert.equal(await page.locator(".skip").getAttribute("href"), "#presets");
    const lacking = (await column(page, "unlit")).map((text) => parseFloat(text) > 0.1);
    const first = lacking.indexOf(true);
    assert.ok(first > 0 && lacking.slice(first).every(Boolean), String(lacking));
    await page.locator("#ranking thead button", { hasText: "excess" }).click();
    const excess = numbers((await column(page, "excess")).filter((text) => /\d/.test(text)));
    assert.ok(isAscending(excess), "who sorts gets what is asked for");
  });

  it("call what they miss in view by another name than what is missed in all cells", async () => {
    const page = await open(pages.limited);
    const heads = await textsOf(page, "#presets-0-0 thead th");
    assert.ok(!heads.includes("missed") && heads.includes("missed in view"), String(heads));
    assert.ok((await textsOf(page, "#ranking thead th")).includes("missed"));
  });

  it("that lose lights to their limit alone are not called methods that are not conservative", async () => {
    const text = (await textsOf(await open(pages.limited), "#warnings li")).join("\n");
    assert.match(text, /1 case lost lights, as methods that are not conservative may: \S*just-cause-3/);
    assert.match(text, /2 cases had more lights in view than their limit lets in, and lost some/);
  });

  it("show where they come from without a cut at 1200 pixels", async () => {
    const page = await open(pages.presets, { viewport: { width: 1200, height: 900 } });
    const [whole, seen] = await page
      .locator("#preset-sources .table")
      .evaluate((table) => [table.scrollWidth, table.clientWidth]);
    assert.ok(whole <= seen, `${whole} of ${seen}`);
  });

  it("are not asked about where there are none", async () => {
    const page = await open(pages.quick);
    assert.equal(await page.locator("#presets").count(), 0);
  });
});

describe("a table that is wider than the screen", () => {
  it("says that it scrolls, until its end is seen", async () => {
    const page = await open(pages.quick, { viewport: { width: 400, height: 900 } });
    const hint = page.locator("#ranking .scroll-hint");
    await hint.waitFor();
    assert.equal(await hint.innerText(), "scroll sideways for more →");
    await page.locator("#ranking .table").evaluate((table) => table.scrollTo(table.scrollWidth, 0));
    await hint.waitFor({ state: "hidden" });
  });

  it("says nothing where it is not", async () => {
    const page = await open(pages.presets, { viewport: { width: 1200, height: 900 } });
    await page.waitForTimeout(100);
    assert.equal(await page.locator("#presets .scroll-hint:visible").count(), 0);
  });
});

describe("the conclusion", () => {
  it("says in the open that depths are random, where nothing else is shaded", async () => {
    const page = await open(pages.quick);
    assert.equal(await page.locator("header .caveat:visible").count(), 1);
    assert.match(await page.locator("header .caveat").innerText(), /random depths.*can change the choice/s);
  });
});

describe("the ranking", () => {
  it("stands first and is sorted by cost; what samples search, which no GPU has measured, comes last", async () => {
    const page = await open(pages.quick);
    assert.equal(await page.locator("main h2").first().innerText(), "Ranking");
    const costs = (await column(page, "cost / best")).map((text) => (/\d/.test(text) ? parseFloat(text) : Infinity));
    const whole = costs.slice(0, costs.indexOf(Infinity)); // then come those that lack light
    assert.ok(whole.length > 5 && whole.length < costs.length && isAscending(whole), String(costs));
  });

  it("has the cost that the conclusion chooses by, marks what it takes, and one setting in depth opens there", async () => {
    const result = JSON.parse(readFileSync(committedResult));
    for (const { scene, take, text } of result.conclusions) {
      const page = await open(pages.quick);
      await page.getByRole("radio", { name: scene, exact: true }).check();
      const taken = result.cases.find(({ id }) => id === take);
      const row = page.locator("#ranking tbody tr", { has: page.locator(".taken") });
      assert.equal(await row.count(), 1, scene);
      assert.equal(await row.locator("th").innerText(), taken.assigner.label);
      const cost = parseFloat(await row.locator("td").first().innerText());
      const told = parseFloat(/a frame costs ([\d.]+) us/.exec(text)[1]);
      assert.ok(Math.abs(cost / told - 1) < 0.01, `${cost} against ${told}: ${text}`);
      const setting = await page.locator("#setting option:checked").innerText();
      assert.ok(setting.includes(taken.grid.name), `${setting}: ${text}`);
    }
  });

  it("sorts by any column, up and down, and says so to screen readers", async () => {
    const page = await open(pages.quick);
    await page.getByRole("radio", { name: "hall-512" }).check();
    const head = page.locator("#ranking thead th", { hasText: "excess" });
    await head.getByRole("button").click();
    assert.equal(await head.getAttribute("aria-sort"), "ascending");
    const told = (texts) => numbers(texts.filter((text) => /\d/.test(text))); // a structure without cells has none, and stands last
    const up = told(await column(page, "excess"));
    assert.ok(isAscending(up), String(up));
    await head.getByRole("button").click();
    assert.equal(await head.getAttribute("aria-sort"), "descending");
    assert.deepEqual(told(await column(page, "excess")), [...up].reverse());
    assert.equal(await page.locator("#ranking [aria-sort]").count(), 1);
  });

  it("says of a cost without times that making the lists is not in it", async () => {
    const [timed, untimed] = [await open(pages.quick), await open(pages.presets)];
    assert.match(
      await timed.locator("#ranking > .note").innerText(),
      /: making the lists, and upload, reading and shading/,
    );
    assert.match(
      await untimed.locator("#ranking > .note").innerText(),
      /cost µs: upload, reading and shading by the model of .*; making the lists was not timed/s,
    );
  });

  it("has the terminal's sign for the Pareto front, and no other star", async () => {
    const page = await open(pages.quick);
    await page.getByRole("radio", { name: "jam" }).check();
    const signs = new Set((await column(page, "front")).filter(Boolean));
    assert.deepEqual([...signs], ["*"]);
    assert.match(
      await page.locator("#ranking > .note").innerText(),
      /\* on the Pareto front of time, bytes and overshade\./,
    );
    assert.doesNotMatch(await page.locator("body").innerText(), /★/);
    const corners = await page
      .locator(".chip .icon path")
      .evaluateAll((all) => all.map((path) => path.getAttribute("d").match(/[ML]/g).length));
    assert.ok(corners.length > 10 && !corners.includes(10) && !corners.includes(8), String(corners)); // of stars
  });

  it("has no grid for a structure that needs no cells", async () => {
    const page = await open(pages.quick);
    await page.getByRole("radio", { name: "street" }).check();
    await page.selectOption("#filter-grid", "no grid");
    assert.deepEqual(await methods(page), ["bvh"]);
  });

  it("shows the cases of one scene, of one grid, of some words, of the front", async () => {
    const page = await open(pages.quick);
    const result = JSON.parse(readFileSync(committedResult));
    const expected = (holds) =>
      result.cases
        .filter(holds)
        .map((one) => one.assigner.label)
        .sort();
    const shown = async () => (await methods(page)).sort();
    await page.getByRole("radio", { name: "street" }).check();
    assert.deepEqual(
      await shown(),
      expected((one) => one.scene === "street"),
    );
    await page.selectOption("#filter-grid", { index: 1 });
    const grid = result.cases[0].grid.name;
    const hasCells = (one) => one.storage !== "own" || one.occupancy;
    assert.deepEqual(
      await shown(),
      expected((one) => one.scene === "street" && one.grid.name === grid && hasCells(one)),
    );
    await page.fill("#filter-words", "fast exact");
    assert.deepEqual(await shown(), ["exact-fast"]);
    await page.fill("#filter-words", "");
    await page.check("#filter-front");
    const front = result.pareto_front.find((one) => one.scene === "street").ids;
    assert.deepEqual(
      await shown(),
      expected((one) => front.includes(one.id) && one.grid.name === grid),
    );
    assert.equal(await page.locator(".count").innerText(), `${(await shown()).length} of ${result.cases.length} cases`);
  });

  it("hides a method at a click on its button, in charts too", async () => {
    const page = await open(pages.quick);
    const chip = page.getByRole("button", { name: "brute-force", exact: true });
    await chip.click();
    assert.equal(await chip.getAttribute("aria-pressed"), "false");
    assert.ok(!(await methods(page)).includes("brute-force"));
    await page.locator("#speed-error summary").click();
    assert.ok(!(await textsOf(page, "#speed-error tbody th")).includes("brute-force"));
    await page.getByRole("button", { name: "Show all methods" }).click();
    assert.ok((await methods(page)).includes("brute-force"));
  });

  it("can be sorted and filtered from the keyboard", async () => {
    const page = await open(pages.quick);
    await page.keyboard.press("Tab");
    assert.equal(await page.evaluate(() => document.activeElement.textContent), "Skip to the ranking");
    await page.locator("#ranking thead button").first().focus();
    await page.keyboard.press("Enter");
    const names = await methods(page);
    assert.deepEqual(
      names,
      [...names].sort((a, b) => a.localeCompare(b, "en")),
    );
    const outline = await page.evaluate(() => getComputedStyle(document.activeElement).outlineStyle);
    assert.equal(outline, "solid");
  });
});

describe("over all scenes", () => {
  const geometric = (values) => Math.exp(values.reduce((sum, value) => sum + Math.log(value), 0) / values.length);

  it("every mean is geometric, with each scene counted once", async () => {
    const page = await open(pages.quick);
    const result = JSON.parse(readFileSync(committedResult));
    const rows = await inTable(page);
    let compared = 0;
    for (const row of rows) {
      const cases = result.cases.filter(
        (one) =>
          one.assigner.label === row.method &&
          one.grid.name === row.grid &&
          one.storage === row.storage &&
          one.error &&
          one.shading.overshade !== null,
      );
      if (cases.length !== result.scenes.length) continue;
      const mean = (figure) => geometric(cases.map(figure));
      assert.equal(
        row.excess,
        `${(100 * (mean((one) => one.error.reported_pairs / one.error.true_pairs) - 1)).toFixed(1)} %`,
        row.method,
      );
      assert.equal(row.overshade, mean((one) => one.shading.overshade).toFixed(2), row.method);
      assert.equal(row.longest, mean((one) => one.occupancy.lights_per_cell.max).toFixed(0), row.method);
      ++compared;
    }
    assert.ok(compared > 5, String(compared));
  });

  it("a scene of two cameras counts as much as one of one", async () => {
    const figures = async (url) =>
      (await inTable(await open(url)))
        .map((row) =>
          [
            row.method,
            row.grid,
            row.storage,
            row["time / best"],
            row.excess,
            row.overshade,
            row.bytes,
            row.longest,
          ].join(),
        )
        .sort();
    assert.deepEqual(await figures(pages.cameras), await figures(pages.quick));
  });

  it("a mean that some scenes have no part in says of how many it is", async () => {
    const page = await open(pages.quick);
    const result = JSON.parse(readFileSync(committedResult));
    const key = (method, grid, storage) => [method, grid, storage].join();
    const holes = new Set(
      result.cases
        .filter((one) => one.shading.overshade === null)
        .map((one) => key(one.assigner.label, one.grid.name, one.storage)),
    );
    const rows = (await inTable(page)).filter((row) => holes.has(key(row.method, row.grid, row.storage)));
    assert.ok(rows.length > 0);
    for (const row of rows) assert.match(row.overshade, / of 5\)$|^–$/, JSON.stringify(row));
  });

  it("the front alone is of methods, whose means stay those of all scenes", async () => {
    const page = await open(pages.quick);
    const before = new Map((await inTable(page)).map((row) => [row.method + row.grid + row.storage, row]));
    await page.check("#filter-front");
    const rows = await inTable(page);
    assert.ok(rows.length > 0 && rows.length < before.size);
    for (const row of rows) {
      const { storage, ...other } = before.get(row.method + row.grid + (row.storage ?? "packed")); // no column of what is the same
      assert.deepEqual(row, { ...other, ...(row.storage && { storage }) });
    }
  });
});

describe("filters", () => {
  it("leave ranks as they are among all", async () => {
    const page = await open(pages.quick);
    await page.getByRole("radio", { name: "street" }).check();
    await page.locator("#ranking thead button", { hasText: "frame µs" }).click();
    const rank = "rank by time";
    const all = await inTable(page);
    const ranked = all.filter((row) => row[rank] !== "–"); // what samples search has none
    assert.deepEqual(
      ranked.map((row) => row[rank]),
      ranked.map((_, at) => String(at + 1)),
    );
    await page.fill("#filter-words", "world-grid");
    const some = await inTable(page);
    assert.ok(some.length > 0 && some.every((row) => Number(row[rank]) > 1));
    for (const row of some)
      assert.equal(row[rank], all.find((one) => one.method === row.method && one.grid === row.grid)[rank]);
  });

  it("that leave nothing say so, and can be cleared", async () => {
    const page = await open(pages.quick);
    await page.fill("#filter-words", "no such thing");
    assert.match(await page.locator("#ranking").innerText(), /No cases: none matches all of the filters/);
    await page.locator("#clear-filters").click();
    assert.ok((await methods(page)).length > 5);
    assert.equal(await page.inputValue("#filter-words"), "");
  });

  it("are in the address, and come back with it", async () => {
    const page = await open(pages.quick);
    await page.getByRole("radio", { name: "street" }).check();
    await page.selectOption("#filter-grid", { index: 1 });
    await page.fill("#filter-words", "fast");
    await page.getByRole("button", { name: "aabb-fast", exact: true }).click();
    await page.selectOption("#speed-error-measure", "bytes");
    await page.getByRole("navigation").getByText("Warnings").click();
    const [shown, address] = [await methods(page), page.url()];
    assert.match(address, /#scene=street&grid=.*&words=fast&hidden=aabb-fast&choice\.speed-error-measure=bytes/);
    const again = await open(address);
    assert.deepEqual(await methods(again), shown);
    assert.equal(await again.inputValue("#filter-words"), "fast");
    assert.equal(await again.inputValue("#speed-error-measure"), "bytes");
    assert.ok(await again.getByRole("radio", { name: "street" }).isChecked());
    await again.evaluate(() => (location.hash = "scene=jam&grid=none+of+these"));
    await again.getByRole("radio", { name: "jam", checked: true }).waitFor();
    assert.equal(await again.inputValue("#filter-grid"), "");
    assert.deepEqual(again.faults, []);
  });
});

describe("figures", () => {
  it("have the units and digits of the terminal's table", async () => {
    const page = await open(pages.lossy);
    const names = { "frame us": "frame µs", "+-": "±", assign: "assign µs", convert: "convert µs", shade: "overshade" };
    const told = [];
    let grid, heads;
    for (const line of lossyTable.split("\n")) {
      const cells = line.replace(/^ *\*? +/, "").split(/ {2,}/);
      if (/, camera /.test(line)) grid = line.trim().replace(/, camera .*/, "");
      else if (cells[0] === "assigner") heads = cells;
      else if (heads && cells.length === heads.length)
        told.push({ grid, ...Object.fromEntries(cells.map((text, at) => [names[heads[at]] ?? heads[at], text])) });
    }
    await page.check("#ranking-all");
    const shown = await inTable(page);
    assert.equal(told.length, shown.length, lossyTable);
    for (const row of told) {
      const other = shown.find((one) => one.grid === row.grid && `${one.method} / ${one.storage}` === row.assigner);
      for (const column of [
        "frame µs",
        "±",
        "assign µs",
        "convert µs",
        "pairs",
        "ns/pair",
        "excess",
        "missed",
        "dropped",
        "unlit",
        "overshade",
        "bytes",
      ])
        assert.equal(
          other[column].replace(/^~/, ""),
          row[column].replace(/^-$/, "–").replace(/^~/, ""),
          `${column} of ${row.assigner}`,
        );
    }
  });
});

describe("columns of figures", () => {
  const figures = () => JSON.parse(execFileSync(tool, ["list", "figures", "--json"], { encoding: "utf8" }));
  const named = {
    "frame µs": "frame_us",
    excess: "excess",
    missed: "missed",
    unlit: "unlit",
    overshade: "overshade",
    bytes: "bytes",
    "worst µs": "frame_us.max",
    "assign µs": "assign_us",
    "ns/pair": "time_per_pair",
    longest: "longest",
    allocate: "bytes_recommended",
  };

  it("have the meanings of the program's table", async () => {
    const page = await open(pages.quick);
    await page.getByRole("radio", { name: "street" }).check();
    await page.check("#ranking-all");
    const meanings = new Map(figures().map(({ name, meaning }) => [name, meaning]));
    const heads = await page
      .locator("#ranking thead th")
      .evaluateAll((all) => all.map((head) => [head.innerText.replace(/( \(.*\))?( [↑↓])?$/, ""), head.title]));
    const titles = new Map(heads);
    for (const [label, name] of Object.entries(named)) {
      const title = titles.get(label);
      assert.ok(title?.toLowerCase().startsWith(meanings.get(name).toLowerCase()), `${label}: ${title}`);
    }
    const note = await page.locator("#ranking > .note").innerText();
    assert.ok(note.includes(`missed: ${meanings.get("missed")}`), note);
  });

  it("have words of their own where they are per frame, or of timed frames", async () => {
    const page = await open(pages.quick);
    await page.getByRole("radio", { name: "street" }).check();
    await page.check("#ranking-all");
    await page.locator("#costs-data > summary").click();
    const titleOf = (table, label) =>
      page.locator(`${table} thead th`, { hasText: label }).first().getAttribute("title");
    for (const label of ["tests per frame", "fallbacks per frame"]) {
      const title = await titleOf("#costs", label);
      assert.match(title, /mean of all frames$/);
      assert.doesNotMatch(title, /over all frames/);
    }
    assert.match(await titleOf("#ranking", /^pairs/), /of the timed frames, or of all frames if no frame is timed/);
  });

  it("have the digits of the terminal in bytes that a sample reads", async () => {
    const page = await open(pages.quick);
    await page.getByRole("radio", { name: "street" }).check();
    const small = (await column(page, "read")).filter((text) => Number(text) < 100);
    assert.ok(small.length > 0);
    const { results } = pageData(tool, committedResult);
    const known = results[0].cases.map(({ figures }) => figures.read_bytes);
    for (const text of small)
      assert.ok(
        known.some((bytes) => Number(text) === Number(bytes?.toPrecision(3))),
        text,
      );
  });

  it("have the numbers of the table in the units of their heads, also where they are downloaded", async () => {
    const page = await open(pages.quick);
    await page.getByRole("radio", { name: "street" }).check();
    await page.check("#ranking-all");
    const waiting = page.waitForEvent("download");
    await page.locator("#ranking").getByRole("button", { name: "Download CSV" }).click();
    const [heads, ...lines] = readFileSync(await (await waiting).path(), "utf8")
      .trim()
      .split("\n")
      .map((line) => line.split(","));
    const { results } = pageData(tool, committedResult);
    const cases = results[0].result.cases
      .map(({ scene }, at) => ({ scene, figures: results[0].cases[at].figures }))
      .filter(({ scene }) => scene === "street");
    assert.equal(lines.length, cases.length);
    for (const [label, name] of Object.entries(named)) {
      const at = heads.findIndex((head) => head.replace(/ \(.*\)$/, "") === label);
      const written = lines.map((line) => (line[at] === "" ? null : Number(line[at])));
      const known = cases.map((one) => one.figures[name] ?? null);
      assert.deepEqual(written, known, label);
    }
    const shown = numbers(await column(page, "assign µs")).sort((a, b) => a - b);
    const written = lines.map((line) => Number(line[heads.indexOf("assign µs")])).sort((a, b) => a - b);
    shown.forEach((value, row) => {
      assert.ok(Math.abs(value - written[row]) <= 0.05 * written[row], `${value} is shown of ${written[row]}`);
    });
  });
});

describe("times", () => {
  it("stand beside the fastest of their scene with a ratio and its interval, and a mark where nothing tells them from the next faster one", async () => {
    const page = await open(pages.quick);
    await page.getByRole("radio", { name: "hall-512" }).check();
    await page.locator("#ranking thead button", { hasText: "frame µs" }).click();
    const ratios = await column(page, "time / fastest");
    const fastest = ratios.lastIndexOf("–"); // before it stand structures that samples search, which have no ratio
    assert.ok(
      ratios.every((text, row) => (row <= fastest ? text === "–" : /^\d+\.\d\d$/.test(text))),
      String(ratios),
    );
    assert.ok(fastest >= 0 && fastest < ratios.length / 2, String(ratios));
    const marked = (await column(page, "frame µs")).filter((text) => text.startsWith("~"));
    assert.ok(marked.length > 0 && marked.length < ratios.length, String(marked));
    const interval = await page
      .locator("#ranking tbody tr")
      .nth(fastest + 1)
      .locator("td span[title*=' to ']")
      .last()
      .getAttribute("title");
    assert.match(interval, /^\d+\.\d\d to \d+\.\d\d$/);
  });

  it("have the terminal's warnings, of each result by its name", async () => {
    const texts = async (name) => (await textsOf(await open(pages[name]), "#warnings li")).join("\n");
    assert.match(await texts("wide"), /Warning\. Times: \d+ of \d+ times with intervals wider than ±10 %/);
    assert.match(await texts("wide"), /--launches \d+/);
    const two = await texts("two");
    assert.match(two, /Warning\. (quick|.*\/quick): Times: /);
  });

  it("that are known to a half and twice show both sides", async () => {
    const page = await open(pages.wide);
    await page.getByRole("radio", { name: "hall-512" }).check();
    assert.ok((await column(page, "±")).every((text) => text === "-50/+100 %"));
  });
});

describe("what a case loses", () => {
  const rows = async (page) => {
    await page.check("#ranking-all");
    const labels = (await textsOf(page, "#ranking thead th")).map((text) => text.replace(/ [↑↓]$/, ""));
    const cells = await page
      .locator("#ranking tbody tr")
      .evaluateAll((all) => all.map((row) => [...row.children].map((cell) => cell.innerText)));
    const dots = await page
      .locator("#ranking tbody tr")
      .evaluateAll((all) => all.map((row) => row.querySelector(".front") !== null));
    return cells.map((one, at) => ({
      ...Object.fromEntries(one.map((text, column) => [labels[column], text])),
      isOnFront: dots[at],
    }));
  };

  it("stands beside its time, takes its overshade and its place on the front", async () => {
    const page = await open(pages.lossy);
    const all = await rows(page);
    assert.equal(all.length, 8);
    const whole = all.filter((one) => one.dropped === "0" && parseFloat(one.unlit) === 0);
    assert.equal(whole.length, 2, JSON.stringify(all));
    assert.ok(
      whole.some((one) => one.isOnFront) && whole.every((one) => /\d/.test(one.overshade)),
      JSON.stringify(whole),
    );
    for (const one of all.filter((other) => !whole.includes(other))) {
      assert.ok(parseFloat(one.unlit) > 0.1 && one.overshade === "–" && !one.isOnFront, JSON.stringify(one));
    }
  });

  it("is ranked by what a frame takes, with its parts and its worst frame beside it", async () => {
    const page = await open(pages.quick); // medians of a few rounds need not add up
    await page.getByRole("radio", { name: "street" }).check();
    const all = (await rows(page)).map((one) =>
      Object.fromEntries(
        Object.entries(one).map(([label, text]) => [label, parseFloat(String(text).replaceAll(/[,~]/g, ""))]),
      ),
    );
    let converted = 0;
    for (const one of all) {
      assert.ok(one["worst µs"] >= 0.9 * one["frame µs"], JSON.stringify(one));
      if (Number.isNaN(one["convert µs"])) continue; // a structure of its own, which converts nothing
      assert.ok(one["assign µs"] < one["frame µs"] && one["convert µs"] < one["frame µs"], JSON.stringify(one));
      assert.ok(one["most pairs"] >= one.pairs, JSON.stringify(one));
      ++converted;
    }
    assert.ok(converted > 5, String(converted));
  });

  it("by its cost stands last where it leaves out lights, and has none", async () => {
    const page = await open(pages.byCost);
    await page.getByRole("radio", { name: "street" }).check();
    const all = await rows(page);
    const isDark = (one) => /^exact-fast/.test(one.method);
    assert.ok(all.some(isDark) && all.some((one) => !isDark(one)), JSON.stringify(all));
    const first = all.findIndex(isDark);
    const isSearched = (one) => /^\(/.test(one["cost µs"]);
    assert.ok(
      all.slice(first).every((one) => isDark(one) || isSearched(one)),
      JSON.stringify(all.map((one) => one.method)),
    );
    for (const one of all) assert.equal(one["cost µs"] === "–", isDark(one), JSON.stringify(one));
  });

  it("takes no part in the chart's front", async () => {
    const page = await open(pages.lossy);
    await page.selectOption("#speed-error-measure", "bytes");
    const label = await page.locator("#speed-error svg[role=img]").first().getAttribute("aria-label");
    const names = label.replace(/.*on the front: /, "").split(", ");
    assert.ok(names.length <= 2, `${label}: fixed storage takes fewest bytes, and drops pairs`);
  });

  it("is a warning", async () => {
    const page = await open(pages.lossy);
    const text = (await textsOf(page, "#warnings li")).join("\n");
    assert.match(text, /Warning\. 4 cases dropped lights because the storage was full/);
    assert.match(
      text,
      /Warning\. 6 cases left more of the lights that random points in the view need unlit than rounding does/,
    );
    assert.doesNotMatch(text, /Failed/);
  });
});

describe("charts", () => {
  it("have a name for those who cannot see them, a table, their data and a command", async () => {
    const page = await open(pages.sweep);
    for (const id of ["speed-error", "heat-map", "camera-path", "list-lengths", "costs"]) {
      const figure = page.locator(`#${id}`);
      assert.ok((await figure.locator("svg[role=img]").first().getAttribute("aria-label")).length > 20, id);
      await figure.locator("summary").click();
      await figure.locator(".figure-data").waitFor();
      assert.ok((await figure.locator("tbody tr").count()) > 1, id);
      assert.match(await figure.locator("pre").innerText(), /^clusterbench run \S+\.json/, id);
      const waiting = page.waitForEvent("download");
      await figure.getByRole("button", { name: "Download CSV" }).click();
      const text = readFileSync(await (await waiting).path(), "utf8");
      const rows = await figure.locator("tbody tr").count();
      assert.ok(text.startsWith("method,") && text.trim().split("\n").length >= rows + 1, id);
    }
  });

  it("of lines have a legend of all methods, whose marks tell those with one colour apart", async () => {
    const page = await open(pages.sweep);
    for (const id of ["camera-path", "list-lengths", "lights-by-depth"]) {
      const keys = page.locator(`#${id} .legend li`);
      const names = (await keys.allInnerTexts()).flatMap((text) => text.split(/[,()] ?/));
      for (const method of ["bounds", "aabb", "aabb-fast"])
        assert.ok(names.includes(method), `${method} of ${id}: ${names}`);
      const looks = await keys.evaluateAll((all) => all.map((key) => key.querySelector("svg").innerHTML));
      assert.equal(new Set(looks).size, looks.length, id);
    }
  });

  it("show errors that are far apart on a logarithmic scale", async () => {
    const page = await open(pages.quick);
    await page.getByRole("radio", { name: "jam" }).check();
    await page.selectOption("#speed-error-measure", "excess");
    const texts = await page.locator("#speed-error svg[role=img] text").allTextContents();
    const ticks = texts.filter((text) => /^[\d.]+ %$/.test(text)).map(parseFloat);
    assert.ok(
      ticks.includes(0) && Math.max(...ticks) >= 100 * Math.min(...ticks.filter((tick) => tick > 0)),
      String(ticks),
    );
  });

  it("are no section where no tiles and slices were swept", async () => {
    const page = await open(pages.quick);
    assert.equal(await page.locator("#grids").count(), 0);
  });

  it("draw list lengths in one piece, down to no cells", async () => {
    const page = await open(pages.sweep);
    const paths = await page
      .locator("#list-lengths svg[role=img] path")
      .evaluateAll((all) => all.map((path) => path.getAttribute("d")));
    const steps = paths.filter((path) => !path.endsWith("Z") && path.length > 60); // marks are closed, ticks short
    assert.ok(steps.length > 0, String(paths));
    for (const line of steps) assert.equal(line.match(/M/g).length, 1, line);
  });

  it("leave out maps that are less than half filled, and say so", async () => {
    const page = await open(pages.sparse);
    const titles = await textsOf(page, "#heat-map h4");
    assert.ok(titles.length > 0 && !titles.some((title) => /^bounds( |$)/.test(title)), String(titles));
    assert.match(await page.locator("#heat-map figcaption").innerText(), /less than half filled (is|are) left out/);
  });

  it("keep the focus and opened tables when what they show changes", async () => {
    const page = await open(pages.sweep);
    await page.locator("#speed-error summary").click();
    await page.locator("#speed-error-measure").focus();
    await page.selectOption("#speed-error-measure", "bytes");
    assert.equal(await page.evaluate(() => document.activeElement.id), "speed-error-measure");
    assert.ok((await textsOf(page, "#speed-error thead th")).includes("bytes"));
  });

  it("show the allocation above every frame of the path", async () => {
    const page = await open(pages.sweep);
    await page.locator("#camera-path summary").click();
    const figures = async (at) => numbers(await textsOf(page, `#camera-path tbody td:nth-child(${at})`));
    const [bytes, allocated] = [await figures(5), await figures(6)];
    assert.ok(bytes.length > 3 && bytes.every((value, at) => value <= allocated[at]));
  });

  it("have names that no interval strikes", async () => {
    const page = await open(pages.wide);
    const struck = await page.locator("#speed-error svg[role=img]").evaluateAll((charts) =>
      charts.flatMap((svg) => {
        const names = [...svg.querySelectorAll("g[font-size], g")].flatMap((group) =>
          group.getAttribute("stroke-width") === "4" ? [...group.querySelectorAll("text")] : [],
        );
        const bars = [...svg.querySelectorAll("g[stroke-width='3'] line")].map((line) => line.getBoundingClientRect());
        return names.map((text) => {
          const box = text.getBoundingClientRect(),
            inside = { left: box.left + 2, right: box.right - 2, top: box.top + 3, bottom: box.bottom - 3 };
          return {
            name: text.textContent,
            bars: bars.length,
            isStruck: bars.some(
              (bar) =>
                bar.left < inside.right &&
                inside.left < bar.right &&
                bar.top < inside.bottom &&
                inside.top < bar.bottom,
            ),
          };
        });
      }),
    );
    assert.ok(
      struck.some((one) => one.bars > 2),
      JSON.stringify(struck),
    );
    assert.deepEqual(
      struck.filter((one) => one.isStruck),
      [],
    );
  });

  it("ring what the ranking marks, draw the intervals of those alone, and end their line there", async () => {
    const page = await open(pages.quick);
    for (const scene of ["street", "jam"]) {
      await page.getByRole("radio", { name: scene }).check();
      const marked = await page.locator("#ranking [aria-label='on the Pareto front']").count();
      const rings = page.locator("#speed-error circle[r='8']");
      assert.ok(marked > 1, scene);
      assert.equal(await rings.count(), marked, scene);
      assert.equal(await page.locator("#speed-error g[stroke-width='3'] line").count(), marked, scene);
    }
  });

  it("name all of their axes", async () => {
    for (const name of ["quick", "sweep", "against"]) {
      const page = await open(pages[name]);
      const labels = await page
        .locator(".chart svg[role=img]")
        .evaluateAll((charts) =>
          charts.map((svg) => [...svg.querySelectorAll("text")].map((text) => text.textContent)),
        );
      assert.ok(labels.length > 3);
      const isName = (text) => /^(↑ )?\p{L}{3,}/u.test(text) || /µs/.test(text);
      for (const texts of labels) assert.ok(texts.filter(isName).length >= 2, texts.join(" | "));
    }
  });
});

// Elements that reach over the page's right edge, unless a box of theirs scrolls; words of tables that lines break.
const overflowing = (page) =>
  page.evaluate(() => {
    const scrolls = (element) =>
      element &&
      element !== document.body &&
      (getComputedStyle(element).overflowX !== "visible" || scrolls(element.parentElement));
    return [...document.body.querySelectorAll("*")]
      .filter((element) => !element.closest(".skip, legend, caption, option"))
      .filter((element) => element.getBoundingClientRect().right > innerWidth + 1 && !scrolls(element.parentElement))
      .map((element) => `${element.tagName}: ${element.textContent.slice(0, 40)}`);
  });
const brokenWords = (page) =>
  page.evaluate(() => {
    const broken = [];
    for (const cell of document.querySelectorAll("#ranking :is(th, td), #presets :is(th, td)")) {
      const walker = document.createTreeWalker(cell, NodeFilter.SHOW_TEXT);
      while (walker.nextNode())
        for (const word of walker.currentNode.data.matchAll(/[^\s\p{P}]+/gu)) {
          const range = document.createRange();
          range.setStart(walker.currentNode, word.index);
          range.setEnd(walker.currentNode, word.index + word[0].length);
          if (new Set([...range.getClientRects()].map(({ top }) => top)).size > 1) broken.push(word[0]);
        }
    }
    return broken;
  });

const paper = { width: 703, height: 1032 }; // A4 between the margins

describe("on paper", () => {
  for (const [name, scene] of [
    ["quick", null],
    ["quick", "street"],
    ["lossy", null],
    ["presets", null],
    ["sweep", "street"],
    ["against", null],
    ["two", "street"],
  ])
    it(`${name}${scene ? `, ${scene}` : ""} cuts nothing and breaks no word of its tables`, async () => {
      const page = await open(pages[name]);
      if (scene) await page.getByRole("radio", { name: scene }).check();
      await page.evaluate(() => window.dispatchEvent(new Event("beforeprint")));
      await page.emulateMedia({ media: "print" });
      await page.setViewportSize(paper);
      assert.deepEqual(await overflowing(page), []);
      assert.deepEqual(await brokenWords(page), []);
    });

  it("has the legends of charts, and names the columns that it has no room for", async () => {
    const page = await open(pages.quick);
    await page.getByRole("radio", { name: "street" }).check();
    const shown = (selector) => page.locator(`${selector}:visible`);
    assert.equal(await shown("#speed-error .legend li").count(), 0, "on a screen the filters are the legend");
    await page.emulateMedia({ media: "print" });
    const names = await shown("#speed-error .legend li").allInnerTexts();
    assert.ok(names.length > 10 && names.includes("exact-fast"), String(names));
    const [left] = await shown("#ranking .paper-only").allInnerTexts();
    const heads = await page.locator("#ranking thead th").evaluateAll((all) =>
      all.map((head) => ({
        label: head.textContent,
        isShown: getComputedStyle(head).display !== "none" || head.classList.contains("under-first"),
      })),
    );
    assert.ok(heads.some((head) => head.label === "rank by time" && head.isShown));
    for (const { label, isShown } of heads) assert.equal(left.includes(label), !isShown, `${label}: ${left}`);
  });

  it("writes the figures of maps within their cells", async () => {
    const page = await open(pages.sweep);
    await page.selectOption("#heat-map-measure", "pairs"); // as "131.7k"
    await page.evaluate(() => window.dispatchEvent(new Event("beforeprint")));
    await page.emulateMedia({ media: "print" });
    await page.setViewportSize(paper);
    const cells = await page.locator("#heat-map svg[role=img]").evaluateAll((maps) =>
      maps.flatMap((map) => {
        const room = map.querySelector("rect").getBoundingClientRect().width;
        return [...map.querySelectorAll("text")]
          .filter((text) => /^[\d.,]+[kM]?$/.test(text.textContent))
          .map((text) => ({ text: text.textContent, room, width: text.getBoundingClientRect().width }));
      }),
    );
    assert.ok(cells.length > 3 && cells.some(({ text }) => text.length > 4), JSON.stringify(cells));
    const spilt = cells.filter(({ room, width }) => width > room - 4);
    assert.deepEqual(spilt, []);
  });

  it("takes few pages, with charts drawn for their width", async () => {
    const page = await open(pages.quick, { viewport: { width: 1400, height: 900 } });
    const pdf = (await page.pdf({ preferCSSPageSize: true })).toString("latin1");
    const count = pdf.match(/\/Type\s*\/Page\b/g).length;
    assert.ok(count > 1 && count <= 6, `${count} pages`);
    const width = () => page.locator("#list-lengths svg[role=img]").getAttribute("width").then(Number);
    assert.ok((await width()) > 1000, "afterwards charts are those of the screen again");
    await page.evaluate(() => window.dispatchEvent(new Event("beforeprint")));
    assert.ok((await width()) < 700);
    const height = await page.locator("#list-lengths svg[role=img]").getAttribute("height");
    assert.ok(Number(height) < 200, `${height}: three such charts fill a page, two leave half of it empty`);
  });

  it("opens what stands behind the conclusions, which are a line each on the screen", async () => {
    const page = await open(pages.sweep);
    const lines = await textsOf(page, "details.conclusion summary");
    assert.ok(lines.length > 0 && lines.every((line) => /: take /.test(line) && !/;/.test(line)), lines.join("\n"));
    const opened = () => page.locator("details.conclusion[open]").count();
    assert.equal(await opened(), 0);
    await page.evaluate(() => window.dispatchEvent(new Event("beforeprint")));
    assert.equal(await opened(), lines.length);
  });
});

describe("a screen of 400 pixels", () => {
  for (const name of ["quick", "sweep", "lossy", "presets", "pictures", "against", "merged"])
    it(`holds ${name}, whose tables scroll in their boxes`, async () => {
      const page = await open(pages[name], { viewport: { width: 400, height: 800 } });
      for (const summary of await page.locator("main figure summary").all()) await summary.click();
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth));
      assert.deepEqual(await overflowing(page), []);
      const cut = await page
        .locator(".chart svg[role=img] text")
        .evaluateAll((texts) =>
          texts
            .filter((text) => text.getBoundingClientRect().left < text.ownerSVGElement.getBoundingClientRect().left - 1)
            .map((text) => text.textContent),
        );
      assert.deepEqual(cut, [], "names that charts have no room for");
    });
});

describe("a narrow ranking", () => {
  it("has the grid under the method, and its filters on one line", async () => {
    const page = await open(pages.presets, { viewport: { width: 400, height: 800 } });
    const grids = new Set(JSON.parse(readFileSync(join(place, "presets.json"))).cases.map((one) => one.grid.name));
    for (const text of await page.locator("#ranking tbody th").allInnerTexts())
      assert.ok(
        [...grids].some((grid) => text.replaceAll("\n", " ").includes(grid)),
        text,
      );
    assert.equal(await page.locator("#ranking thead th", { hasText: "grid" }).isVisible(), false);
    assert.ok((await page.locator(".chips").boundingBox()).height < 60);
    const wide = await open(pages.presets);
    assert.equal(await wide.locator("#ranking .under").first().isVisible(), false);
    assert.equal(await wide.locator("#ranking thead th", { hasText: "grid" }).isVisible(), true);
  });
});

describe("pictures in the dark", () => {
  it("are dimmed, whoever chose the dark", async () => {
    const filterOf = async (options, theme) => {
      const page = await open(pages.pictures, options);
      if (theme) await page.getByLabel("Theme").selectOption(theme);
      return page
        .locator("#pictures img")
        .first()
        .evaluate((image) => getComputedStyle(image).filter);
    };
    assert.match(await filterOf({ colorScheme: "dark" }), /brightness/);
    assert.match(await filterOf({ colorScheme: "light" }, "dark"), /brightness/);
    assert.equal(await filterOf({ colorScheme: "dark" }, "light"), "none");
  });
});

describe("the layout", () => {
  for (const [name, scene] of [
    ["quick", null],
    ["quick", "jam"],
    ["lossy", null],
    ["two", null],
    ["two", "street"],
    ["sweep", "street"],
    ["against", null],
  ])
    it(`cuts no column of the ranking of ${name}${scene ? `, ${scene}` : ""}, at 1400 pixels`, async () => {
      const page = await open(pages[name], { viewport: { width: 1400, height: 900 } });
      if (scene) await page.getByRole("radio", { name: scene }).check();
      const isCut = () =>
        page
          .locator("#ranking .table")
          .evaluate((table) => table.scrollWidth > table.clientWidth && `${table.scrollWidth} of ${table.clientWidth}`);
      assert.equal(await isCut(), false);
      if ((await page.locator("#ranking-all").count()) === 0) return;
      await page.check("#ranking-all");
      assert.equal(await isCut(), false);
    });

  for (const [name, scene, wanted] of [
    ["quick", null, ["method", "cost / best", "time / best"]],
    ["quick", "jam", ["method", "cost µs", "frame µs"]],
    ["two", "street", ["method", "cost µs", "frame µs"]],
  ])
    it(`shows method, cost and time of ${name}${scene ? `, ${scene}` : ""} first, at 390 pixels`, async () => {
      const page = await open(pages[name], { viewport: { width: 390, height: 800 } });
      if (scene) await page.getByRole("radio", { name: scene }).check();
      const inView = await page
        .locator("#ranking thead th")
        .evaluateAll((heads) =>
          heads
            .filter((head) => head.getBoundingClientRect().right <= innerWidth - 14)
            .map((head) => head.innerText.replace(/ [↑↓]$/, "")),
        );
      assert.deepEqual(inView.slice(0, 3), wanted);
    });
});

describe("several results", () => {
  it("stand on one page, told apart by their files", async () => {
    const page = await open(pages.two);
    assert.deepEqual(await textsOf(page, "#setup article > h3"), ["quick", "sweep"]);
    await page.selectOption("#filter-run", "sweep");
    assert.ok(
      (await page.locator(".count").innerText()).startsWith(`${JSON.parse(readFileSync(sweepFile)).cases.length} of `),
    );
  });

  it("say in every table and chart whose a figure is, and share no front", async () => {
    const page = await open(pages.against);
    const runs = ["sweep", "elsewhere"];
    assert.deepEqual(new Set((await inTable(page)).map((row) => row.result)), new Set(runs));
    assert.deepEqual(
      (await textsOf(page, "#speed-error h4")).sort(),
      ["hall-512", "street"].flatMap((scene) => runs.map((run) => `${scene} · ${run}`)).sort(),
    );
    for (const text of await textsOf(page, "#heat-map h4"))
      assert.ok(
        runs.some((run) => text.includes(run)),
        text,
      );
    for (const text of await textsOf(page, "#setting option"))
      assert.ok(
        runs.some((run) => text.endsWith(run)),
        text,
      );
    await openAll(page);
    for (const id of [
      "speed-error",
      "costs",
      "camera-path",
      "list-lengths",
      "heat-map",
      "stability-table",
      "packed-lights",
      "lookup",
    ])
      for (const row of (await inTable(page, `#${id}`)).slice(0, 5))
        assert.match(Object.values(row).join(" "), /sweep|elsewhere/, id);
    const dot = page.locator("#speed-error svg[role=img] path[fill]").first();
    await dot.hover({ force: true });
    await page
      .locator("#speed-error svg g[aria-label=tip] text, #speed-error svg text:has-text('µs') tspan")
      .first()
      .waitFor({ state: "attached" });
    assert.match(await page.locator("#speed-error svg[role=img]").first().textContent(), /· (sweep|elsewhere)/);
  });

  it("can be held one against the first, case by case", async () => {
    const page = await open(pages.against);
    await page.locator("#against-first summary").click();
    const rows = await inTable(page, "#against-first");
    assert.equal(rows.length, JSON.parse(readFileSync(sweepFile)).cases.length);
    for (const row of rows) assert.equal(row.time, "+100.0 %", JSON.stringify(row));
    assert.match(
      await page.locator("#against svg[role=img]").getAttribute("aria-label"),
      /Frame time of elsewhere by that of sweep, \d+ cases/,
    );
    await page.selectOption("#filter-run", "elsewhere");
    assert.equal((await inTable(page, "#against-first")).length, rows.length);
  });

  it("without a case in common say so", async () => {
    const page = await open(pages.two);
    assert.match(await page.locator("#against").innerText(), /No cases: sweep and quick have none in common/);
  });
});

describe("a result of two machines", () => {
  const places = ["machine 1: fast processor", "machine 2: slow processor"];
  const ranks = (page) =>
    page.locator("#ranking .table").evaluateAll((tables) =>
      tables.map((table) => {
        const heads = [...table.querySelectorAll("thead th")].map((head) => head.innerText.replace(/ [↑↓]$/, ""));
        const at = (label) => heads.indexOf(label);
        return [...table.querySelectorAll("tbody tr")].map(({ children }) => ({
          machine: children[at("machine")].innerText,
          rank: children[at("rank by time")].innerText,
        }));
      }),
    );

  it("names both with their processors where it says what was measured, and describes both", async () => {
    const page = await open(pages.merged);
    const summary = await page.locator(".summary").innerText();
    for (const name of places) assert.ok(summary.includes(name), summary);
    assert.deepEqual(await textsOf(page, "#setup article h3"), ["machine 1", "machine 2", "all machines"]);
    const text = await page.locator("#setup").innerText();
    for (const cpu of ["fast processor", "slow processor"]) assert.ok(text.includes(cpu), text);
  });

  it("has a ranking for each, over all scenes and of one, with ranks from 1 on", async () => {
    const page = await open(pages.merged);
    for (const scene of [null, "street"]) {
      if (scene) await page.getByRole("radio", { name: scene }).check();
      const titles = await textsOf(page, "#ranking h3");
      assert.deepEqual(
        titles.map((title) => title.replace(/, \d+ cores?$/, "")),
        places,
      );
      for (const [at, rows] of (await ranks(page)).entries()) {
        assert.deepEqual([...new Set(rows.map((row) => row.machine))], [`machine ${at + 1}`]);
        const given = rows.map((row) => Number(row.rank)).filter((rank) => rank > 0);
        assert.deepEqual(
          given.sort((a, b) => a - b),
          given.map((_, place) => place + 1),
        );
      }
    }
  });

  it("has panels, maps and settings that say whose times they are of", async () => {
    const page = await open(pages.merged);
    for (const selector of ["#speed-error h4", "#heat-map h4", "#setting option"])
      for (const text of await textsOf(page, selector)) assert.match(text, /machine [12]/, selector);
    const ranges = await page
      .locator("#heat-map svg[role=img]")
      .evaluateAll((all) => all.map((one) => /colours from .*/.exec(one.getAttribute("aria-label"))[0]));
    assert.equal(new Set(ranges).size, 2, String(ranges));
  });

  it("is held against another result without times", async () => {
    const page = await open(pages.mergedAgainst);
    assert.match(await page.locator("#against-first figcaption").innerText(), /Times are left out/);
    assert.deepEqual(page.faults, []);
    const heads = await textsOf(page, "#against-first thead th");
    assert.ok(!heads.some((head) => /time|µs/.test(head)), String(heads));
  });
});

describe("pictures", () => {
  it("are shown for the methods that the filters leave, one kind at a time", async () => {
    const page = await open(pages.pictures);
    const images = page.locator("#pictures img");
    const grids = JSON.parse(readFileSync(join(place, "pictured.json"))).cases.length / 2;
    assert.equal(await images.count(), 2 * 2 * grids);
    for (const image of await images.all()) await image.scrollIntoViewIfNeeded();
    await page.waitForFunction(() =>
      [...document.querySelectorAll("#pictures img")].every((image) => image.naturalWidth > 600),
    );
    assert.match(
      await images.first().getAttribute("alt"),
      /^Lights per pixel: aabb-fast, packed\. Mean [\d.]+, at most \d+/,
    );
    await page.selectOption("#pictures-frame", "2");
    assert.equal(await images.count(), 2 * grids);
    await page.selectOption("#pictures-kind", "depth");
    assert.equal(await images.count(), 1);
    await page.selectOption("#pictures-kind", "strip");
    assert.equal(await images.count(), 2 * grids);
    await page.getByRole("button", { name: "exact-fast" }).first().click();
    assert.equal(await images.count(), grids);
    assert.equal(await (await open(pages.sweep)).locator("#pictures").count(), 0);
  });
});

describe("the history's page", () => {
  it("draws what varies, with an axis and the commits that changed it", async () => {
    const page = await open(pages.history);
    const figure = page.locator("figure", { hasText: "assign_time" }).first();
    assert.match(
      await figure.locator("svg[role=img]").getAttribute("aria-label"),
      /^assign_time in ns of .*, 14 values from /,
    );
    assert.match(await figure.locator(".changes .worse").innerText(), /^c7: .* worse$/);
    assert.match(await figure.locator("svg").textContent(), /↑ ns/);
    assert.ok((await figure.locator("svg [stroke-dasharray] line, svg line[stroke-dasharray]").count()) >= 1);
    assert.match(await page.locator(".summary").innerText(), /14 results, \d+ series, \d+ changes? \(dashed lines\)/);
  });
});
