// Methods that have different sets of samples, in any order: each figure stands under its own heading.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "cli/tool.h"
#include "core/random.h"
#include "effort.h"

namespace clusterbench::test {
namespace {

using OrderedJson = nlohmann::ordered_json;

// Some with points of the view, some that need depth and have none.
std::vector<std::string> random_methods(SplitMix64& random) {
  std::vector<std::string> left{"exact-fast", "aabb-fast",   "tiled",   "tiled-2.5d",
                                "z-binning",  "tile-ranges", "deferred"},
      drawn;
  for (std::uint64_t count = 2 + random.below(4); count > 0; --count) {
    const std::size_t next = random.below(left.size());
    drawn.push_back(left[next]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(next));
  }
  return drawn;
}

std::string random_sets(SplitMix64& random) {
  std::string flags;
  for (const char* set : {"opaque={}", "fog.froxels=[16,9,8]", "transparent={}", "mirror={}", "anywhere={}"})
    if (random.below(5) < 2) flags += std::string(" --set samples.") + set;
  return flags;
}

std::string joined(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ",") + name;
  return out;
}

struct Shown {
  OrderedJson result;
  std::string text;
};

Shown shown_of(const Folder& folder, const std::vector<std::string>& methods, const std::string& sets) {
  const std::string result = (folder / "result.json").string();
  const Outcome run = tool("run " + source_file("scenes/mix.glb") +
                           " --viewport 192x108 --grid frustum --tiles 32 --slices 8 --set 'scenes.*.frames=1' "
                           "--no-timing --assigner " +
                           joined(methods) + sets + " -o " + result);
  EXPECT_EQ(run.code, 0) << joined(methods) << sets << run.err;
  return {OrderedJson::parse(file_text(result)), run.out + run.err};
}

// Cells of a line that stand at least two blanks apart.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  for (std::size_t begin = line.find_first_not_of(' '); begin < line.size();) {
    const std::size_t end = std::min(line.find("  ", begin), line.size());
    cells.push_back(line.substr(begin, end - begin));
    begin = std::min(line.find_first_not_of(' ', end), line.size());
  }
  return cells;
}

std::vector<std::string> lines_from(const std::string& text, const std::string& begin) {
  std::istringstream in(text.substr(std::min(text.find(begin), text.size())));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line) && !(line.empty() && !lines.empty());) lines.push_back(line);
  return lines;
}

const OrderedJson* set_named(const OrderedJson& result_case, const std::string& name) {
  if (name == "volume") return result_case.contains("shading") ? &result_case["shading"] : nullptr;
  const bool has_it = result_case.contains("samples") && result_case["samples"].contains(name);
  return has_it ? &result_case["samples"][name] : nullptr;
}

std::string expected_cell(const OrderedJson& result_case, const std::string& name) {
  const OrderedJson* set = set_named(result_case, name);
  if (set == nullptr) return "-";
  if ((*set)["samples"] == 0) return "none";
  if ((*set)["unanswered"] == (*set)["samples"]) return "no answer";
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", (*set)["evaluated"].get<double>() / (*set)["samples"].get<double>());
  return text;
}

// The table of lights per sample: a line of each method has at each set its own figure, and a dash where it has none.
void hold_table_against(const Shown& shown) {
  std::map<std::string, const OrderedJson*> cases;
  for (const OrderedJson& result_case : shown.result["cases"])
    cases[result_case["assigner"]["name"].get<std::string>()] = &result_case;
  std::set<std::string> headings;
  std::size_t held = 0;
  std::vector<std::string> sets;
  for (const std::string& line : lines_from(shown.text, "lights per sample of mix")) {
    const std::vector<std::string> cells = cells_of(line);
    if (cells.empty()) continue;
    if (cells[0] == "assigner") sets.assign(cells.begin() + 1, cells.end());
    headings.insert(sets.begin(), sets.end());
    const auto found = cases.find(cells[0].substr(0, cells[0].find(" / ")));
    if (found == cases.end()) continue;
    ASSERT_EQ(cells.size(), 1 + sets.size()) << line;
    for (std::size_t i = 0; i < sets.size(); ++i) {
      const std::string expected = expected_cell(*found->second, sets[i]);
      EXPECT_EQ(cells[1 + i].substr(0, cells[1 + i].find(',')), expected) << sets[i] << ": " << line;
      ++held;
    }
  }
  EXPECT_EQ(held > 0, shown.text.find("lights per sample of mix") != std::string::npos) << shown.text;
  for (const auto& [name, result_case] : cases) {
    const OrderedJson own = result_case->value("samples", OrderedJson::object());
    for (const auto& [set, _] : own.items())
      EXPECT_TRUE(headings.contains(set)) << set << " of " << name << "\n" << shown.text;
  }
}

// A set that only some methods have is not what others are cheaper by.
TEST(RandomSamples, points_of_the_view_that_have_a_price_are_lacking_where_a_method_has_none) {
  const Folder folder;
  const std::string weight = " --set 'cost.weights.volume=pixels'";
  for (const std::string& sets :
       {std::string(), std::string(" --set samples.opaque={}"), std::string(" --set samples.transparent={}")})
    for (const std::vector<std::string>& methods :
         {std::vector<std::string>{"tiled", "exact-fast"}, std::vector<std::string>{"exact-fast", "tiled"}}) {
      const Shown shown = shown_of(folder, methods, sets + weight);
      for (const OrderedJson& result_case : shown.result["cases"]) {
        const bool is_tiled = result_case["assigner"]["name"] == "tiled";
        if (result_case.contains("cost")) {
          EXPECT_EQ(result_case["cost"]["lit"], !is_tiled) << joined(methods) << sets;
        }
        if (!is_tiled) {
          EXPECT_EQ(shown.result["conclusions"][0]["take"], result_case["id"]) << shown.text;
        }
      }
      hold_table_against(shown);
    }
}

TEST(RandomSamples, stand_under_their_own_headings_and_no_order_of_methods_changes_them) {
  const Folder folder;
  SplitMix64 random(12);
  for (int draw = 0; draw < tries(40); ++draw) {
    std::vector<std::string> methods = random_methods(random);
    const std::string sets = random_sets(random);
    SCOPED_TRACE("draw " + std::to_string(draw) + ": " + joined(methods) + sets);
    const Shown shown = shown_of(folder, methods, sets);
    if (shown.result["cases"].empty()) continue;
    hold_table_against(shown);
    std::rotate(methods.begin(), methods.begin() + 1, methods.end());
    const Shown other = shown_of(folder, methods, sets);
    hold_table_against(other);
    const auto conclusion = [](const Shown& one) { return lines_from(one.text, "conclusion: "); };
    EXPECT_EQ(conclusion(other), conclusion(shown));
  }
}

}  // namespace
}  // namespace clusterbench::test
