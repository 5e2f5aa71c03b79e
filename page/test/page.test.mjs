// The page in a browser, as `clusterbench report` writes it: node --test test/, with CLUSTERBENCH naming the built tool.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { after, afterEach, before, describe, it } from "node:test";
import { chromiumPath, folder, launch, makePage, open as openPage } from "./browser.mjs";
import { committedResult, lossy, measureSweep } from "./results.mjs";

if (!chromiumPath) {
  console.log("skipped: there is no Chromium (scripts/setup test installs it)");
  process.exit(0);
}
const tool = process.env.CLUSTERBENCH;
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const place = folder();
const pages = {};

let browser, sweepFile;
before(async () => {
  pages.quick = makePage(tool, [committedResult], join(place, "quick.html"));
  sweepFile = measureSweep(tool, place);
  pages.sweep = makePage(tool, [sweepFile], join(place, "sweep.html"));
  pages.lossy = makePage(tool, [measureSweep(tool, place, lossy)], join(place, "lossy.html"));
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
const isAscending = (values) => values.every((value, at) => at === 0 || values[at - 1] <= value);

async function violations(page) {
  await page.evaluate(axe);
  const found = await page.evaluate(() => globalThis.axe.run(document));
  return found.violations.map((one) => `${one.id}: ${one.nodes.map((node) => node.target).join("; ")}`);
}

async function openAll(page) {
  for (const summary of await page.locator("summary").all()) await summary.click();
  await page.waitForFunction(() => !document.querySelector("figure > details[open]:not(:has(.twin))"));
}

describe("the page", () => {
  for (const [name, colorScheme] of [["quick", "dark"], ["sweep", "light"], ["two", "light"]])
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
    const brightness = () => page.evaluate(() => Number(getComputedStyle(document.documentElement).backgroundColor.match(/\d+/)[0]));
    assert.ok((await brightness()) < 60);
    await page.selectOption("#theme", "light");
    assert.ok((await brightness()) > 200);
  });
});

describe("the ranking", () => {
  it("stands first and is sorted by time", async () => {
    const page = await open(pages.quick);
    assert.equal(await page.locator("main h2").first().innerText(), "Ranking");
    const times = numbers(await column(page, "time / best"));
    assert.ok(times.length > 5 && isAscending(times), String(times));
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

  it("shows the cases of one scene, of one grid, of some words, of the front", async () => {
    const page = await open(pages.quick);
    const result = JSON.parse(readFileSync(committedResult));
    const expected = (holds) => result.cases.filter(holds).map((one) => one.assigner.label).sort();
    const shown = async () => (await methods(page)).sort();
    await page.getByRole("radio", { name: "street" }).check();
    assert.deepEqual(await shown(), expected((one) => one.scene === "street"));
    await page.selectOption("#filter-grid", { index: 1 });
    const grid = result.cases[0].grid.name;
    assert.deepEqual(await shown(), expected((one) => one.scene === "street" && one.grid.name === grid));
    await page.fill("#filter-words", "fast exact");
    assert.deepEqual(await shown(), ["exact-fast"]);
    await page.fill("#filter-words", "");
    await page.check("#filter-front");
    const front = result.front.find((one) => one.scene === "street").ids;
    assert.deepEqual(await shown(), expected((one) => front.includes(one.id) && one.grid.name === grid));
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
    assert.deepEqual(names, [...names].sort((a, b) => a.localeCompare(b, "en")));
    const outline = await page.evaluate(() => getComputedStyle(document.activeElement).outlineStyle);
    assert.equal(outline, "solid");
  });
});

describe("what a case loses", () => {
  const rows = async (page) => {
    const labels = (await textsOf(page, "#ranking thead th")).map((text) => text.replace(/ [↑↓]$/, ""));
    const cells = await page.locator("#ranking tbody tr").evaluateAll((all) => all.map((row) => [...row.children].map((cell) => cell.innerText)));
    const dots = await page.locator("#ranking tbody tr").evaluateAll((all) => all.map((row) => row.querySelector(".front") !== null));
    return cells.map((one, at) => ({ ...Object.fromEntries(one.map((text, column) => [labels[column], text])), isOnFront: dots[at] }));
  };

  it("stands beside its time, takes its overshade and its place on the front", async () => {
    const page = await open(pages.lossy);
    const all = await rows(page);
    assert.equal(all.length, 8);
    const whole = all.filter((one) => one.dropped === "0" && parseFloat(one.unlit) === 0);
    assert.equal(whole.length, 2, JSON.stringify(all));
    assert.ok(whole.some((one) => one.isOnFront) && whole.every((one) => one.overshade.endsWith("×")), JSON.stringify(whole));
    for (const one of all.filter((other) => !whole.includes(other))) {
      assert.ok(parseFloat(one.unlit) > 0.1 && one.overshade === "–" && !one.isOnFront, JSON.stringify(one));
    }
  });

  it("is ranked by what a frame takes, with its parts and its worst frame beside it", async () => {
    const page = await open(pages.lossy);
    const all = (await rows(page)).map((one) => Object.fromEntries(Object.entries(one).map(([label, text]) => [label, parseFloat(String(text).replaceAll(",", ""))])));
    assert.ok(isAscending(all.map((one) => one["frame µs"])), JSON.stringify(all));
    for (const one of all) {
      assert.ok(one["worst µs"] >= 0.99 * one["frame µs"], JSON.stringify(one));
      assert.ok(one["assign µs"] < one["frame µs"] && one["convert µs"] < one["frame µs"], JSON.stringify(one));
      assert.ok(one["most pairs"] >= one.pairs, JSON.stringify(one));
    }
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
    assert.match(text, /Note\. 4 cases dropped lights because their storage was full/);
    assert.match(text, /Note\. 6 cases leave more than 0\.1 % of the lights that samples need unlit/);
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
      await figure.locator(".twin").waitFor();
      assert.ok((await figure.locator("tbody tr").count()) > 1, id);
      assert.match(await figure.locator("pre").innerText(), /^clusterbench run \S+\.json/, id);
      const waiting = page.waitForEvent("download");
      await figure.getByRole("button", { name: "Download CSV" }).click();
      const text = readFileSync(await (await waiting).path(), "utf8");
      const rows = await figure.locator("tbody tr").count();
      assert.ok(text.startsWith("method,") && text.trim().split("\n").length >= rows + 1, id);
    }
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

  it("fit a narrow screen without scrolling the page sideways", async () => {
    const page = await open(pages.sweep, { viewport: { width: 390, height: 800 } });
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth));
  });
});

describe("several results", () => {
  it("stand on one page, told apart by their files", async () => {
    const page = await open(pages.two);
    assert.deepEqual(await textsOf(page, "#setup article > h3"), ["quick", "sweep"]);
    await page.selectOption("#filter-run", "sweep");
    assert.ok((await page.locator(".count").innerText()).startsWith(`${JSON.parse(readFileSync(sweepFile)).cases.length} of `));
  });
});
