// A headless Chromium and pages made by the built tool, for tests and screenshots.

import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

export const chromiumPath = [
  process.env.CHROMIUM,
  "/usr/bin/chromium-headless-shell", // the same without windows, which takes half the time
  "/usr/bin/chromium",
  "/usr/bin/chromium-browser",
  "/usr/bin/google-chrome",
].find((path) => path && existsSync(path));

const timeout = 120_000; // ms; Playwright's own half a minute can pass where other tests and other users have the processors

export const launch = (more = []) =>
  chromium.launch({
    executablePath: chromiumPath,
    headless: true,
    timeout,
    args: [
      "--no-sandbox",
      "--disable-gpu",
      "--disable-quic",
      "--no-first-run",
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-sync",
      ...more,
    ],
  });

// WebGL without a graphics card.
export const webGlInSoftware = [
  "--use-gl=angle",
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
  "--ignore-gpu-blocklist",
];

// Opens a page and collects in `faults` whatever it should not do. `levels`: of its console.
export async function open(browser, url, { levels = ["error", "warning"], ...options } = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, ...options });
  context.setDefaultTimeout(timeout);
  const page = await context.newPage();
  page.faults = [];
  page.on("console", (message) => levels.includes(message.type()) && page.faults.push(message.text()));
  page.on("pageerror", (error) => page.faults.push(error.message));
  page.on(
    "request",
    (request) =>
      request.url() !== url.replace(/#.*/, "") &&
      !request.url().startsWith("blob:") &&
      page.faults.push(`asks for ${request.url()}`),
  );
  await page.goto(url);
  await page.waitForFunction(() => document.documentElement.dataset.ready);
  return page;
}

// A folder that goes when the process ends.
export function folder() {
  const path = mkdtempSync(join(tmpdir(), "clusterbench-page."));
  process.on("exit", () => rmSync(path, { recursive: true, force: true }));
  return path;
}

export function makePage(tool, results, into, ...more) {
  execFileSync(tool, ["report", ...results, "-o", into, ...more], { stdio: ["ignore", "ignore", "pipe"] });
  return pathToFileURL(into).href;
}

// The data of the page that the tool makes of a result.
export function pageData(tool, result) {
  const into = join(folder(), "page.html");
  makePage(tool, [result], into);
  return JSON.parse(/ id="results">(.*?)<\/script>/s.exec(readFileSync(into, "utf8"))[1]);
}
