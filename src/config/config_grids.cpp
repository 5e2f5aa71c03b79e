#include "config/config_grids.h"

#include <algorithm>
#include <set>

#include "assign/contract/assigner.h"
#include "config/grid_json.h"
#include "core/error.h"
#include "core/text.h"

namespace clusterbench::config {
namespace {

using Json = nlohmann::json;

// A key that can be an axis, and the nesting depth of lists in a single value of it.
struct Axis {
  const char* pointer;
  int depth;
};
constexpr Axis k_axes[] = {{"/tiles/pixels", 1},
                           {"/tiles/count", 1},
                           {"/tiles/aspect", 0},
                           {"/slices/scheme", 0},
                           {"/slices/count", 0},
                           {"/slices/near", 0},
                           {"/slices/first", 0},
                           {"/slices/far", 0},
                           {"/slices/far_at_most", 0},
                           {"/slices/far_default", 0},
                           {"/slices/orthographic", 0},
                           {"/slices/lambda", 0},
                           {"/slices/boundaries", 1},
                           {"/slices/fit", 0},
                           {"/slices/fit/to", 0},
                           {"/slices/fit/damping", 0},
                           {"/slices/fit/step", 0},
                           {"/react", 0},
                           {"/react/to", 0},
                           {"/react/most", 0},
                           {"/react/of", 0},
                           {"/react/most_lights", 0},
                           {"/cells", 1},
                           {"/levels", 0},
                           {"/finest", 0},
                           {"/follow", 0},
                           {"/cell_size", 1}};

std::vector<Json::json_pointer> axis_pointers() {
  std::vector<Json::json_pointer> out;
  for (const Axis& axis : k_axes) out.emplace_back(axis.pointer);
  return out;
}

// Error ("", pointer) if lists multiply to more.
void check_combinations(std::uint64_t count, const std::string& pointer) {
  if (count > k_most_combinations)
    throw Error("", pointer,
                "lists make " + std::to_string(count) + " combinations here; allowed: at most " +
                    std::to_string(k_most_combinations) + ", so shorten one or write several configurations");
}

// Errors of `call` with their place in the text; `pointer`: the place of its object.
template <class Call>
auto placed(const JsonText& text, const std::string& pointer, Call call) {
  try {
    return call();
  } catch (const Error& error) {
    throw Error(text.file, text.where(pointer + error.where()), error.message());
  }
}

int nesting(const Json& value) {
  return value.is_array() && !value.empty() ? 1 + nesting(value.front()) : 0;
}

bool is_list(const Json& object, const Json::json_pointer& axis, int depth) {
  return object.contains(axis) && nesting(object[axis]) > depth;
}

// Copies of each object of `all`, with each value of the list of the axis.
std::vector<Json> expand_axis(std::vector<Json> all, const Json::json_pointer& axis, int depth) {
  if (std::ranges::none_of(all, [&](const Json& object) { return is_list(object, axis, depth); })) return all;
  std::uint64_t count = 0;
  for (const Json& object : all) count += is_list(object, axis, depth) ? object[axis].size() : 1;
  check_combinations(count, axis.to_string());
  std::vector<Json> out;
  for (const Json& object : all) {
    if (!is_list(object, axis, depth)) {
      out.push_back(object);
      continue;
    }
    for (const Json& value : object[axis]) {
      out.push_back(object);
      out.back()[axis] = value;
    }
  }
  return out;
}

void drop_unused_reaction(Json& grid) {
  if (!grid.contains("react")) return;
  Json& react = grid["react"];
  if (react.is_null()) {
    grid.erase("react");
    return;
  }
  react.erase(react["to"] == "entries" ? "most_lights" : "of");
  if (react["to"] == "entries" && !react.contains("of"))
    react["of"] = grid["kind"] == "distance" ? "distance-fast" : "exact-fast";
}

// A key that only other schemes use must not make several equal grids.
void drop_unused(Json& grid) {
  drop_unused_reaction(grid);
  if (grid.contains("cell_size") && grid.value("follow", Json()) != "camera") grid.erase("cell_size");
  if (!grid.contains("slices")) return;
  Json& slices = grid["slices"];
  const std::string scheme = slices["scheme"].get<std::string>();
  const bool is_cubical = scheme == "cubical" || scheme == "cubical-first";
  if (scheme != "exponential-first" && scheme != "cubical-first") slices.erase("first");
  if (scheme != "power") slices.erase("lambda");
  if (scheme != "list") slices.erase("boundaries");
  if (scheme == "list")
    for (const char* key : {"count", "near", "far", "far_at_most", "far_default", "orthographic"}) slices.erase(key);
  if (is_cubical) slices.erase("count");
  if (scheme == "linear" || slices.value("orthographic", Json()) == "scheme") slices.erase("orthographic");
  for (const char* key : {"far_at_most", "far_default"})
    if (slices.contains(key) && slices[key].is_null()) slices.erase(key);
  const bool is_fitted = slices.contains("fit") && !slices["fit"].is_null();
  if (!is_fitted || is_cubical || scheme == "list" || scheme == "fit") slices.erase("fit");
}

bool has_one_slice_and_a_first(const Json& grid) {
  return grid.contains("slices") && grid["slices"]["scheme"] == "exponential-first" && grid["slices"]["count"] == 1;
}

std::vector<Json> expanded(const Json& grid) {
  std::vector<Json> all{grid};
  static const std::vector<Json::json_pointer> pointers = axis_pointers();
  for (std::size_t i = 0; i < std::size(k_axes); ++i) all = expand_axis(std::move(all), pointers[i], k_axes[i].depth);
  std::vector<Json> out;
  std::set<Json> different;
  for (Json& single : all) {
    drop_unused(single);
    if (different.insert(single).second) out.push_back(std::move(single));
  }
  return out;
}

void check_slices(const Json& slices, const std::string& pointer, const JsonText& text) {
  const auto fail = [&](const char* key, const std::string& message) {
    throw Error(text.file, text.where(pointer + key), message);
  };
  const double near = slices_metres(slices, "near"), far = slices_metres(slices, "far"),
               first = slices_metres(slices, "first");
  if (near > 0 && far > 0 && near >= far)
    fail("/far", "found " + slices["far"].dump() + ", allowed: a number above near, " + slices["near"].dump());
  if (first > 0 && near >= first)
    fail("/first", "found " + slices["first"].dump() + ", allowed: a number above near, " + slices["near"].dump());
  if (first > 0 && far > 0 && first >= far)
    fail("/first", "found " + slices["first"].dump() + ", allowed: a number below far, " + slices["far"].dump());
  if (slices["scheme"] == "exponential-first" && slices["count"] == 1)
    fail("/count", "found 1, allowed: at least 2 slices with scheme exponential-first");
  const Json boundaries = slices.value("boundaries", Json::array());
  for (std::size_t i = 1; i < boundaries.size(); ++i)
    if (boundaries[i] <= boundaries[i - 1])
      fail(("/boundaries/" + std::to_string(i)).c_str(),
           "found " + boundaries[i].dump() + " after " + boundaries[i - 1].dump() + ", allowed: ascending numbers");
}

// Rejects settings that no grid with `react` can have, in any scene.
void check_reaction(const Json& grid, const std::string& pointer, const JsonText& text) {
  const Json& react = grid["react"];
  const auto fail = [&](const char* key, const std::string& message) {
    throw Error(text.file, text.where(pointer + "/react" + key), message);
  };
  const std::string scheme = grid["slices"]["scheme"].get<std::string>();
  if (grid["tiles"].contains("aspect"))
    fail("", "found tiles.aspect, which makes tiles of slices; allowed beside react: tiles.pixels or tiles.count");
  if (scheme == "cubical" || scheme == "cubical-first")
    fail("", "found " + scheme + " slices, which follow from tiles; allowed beside react: another slices.scheme");
  if (react["to"] == "mask-words" && grid["tiles"].contains("count"))
    fail("/to", "found 'mask-words', which doubles tiles in pixels, beside tiles.count; allowed: tiles.pixels");
}

// The method whose lists tiles react to must have lists for this kind of grid, and must not need depth.
void check_method_of_reaction(const Json& grid, const std::string& pointer, const JsonText& text) {
  const Json& react = grid["react"];
  if (react["to"] != "entries") return;
  const std::string name = react["of"].get<std::string>(), kind = grid["kind"].get<std::string>();
  const assign::AssignerDescriptor* method = assign::find_assigner(name);
  std::vector<std::string> allowed;
  for (const assign::AssignerDescriptor* any : assign::assigner_descriptors())
    if (any->answers(assign::Answer::lists) && !any->needs.depth &&
        std::ranges::any_of(any->kinds, [&](grid::Kind taken) { return grid::kind_name(taken) == kind; }))
      allowed.push_back(any->name);
  if (method == nullptr)
    throw Error(text.file, text.where(pointer + "/react/of"),
                "found '" + name + "'" + did_you_mean(name, allowed) + ", allowed: " + joined(allowed));
  if (std::ranges::find(allowed, name) == allowed.end())
    throw Error(text.file, text.where(pointer + "/react/of"),
                "found '" + name + "', which fills no lists of " + kind +
                    " grids from lights alone; allowed: " + joined(allowed));
}

void check_boxes(const Json& grid, const std::string& pointer, const JsonText& text) {
  const Json& cells = grid["cells"];
  if (grid["kind"] == "cascades" &&
      (cells[0].get<int>() % 4 != 0 || cells[1].get<int>() % 4 != 0 || cells[2].get<int>() % 2 != 0))
    throw Error(text.file, text.where(pointer + "/cells"),
                "found " + cells.dump() + ", allowed: multiples of 4, 4 and 2");
  if (!grid.contains("bounds") || grid["bounds"].is_null()) return;
  if (grid.value("follow", Json()) == "lights")
    throw Error(text.file, text.where(pointer + "/bounds"),
                "found bounds of a grid that follows the lights in view, which are its bounds; allowed: null");
  const Json& bounds = grid["bounds"];
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (bounds["min"][axis] >= bounds["max"][axis])
      throw Error(
          text.file, text.where(child_pointer(pointer + "/bounds/max", axis)),
          "found " + bounds["max"][axis].dump() + ", allowed: a number above min, " + bounds["min"][axis].dump());
}

}  // namespace

std::vector<Json> expand_all_axes(const Json& object, const JsonText& text, const std::string& pointer,
                                  const std::set<std::string>& triples) {
  std::vector<Json> all{object};
  placed(text, pointer, [&] {
    for (const auto& [key, value] : object.items())
      all = expand_axis(std::move(all), Json::json_pointer(child_pointer("", key)), triples.contains(key) ? 1 : 0);
  });
  return all;
}

std::vector<grid::GridSpec> grid_specs(const Json& grids, const JsonText& text) {
  std::vector<grid::GridSpec> out;
  std::set<Json> earlier;
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const std::string pointer = child_pointer("/grids", i);
    const std::vector<Json> singles = placed(text, pointer, [&] { return expanded(grids[i]); });
    placed(text, "/grids", [&] { check_combinations(out.size() + singles.size(), ""); });
    if (singles.size() == 1) {
      if (singles[0].contains("slices")) check_slices(singles[0]["slices"], pointer + "/slices", text);
      if (singles[0].contains("cells")) check_boxes(singles[0], pointer, text);
      if (singles[0].contains("react")) check_reaction(singles[0], pointer, text);
    }
    for (const Json& single : singles) {
      if (single.contains("react")) check_method_of_reaction(single, pointer, text);
      if (!earlier.insert(single).second)
        throw Error(text.file, text.where(pointer), "this grid stands here twice: " + single.dump());
      out.push_back(grid_spec(single));
    }
  }
  return out;
}

Json usable_default_grids(const Json& grids) {
  std::set<Json> earlier;
  Json out = Json::array();
  for (const Json& grid : grids) {
    bool is_changed = false;
    Json kept = Json::array();
    for (Json single : expanded(grid)) {
      if (has_one_slice_and_a_first(single)) {
        single["slices"]["scheme"] = "linear";
        drop_unused(single);
        is_changed = true;
      }
      const bool is_repeated = !earlier.insert(single).second;
      is_changed = is_changed || is_repeated;
      if (is_repeated) continue;
      kept.push_back(single);
    }
    if (!is_changed) kept = Json::array({grid});
    out.insert(out.end(), kept.begin(), kept.end());
  }
  return out;
}

}  // namespace clusterbench::config
