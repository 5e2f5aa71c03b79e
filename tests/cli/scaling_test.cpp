// Do whole runs cost more per light when there are more lights? Instructions under valgrind, which are the same in
// every run: loading or making the rig, assigning, truth, measures, writing. Skipped without valgrind.

#include <gtest/gtest.h>

#include <vector>

#include "cli/tool.h"
#include "places.h"

namespace clusterbench::test {
namespace {

// All that is measured but time.
std::string config_of(const std::string& scene) {
  return R"({"scenes": [)" + scene + R"(], "viewport": [640, 360],
    "grids": [
      {"kind": "frustum", "tiles": {"count": [16, 9]}, "slices": {"scheme": "exponential", "count": 12, "far": 300}},
      {"kind": "distance", "tiles": {"count": [16, 9]}, "slices": {"scheme": "exponential", "count": 12, "far": 300}},
      {"kind": "cascades", "levels": 3, "finest": 4}, {"kind": "world", "cells": [20, 6, 20]}],
    "assigners": ["bounds", "bounds-fast", "aabb", "aabb-fast", "sphere-refinement", "sphere-refinement-fast", "exact",
                  "exact-fast", "planes", "distance", "cascades", "world-grid"],
    "storages": ["packed", "fixed"], "precision": ["float32", {"packing": "half", "inflate": true}],
    "shading": {"samples": 500}, "lookup": {"samples": 500}, "stability": {"steps": 2}, "timing": {"measure": false}})";
}

// Instructions of the whole program; 0 where there is no valgrind that can run it.
double instructions(const Folder& folder, const std::string& arguments) {
  const std::string log = (folder / "log").string();
  const std::string command = "valgrind --tool=callgrind --callgrind-out-file=/dev/null " + test::program() + " " +
                              arguments + " >/dev/null 2>" + log;
  if (std::system(command.c_str()) != 0) return 0.0;
  const std::string text = file_text(log), label = "Collected : ";
  const std::size_t place = text.find(label);
  return place == std::string::npos ? 0.0 : std::stod(text.substr(place + label.size()));
}

// n, 2n and 4n lights: the second step has twice as many more lights as the first, and may cost twice as much.
void expect_linear(const std::vector<double>& counts) {
  if (counts.front() == 0.0) GTEST_SKIP() << "valgrind cannot run this build here";
  ASSERT_EQ(counts.size(), 3u);
  const double step = counts[1] - counts[0], next = counts[2] - counts[1];
  EXPECT_LE(next, 2.1 * step) << counts[0] << " " << counts[1] << " " << counts[2];
}

TEST(Scaling, a_whole_run_costs_as_much_per_light_whatever_their_number) {
  const Folder folder;
  std::vector<double> counts;
  for (const int lights : {400, 800, 1600}) {
    const auto config = folder.write(
        "c.json", config_of(R"({"rig": {"lights": )" + std::to_string(lights) + R"(, "range": 3, "spots": 0.1}})"));
    counts.push_back(instructions(folder, "run -q " + config.string() + " -o " + (folder / "out.json").string()));
  }
  expect_linear(counts);
}

TEST(Scaling, a_scene_file_costs_as_much_per_light_to_make_and_to_look_at_whatever_their_number) {
  const Folder folder;
  std::vector<double> made, seen;
  for (const char* lights : {"500", "1000", "2000"}) {
    const std::string file = (folder / "scene.glb").string();
    made.push_back(instructions(folder, std::string("scene generate hall-512 --lights ") + lights + " -o " + file));
    seen.push_back(instructions(folder, "scene info " + file));
  }
  expect_linear(made);
  expect_linear(seen);
}

}  // namespace
}  // namespace clusterbench::test
