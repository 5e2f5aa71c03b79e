// Bundles src/ into FOLDER/template.html (of reports), FOLDER/history.html and FOLDER/check.html, each one file that may load nothing, and
// FOLDER/page_template.cpp, which holds all: node build.mjs FOLDER. FOLDER/packages.json says whose code is inside, for packaging/pieces.py.

import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const root = dirname(fileURLToPath(import.meta.url));
const resultsMark = "{{results}}";

const hashOf = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;

async function bundled(entry) {
  const made = await build({
    absWorkingDir: root,
    entryPoints: [entry],
    bundle: true,
    minify: true,
    format: "iife",
    target: "es2022",
    legalComments: "none",
    write: false,
    metafile: true,
  });
  return { text: made.outputFiles[0].text.trim(), inputs: Object.keys(made.metafile.inputs) };
}

// Plot puts this style into every chart. A policy of hashes has to know it before.
function plotStyle() {
  const source = readFileSync(join(root, "node_modules/@observablehq/plot/src/plot.js"), "utf8");
  const found = /append\("style"\)\.text\(\s*`([^`]*)`/.exec(source);
  if (!found) throw new Error("Plot no longer makes its <style> as this build expects");
  return found[1].replaceAll("${className}", "plot");
}

function packageOf(input) {
  const found = /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(input);
  return found?.[1];
}

// Packages whose code is inside of d3's own files.
const within = ["delaunator", "internmap", "robust-predicates"];

function packageNames(inputs) {
  return [...new Set([...inputs.map(packageOf).filter(Boolean), ...within])].sort();
}

function licenceText(name) {
  const folder = join(root, "node_modules", name);
  const file = readdirSync(folder).find((entry) => /^(un)?licen[cs]e/i.test(entry));
  if (!file) throw new Error(`${name} has no licence file`);
  return readFileSync(join(folder, file), "utf8").trim();
}

// What the bundled packages' licences ask to be kept with copies.
function notices(inputs) {
  return packageNames(inputs)
    .map((name) => `${name}\n\n${licenceText(name)}`)
    .join("\n\n----\n\n")
    .replaceAll("--", "- -");
}

function packageFacts(name) {
  const facts = JSON.parse(readFileSync(join(root, "node_modules", name, "package.json"), "utf8"));
  if (!facts.license) throw new Error(`${name}/package.json names no licence`);
  return {
    name,
    version: facts.version,
    licence: facts.license,
    homepage: facts.homepage ?? "",
    text: licenceText(name),
  };
}

function filled(text, values) {
  for (const [mark, value] of Object.entries(values)) {
    if (text.split(mark).length !== 2) throw new Error(`page.html must hold ${mark} once`);
    text = text.replace(mark, () => value);
  }
  return text;
}

function policy(script, style) {
  const only = {
    "default-src": "'none'",
    "script-src": hashOf(script),
    "style-src": `${hashOf(style)} ${hashOf(plotStyle())}`,
    "img-src": "data: blob:",
    "base-uri": "'none'",
    "form-action": "'none'",
  };
  return Object.entries(only)
    .map((rule) => rule.join(" "))
    .join("; ");
}

const text = (name, template) => `std::string_view ${name}() {
  static constexpr char k_template[] = R"__page__(${template})__page__";
  return {k_template, sizeof k_template - 1};
}
`;
const cpp = (report, history, check) => `#include "report/page/page_template.h"

namespace clusterbench::report {

${text("page_template", report)}${text("history_template", history)}${text("check_template", check)}std::string_view page_obstacle() { return {}; }

}  // namespace clusterbench::report
`;

const folder = process.argv[2];
if (!folder) throw new Error("usage: node build.mjs FOLDER");
const style = await bundled("src/style.css");

const bundledInputs = [];

async function templateOf(entry) {
  const script = await bundled(entry);
  bundledInputs.push(...script.inputs);
  if (script.text.includes("</script") || script.text.includes(resultsMark))
    throw new Error("the script holds what would end it early");
  const template = filled(readFileSync(join(root, "src/page.html"), "utf8"), {
    "{{policy}}": policy(script.text, style.text),
    "{{style}}": style.text,
    "{{script}}": script.text,
    "{{notices}}": notices(script.inputs),
  });
  if (template.split(resultsMark).length !== 2) throw new Error(`the template must hold ${resultsMark} once`);
  return template;
}

const [report, history, check] = [
  await templateOf("src/main.ts"),
  await templateOf("src/history.ts"),
  await templateOf("src/check.ts"),
];
if (!existsSync(folder)) mkdirSync(folder, { recursive: true });
writeFileSync(join(folder, "template.html"), report);
writeFileSync(join(folder, "history.html"), history);
writeFileSync(join(folder, "check.html"), check);
writeFileSync(join(folder, "page_template.cpp"), cpp(report, history, check));
writeFileSync(join(folder, "packages.json"), JSON.stringify(packageNames(bundledInputs).map(packageFacts)));
