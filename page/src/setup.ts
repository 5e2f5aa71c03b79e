// Where the figures come from: machine, tool, scenes, configuration.

import { h } from "./dom.ts";
import * as format from "./format.ts";
import { copyButton, downloadButton } from "./handover.ts";
import { type Place, placesOf } from "./machines.ts";
import type { Run } from "./model.ts";
import { tableView } from "./table.ts";
import type { Section } from "./view.ts";

function facts(rows: [string, string][]): HTMLElement {
  return h("dl", {}, ...rows.map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, value))));
}

function configView(run: Run): HTMLElement {
  const text = () => JSON.stringify(run.result.config, null, 2) + "\n";
  const details = h("details", { id: `config-${run.label}` }, h("summary", {}, "Configuration, with every default"));
  details.addEventListener("toggle", () => {
    if (details.open && !details.querySelector("pre"))
      details.append(
        h("pre", { tabindex: 0, "aria-label": "Configuration" }, text()),
        h(
          "p",
          { class: "tools" },
          copyButton("Copy configuration", text),
          downloadButton("Download configuration", `${run.result.name}.json`, "application/json", text),
        ),
      );
  });
  return details;
}

function machineFacts({ machine, simdTarget }: Place): [string, string][] {
  return [
    [
      "processor",
      [
        machine.cpu,
        ...(["family", "model", "stepping"] as const).flatMap((key) => (machine[key] ? `${key} ${machine[key]}` : [])),
      ].join(", "),
    ],
    [
      "caches",
      Object.entries(machine.caches ?? {})
        .map(([level, size]) => `${level.toUpperCase()} ${format.memory(size)}`)
        .join(", ") || "unknown",
    ],
    ["cores", String(machine.cores)],
    ["memory", format.memory(machine.ram_bytes)],
    ["system", machine.os],
    [
      "clock",
      machine.clock_mhz
        ? `${machine.clock_mhz.now} MHz${machine.clock_mhz.max ? ` of ${machine.clock_mhz.max}` : ""}`
        : "unknown",
    ],
    ["load", machine.load ? `${machine.load.begin} before the run, ${machine.load.end} after` : "unknown"],
    ["instruction set", simdTarget],
  ];
}

// Of methods that ran on a device.
function deviceFacts({ device }: Run["result"]): [string, string][] {
  if (!device) return [];
  const { arithmetic } = device;
  const rounding = arithmetic?.rounding.replaceAll("_", " ") ?? (device.rounds_to_nearest ? "to nearest" : "unknown");
  return [
    ["device", `${device.name}, ${device.type}`],
    ["driver", `${device.driver}, Vulkan ${device.vulkan}`],
    ["UUID", device.uuid],
    [
      "arithmetic",
      `rounds ${rounding}${arithmetic?.flushes_denormals ? ", flushes denormal numbers" : ""}, subgroups of ${device.subgroup_size}`,
    ],
    ["device's clock", device.timestamp_bits > 0 ? `ticks of ${device.timestamp_period_ns ?? "unknown"} ns` : "none"],
  ];
}

// Of several machines of a result, each with its name and its share of the cases.
function machineViews(run: Run, isAlone: boolean): HTMLElement[] {
  return placesOf(run).flatMap((place) => {
    const cases = run.result.cases.filter(({ machine }) => machine === place.name).length;
    const heading = place.name && h(isAlone ? "h3" : "h4", {}, place.name);
    const more: [string, string][] = place.name ? [["times", format.plural(cases, "case")]] : [];
    return [...(heading ? [heading] : []), facts([...machineFacts(place), ...more])];
  });
}

function runView(run: Run, isAlone: boolean): HTMLElement {
  const { tool, plugins = [], scenes, cases, name, date, command } = run.result;
  const libraries = Object.entries(tool.libraries)
    .map((library) => library.join(" "))
    .join(", ");
  const hasNames = (run.result.machines ?? []).length > 0;
  const undated = hasNames ? "in shards, whose results say when" : "without times, so it does not say when";
  return h(
    "article",
    {},
    isAlone ? null : h("h3", {}, run.label),
    ...machineViews(run, isAlone),
    hasNames && h(isAlone ? "h3" : "h4", {}, "all machines"),
    facts([
      ["measured", [date, command].filter(Boolean).join(", ") || undated],
      ...deviceFacts(run.result),
      ["clusterbench", `${tool.version}, commit ${tool.git_sha}`],
      ...plugins.map(({ id, version, file, sha256 }): [string, string] => [
        `plug-in ${id}`,
        `${version}, ${file}, SHA-256 ${sha256.slice(0, 12)}`,
      ]),
      ["compiler", `${tool.compiler} ${tool.flags}`],
      ["build", tool.build_type],
      ["libraries", libraries],
      ["configuration", `${name}, ${format.plural(cases.length, "case")}`],
      ["file", run.file],
    ]),
    tableView({
      caption: `Scenes of ${run.label}`,
      columns: [
        { label: "scene", value: (scene) => scene.name },
        { label: "points", value: (scene) => scene.lights.point },
        { label: "spots", value: (scene) => scene.lights.spot },
        { label: "directional", value: (scene) => scene.lights.directional },
        { label: "boxes", value: (scene) => scene.lights.box },
        { label: "frames", value: (scene) => scene.frames },
        {
          label: "SHA-256",
          value: (scene) => scene.sha256,
          show: (scene) => h("code", { title: scene.sha256 }, scene.sha256.slice(0, 12)),
        },
      ],
      rows: scenes,
      most: 50,
    }),
    configView(run),
  );
}

export const setupSection: Section = ({ model }) =>
  h(
    "section",
    { id: "setup" },
    h("h2", {}, "Machine and configuration"),
    ...model.runs.map((run) => runView(run, model.runs.length === 1)),
    h("h3", {}, "This page"),
    h(
      "div",
      { class: "command" },
      h("pre", { tabindex: 0, "aria-label": "Command that made this page" }, model.command),
      copyButton("Copy command", () => model.command),
    ),
  );
