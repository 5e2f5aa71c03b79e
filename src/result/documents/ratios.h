#pragma once
// Ratios: the output of `clusterbench ratio RESULT --json FILE`.

#include "result/result.h"

namespace clusterbench::result {

struct RatioCase {
  RECORD(RatioCase);
  FIELD(std::string, id, "As in the result");
  FIELD(std::string, name, "As in the result");
  FIELD(std::string, label,
        "What tells it from the others of the block: method and storage, and the grid where there are several");
  FIELD(double, frame_ns, About("Median time of a frame", "ns").finite().at_least(0));
  FIELD(std::optional<bool>, samples_search,
        "Whether samples search its structure for lights, which no time here holds. Absent in older files");
  END_RECORD;
};

struct RatioPair {
  RECORD(RatioPair);
  FIELD_AS("case", std::uint64_t, slower, About("Place in cases: the slower one").at_least(1));
  FIELD_AS("other", std::uint64_t, faster, "Place in cases: the faster one");
  FIELD(double, ratio,
        About("Frame time of the case / that of the other: the median of the rounds' or launches' ratios", "ratio")
            .finite()
            .above(0));
  FIELD(Pair, ci95,
        About("95 % interval of the ratio: low, high; null: unknown, of too few launches or rounds").at_least(0));
  FIELD(std::string, over,
        About("What the ratio is formed over: rounds that both were measured in, or, of two grids, launches")
            .one_of({"rounds", "launches"}));
  FIELD(bool, takes_longer, "The interval is above 1: the case takes longer than the other, with 95 % certainty");
  END_RECORD;
};

struct RatioBlock {
  RECORD(RatioBlock);
  FIELD(std::string, scene, "Name of the scene");
  FIELD(std::string, name, "Camera and viewport, and the grid unless blocks hold all grids");
  FIELD(std::vector<RatioCase>, cases, "The fastest first");
  FIELD(std::vector<RatioPair>, pairs, "Any two cases of the block that were measured side by side");
  END_RECORD;
};

struct Ratios {
  RECORD(Ratios);
  FIELD(int, ratios_version, About("Grows whenever a name or a meaning changes").always(1));
  FIELD(std::string, name, "Of the result");
  FIELD(Tool, tool, "As results have it");
  FIELD(bool, across_grids, "Whether a block holds all grids of a scene, camera and viewport, or one of them");
  FIELD(std::vector<RatioBlock>, blocks, "Cases whose times are held against each other");
  END_RECORD;
};

Json ratios_schema();

extern template const Type& type_of<Ratios>();

}  // namespace clusterbench::result
