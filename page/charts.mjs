// Draws a picture of the documents with the page's own charts: node charts.mjs speed-error RESULT OUT.svg, or
// node charts.mjs scaling CURVES.json OUT.svg, where CURVES is a list of {label, file, sizes by the id of a case}.
// Figures are those of pages that the program that CLUSTERBENCH names, or the release build's, makes of the results.

import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";
import { launch, pageData } from "./test/browser.mjs";

const [what, from, to] = process.argv.slice(2);
const root = dirname(fileURLToPath(import.meta.url));
const tool = process.env.CLUSTERBENCH ?? join(root, "../build/release/clusterbench");

async function bundled(entry) {
  const made = await build({
    absWorkingDir: root,
    entryPoints: [entry],
    bundle: true,
    format: "iife",
    target: "es2022",
    write: false,
  });
  return made.outputFiles[0].text;
}

const data =
  what === "scaling"
    ? JSON.parse(readFileSync(from, "utf8")).map(({ file, ...curve }) => ({ ...curve, data: pageData(tool, file) }))
    : pageData(tool, from);
const browser = await launch();
const page = await browser.newPage({ colorScheme: "light" });
page.on("pageerror", (error) => {
  throw error;
});
await page.setContent("<!doctype html><html><head></head><body></body></html>");
await page.addStyleTag({ content: await bundled("src/style.css") });
await page.addScriptTag({ content: await bundled("src/drawings.ts") });
const svg = await page.evaluate(([name, value]) => globalThis.drawings[name](value), [what, data]);
await browser.close();
writeFileSync(to, svg);
