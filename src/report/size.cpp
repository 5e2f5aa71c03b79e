#include "report/size.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <limits>
#include <regex>
#include <set>
#include <tuple>

#include "core/error.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

std::string text(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

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
std::string comment(const Json& result, const Json& one) {
  const Json& buffers = one["buffers"];
  const Json& entries = buffers["index_entries"];
  const auto high = entries["high_water"].get<std::uint64_t>(), most = entries["theoretical_max"].get<std::uint64_t>();
  const auto capacity = entries["recommended"].get<std::uint64_t>();
  std::string out = "// " + comment_text(one["name"]) + "\n";
  out += "//   high water  " + std::to_string(high) + " entries in frame " + buffers["worst_frame"].dump() +
         (buffers.contains("worst_cell") ? ", longest list in cell " + buffers["worst_cell"].dump() : "") + "; " +
         share(high, most) + " of the theoretical " + std::to_string(most) + "\n";
  out += "//   allocate    " + std::to_string(capacity) + " entries of " + buffers["index_bits"].dump() + " bits (" +
         (capacity == most ? std::string("all that there can be") : "high water x " + text("%g", margin(result))) +
         "), " + buffers["bytes"]["recommended"].dump() + " bytes with headers\n";
  out += "//   warn above  " + std::to_string(warning_level(result, capacity)) + " entries (" +
         text("%g", warn_at(result)) + " of the capacity)\n";
  if (buffers["overflow"]["dropped_pairs"] != 0)
    out += "//   OVERFLOW    " + buffers["overflow"]["dropped_pairs"].dump() + " pairs dropped in " +
           buffers["overflow"]["cells"].dump() + " cells of " + buffers["overflow"]["frames"].dump() + " frames\n";
  return out;
}

// A case's name as a C++ identifier; a number is added where two become the same.
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
  if (id.empty() || std::isdigit(static_cast<unsigned char>(id.front())) != 0) id = "case_" + id;
  std::string unique = id;
  for (int number = 2; !taken.insert(unique).second; ++number) unique = id + "_" + std::to_string(number);
  return unique;
}

// "scene/camera/grid" of a case's name; its other parts are the method's.
std::string group_of(const Json& one) {
  const auto name = one["name"].get<std::string>();
  std::size_t end = 0;
  for (int part = 0; part < 3 && end != std::string::npos; ++part) end = name.find('/', end + (part > 0 ? 1 : 0));
  return name.substr(0, end);
}

// A light structure of the method's own, not lists.
bool is_own(const Json& one) {
  return one["storage"] == "own";
}

// Smaller is better. Structures of their own come after all lists: what samples pay for them differs.
auto rank(const Json& one) {
  const bool loses = one.value("loses_lights", false) || !one.value("failures", Json::array()).empty();
  const Json time = one.value(Json::json_pointer("/timing/frame_ns/median"), Json());  // null where it was not measured
  const double time_ns = time.is_number() ? time.get<double>() : std::numeric_limits<double>::infinity();
  return std::tuple(loses, is_own(one), time_ns, one["buffers"]["bytes"]["recommended"].get<std::uint64_t>());
}

std::vector<Json> best_of_groups(const std::vector<Json>& cases) {
  std::vector<Json> best;
  for (const Json& one : cases) {
    const auto earlier = std::ranges::find(best, group_of(one), group_of);
    if (earlier == best.end())
      best.push_back(one);
    else if (rank(one) < rank(*earlier))
      *earlier = one;
  }
  return best;
}

std::vector<Json> matching_cases(const Json& cases, const std::string& filter) {
  std::vector<Json> out;
  try {
    const std::regex regex(filter, std::regex::ECMAScript);
    for (const Json& one : cases)
      if (std::regex_search(one["name"].get<std::string>(), regex)) out.push_back(one);
  } catch (const std::regex_error& error) {
    throw Error("", "--filter", "'" + filter + "' is no regular expression (ECMAScript): " + error.what());
  }
  if (out.empty() && !cases.empty())
    throw Error("", "--filter",
                "'" + filter + "' matches none of " + std::to_string(cases.size()) + " cases; one of them is '" +
                    cases[0]["name"].get<std::string>() + "'");
  return out;
}

std::string constants(const Json& result, const Json& one, const std::string& name, std::set<std::string>& taken) {
  const auto capacity = one["buffers"]["index_entries"]["recommended"].get<std::uint64_t>();
  return comment(result, one) + "inline constexpr LightListBudget " + identifier(name, taken) + "{" +
         std::to_string(capacity) + "u, " + std::to_string(warning_level(result, capacity)) + "u, " +
         one["buffers"]["bytes"]["recommended"].dump() + "u};\n\n";
}

constexpr const char* k_header_start = R"(#pragma once
// Light-list allocation, measured by clusterbench. Measure again when levels, lights or the clustering change.

#include <cassert>
#include <cstdint>
#include <cstdio>

namespace light_lists {

struct LightListBudget {
  std::uint64_t capacity_entries;  // light indices to allocate
  std::uint64_t warn_entries;      // say something above this
  std::uint64_t bytes;             // headers included
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

}  // namespace

std::string size_report(const Json& result, const SizeRequest& request) {
  const std::vector<Json> cases = matching_cases(result["cases"], request.filter);
  const std::vector<Json> shown = request.all ? cases : best_of_groups(cases);
  std::string header = k_header_start;
  if (shown.size() < cases.size())
    header += "// The best case of each grid: no light lost, fastest, smallest. --all has all " +
              std::to_string(cases.size()) + ".\n\n";
  std::set<std::string> taken;
  for (const Json& one : shown)
    header += constants(result, one, request.all ? one["name"].get<std::string>() : group_of(one), taken);
  return header + k_header_end;
}

}  // namespace clusterbench::report
