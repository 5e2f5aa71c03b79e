#include "report/lookup_constants.h"

#include "report/columns.h"
#include "report/result_json.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using Type = LookupConstant::Type;

std::vector<double> numbers_of(const Json& list) {
  std::vector<double> out;
  for (const Json& value : list) out.push_back(value.get<double>());
  return out;
}

// As float literals of C++, HLSL and GLSL alike.
std::string float_text(double value) {
  std::string digits = text("%.9g", value);
  if (digits.find_first_of(".e") == std::string::npos) digits += ".0";
  return digits;
}

bool is_integer(const LookupConstant& constant) {
  return constant.type == LookupConstant::Type::integer;
}

// `suffix`: of single precision.
std::string values_text(const LookupConstant& constant, const std::string& suffix = "") {
  std::string out;
  for (const double value : constant.values)
    out += (out.empty() ? "" : ", ") + (is_integer(constant) ? text("%.0f", value) : float_text(value)) +
           (constant.type == LookupConstant::Type::real ? suffix : "");
  return out;
}

void add_tiles(std::vector<LookupConstant>& out, const Json& result_case) {
  const Json &tiles = result_case["grid"]["tiles"], &viewport = result_case["viewport"];
  if (viewport[0] == 0 || viewport[1] == 0) return;
  out.push_back({"viewport", Type::real, numbers_of(viewport)});
  std::vector<double> scale;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const bool by_pixels = tiles.contains("pixels");
    if (!by_pixels && !tiles.contains("count")) return;
    scale.push_back(by_pixels ? 1.0 / tiles["pixels"][axis].get<double>()
                              : tiles["count"][axis].get<double>() / viewport[axis].get<double>());
  }
  out.push_back({"tile_scale", Type::real, scale});
}

void add_slices(std::vector<LookupConstant>& out, const Json& slices) {
  const Json& lookup = slices["lookup"];
  if (lookup["form"] == "search" && slices["boundaries"].size() > 1)
    out.push_back({"slice_boundaries", Type::real, numbers_of(slices["boundaries"]), true});
  for (const auto& [key, name] :
       {std::pair("scale", "slice_scale"), std::pair("bias", "slice_bias"), std::pair("first", "slice_first")})
    if (lookup.contains(key))
      out.push_back({name, Type::real, {lookup[key].get<double>()}});
    else if (name == std::string("slice_first") && lookup.contains("scale"))
      out.push_back({name, Type::real, {0.0}});
  if (!slices["boundaries"].empty())
    out.push_back({"slice_far", Type::real, {slices["boundaries"].back().get<double>()}});
}

// Those that a grid does not keep over a path.
void mark_changing(std::vector<LookupConstant>& constants, const Json& result_case) {
  const Json& grid = result_case["grid"];
  const auto mark = [&](std::string_view beginning) {
    for (LookupConstant& constant : constants) constant.changes |= constant.name.starts_with(beginning);
  };
  if (grid.contains("follow")) mark("origin");
  if (grid.contains("follow") && grid["follow"] == "lights") mark("box_");
  if (grid.contains("slices") && (grid["slices"]["scheme"] == "fit" || result_case.contains("fit"))) mark("slice_");
  if (result_case.contains("react")) {
    mark("cells");
    mark("tile_scale");
  }
}

struct Language {
  const char *constant, *variable, *integer, *real;
  const char* integers[2];  // of two, of three
  const char* reals[2];
  bool has_array_constructors;  // of arrays: float[2](1.0, 2.0), else {1.0, 2.0}
};
constexpr Language k_hlsl{"static const ", "static ", "int", "float", {"int2", "int3"}, {"float2", "float3"}, false};
constexpr Language k_glsl{"const ", "", "int", "float", {"ivec2", "ivec3"}, {"vec2", "vec3"}, true};

std::string declared_array(const std::string& name, const LookupConstant& constant, const Language& language) {
  const std::string size = "[" + std::to_string(constant.values.size()) + "]", values = values_text(constant);
  return (constant.changes ? language.variable : language.constant) + std::string(language.real) + " " + name + size +
         " = " + (language.has_array_constructors ? language.real + size + "(" + values + ")" : "{" + values + "}") +
         ";\n";
}

std::string declared(const std::string& prefix, const std::vector<LookupConstant>& constants,
                     const Language& language) {
  std::string out;
  for (const LookupConstant& constant : constants) {
    if (constant.is_array) {
      out += declared_array(prefix + "_" + constant.name, constant, language);
      continue;
    }
    const std::size_t count = constant.values.size();
    const std::string type = count == 1 ? (is_integer(constant) ? language.integer : language.real)
                                        : (is_integer(constant) ? language.integers : language.reals)[count - 2];
    out += (constant.changes ? language.variable : language.constant) + type + " " + prefix + "_" + constant.name +
           " = " + (count == 1 ? values_text(constant) : type + "(" + values_text(constant) + ")") + ";\n";
  }
  return out;
}

}  // namespace

std::vector<LookupConstant> lookup_constants(const Json& result_case) {
  const Json& grid = result_case["grid"];
  std::vector<LookupConstant> out{{"cells", Type::integer, numbers_of(grid["cells"])}};
  if (grid.contains("tiles")) add_tiles(out, result_case);
  if (grid.contains("slices")) add_slices(out, grid["slices"]);
  if (grid.contains("levels")) out.push_back({"levels", Type::integer, {grid["levels"].get<double>()}});
  if (grid.contains("finest")) out.push_back({"finest", Type::real, {grid["finest"].get<double>()}});
  if (grid.contains("origin")) out.push_back({"origin", Type::precise, numbers_of(grid["origin"])});
  if (grid.contains("bounds")) {
    out.push_back({"box_min", Type::real, numbers_of(grid["bounds"]["min"])});
    out.push_back({"box_max", Type::real, numbers_of(grid["bounds"]["max"])});
  }
  mark_changing(out, result_case);
  return out;
}

std::string lookup_note(const Json& result_case) {
  const Json& grid = result_case["grid"];
  if (grid.contains("follow"))
    return std::string("the grid follows the ") +
           (grid["follow"] == "camera" ? "camera: origin is" : "lights in view: origin, box_min and box_max are") +
           " the last frame's: set this frame's before a lookup";
  if (!grid.contains("slices")) return "";
  if (grid["slices"]["scheme"] == "fit")
    return "slices follow the lights: scale, bias and far are the last frame's: set this frame's before a lookup";
  if (result_case.contains("react"))
    return "tiles react: cells and tile_scale are the last frame's: set this frame's before a lookup" +
           std::string(result_case.contains("fit") ? ", as are scale, bias, first and far" : "");
  if (result_case.contains("fit"))
    return "slices follow what frames need: scale, bias, first and far are the last frame's: set this frame's before a "
           "lookup";
  const Json& form = grid["slices"]["lookup"]["form"];
  const std::string along = grid["kind"] == "distance" ? "length(view)" : "depth";
  if (form == "search") return "slice = the last one whose boundary, slice_boundaries[slice], is not beyond " + along;
  return "slice = " + (form == "log2" ? "log2(" + along + ")" : along) + " * slice_scale + slice_bias";
}

std::string lookup_hlsl(const std::string& name, const std::vector<LookupConstant>& constants) {
  return declared(name, constants, k_hlsl);
}

std::string lookup_glsl(const std::string& name, const std::vector<LookupConstant>& constants) {
  return declared(name, constants, k_glsl);
}

std::string lookup_cpp(const std::string& name, const std::vector<LookupConstant>& constants) {
  std::string out = "namespace " + name + " {\n";
  for (const LookupConstant& constant : constants) {
    const bool is_single = constant.values.size() == 1;
    const char* type = is_integer(constant) ? "int " : constant.type == Type::precise ? "double " : "float ";
    out += std::string(constant.changes ? "inline " : "inline constexpr ") + type + constant.name +
           (is_single ? " = " + values_text(constant, "f") : "[] = {" + values_text(constant, "f") + "}") + ";\n";
  }
  return out + "}\n";
}

Json lookup_json(const std::vector<LookupConstant>& constants) {
  Json out = Json::object();
  for (const LookupConstant& constant : constants) {
    Json values = Json::array();
    for (const double value : constant.values) values.push_back(number_or_null(value));
    out[constant.name] = values.size() == 1 ? values[0] : values;
  }
  return out;
}

}  // namespace clusterbench::report
