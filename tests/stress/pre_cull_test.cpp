// What the camera's planes and a distance remove, against the exact truth and the count of lights in view: on the hard
// cases for numerical stability and on random settings, half of whose lights are laid against a cell.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "cull/pre_cull.h"
#include "cull/view_planes.h"
#include "grid/lights_in_view.h"
#include "measure/truth/truth.h"
#include "stress/hard_cases.h"
#include "stress/random_setting.h"

namespace clusterbench::stress {
namespace {

struct Found {
  std::uint64_t settings = 0, with_cells_beside_the_view = 0, lights = 0, removed_by_planes = 0,
                removed_by_distance = 0, true_pairs = 0;
};

std::uint64_t lost_pairs(const measure::Truth& truth, const cull::FrameCull& culled) {
  return static_cast<std::uint64_t>(std::ranges::count_if(
      truth.lists.lights, [&](std::uint32_t light) { return !std::ranges::binary_search(culled.kept, light); }));
}

// Adds a trial whose grid ends with the picture; others promise nothing.
void hold_against_truth(const Trial& trial, Found& found) {
  if (!trial.grid.has_tiles() || trial.is_refused) return;
  try {
    const view::Frame frame = frame_of(trial);
    const grid::Grid grid = grid_of(trial, frame);
    const view::LightArrays lights = view::lights_in(frame, grid::space_of(grid, frame));
    const measure::Truth truth = measure::find_truth(frame, grid, 1);
    const cull::PreCull by_planes({{cull::FrustumStep{}}}, {}),
        by_distance({{cull::DistanceStep{cull::farthest_of_cells(grid)}}}, {});
    cull::FrameCull culled;
    by_planes.cull(frame, grid, lights, culled);
    if (by_planes.is_conservative(frame, grid, lights, culled)) {
      EXPECT_EQ(lost_pairs(truth, culled), 0u) << trial.label;
    } else {
      ++found.with_cells_beside_the_view;
    }
    for (std::uint32_t light = 0; light < lights.size(); ++light)
      EXPECT_TRUE(std::ranges::binary_search(culled.kept, light) || !grid::is_in_view(frame, frame.lights[light]))
          << trial.label << ": light " << light << " is in view, and removed";
    found.removed_by_planes += culled.removed[0];
    by_distance.cull(frame, grid, lights, culled);
    ASSERT_TRUE(by_distance.is_conservative(frame, grid, lights, culled));
    EXPECT_EQ(lost_pairs(truth, culled), 0u) << trial.label;
    found.removed_by_distance += culled.removed[0];
    ++found.settings;
    found.lights += lights.size();
    found.true_pairs += truth.lists.pair_count();
  } catch (const Error&) {  // a grid that cannot be for this camera
  }
}

TEST(PreCullAgainstTruth, loses_no_pair_on_the_hard_cases) {
  Found found;
  for (const HardCase& hard : hard_cases())
    if (hard.trials != nullptr)
      for (const Trial& trial : hard.trials(1)) hold_against_truth(trial, found);
  EXPECT_GT(found.settings, 100u);
  EXPECT_GT(found.true_pairs, 1000u);
  EXPECT_GT(found.removed_by_planes, 100u);
}

TEST(PreCullAgainstTruth, loses_no_pair_in_random_settings) {
  Found found;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const Trial trial = random_setting(seed);
    if (!has_boxes(trial)) hold_against_truth(trial, found);  // pre-culls take points and spots
  }
  EXPECT_GT(found.settings, 100u);
  EXPECT_LT(found.with_cells_beside_the_view, found.settings / 2);
  EXPECT_GT(found.removed_by_planes, 100u);
  EXPECT_GT(found.removed_by_distance, 10u);
}

}  // namespace
}  // namespace clusterbench::stress
