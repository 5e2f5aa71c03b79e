// Every file of the scene library loads or is refused in one line; what loads agrees with the reference reports except
// where corpus_disagreements.md says why not.

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/error.h"
#include "places.h"
#include "scene/scene.h"

namespace clusterbench::scene {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

const std::string k_validator = "gltf-validator-corpus/test/";
const std::string k_magnum = "magnum-tests/src/MagnumPlugins/GltfImporter/Test/";

struct Row {
  std::string here, reference, why;
};

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line.substr(1));
  for (std::string cell; std::getline(in, cell, '|');) {
    const std::size_t first = cell.find_first_not_of(' '), last = cell.find_last_not_of(' ');
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
  }
  return cells;
}

// Rows "| `file` | here | reference | why |"; the second table of the page lists magnum-tests.
std::map<std::string, Row> disagreements() {
  std::ifstream in(fs::path(clusterbench::test::source_dir()) / "tests/scene/corpus_disagreements.md");
  std::map<std::string, Row> rows;
  std::string folder = k_validator;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("## Files of magnum-tests")) folder = k_magnum;
    if (!line.starts_with("| `")) continue;
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() < 4) continue;
    rows[folder + cells[0].substr(1, cells[0].size() - 2)] = {cells[1], cells[2], cells[3]};
  }
  return rows;
}

struct Outcome {
  bool loads = false;
  std::string where, message;
};

Outcome outcome_of(const fs::path& path) {
  try {
    Scene scene = load_gltf(path);
    resolve_ranges(scene, RangeRule{});
    world_lights(scene, scene.duration_s / 2.0);
    for (const Camera& camera : scene.cameras) camera_pose(scene, camera, scene.duration_s / 2.0);
    return {true, "", ""};
  } catch (const Error& error) {
    EXPECT_EQ(error.file(), path.string());
    return {false, error.where(), error.message()};
  }
}

class Corpus : public testing::Test {
 protected:
  // The library is read once for all tests.
  static void SetUpTestSuite() {
    const char* folder = std::getenv("CLUSTERBENCH_SCENE_LIBRARY");
    if (folder == nullptr) return;
    library_ = folder;
    std::ifstream in(library_ / "INDEX.json");
    for (const json& entry : json::parse(in)) {
      const std::string file = entry["file"].get<std::string>();
      outcomes_[file] = outcome_of(library_ / file);
    }
  }

  void SetUp() override {
    if (library_.empty()) GTEST_SKIP() << "CLUSTERBENCH_SCENE_LIBRARY does not name the scene library";
  }

  bool reference_is_clean(const std::string& file) const {
    std::ifstream in(library_ / (file + ".report.json"));
    return json::parse(in)["issues"]["numErrors"].get<int>() == 0;
  }

  static inline fs::path library_;
  static inline std::map<std::string, Outcome> outcomes_;
};

TEST_F(Corpus, every_file_loads_or_is_refused_in_one_line_that_names_a_place) {
  EXPECT_GE(outcomes_.size(), 574U);
  for (const auto& [file, outcome] : outcomes_) {
    if (outcome.loads) continue;
    EXPECT_FALSE(outcome.where.empty()) << file;
    EXPECT_FALSE(outcome.message.empty()) << file;
    EXPECT_EQ((outcome.where + outcome.message).find('\n'), std::string::npos) << file;
  }
}

TEST_F(Corpus, every_file_of_a_real_scene_loads) {
  for (const auto& [file, outcome] : outcomes_) {
    if (file.starts_with(k_validator) || file.starts_with(k_magnum)) continue;
    EXPECT_TRUE(outcome.loads) << file << ": " << outcome.where << ": " << outcome.message;
  }
}

TEST_F(Corpus, the_validator_reports_and_the_loader_agree_except_where_the_table_says_why) {
  const std::map<std::string, Row> rows = disagreements();
  int compared = 0;
  for (const auto& [file, outcome] : outcomes_) {
    if (!file.starts_with(k_validator)) continue;
    ++compared;
    const bool agrees = outcome.loads == reference_is_clean(file);
    const auto row = rows.find(file);
    EXPECT_EQ(agrees, row == rows.end()) << file << (agrees ? ": the table's row is stale" : ": is not in the table")
                                         << " (" << (outcome.loads ? "loads" : outcome.where + ": " + outcome.message)
                                         << ")";
    if (row != rows.end()) {
      EXPECT_EQ(row->second.here, outcome.loads ? "loads" : "refused") << file;
    }
  }
  EXPECT_GE(compared, 262);
}

TEST_F(Corpus, of_the_magnum_tests_exactly_those_in_the_table_are_refused_at_the_place_it_names) {
  const std::map<std::string, Row> rows = disagreements();
  for (const auto& [file, outcome] : outcomes_) {
    if (!file.starts_with(k_magnum)) continue;
    const auto row = rows.find(file);
    EXPECT_EQ(outcome.loads, row == rows.end()) << file << ": " << outcome.where << ": " << outcome.message;
    if (row != rows.end()) {
      EXPECT_EQ(row->second.reference, outcome.where) << file;
    }
  }
}

TEST_F(Corpus, every_row_of_the_table_names_a_file_that_exists_and_gives_a_reason) {
  for (const auto& [file, row] : disagreements()) {
    EXPECT_TRUE(outcomes_.contains(file)) << file;
    EXPECT_FALSE(row.why.empty()) << file;
  }
}

}  // namespace
}  // namespace clusterbench::scene
