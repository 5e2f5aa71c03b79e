// Charts and the layout, on screens of all sizes and on paper.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { describe, it } from "node:test";
import { numbers, open, pages, results, textsOf } from "./pages.mjs";

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
    const grids = new Set(JSON.parse(readFileSync(results.presets)).cases.map((one) => one.grid.name));
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
