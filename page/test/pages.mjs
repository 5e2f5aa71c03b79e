// Pages of the tests, each made when it is first asked for, and what tests read from them.

import { join } from "node:path";
import { after, afterEach, before } from "node:test";
import { chromiumPath, folder, launch, makePage, open as openPage } from "./browser.mjs";
import {
  committedResult,
  historyPage,
  limited,
  lossy,
  measureSweep,
  ofTwoMachines,
  onAnotherMachine,
  onDevice,
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
export const tool = process.env.CLUSTERBENCH;
const place = folder();

// An object whose values are made when they are first asked for.
function lazily(makers) {
  const made = {};
  const out = {};
  for (const [name, make] of Object.entries(makers))
    Object.defineProperty(out, name, { get: () => (made[name] ??= make()) });
  return out;
}

// Files; of `lossy` also the table that the terminal shows.
export const results = lazily({
  sweep: () => measureSweep(tool, place),
  lossy: () => {
    let table;
    const file = measureSweep(tool, place, lossy, (text) => (table = text));
    return { file, table };
  },
  presets: () => measureSweep(tool, place, presets),
  merged: () => ofTwoMachines(results.sweep, place),
  pictured: () => withPictures(tool, place),
});

const pageOf = (name, files, ...more) => makePage(tool, files, join(place, `${name}.html`), ...more);
export const pages = lazily({
  quick: () => pageOf("quick", [committedResult]),
  sweep: () => pageOf("sweep", [results.sweep]),
  lossy: () => pageOf("lossy", [results.lossy.file]),
  presets: () => pageOf("presets", [results.presets]),
  limited: () => pageOf("limited", [limited(results.presets, place)]),
  sparse: () => pageOf("sparse", [sparse(results.sweep, place)]),
  wide: () => pageOf("wide", [widened(committedResult, place)]),
  cameras: () => pageOf("cameras", [withTwoCameras(committedResult, place)]),
  against: () => pageOf("against", [results.sweep, onAnotherMachine(results.sweep, place)]),
  merged: () => pageOf("merged", [results.merged]),
  mergedAgainst: () => pageOf("merged-against", [results.sweep, results.merged]),
  pictures: () => pageOf("pictures", [results.pictured.file], "--images", results.pictured.images),
  byCost: () => pageOf("by-cost", [rankedByCost(committedResult, place)]),
  history: () => historyPage(tool, place),
  onDevice: () => pageOf("on-device", [onDevice(committedResult, place)]),
  onSoftware: () => pageOf("on-software", [onDevice(committedResult, place, true)]),
  two: () => pageOf("two", [committedResult, results.sweep]),
});

let browser;
before(async () => (browser = await launch()));
afterEach(() => Promise.all(browser.contexts().map((context) => context.close())));
after(() => browser?.close());

export const open = (url, options) => openPage(browser, url, options);

// Of all that match, as soon as there are any: tables of figures are made a moment after they are opened.
export async function textsOf(page, selector) {
  await page.locator(selector).first().waitFor({ state: "attached" });
  return page.locator(selector).allInnerTexts();
}
export const methods = (page) => textsOf(page, "#ranking tbody th");
export const column = async (page, label) => {
  const labels = (await textsOf(page, "#ranking thead th")).map((text) => text.replace(/ [↑↓]$/, ""));
  return textsOf(page, `#ranking tbody td:nth-child(${labels.indexOf(label) + 1})`);
};
export const numbers = (texts) => texts.map((text) => Number(text.replace(/[^\d.]/g, "")));
export const inTable = async (page, selector = "#ranking") => {
  const labels = (await textsOf(page, `${selector} thead th`)).map((text) => text.replace(/ [↑↓]$/, ""));
  const rows = await page
    .locator(`${selector} tbody tr`)
    .evaluateAll((all) => all.map((row) => [...row.children].map((cell) => cell.innerText)));
  return rows.map((row) => Object.fromEntries(row.map((text, at) => [labels[at], text])));
};
export const isAscending = (values) => values.every((value, at) => at === 0 || values[at - 1] <= value);

// Opens every closed part of the page, and waits for the tables in them.
export async function openAll(page) {
  for (const summary of await page.locator("summary").all()) await summary.click();
  await page.waitForFunction(() => !document.querySelector("figure > details[open]:not(:has(.figure-data))"));
}
