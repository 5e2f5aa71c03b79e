// Tables of several results say of each row whose it is.

import type { Case } from "./model.ts";
import type { Column } from "./table.ts";
import type { View } from "./view.ts";

export function ofRuns<Row extends { aCase: Case }>(view: View, columns: Column<Row>[]): Column<Row>[] {
  const [first, ...others] = columns;
  return view.hasRuns ? [first!, { label: "result", value: ({ aCase }) => aCase.run.label }, ...others] : columns;
}
