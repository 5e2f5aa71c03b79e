#include "report/shader_code/lookup_constants.h"

#include "report/cases/columns.h"
#include "result/rounding.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using Type = LookupConstant::Type;

template <class List>
std::vector<double> numbers_of(const List& list) {
  return {list.begin(), list.end()};
}

// A float literal that is valid in C++, HLSL and GLSL.
std::string float_text(double value) {
  std::string digits = text("%.9g", value);
  if (digits.find_first_of(".e") == std::string::npos) digits += ".0";
  return digits;
}

bool is_integer(const LookupConstant& constant) {
  return constant.type == LookupConstant::Type::integer;
}

// `suffix`: for single precision.
std::string values_text(const LookupConstant& constant, const std::string& suffix = "") {
  std::string out;
  for (const double value : constant.values)
    out += (out.empty() ? "" : ", ") + (is_integer(constant) ? text("%.0f", value) : float_text(value)) +
           (constant.type == LookupConstant::Type::real ? suffix : "");
  return out;
}

void add_tiles(std::vector<LookupConstant>& out, const result::Tiles& tiles, const result::Counts2& viewport) {
  if (viewport[0] == 0 || viewport[1] == 0) return;
  const std::vector<double> pixels = numbers_of(viewport);
  out.push_back({"viewport", Type::real, pixels});
  if (tiles.pixels) {
    const auto [width, height] = *tiles.pixels;
    out.push_back({"tile_scale", Type::real, {1.0 / static_cast<double>(width), 1.0 / static_cast<double>(height)}});
  } else if (tiles.count) {
    const std::vector<double> count = numbers_of(*tiles.count);
    out.push_back({"tile_scale", Type::real, {count[0] / pixels[0], count[1] / pixels[1]}});
  }
}

void add_slices(std::vector<LookupConstant>& out, const result::Slices& slices) {
  const result::SliceLookup& lookup = slices.lookup;
  if (lookup.form == "search" && slices.boundaries.size() > 1)
    out.push_back({"slice_boundaries", Type::real, slices.boundaries, true});
  if (lookup.scale) out.push_back({"slice_scale", Type::real, {*lookup.scale}});
  if (lookup.bias) out.push_back({"slice_bias", Type::real, {*lookup.bias}});
  if (lookup.first || lookup.scale) out.push_back({"slice_first", Type::real, {lookup.first.value_or(0.0)}});
  if (!slices.boundaries.empty()) out.push_back({"slice_far", Type::real, {slices.boundaries.back()}});
}

// Marks constants that the grid changes along a path.
void mark_changing(std::vector<LookupConstant>& constants, const result::Case& result_case) {
  const result::Grid& grid = result_case.grid;
  const auto mark = [&](std::string_view beginning) {
    for (LookupConstant& constant : constants) constant.changes |= constant.name.starts_with(beginning);
  };
  if (grid.follow) mark("origin");
  if (grid.follow == "lights") mark("box_");
  if (grid.slices && (grid.slices->scheme == "fit" || result_case.fit)) mark("slice_");
  if (result_case.react) {
    mark("cells");
    mark("tile_scale");
  }
}

struct Language {
  const char *constant, *variable, *integer, *real;
  const char* integers[2];  // of two, of three components
  const char* reals[2];
  bool has_array_constructors;  // arrays as float[2](1.0, 2.0), else {1.0, 2.0}
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

std::vector<LookupConstant> lookup_constants(const result::Case& result_case) {
  const result::Grid& grid = result_case.grid;
  std::vector<LookupConstant> out{{"cells", Type::integer, numbers_of(grid.cells)}};
  if (grid.tiles) add_tiles(out, *grid.tiles, result_case.viewport);
  if (grid.slices) add_slices(out, *grid.slices);
  if (grid.levels) out.push_back({"levels", Type::integer, {static_cast<double>(*grid.levels)}});
  if (grid.finest) out.push_back({"finest", Type::real, {*grid.finest}});
  if (grid.origin) out.push_back({"origin", Type::precise, numbers_of(*grid.origin)});
  if (grid.bounds) {
    out.push_back({"box_min", Type::real, numbers_of(grid.bounds->min)});
    out.push_back({"box_max", Type::real, numbers_of(grid.bounds->max)});
  }
  mark_changing(out, result_case);
  return out;
}

std::string lookup_note(const result::Case& result_case) {
  const result::Grid& grid = result_case.grid;
  if (grid.follow)
    return std::string("the grid follows the ") +
           (*grid.follow == "camera" ? "camera: origin is" : "lights in view: origin, box_min and box_max are") +
           " the last frame's: set this frame's before a lookup";
  if (!grid.slices) return "";
  if (grid.slices->scheme == "fit")
    return "slices follow the lights: scale, bias and far are the last frame's: set this frame's before a lookup";
  if (result_case.react)
    return "tiles react: cells and tile_scale are the last frame's: set this frame's before a lookup" +
           std::string(result_case.fit ? ", as are scale, bias, first and far" : "");
  if (result_case.fit)
    return "slices follow what frames need: scale, bias, first and far are the last frame's: set this frame's before a "
           "lookup";
  const std::string &form = grid.slices->lookup.form, along = grid.kind == "distance" ? "length(view)" : "depth";
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
    for (const double value : constant.values) values.push_back(result::number_json(result::counted(value), false));
    out[constant.name] = values.size() == 1 ? values[0] : values;
  }
  return out;
}

}  // namespace clusterbench::report
