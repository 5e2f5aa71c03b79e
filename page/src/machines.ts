// Machines of a merged result. Times of two are never compared: what has times stands for each machine by itself.

import { plural } from "./format.ts";
import type { Case, Run } from "./model.ts";
import type { Result } from "./result.ts";

type Machine = Result["machine"];

export interface Place {
  name: string; // of `machine` of its cases; "" where the result is of one machine
  machine: Machine;
  simdTarget: string;
}

export function placesOf({ result }: Pick<Run, "result">): Place[] {
  const { machines = [], machine, tool } = result;
  if (machines.length === 0) return [{ name: "", machine, simdTarget: tool.simd_target }];
  return machines.map((one) => ({ name: one.name, machine: one.machine, simdTarget: one.simd_target }));
}

// "machine 2: AMD EPYC, 2 cores".
export function placeText({ name, machine }: Place): string {
  const text = `${machine.cpu}, ${plural(machine.cores, "core")}`;
  return name ? `${name}: ${text}` : text;
}

export const hasMachines = (cases: Case[]) => cases.some(({ machine }) => machine !== "");

// Two results can each have a "machine 1".
export const machineKey = ({ run, machine }: Case) => (machine ? [run.label, machine].join("\n") : "");

const ofOthers = "not of a result of several machines, or without times";

export interface Block {
  title: string; // "" where nothing is of several machines
  cases: Case[];
}

function titleOf({ run, machine }: Case, isAlone: boolean): string {
  if (!machine) return ofOthers;
  const place = placesOf(run).find(({ name }) => name === machine);
  const text = place ? placeText(place) : machine;
  return isAlone ? text : `${run.label}, ${text}`;
}

// Machine by machine, in the order of the results, then what is of none.
export function blocksOf(cases: Case[], isAlone: boolean): Block[] {
  const groups = [...Map.groupBy(cases, machineKey).values()];
  if (!hasMachines(cases)) return groups.map((some) => ({ title: "", cases: some }));
  const rank = ({ run, machine }: Case) => placesOf(run).findIndex(({ name }) => name === machine);
  return groups
    .map((some) => ({ title: titleOf(some[0]!, isAlone), cases: some, first: some[0]! }))
    .sort(
      (a, b) =>
        Number(!a.first.machine) - Number(!b.first.machine) ||
        (a.first.run === b.first.run ? rank(a.first) - rank(b.first) : 0),
    );
}
