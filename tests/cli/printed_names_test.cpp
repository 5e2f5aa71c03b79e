// Every name that a command prints for a case or a structure selects it, copied into --filter or a budget.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "cli/tool.h"
#include "core/random.h"
#include "effort.h"

namespace clusterbench {
namespace {

using test::Folder;
using test::Outcome;
using test::tool;
using NamesJson = nlohmann::json;

// A grid of any kind, with what its name can have in it.
NamesJson random_named_grid(SplitMix64& random) {
  const auto size = [&] { return static_cast<int>(32U << random.below(3)); };
  const auto count = [&] { return static_cast<int>(2 + random.below(9)); };
  switch (random.below(4)) {
    case 0:
      return {{"kind", "frustum"},
              {"tiles", {{"pixels", {size(), size()}}}},
              {"slices",
               {{"scheme", "exponential-first"}, {"count", count()}, {"near", 0.25}, {"first", 2.5}, {"far", 40}}}};
    case 1:
      return {{"kind", "frustum"},
              {"tiles", {{"count", {count(), count()}}}},
              {"slices", {{"scheme", "linear"}, {"count", count()}, {"near", 0.1}, {"far", 40}}}};
    case 2:
      return {{"kind", "distance"},
              {"tiles", {{"pixels", {size(), size()}}}},
              {"slices", {{"scheme", "exponential"}, {"count", count()}, {"near", 0.1}, {"far", 40}}}};
    default:
      return {{"kind", "world"}, {"cells", {count(), count(), count()}}};
  }
}

NamesJson random_named_config(SplitMix64& random) {
  NamesJson config{{"scenes", NamesJson::array({{{"path", test::source_file("scenes/street.glb")}, {"frames", 1}}})},
                   {"viewports", {{320, 180}}},
                   {"assigners", {"exact-fast", {{"name", "aabb"}, {"spot", "sphere"}}, "bvh"}},
                   {"storages", {"packed", {{"name", "fixed"}, {"cap", 64}}}},
                   {"accuracy", {{"check", false}}},
                   {"limits", {{"dropped_pairs", nullptr}}}};
  if (random.below(2) == 0) config["viewports"].push_back({640, 360});
  if (random.below(2) == 0) config["precision"] = {"float32", {{"packing", "half"}, {"inflate", true}}};
  if (random.below(2) == 0) config["pre_cull"] = {"none", "frustum"};
  config["grids"] = NamesJson::array({random_named_grid(random), random_named_grid(random)});
  if (config["grids"][0] == config["grids"][1]) config["grids"].erase(1);
  return config;
}

std::string quoted(const std::string& text) {
  return "'" + text + "'";
}

// Rows and blocks of the table of `run`: lines that name a method, and lines that name a grid and a camera.
std::set<std::string> names_in_table(const std::string& table) {
  std::set<std::string> names;
  std::istringstream in(table);
  std::string block;
  bool has_rows = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with(" ") && !line.starts_with("  ") && line.find(", camera ") != std::string::npos) {
      block = line.substr(1);
      if (!block.starts_with("structures that")) names.insert(block);
      has_rows = true;
    } else if (has_rows && line.starts_with("    ") && line.find("assigner ") == std::string::npos) {
      names.insert(line.substr(4, line.find("  ", 4) - 4));
    } else if (has_rows && line.starts_with("  * ")) {
      names.insert(line.substr(4, line.find("  ", 4) - 4));
    } else if (!line.starts_with("    ")) {
      has_rows = false;
    }
  }
  return names;
}

class PrintedNames : public ::testing::Test {
 protected:
  void make(SplitMix64& random) {
    config_ = folder_.write("config.json", random_named_config(random).dump()).string();
    result_ = (folder_ / "result.json").string();
    const Outcome ran = tool("run --no-timing " + config_ + " -o " + result_);
    ASSERT_EQ(ran.code, 0) << ran.err;
    table_ = ran.err;
  }
  // Copied into every command that selects.
  void expect_selects(const std::string& name) const {
    const std::string text = quoted(name);
    for (const std::string& arguments :
         {"run --dry-run --filter " + text + " " + config_, "size --all --filter " + text + " " + result_,
          "export --format csv --filter " + text + " " + result_,
          "compare --filter " + text + " " + result_ + " " + result_,
          "report --filter " + text + " -o " + (folder_ / "page.html").string() + " " + result_}) {
      const Outcome done = tool(arguments);
      EXPECT_EQ(done.code, 0) << arguments << "\n" << done.err;
    }
    const Outcome budget = tool("run -q --no-timing --fail-if " + quoted(name + ": bytes > 1e12") + " " + config_ +
                                " -o " + (folder_ / "again.json").string());
    EXPECT_EQ(budget.code, 0) << name << "\n" << budget.err;
  }

  const Folder folder_;
  std::string config_, result_, table_;
};

TEST_F(PrintedNames, select_their_case_in_every_command_on_random_grids) {
  const int tries = test::k_sanitized ? 1 : 3;
  for (int i = 0; i < tries; ++i) {
    SplitMix64 random(static_cast<std::uint64_t>(100 + i));
    make(random);
    std::set<std::string> names = names_in_table(table_);
    EXPECT_GE(names.size(), 4u) << table_;
    const Outcome sized = tool("size --all --format json " + result_);
    ASSERT_EQ(sized.code, 0) << sized.err;
    for (const NamesJson structures = NamesJson::parse(sized.out);
         const NamesJson& structure : structures["structures"])
      names.insert(structure["name"].get<std::string>());
    const Outcome one_for_all = tool("size --all --one-for-viewports --format json " + result_);
    for (const NamesJson structures = NamesJson::parse(one_for_all.out);
         const NamesJson& structure : structures["structures"])
      names.insert(structure["name"].get<std::string>());
    const NamesJson result = NamesJson::parse(test::file_text(result_));
    names.insert(result["cases"][0]["name"].get<std::string>());
    names.insert(result["cases"][0]["id"].get<std::string>());
    std::vector<std::string> some(names.begin(), names.end());
    const std::size_t most = test::k_sanitized ? 4 : 12;  // of each kind some: each is tried in six commands
    while (some.size() > most) some.erase(some.begin() + static_cast<std::ptrdiff_t>(random.below(some.size())));
    for (const std::string& name : some) expect_selects(name);
  }
}

TEST_F(PrintedNames, of_a_structure_select_its_cases_of_all_cameras_and_nothing_else) {
  SplitMix64 random(7);
  make(random);
  const NamesJson result = NamesJson::parse(test::file_text(result_));
  const auto structures = NamesJson::parse(tool("size --all --format json " + result_).out)["structures"];
  for (const NamesJson& structure : structures) {
    const std::string name = structure["name"];
    const Outcome planned = tool("run --dry-run --filter " + quoted(name) + " " + config_);
    std::size_t lines = 0;
    std::istringstream in(planned.out);
    for (std::string line; std::getline(in, line);) {
      if (line.starts_with("skipped")) continue;
      ++lines;
      EXPECT_NE(line.find(name.substr(name.find('/') + 1)), std::string::npos) << line;
    }
    EXPECT_EQ(lines, 1u) << name << "\n" << planned.out;
  }
}

TEST(FormerNames, of_a_methods_choice_are_those_of_today_wherever_they_are_read) {
  const test::Folder folder;
  const auto configuration = [](const std::string& spot) {
    return R"({"scenes": [{"path": ")" + test::source_file("scenes/street.glb") +
           R"(", "frames": 2}], "viewport": [320, 180], "grids": [{"kind": "frustum", "slices": {"count": 4}}],
             "assigners": [{"name": "aabb", "spot": ")" +
           spot + R"("}], "timing": {"measure": false}})";
  };
  const auto result_of = [&](const std::string& spot) {
    const std::string out = (folder / (spot + ".result.json")).string();
    EXPECT_EQ(tool("run -q -o " + out + " " + folder.write(spot + ".json", configuration(spot)).string()).code, 0);
    return out;
  };
  const std::string now = result_of("sphere"), before = result_of("ball");
  EXPECT_EQ(NamesJson::parse(test::file_text(now))["cases"], NamesJson::parse(test::file_text(before))["cases"]);
  // As an earlier version wrote it.
  NamesJson old = NamesJson::parse(test::file_text(now));
  NamesJson& one = old["cases"][0];
  one["assigner"]["label"] = "aabb(spot=ball)";
  one["assigner"]["params"]["spot"] = "ball";
  std::string name = one["name"];
  name.replace(name.find("spot=sphere"), 11, "spot=ball");
  one["name"] = name;
  const std::string former = folder.write("former.json", old.dump()).string();
  const Outcome compared = tool("compare " + former + " " + now);
  EXPECT_EQ(compared.code, 0) << compared.out << compared.err;
  for (const char* spot : {"sphere", "ball"}) {
    const Outcome exported = tool("export --format csv --filter 'aabb(spot=" + std::string(spot) + ")' " + former);
    EXPECT_EQ(exported.code, 0) << exported.err;
    EXPECT_NE(exported.out.find("aabb(spot=sphere)"), std::string::npos) << exported.out;
  }
}

}  // namespace
}  // namespace clusterbench
