#include "report/size.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include "core/error.h"
#include "core/pattern.h"
#include "measure/side_by_side.h"
#include "report/columns.h"
#include "report/json_values.h"
#include "report/lookup_constants.h"
#include "report/ratios.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

double warn_at(const Json& result) {
  return result["config"]["allocation"]["warn_at"].get<double>();
}
double margin(const Json& result) {
  return result["config"]["allocation"]["margin"].get<double>();
}

std::uint64_t warning_level(const Json& result, std::uint64_t capacity) {
  return static_cast<std::uint64_t>(std::floor(warn_at(result) * static_cast<double>(capacity)));
}

std::string share(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? "-" : text("%.2f %%", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

// A name from a scene file as one comment line: no line may end early or run on.
std::string comment_text(std::string name) {
  for (char& c : name)
    if (std::iscntrl(static_cast<unsigned char>(c)) != 0 || c == '\\') c = '?';
  return name;
}

// What was seen, as comment lines above the case's constants.
std::string comment(const Json& result, const Json& result_case) {
  const Json& buffers = result_case["buffers"];
  const Json& entries = buffers["index_entries"];
  const auto high = entries["high_water"].get<std::uint64_t>(), most = entries["theoretical_max"].get<std::uint64_t>();
  const auto capacity = entries["recommended"].get<std::uint64_t>();
  std::string out = "// " + comment_text(result_case["name"]) + "\n";
  out += "//   high water  " + std::to_string(high) + " entries in frame " + buffers["worst_frame"].dump() +
         (buffers.contains("worst_cell") ? ", longest list in cell " + buffers["worst_cell"].dump() : "") + "; " +
         share(high, most) + " of the theoretical " + std::to_string(most) + "\n";
  out += "//   allocate    " + std::to_string(capacity) + " entries of " + buffers["index_bits"].dump() + " bits (" +
         (capacity == most ? std::string("all that there can be") : "high water x " + text("%g", margin(result))) +
         "), " + buffers["bytes"]["recommended"].dump() + " bytes with headers\n";
  out += "//   warn above  " + std::to_string(warning_level(result, capacity)) + " entries (" +
         text("%g", warn_at(result)) + " of the capacity)\n";
  if (buffers["overflow"]["dropped_pairs"] != 0)
    out += "//   OVERFLOW    " + number_of(buffers["overflow"]["dropped_pairs"].get<std::uint64_t>(), "pair") +
           " dropped in " + number_of(buffers["overflow"]["cells"].get<std::uint64_t>(), "cell") + " of " +
           number_of(buffers["overflow"]["frames"].get<std::uint64_t>(), "frame") + "\n";
  return out;
}

// A case's name as an identifier of C++ and of shaders' languages; a number is added where two become the same.
std::string identifier(const std::string& name, std::set<std::string>& taken) {
  std::string id;
  for (const char c : name) {
    const bool is_word = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (is_word)
      id += c;
    else if (!id.empty() && id.back() != '_')
      id += '_';
  }
  while (!id.empty() && id.back() == '_') id.pop_back();
  const bool is_reserved = id.starts_with("gl_") || id.empty();  // of GLSL
  if (is_reserved || std::isdigit(static_cast<unsigned char>(id.front())) != 0) id = "case_" + id;
  std::string unique = id;
  for (int number = 2; !taken.insert(unique).second; ++number) unique = id + "_" + std::to_string(number);
  return unique;
}

// "scene/camera/grid" of a case's name; its other parts are the method's.
std::string group_of(const Json& result_case) {
  const auto name = result_case["name"].get<std::string>();
  std::size_t end = 0;
  for (int part = 0; part < 3 && end != std::string::npos; ++part) end = name.find('/', end + (part > 0 ? 1 : 0));
  return name.substr(0, end);
}

// A light structure of the method's own, not lists.
bool is_own(const Json& result_case) {
  return result_case["storage"] == "own";
}

// Smaller is better. Structures of their own come after all lists: what samples pay for them differs.
auto rank(const Json& result_case) {
  const bool loses = result_case["loses_lights"] || !result_case["failures"].empty();
  return std::pair(loses, is_own(result_case));
}

double time_of(const Json& result_case) {
  return number_at(result_case, "/timing/frame_ns/median").value_or(std::numeric_limits<double>::infinity());
}

// Whether its frames take longer than those of the fastest case: as far as is known, lest noise decides.
bool is_slower(const Json& result, const Json& result_case, const Json& fastest) {
  const std::optional<measure::Ratio> ratio = ratio_of_cases(result, result_case, fastest);
  return ratio ? measure::takes_longer(ratio) : time_of(result_case) > time_of(fastest);
}

// Of cases of one grid that lose no light the fastest; of those that may be as fast, the one with the least memory.
const Json* best_of(const Json& result, std::vector<const Json*> cases) {
  const auto least_rank = rank(**std::ranges::min_element(cases, {}, [](const Json* one) { return rank(*one); }));
  std::erase_if(cases, [&](const Json* one) { return rank(*one) != least_rank; });
  const Json& fastest = **std::ranges::min_element(cases, {}, [](const Json* one) { return time_of(*one); });
  std::erase_if(cases, [&](const Json* one) { return one != &fastest && is_slower(result, *one, fastest); });
  return *std::ranges::min_element(cases, {}, [](const Json* one) {
    return std::tuple((*one)["buffers"]["bytes"]["recommended"].get<std::uint64_t>(), time_of(*one),
                      (*one)["name"].get_ref<const std::string&>());
  });
}

std::vector<const Json*> best_of_groups(const Json& result, const std::vector<const Json*>& cases) {
  std::vector<std::pair<std::string, std::vector<const Json*>>> groups;
  for (const Json* result_case : cases) {
    const std::string name = group_of(*result_case);
    auto group = std::ranges::find(groups, name, [](const auto& one) { return one.first; });
    if (group == groups.end()) group = groups.insert(groups.end(), {name, {}});
    group->second.push_back(result_case);
  }
  std::vector<const Json*> best;
  for (const auto& group : groups) best.push_back(best_of(result, group.second));
  return best;
}

std::vector<const Json*> matching_cases(const Json& cases, const std::string& filter) {
  std::vector<const Json*> out;
  const Pattern pattern(filter, "--filter");
  for (const Json& result_case : cases)
    if (pattern.is_in(result_case["name"].get_ref<const std::string&>())) out.push_back(&result_case);
  if (out.empty() && !cases.empty())
    throw Error("", "--filter",
                "'" + filter + "' matches none of " + number_of(cases.size(), "case") + "; one of them is '" +
                    cases[0]["name"].get<std::string>() + "'");
  return out;
}

// What a case is to be given, under a name that programs can have.
struct Budget {
  const Json* result_case = nullptr;
  std::string name;
  std::uint64_t capacity_entries = 0, warn_entries = 0, bytes = 0;
};

// With how a sample finds its list. A structure of a method's own has lookups of its own.
std::string lookup_text(const Budget& budget,
                        std::string (*declare)(const std::string&, const std::vector<LookupConstant>&)) {
  if (is_own(*budget.result_case)) return "";
  const std::string note = lookup_note(*budget.result_case);
  return (note.empty() ? "" : "//   lookup      " + note + "\n") +
         declare(budget.name + "_lookup", lookup_constants(*budget.result_case));
}

std::string cpp_constants(const Json& result, const Budget& budget) {
  return comment(result, *budget.result_case) + "inline constexpr LightListBudget " + budget.name + "{" +
         std::to_string(budget.capacity_entries) + "u, " + std::to_string(budget.warn_entries) + "u, " +
         std::to_string(budget.bytes) + "u};\n" + lookup_text(budget, lookup_cpp) + "\n";
}

// Bytes that 32 bits do not hold are in the comment alone.
std::string shader_constants(const Json& result, const Budget& budget, bool is_hlsl) {
  const std::string type = is_hlsl ? "static const uint" : "const uint";
  const auto line = [&](const char* what, std::uint64_t value) {
    if (value > std::numeric_limits<std::uint32_t>::max()) return std::string();
    return type + " " + budget.name + "_" + what + " = " + std::to_string(value) + "u;\n";
  };
  return comment(result, *budget.result_case) + line("capacity_entries", budget.capacity_entries) +
         line("warn_entries", budget.warn_entries) + line("bytes", budget.bytes) +
         lookup_text(budget, is_hlsl ? lookup_hlsl : lookup_glsl) + "\n";
}

Json budget_json(const Budget& budget) {
  const Json& result_case = *budget.result_case;
  const Json &buffers = result_case["buffers"], &entries = buffers["index_entries"];
  Json out{{"name", budget.name},
           {"id", result_case["id"]},
           {"case", result_case["name"]},
           {"capacity_entries", budget.capacity_entries},
           {"warn_entries", budget.warn_entries},
           {"bytes", budget.bytes},
           {"index_bits", buffers["index_bits"]},
           {"high_water_entries", entries["high_water"]},
           {"theoretical_max_entries", entries["theoretical_max"]},
           {"worst_frame", buffers["worst_frame"]}};
  if (buffers.contains("worst_cell")) out["worst_cell"] = buffers["worst_cell"];
  out["dropped_pairs"] = buffers["overflow"]["dropped_pairs"];
  if (!is_own(result_case)) out["lookup"] = lookup_json(lookup_constants(result_case));
  return out;
}

constexpr const char* k_header_start = R"(#pragma once
// Light-list allocation, measured by clusterbench. Measure again when levels, lights or the clustering change.

#include <cassert>
#include <cstdint>
#include <cstdio>

namespace light_lists {

struct LightListBudget {
  std::uint64_t capacity_entries;  // entries to allocate: light indices of packed lists
  std::uint64_t warn_entries;      // check() warns of a frame that needs more entries than this
  std::uint64_t bytes;             // of these entries and the headers
};

)";

constexpr const char* k_header_end =
    R"(// Call once per frame with the number of entries that the frame needs. Keeps the worst ever seen; warns once per new worst
// above the warning level; asserts before the allocation is overrun.
inline void check(const LightListBudget& budget, std::uint64_t needed_entries, std::uint64_t& worst_ever) {
  if (needed_entries > worst_ever) {
    worst_ever = needed_entries;
    if (needed_entries > budget.warn_entries)
      std::fprintf(stderr, "light lists: %llu of %llu entries in use; raise the allocation\n",
                   static_cast<unsigned long long>(needed_entries), static_cast<unsigned long long>(budget.capacity_entries));
  }
  assert(needed_entries <= budget.capacity_entries && "light lists overflow their allocation");
}

}  // namespace light_lists
)";

// What is left out, as a comment line.
std::string left_out_text(std::size_t shown, std::size_t all) {
  if (shown == all) return "";
  return "// Of each grid the fastest case that loses no light; of those that may be as fast, the smallest. --all has "
         "all " +
         std::to_string(all) + ".\n\n";
}

std::string cpp_report(const Json& result, const std::vector<Budget>& budgets, std::size_t all) {
  std::string text = k_header_start + left_out_text(budgets.size(), all);
  for (const Budget& budget : budgets) text += cpp_constants(result, budget);
  return text + k_header_end;
}

std::string shader_report(const Json& result, const std::vector<Budget>& budgets, std::size_t all, bool is_hlsl) {
  std::string text =
      "// Light-list allocation, measured by clusterbench. Measure again when levels, lights or the clustering "
      "change.\n\n" +
      left_out_text(budgets.size(), all);
  for (const Budget& budget : budgets) text += shader_constants(result, budget, is_hlsl);
  text.pop_back();
  return text;
}

std::string json_report(const Json& result, const std::vector<Budget>& budgets, std::size_t all) {
  Json out{{"margin", margin(result)}, {"warn_at", warn_at(result)}, {"cases", all}, {"budgets", Json::array()}};
  for (const Budget& budget : budgets) out["budgets"].push_back(budget_json(budget));
  return out.dump(1) + "\n";
}

}  // namespace

std::vector<std::string> size_formats() {
  return {"cpp", "hlsl", "glsl", "json"};
}

std::string size_report(const Json& result, const SizeRequest& request) {
  const std::vector<const Json*> cases = matching_cases(result["cases"], request.filter);
  const std::vector<const Json*> shown = request.all ? cases : best_of_groups(result, cases);
  std::set<std::string> taken;
  std::vector<Budget> budgets;
  for (const Json* shown_case : shown) {
    const Json& result_case = *shown_case;
    const auto capacity = result_case["buffers"]["index_entries"]["recommended"].get<std::uint64_t>();
    budgets.push_back({&result_case,
                       identifier(request.all ? result_case["name"].get<std::string>() : group_of(result_case), taken),
                       capacity, warning_level(result, capacity),
                       result_case["buffers"]["bytes"]["recommended"].get<std::uint64_t>()});
  }
  if (request.format == "hlsl") return shader_report(result, budgets, cases.size(), true);
  if (request.format == "glsl") return shader_report(result, budgets, cases.size(), false);
  if (request.format == "json") return json_report(result, budgets, cases.size());
  return cpp_report(result, budgets, cases.size());
}

}  // namespace clusterbench::report
