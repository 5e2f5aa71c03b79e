// Numbers as the page writes them, against what printf writes.

import assert from "node:assert/strict";
import { it } from "node:test";
import { buildSync } from "esbuild";

const source = new URL("../src/format.ts", import.meta.url).pathname;
const code = buildSync({ entryPoints: [source], bundle: true, format: "esm", write: false }).outputFiles[0].text;
const { fixed, microseconds, plural, readBytes } = await import(`data:text/javascript,${encodeURIComponent(code)}`);

it("numbers half-way between two have the digits that printf gives them", () => {
  const expected = [
    [0.5, 0, "0"],
    [1.5, 0, "2"],
    [2.5, 0, "2"],
    [-2.5, 0, "-2"],
    [127.25, 1, "127.2"],
    [127.75, 1, "127.8"],
    [0.125, 2, "0.12"],
    [0.375, 2, "0.38"],
    [1e9 + 0.5, 0, "1000000000"],
  ];
  for (const [value, digits, text] of expected)
    assert.equal(fixed(value, digits), text, `${value} to ${digits} digits`);
});

it("other numbers are rounded to the nearest by what the double holds", () => {
  const expected = [
    [0.15, 1, "0.1"],
    [0.35, 1, "0.3"],
    [2.675, 2, "2.67"],
    [1.005, 2, "1.00"],
    [0.30000001, 1, "0.3"],
    [123456.789, 2, "123456.79"],
  ];
  for (const [value, digits, text] of expected)
    assert.equal(fixed(value, digits), text, `${value} to ${digits} digits`);
});

it("times have the digits of the terminal's table", () => {
  assert.equal(microseconds(127.25), "127.2");
  assert.equal(microseconds(9.995), "9.99");
  assert.equal(microseconds(null), "–");
});

it("bytes that a sample reads have the digits of the terminal's table", () => {
  const expected = [
    [8.58, "8.58"],
    [9.2789, "9.28"],
    [9.5, "9.5"],
    [9.996, "10"],
    [8.125, "8.12"], // half-way
    [54.96, "55"],
    [99.94, "99.9"],
    [99.96, "100"],
    [1246.7, "1247"],
    [0.1234, "0.123"],
    [0, "0"],
    [null, "–"],
  ];
  for (const [value, text] of expected) assert.equal(readBytes(value), text, `${value}`);
});

it("one is not many", () => {
  assert.deepEqual(
    [plural(0, "case"), plural(1, "case"), plural(2, "case"), plural(2, "series", "series")],
    ["0 cases", "1 case", "2 cases", "2 series"],
  );
});
