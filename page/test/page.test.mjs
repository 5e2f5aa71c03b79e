// The page in a browser, as `clusterbench report` writes it: node --test test/, with CLUSTERBENCH naming the built tool.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { describe, it } from "node:test";
import { inTable, open, openAll, pages, results, textsOf } from "./pages.mjs";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

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

describe("several results", () => {
  it("stand on one page, told apart by their files", async () => {
    const page = await open(pages.two);
    assert.deepEqual(await textsOf(page, "#setup article > h3"), ["quick", "sweep"]);
    await page.selectOption("#filter-run", "sweep");
    assert.ok(
      (await page.locator(".count").innerText()).startsWith(
        `${JSON.parse(readFileSync(results.sweep)).cases.length} of `,
      ),
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
    assert.equal(rows.length, JSON.parse(readFileSync(results.sweep)).cases.length);
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
    const grids = JSON.parse(readFileSync(results.pictured.file)).cases.length / 2;
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
