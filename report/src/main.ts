// The page: reads the results that stand in it and puts the sections in order.

import { h } from "./dom.ts";
import { modelOf } from "./model.ts";
import { rankingSection } from "./ranking.ts";
import type { PageData } from "./result.ts";

const data = JSON.parse(document.getElementById("results")!.textContent!) as PageData;
const model = modelOf(data);

document.body.prepend(h("main", {}, h("h1", {}, "clusterbench report"), rankingSection(model)));
document.documentElement.dataset["ready"] = String(performance.now());
