// The page's figures, in a browser: those of the terminal.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { describe, it } from "node:test";
import { pageData } from "./browser.mjs";
import { column, inTable, numbers, open, pages, results, textsOf, tool } from "./pages.mjs";
import { committedResult } from "./results.mjs";

describe("figures", () => {
  it("have the units and digits of the terminal's table", async () => {
    const page = await open(pages.lossy);
    const names = { "frame us": "frame µs", "+-": "±", assign: "assign µs", convert: "convert µs", shade: "overshade" };
    const told = [];
    let grid, heads;
    for (const line of results.lossy.table.split("\n")) {
      const cells = line.replace(/^ *\*? +/, "").split(/ {2,}/);
      if (/, camera /.test(line)) grid = line.trim().replace(/, camera .*/, "");
      else if (cells[0] === "assigner") heads = cells;
      else if (heads && cells.length === heads.length)
        told.push({ grid, ...Object.fromEntries(cells.map((text, at) => [names[heads[at]] ?? heads[at], text])) });
    }
    await page.check("#ranking-all");
    const shown = await inTable(page);
    assert.equal(told.length, shown.length, results.lossy.table);
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

describe("times of a device", () => {
  it("are in a table of their own, fastest first, and in no other", async () => {
    const page = await open(pages.onDevice);
    assert.equal(await page.locator("#device h2").innerText(), "On a device");
    await page.locator("#device-times-data > summary").click();
    const rows = await inTable(page, "#device-times");
    assert.deepEqual(
      rows.map((row) => [row["device µs"], row["±"], row["× floor"], row["upload µs"], row["readback µs"]]),
      ["10.0", "20.0", "30.0"].map((us) => [us, "10.0 %", `${Number(us) / 5}.00`, "4.00", "5.00"]),
    );
    assert.ok(rows.every((row) => row.device === "Card, driver 1.2"));
    const ranked = await inTable(page);
    assert.ok(ranked.every((row) => row["frame µs"] !== "10.0"));
    await page.emulateMedia({ media: "print" });
    const text = await page.locator("#setup, #machine, main").last().innerText();
    assert.match(text, /Card, discrete GPU/);
    assert.match(text, /rounds to nearest, flushes denormal numbers, subgroups of 32/);
  });

  it("are of readings, too, with the frame beside the figures' walk alone", async () => {
    const page = await open(pages.onDevice);
    const rows = await inTable(page, "#readings");
    assert.deepEqual(
      rows.map((row) => [row.walk, row["read µs"], row["× exact"], row["× nothing"], row["frame µs"]]),
      [
        ["light", "90.0", "1.50", "3.00", "–"],
        ["lane", "100.0", "1.50", "3.00", "134.0"],
      ],
    );
  });

  it("of software are in the order of the result, and said to be no GPU's", async () => {
    const page = await open(pages.onSoftware);
    await page.locator("#device-times-data > summary").click();
    const rows = await inTable(page, "#device-times");
    assert.deepEqual(
      rows.map((row) => row["device µs"]),
      ["30.0", "10.0", "20.0"],
    );
    assert.match(await page.locator("#device-times").innerText(), /their times are no GPU's, are not sorted/);
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
