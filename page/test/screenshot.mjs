// node screenshot.mjs PAGE.html OUT.png [SECTION]: a section, or the page's head, ranking and first chart, as
// scripts/page_screenshot wants them.

import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { launch, webGlInSoftware } from "./browser.mjs";

const [from, to, section] = process.argv.slice(2);
const browser = await launch(webGlInSoftware);
const page = await browser.newPage({ viewport: { width: 1240, height: 900 }, colorScheme: "light" });
await page.goto(pathToFileURL(resolve(from)).href);
await page.waitForFunction(() => document.documentElement.dataset.ready);
const [begin, end] = await page.locator(section ? `#${section}` : "#speed-error").evaluate((part) => {
  const { top, bottom } = part.getBoundingClientRect();
  return [Math.floor(top + window.scrollY), Math.ceil(bottom + window.scrollY)];
});
const top = section ? begin - 8 : 0;
await page.screenshot({ path: to, fullPage: true, clip: { x: 0, y: top, width: 1240, height: end + 16 - top } });
await browser.close();
