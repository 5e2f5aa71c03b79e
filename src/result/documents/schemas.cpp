#include "result/documents/check.h"
#include "result/documents/check_page.h"
#include "result/documents/comparison.h"
#include "result/documents/dump.h"
#include "result/documents/light_map.h"
#include "result/documents/page.h"
#include "result/documents/plugin_check.h"
#include "result/documents/ratios.h"
#include "result/documents/recommendation.h"
#include "result/documents/shader.h"
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
template const Type& type_of<PluginCheck>();
template const Type& type_of<Ratios>();
template const Type& type_of<Recommendation>();
template const Type& type_of<ShaderMethod>();
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

Json plugin_check_schema() {
  return schema_of<PluginCheck>("clusterbench plugin check",
                                "What `clusterbench plugin check PLUGIN --json FILE` writes: whether the methods of a "
                                "plug-in keep their contract, test by test.");
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

namespace {

// The same schema, where a whole number may also be a formula.
void allow_formulas(Json& schema) {
  if (schema.is_object() && schema.value("type", Json()) == "integer") {
    const Json formula{{"type", "string"}, {"x-formula", true}};
    Json number = schema, outer = Json::object();
    for (const char* key : {"description", "x-unit"})
      if (number.contains(key)) {
        outer[key] = number[key];
        number.erase(key);
      }
    outer["anyOf"] = Json::array({number, formula});
    schema = outer;
    return;
  }
  if (schema.is_structured())
    for (Json& member : schema) allow_formulas(member);
}

}  // namespace

Json shader_schema() {
  Json schema = schema_of<ShaderMethod>("clusterbench shader",
                                        "What `--shader FILE` reads: compute shaders of a user as a method, with their "
                                        "buffers, dispatches and the lists that they leave.");
  const Json dump = dump_schema();
  for (const char* name : {"lists", "rows", "field"}) {
    Json part = dump["definitions"][name];
    allow_formulas(part);
    schema["definitions"][name] = part;
  }
  schema["properties"]["$schema"] = {{"type", "string"}, {"description", "For editors"}};
  schema["properties"]["lists"]["items"] = {{"$ref", "#/definitions/lists"}};
  return schema;
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
