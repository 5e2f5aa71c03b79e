// Writes the types of a result and of the page's data into src/schema_types.ts from their JSON Schemas, as
// `clusterbench schema result` and page_schema print them (the programs that CLUSTERBENCH and PAGE_SCHEMA name, or the
// release build's): node types.mjs [--check]. With --check it only says whether they are up to date.

import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

const here = (path) => fileURLToPath(new URL(path, import.meta.url));
const printed = (program, ...words) => JSON.parse(execFileSync(program, words, { encoding: "utf8" }));
const schema = printed(process.env.CLUSTERBENCH ?? here("../build/release/clusterbench"), "schema", "result");
const pageSchema = process.env.PAGE_SCHEMA ?? here("../build/release/tests/page_schema");
const page = printed(pageSchema);
const check = printed(pageSchema, "check");
const into = here("src/schema_types.ts");

const nameOf = (definition) => definition.replace(/(^|_)(\w)/g, (_match, _before, letter) => letter.toUpperCase());
const simple = { integer: "number", number: "number", string: "string", boolean: "boolean", null: "null" };

function commentOf({ description, "x-unit": unit, "x-over": over }) {
  const measure = [unit, over && `over ${over}`].filter(Boolean).join(", ");
  const text = [description, measure && `[${measure}]`].filter(Boolean).join(" ");
  return text ? ` // ${text}` : "";
}

function arrayType(part, indent) {
  const items = typeOf(part.items, indent);
  if (part.minItems !== undefined && part.minItems === part.maxItems)
    return `[${Array(part.minItems).fill(items).join(", ")}]`;
  return /[ |{]/.test(items) ? `Array<${items}>` : `${items}[]`;
}

function objectType(part, indent) {
  if (!part.properties)
    return `Record<string, ${part.additionalProperties ? typeOf(part.additionalProperties, indent) : "unknown"}>`;
  const required = new Set(part.required);
  const members = Object.entries(part.properties).map(
    ([name, member]) =>
      `${indent}  ${name}${required.has(name) ? "" : "?"}: ${typeOf(member, `${indent}  `)};${commentOf(member)}\n`,
  );
  return `{\n${members.join("")}${indent}}`;
}

function typeOf(part, indent = "") {
  if (part.$ref) return nameOf(part.$ref.replace("#/definitions/", ""));
  if ("const" in part) return JSON.stringify(part.const);
  if (part.enum) return part.enum.map((value) => JSON.stringify(value)).join(" | ");
  if (Array.isArray(part.type)) return part.type.map((type) => typeOf({ ...part, type }, indent)).join(" | ");
  if (part.type === "array") return arrayType(part, indent);
  if (part.type === "object") return objectType(part, indent);
  if (!simple[part.type]) throw new Error(`no type is known for ${JSON.stringify(part)}`);
  return simple[part.type];
}

const { result: _described, ...ofPage } = page.definitions;
const parts = {
  ...schema.definitions,
  result: schema,
  ...ofPage,
  page_data: page,
  ...check.definitions,
  check_page: check,
};
const types = Object.entries(parts).map(
  ([name, part]) =>
    `${part.description ? `// ${part.description}\n` : ""}export type ${nameOf(name)} = ${typeOf(part)};\n`,
);
const text = `// Made by types.mjs of the records of src/result: change those, and run \`node types.mjs\`.\n\n${types.join("\n")}`;

if (!process.argv.includes("--check")) {
  writeFileSync(into, text);
} else if (readFileSync(into, "utf8") !== text) {
  console.error("page/src/schema_types.ts is not what the schema says: run `node types.mjs` in page/");
  process.exit(1);
}
