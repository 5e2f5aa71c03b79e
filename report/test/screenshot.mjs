// node screenshot.mjs PAGE.html OUT.png: the page's head, ranking and first chart, as scripts/page_screenshot wants them.

import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { launch } from "./browser.mjs";

const [from, to] = process.argv.slice(2);
const browser = await launch();
const page = await browser.newPage({ viewport: { width: 1240, height: 900 }, colorScheme: "light" });
await page.goto(pathToFileURL(resolve(from)).href);
await page.waitForFunction(() => document.documentElement.dataset.ready);
const end = await page.locator("#speed-error").evaluate((figure) => figure.getBoundingClientRect().bottom + window.scrollY);
await page.screenshot({ path: to, fullPage: true, clip: { x: 0, y: 0, width: 1240, height: Math.ceil(end) + 16 } });
await browser.close();
