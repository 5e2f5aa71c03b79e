// How long a large result takes to open, in a browser that has the machine to itself.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { it } from "node:test";
import { chromiumPath, folder, launch, makePage, open } from "./browser.mjs";
import { committedResult, grown } from "./results.mjs";

if (!chromiumPath) {
  console.log("skipped: there is no Chromium (scripts/setup test installs it)");
  process.exit(0);
}

it("opens a result of 20 MB in under 3 s", async (test) => {
  const place = folder(),
    file = join(place, "large.json");
  writeFileSync(file, JSON.stringify(grown(JSON.parse(readFileSync(committedResult)), 20e6)));
  const url = makePage(process.env.CLUSTERBENCH, [file], join(place, "large.html"));
  const browser = await launch();
  test.after(() => browser.close());
  const tries = [];
  do {
    const page = await open(browser, url);
    tries.push(await page.evaluate(() => Number(document.documentElement.dataset.ready)));
    assert.deepEqual(page.faults, []);
  } while (tries.at(-1) >= 3000 && tries.length < 2); // once more: the machine may have been busy
  test.diagnostic(`ready after ${tries.map((ms) => `${ms} ms`).join(", then ")}`);
  assert.ok(tries.at(-1) < 3000, String(tries));
});
