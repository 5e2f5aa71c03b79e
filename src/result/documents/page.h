#pragma once
// The data of a page of `clusterbench report`, which page/ reads: results, and numbers computed from them.

#include "result/figures/figure_table.h"
#include "result/result.h"

namespace clusterbench::result {

// Names of the table's rows.
std::vector<const char*> figure_names();

struct FigureWords {
  static constexpr const char* k_definition = "figure_words";
  static About about() { return About("A row of the table of figures (`clusterbench list figures`)"); }
  RECORD(FigureWords);
  FIELD(std::string, name, About("In the table").one_of(figure_names()));
  FIELD(std::string, unit, "Of its values here");
  FIELD(std::string, meaning, "As the table has it");
  END_RECORD;
};

struct FrameCost {
  static constexpr const char* k_definition = "frame_cost";
  static About about() { return About("Cost of a case that loses nothing, by which conclusions choose"); }
  RECORD(FrameCost);
  FIELD(std::string, id, "Of the case");
  FIELD(double, ns, About("Making its lists (where timed), upload, reading and shading by config.cost", "ns").finite());
  FIELD(double, gpu_ns, About("The modelled part", "ns").finite());
  END_RECORD;
};

struct Beside {
  static About about() { return About("Frame time / that of another case that was measured beside it"); }
  RECORD(Beside);
  FIELD(std::string, id, "Of the other case");
  FIELD(double, ratio, "Median", "ratio");
  FIELD(Pair, ci95, "95 % interval; null: unknown");
  END_RECORD;
};

struct Ranked {
  static constexpr const char* k_definition = "ranked";
  static About about() { return About("A timed case with lists, among all of its scene, camera and viewport"); }
  RECORD(Ranked);
  FIELD(std::string, id, "Of the case");
  FIELD(Nullable<Beside>, fastest, "Beside the fastest; null: it is the fastest, or they have no ratio");
  FIELD(Nullable<Beside>, above, "Beside the next faster one");
  FIELD(bool, is_like_above, "It may be as fast as the next faster one, as far as their ratio is known");
  END_RECORD;
};

struct PageCase {
  static constexpr const char* k_definition = "page_case";
  static About about() { return About("Numbers of a case"); }
  RECORD(PageCase);
  FIELD(ByName<double>, figures, About("By their names in the table, without those that the case has not").finite());
  FIELD(std::vector<std::string>, sets, "Sets of samples that rank the case: figures of samples are of them");
  END_RECORD;
};

struct PageResult {
  static constexpr const char* k_definition = "page_result";
  static About about() { return About("A result"); }
  RECORD(PageResult);
  FIELD(std::string, file, "Its name for readers");
  FIELD_AS("result", Result, recorded, "Itself");
  FIELD(std::vector<PageCase>, cases, "One for each case of the result, in its order");
  FIELD(std::vector<std::string>, doubts, "Reasons to doubt its times");
  FIELD(std::vector<Ranked>, ratios, "Of timed cases");
  FIELD(std::vector<FrameCost>, costs, "Of cases that lose nothing, where the configuration has a model");
  END_RECORD;
};

struct PagePicture {
  static constexpr const char* k_definition = "picture";
  static About about() { return About("Pixels of some cases, made by `run --images`"); }
  RECORD(PagePicture);
  FIELD(std::string, kind, "As in --image-kinds");
  FIELD(Nullable<int>, frame, "null: along the path");
  FIELD_AS("cases", std::vector<std::string>, case_ids, "Ids of the cases");
  FIELD(std::string, text, "For readers who do not see it");
  FIELD(std::string, url, "Contains the picture (data:)");
  END_RECORD;
};

struct PageData {
  RECORD(PageData);
  FIELD(std::string, command, "Makes the page again");
  FIELD(std::vector<PageResult>, results, "In the order of the command");
  FIELD(std::vector<FigureWords>, figures, "All rows of the table of figures");
  FIELD(ByName<std::string>, sample_sets, About("Words for the sets of samples").each("In texts"));
  FIELD(std::vector<PagePicture>, pictures, "Of --images");
  END_RECORD;
};

// For page/types.mjs, which makes the page's types of it.
Json page_schema();

extern template const Type& type_of<PageData>();

}  // namespace clusterbench::result
