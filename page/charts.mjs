// Draws a picture of the documents with the page's own charts: node charts.mjs speed-error RESULT OUT.svg, or
// node charts.mjs scaling CURVES.json OUT.svg, where CURVES is a list of {label, file, sizes by the id of a case}.

import { readFileSync, writeFileSync } from "node:fs";
import { dirname } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";
import { launch } from "./test/browser.mjs";

const [what, from, to] = process.argv.slice(2);
const read = (path) => JSON.parse(readFileSync(path, "utf8"));
const root = dirname(fileURLToPath(import.meta.url));

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

const given = read(from);
const data = what === "scaling" ? given.map(({ file, ...curve }) => ({ ...curve, result: read(file) })) : given;
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
