// The page's tables and conclusions, in a browser.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { describe, it } from "node:test";
import { column, inTable, isAscending, methods, numbers, open, pages, textsOf } from "./pages.mjs";
import { committedResult } from "./results.mjs";

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
