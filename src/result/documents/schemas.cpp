#include "result/documents/check.h"
#include "result/documents/check_page.h"
#include "result/documents/comparison.h"
#include "result/documents/dump.h"
#include "result/documents/light_map.h"
#include "result/documents/page.h"
#include "result/documents/ratios.h"
#include "result/documents/recommendation.h"
#include "result/documents/size.h"
#include "result/documents/stress.h"
#include "result/documents/worst_case.h"
#include "result/schema.h"

namespace clusterbench::result {

// Here once: each instance lists the fields of all records below it.
template const Type& type_of<Check>();
template const Type& type_of<CheckPage>();
template const Type& type_of<Comparison>();
template const Type& type_of<Dump>();
template const Type& type_of<LightMaps>();
template const Type& type_of<PageData>();
template const Type& type_of<Ratios>();
template const Type& type_of<Recommendation>();
template const Type& type_of<Size>();
template const Type& type_of<Stress>();
template const Type& type_of<WorstCase>();

Json check_schema() {
  return schema_of<Check>("clusterbench check",
                          "What `clusterbench check DUMP --json FILE` writes: light lists of any program, held against "
                          "the exact ones.");
}

Json check_page_schema() {
  return schema_of<CheckPage>("clusterbench check page", "The data of a page that `clusterbench check` writes.");
}

Json comparison_schema() {
  return schema_of<Comparison>("clusterbench comparison",
                               "What `clusterbench compare BASE NEW --json FILE` writes. Times are nanoseconds per "
                               "frame, ratios new / base.");
}

Json dump_schema() {
  return schema_of<Dump>("clusterbench dump",
                         "What `clusterbench check` reads: a camera, a grid, lights and light lists of any program, as "
                         "they lie in buffers.");
}

Json light_map_schema() {
  return schema_of<LightMaps>("clusterbench light maps",
                              "What `clusterbench light-map` writes: the lights that reach each texel of static "
                              "meshes, and what they take as bit fields and in sparser forms.");
}

// Names are literals, so each ends with 0.
std::vector<const char*> figure_names() {
  std::vector<const char*> names;
  for (const Figure& figure : figures()) names.push_back(figure.name.data());
  return names;
}

Json page_schema() {
  return schema_of<PageData>("clusterbench page", "The data of a page that `clusterbench report` writes.");
}

Json ratios_schema() {
  return schema_of<Ratios>("clusterbench ratios",
                           "What `clusterbench ratio RESULT --json FILE` writes: how much longer one case takes than "
                           "another, of one result.");
}

Json recommendation_schema() {
  return schema_of<Recommendation>("clusterbench recommendation",
                                   "What `clusterbench recommend -o FILE` writes: of each scene and viewport the "
                                   "candidate with the least objective among those that break no constraint.");
}

Json size_schema() {
  return schema_of<Size>("clusterbench allocation",
                         "What `clusterbench size --format json` writes: what to allocate for each buffer of light "
                         "structures. x-unit: of a number.");
}

Json stress_schema() {
  return schema_of<Stress>("clusterbench stress result",
                           "What `clusterbench stress` writes: hard cases for numerical stability, and a search for "
                           "lost lights.");
}

Json worst_case_schema() {
  return schema_of<WorstCase>("clusterbench worst-case result",
                              "What `clusterbench worst-case` writes: the frames in which a measure of one case is "
                              "largest.");
}

}  // namespace clusterbench::result
