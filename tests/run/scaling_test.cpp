// Does what a method does grow with its work, and no faster? Counted in its light-cell tests, which are exact.

#include <gtest/gtest.h>

#include <map>

#include "core/text.h"
#include "run/cases/case_names.h"
#include "run/cases/plan.h"
#include "run/runner.h"

namespace clusterbench::run {
namespace {

Result counted(const std::string& text) {
  const config::Config config = config::parse_config(
      R"({"shading": {"samples": 0}, "accuracy": {"check": false}, "timing": {"measure": false}, )" + text, "c.json");
  const std::atomic<bool> stop{false};
  return run_plan(config, make_plan(config, ""), {}, {}, stop);
}

double work_of(const CaseResult& case_result, double lights) {
  double cells = 1.0;
  for (const nlohmann::json& along : case_result.grid["cells"]) cells *= along.get<double>();
  return lights + cells + (case_result.occupancy ? case_result.occupancy->pairs.mean : 0.0);
}

// Method and grid kind -> tests per unit of work, small before large.
using Curves = std::map<std::string, std::vector<double>>;

Curves curves_of(const Result& result) {
  std::map<std::string, double> lights;
  for (const SceneResult& scene : result.scenes) lights[scene.name] = scene.points + scene.spots;
  Curves curves;
  for (const CaseResult& case_result : result.cases)
    curves[case_result.assigner_label + (case_result.storage_label == k_own_structure ? " asked by samples" : "") +
           " on " + case_result.grid["kind"].get<std::string>()]
        .push_back(static_cast<double>(case_result.tests_done) / work_of(case_result, lights[case_result.scene]));
  return curves;
}

void expect_bounded(const Curves& curves, std::size_t sizes) {
  EXPECT_GE(curves.size(), 12u);
  for (const auto& [name, costs] : curves) {
    ASSERT_EQ(costs.size(), sizes) << name;
    EXPECT_LE(costs.back(), 1.5 * costs[sizes - 2] + 0.5) << name;
  }
}

constexpr const char* k_grids = R"("grids": [
    {"kind": "frustum", "tiles": {"count": [16, 9]}, "slices": {"scheme": "exponential", "count": 12, "far": 300}},
    {"kind": "distance", "tiles": {"count": [16, 9]}, "slices": {"scheme": "exponential", "count": 12, "far": 300}},
    {"kind": "cascades", "levels": 3, "finest": 4}, {"kind": "world", "cells": [20, 6, 20]}])";

TEST(Scaling, tests_per_light_stay_bounded_from_rig_to_rig) {
  const Result result = counted(R"("scenes": [{"rig": {"lights": [500, 2000, 8000], "range": 4, "spots": 0.1}}], )" +
                                std::string(k_grids) + "}");
  Curves curves = curves_of(result);
  EXPECT_EQ(curves.erase("brute-force on frustum"), 1u);
  expect_bounded(curves, 3);
}

std::string screen_grids(const char* kind) {
  std::string grids;
  for (const char* size : {R"([4, 2]}, "slices": {"count": 4)", R"([16, 8]}, "slices": {"count": 16)",
                           R"([64, 32]}, "slices": {"count": 64)"})
    grids += std::string(R"({"kind": ")") + kind + R"(", "tiles": {"count": )" + size +
             R"(, "scheme": "exponential", "far": 300}}, )";
  return grids;
}

TEST(Scaling, tests_per_cell_and_pair_stay_bounded_from_grid_to_grid) {
  const Result result = counted(R"("scenes": [{"rig": {"lights": 200, "range": 7, "spots": 0.1}}], "grids": [)" +
                                screen_grids("frustum") + screen_grids("distance") +
                                R"({"kind": "cascades", "levels": 3, "cells": [8, 8, 8], "finest": 4},
                                   {"kind": "cascades", "levels": 3, "cells": [16, 16, 16], "finest": 2},
                                   {"kind": "cascades", "levels": 3, "cells": [32, 32, 32], "finest": 1},
                                   {"kind": "world", "cells": [[5, 2, 5], [20, 6, 20], [80, 24, 80]]}]})");
  Curves curves = curves_of(result);
  const std::vector<double> brute = curves.at("brute-force on frustum");
  EXPECT_GT(brute[2], 1.5 * brute[1] + 0.5) << "this measure would not see a product of lights and cells";
  curves.erase("brute-force on frustum");
  EXPECT_EQ(curves.erase("bvh asked by samples on frustum"), 1u) << "is measured on one grid";
  expect_bounded(curves, 3);
}

}  // namespace
}  // namespace clusterbench::run
