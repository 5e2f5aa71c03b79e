#include "report/comparing/exact_differences.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "report/cases/columns.h"
#include "result/at.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

enum class Kind {
  cost,      // less is better
  follows,   // says the same as some cost in another way
  unjudged,  // says nothing of the case by itself: how the truth was found, what limits make of the counts
  fixed      // what both must have in common
};

struct Rule {
  std::string_view prefix;
  Kind kind;
};

// The first that fits; what none fits is fixed.
constexpr std::array k_rules{
    Rule{"/failures", Kind::unjudged},  // they fail by themselves
    Rule{"/scene", Kind::unjudged},     // its name: follows the file's, and the order of files of one name
    Rule{"/warnings", Kind::follows},
    Rule{"/loses_lights", Kind::follows},
    Rule{"/eligible", Kind::follows},
    Rule{"/tests_done", Kind::cost},
    Rule{"/fallbacks", Kind::cost},
    Rule{"/occupancy/pairs", Kind::cost},
    Rule{"/occupancy/lights_per_cell/histogram", Kind::follows},
    Rule{"/occupancy/lights_per_cell", Kind::cost},
    Rule{"/occupancy", Kind::follows},
    Rule{"/buffers/used_share", Kind::follows},
    Rule{"/buffers/worst_", Kind::follows},
    Rule{"/buffers/along_path", Kind::follows},
    Rule{"/buffers/each", Kind::follows},
    Rule{"/buffers/overflow/lights", Kind::follows},
    Rule{"/buffers", Kind::cost},
    Rule{"/error/true_pairs", Kind::fixed},
    Rule{"/error/frames_checked", Kind::fixed},
    Rule{"/error/decided", Kind::unjudged},
    Rule{"/error/deepest_miss", Kind::cost},
    Rule{"/error/deepest", Kind::follows},
    Rule{"/error", Kind::cost},
    Rule{"/shading/samples", Kind::fixed},
    Rule{"/shading/needed", Kind::fixed},
    Rule{"/shading/waves/longest_list", Kind::cost},
    Rule{"/shading/waves/united_lists", Kind::cost},
    Rule{"/shading/waves/mean_list", Kind::cost},
    Rule{"/shading/waves", Kind::follows},
    Rule{"/shading/worst_frame", Kind::follows},
    Rule{"/shading/darkest", Kind::follows},
    Rule{"/shading", Kind::cost},
    Rule{"/depth_ranges", Kind::fixed},
    Rule{"/lookup", Kind::cost},
    Rule{"/stability/changed/method", Kind::cost},
    Rule{"/stability/flickers/method", Kind::cost},
    Rule{"/stability/excess", Kind::cost},
    Rule{"/precision/extra_pairs", Kind::cost},
    Rule{"/pre_cull/build_ns", Kind::unjudged},
    Rule{"/pre_cull/bytes", Kind::cost},
    Rule{"/pre_cull/lost", Kind::cost},
    Rule{"/fit/fitted/true_pairs", Kind::fixed},
    Rule{"/fit/fitted", Kind::cost},
    Rule{"/fit/unfitted/true_pairs", Kind::fixed},
    Rule{"/fit/unfitted", Kind::cost},
    Rule{"/fit/saved", Kind::follows},
    Rule{"/react/frames", Kind::cost},
    Rule{"/react/needed", Kind::cost},
    Rule{"/react/moves/changed", Kind::cost},
    Rule{"/react/tiles", Kind::follows},
    Rule{"/react/reacting/true_pairs", Kind::follows},
    Rule{"/react/reacting", Kind::cost},
    Rule{"/react/fixed/true_pairs", Kind::fixed},
    Rule{"/react/fixed", Kind::cost},
    Rule{"/react/saved", Kind::follows},
    Rule{"/fallback/saved", Kind::follows},
    Rule{"/fallback", Kind::cost},
    Rule{"/shadow_cull/pairs/after", Kind::cost},
    Rule{"/shadow_cull/pairs", Kind::follows},
    Rule{"/shadow_cull/true_pairs/after", Kind::cost},
    Rule{"/shadow_cull/true_pairs", Kind::follows},
    Rule{"/shadow_cull/opaque/evaluated/after", Kind::cost},
    Rule{"/shadow_cull/opaque/evaluated", Kind::follows},
    Rule{"/shadow_cull/opaque/wrongly_removed", Kind::cost},
    Rule{"/shadow_cull/opaque/lost_irradiance", Kind::cost},
    Rule{"/shadow_cull/maps/unlimited", Kind::cost},
    Rule{"/shadow_cull/maps", Kind::follows},
};

// Sets of samples are shaded like those of the whole view: "/samples/fog/missed" counts as "/shading/missed".
std::string as_shading(const std::string& pointer) {
  constexpr std::string_view k_sets = "/samples/";
  if (!pointer.starts_with(k_sets)) return pointer;
  const std::size_t end = pointer.find('/', k_sets.size());
  if (end == std::string::npos) return pointer;
  constexpr std::string_view k_waves = "/waves/";  // of each size: "/waves/0/longest_list"
  const std::string rest = pointer.substr(end);
  if (!rest.starts_with(k_waves)) return "/shading" + rest;
  const std::size_t size_end = rest.find('/', k_waves.size());
  return "/shading/waves" + (size_end == std::string::npos ? "" : rest.substr(size_end));
}

// Ways to take out what lies in shadow count alike: "/shadows/culls/0/pairs/after" as "/shadow_cull/pairs/after".
std::string as_shadow_cull(const std::string& pointer) {
  constexpr std::string_view k_ways = "/shadows/culls/";
  if (!pointer.starts_with(k_ways)) return pointer;
  const std::size_t end = pointer.find('/', k_ways.size());
  return "/shadow_cull" + (end == std::string::npos ? "" : pointer.substr(end));
}

Kind kind_of(const std::string& of) {
  const std::string pointer = as_shadow_cull(as_shading(of));
  for (const Rule& rule : k_rules)
    if (pointer.compare(0, rule.prefix.size(), rule.prefix) == 0) return rule.kind;
  return Kind::fixed;
}

const char* judged(Kind kind, const Json& base, const Json& next) {
  if (kind == Kind::unjudged || kind == Kind::follows) return "changed";
  // A quotient that says nothing on one side; what it is made of is compared.
  if (kind == Kind::cost && (base.is_null() || next.is_null())) return "changed";
  if (kind == Kind::fixed || !base.is_number() || !next.is_number()) return "worse";
  return next.get<double>() < base.get<double>() ? "better" : "worse";
}

bool holds_objects(const Json& value) {
  return value.is_array() && !value.empty() && value.front().is_object();
}

// Goes down both values side by side and adds each leaf that differs.
void walk(const std::string& pointer, const Json& base, const Json& next, Json& out) {
  if (base == next) return;
  if (base.is_object() && next.is_object()) {
    for (const auto& [key, value] : base.items())
      if (next.contains(key)) walk(pointer + "/" + key, value, next[key], out);
  } else if (holds_objects(base) && holds_objects(next) && base.size() == next.size()) {
    for (std::size_t i = 0; i < base.size(); ++i) walk(pointer + "/" + std::to_string(i), base[i], next[i], out);
  } else {
    out.push_back({{"what", pointer}, {"base", base}, {"new", next}, {"is", judged(kind_of(pointer), base, next)}});
  }
}

bool is_counted(const std::string& key) {
  constexpr std::array<std::string_view, 3> k_others{"name", "timing", "count"};
  return std::find(k_others.begin(), k_others.end(), key) == k_others.end();
}

// The high-water marks behind it are compared in any case.
bool follows_margin(const std::string& pointer) {
  return pointer.starts_with("/buffers/") &&
         (pointer.ends_with("/recommended") || pointer.starts_with("/buffers/used_share"));
}

bool any(const Json& differences, const char* what) {
  return std::any_of(differences.begin(), differences.end(),
                     [&](const Json& difference) { return difference["is"] == what; });
}

bool follows_from_nothing(const Json& differences) {
  return std::any_of(differences.begin(), differences.end(),
                     [](const Json& difference) { return kind_of(difference["what"]) == Kind::follows; });
}

}  // namespace

std::string deepest_loss_text(const result::Case& result_case) {
  const auto* deepest = result::part<&result::Case::error, &result::ListError::deepest>(result_case);
  if (deepest == nullptr) return "";
  return "frame " + std::to_string(deepest->frame) + ", cell " + Json(deepest->cell).dump() + ", light " +
         std::to_string(deepest->light) + " ('" + shown(deepest->light_name) + "')";
}

Json exact_differences(const result::Case& base, const result::Case& next, bool is_margin_same) {
  const Json base_json = result::to_json(base), next_json = result::to_json(next);
  Json found = Json::array(), differences = Json::array();
  for (const auto& [key, value] : base_json.items())
    if (is_counted(key) && next_json.contains(key)) walk("/" + key, value, next_json[key], found);
  for (const Json& difference : found)
    if (is_margin_same || !follows_margin(difference["what"].get<std::string>())) differences.push_back(difference);
  const bool is_better = any(differences, "better");
  const bool is_worse = any(differences, "worse") || (!is_better && follows_from_nothing(differences));
  Json out{{"counts", is_worse ? "worse" : is_better ? "better" : "same"}, {"differences", differences}};
  for (const Json& difference : differences)
    if (difference["what"] == "/error/false_negatives" && difference["is"] == "worse")
      out["place"] = deepest_loss_text(next);
  return out;
}

}  // namespace clusterbench::report
