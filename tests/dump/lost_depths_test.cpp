// How deep lost lights reach, and which of them rounding explains.

#include <gtest/gtest.h>

#include "dump/made_dump.h"

namespace clusterbench::dump {
namespace {

using namespace testing;

TEST(LostDepths, a_light_that_is_lost_within_rounding_is_told_apart) {
  Made one = made_frame();
  one.frame.lights.resize(1);
  one.frame.count_types();
  scene::WorldLight& light = one.frame.lights[0];
  // A ball in front of the camera that ends a hair beyond the end of slice 4.
  const float end = one.grid.screen().slices.boundaries[5];
  const Vec3d ahead = -glm::transpose(one.frame.view_space.rotation)[2];
  for (const auto& [beyond_m, wanted] : {std::pair(1e-7, "rounding"), std::pair(1e-2, "lost")}) {
    light.range_m = 1.0;
    light.position = one.frame.view_space.origin + (static_cast<double>(end) - 1.0 + beyond_m) * ahead;
    one.truth = measure::find_truth(one.frame, one.grid, 1).lists;
    const result::CheckedSet set = verdict_on(dump_of(one, changed(one.truth, [&](auto cell, auto of) -> Moved {
                                                        if (one.grid.cell_at(cell).z == 5) return std::nullopt;
                                                        return std::pair(cell, of);
                                                      })));
    EXPECT_EQ(set.verdict, wanted);
    ASSERT_FALSE(set.lost.empty());
    EXPECT_NEAR(set.lost[0].reach_mm, 1000.0 * beyond_m, 1e-6);
  }
}

// A spot that shines along slices, whose cone enters slice 5 with its side alone.
TEST(LostDepths, a_spot_reaches_in_by_the_side_of_its_cone_and_not_by_its_range) {
  Made one = made_frame();
  scene::WorldLight spot =
      *std::ranges::find_if(one.frame.lights, [](const auto& light) { return light.type == scene::LightType::spot; });
  const Mat3d to_world = glm::transpose(one.frame.view_space.rotation);
  const double end = one.grid.screen().slices.boundaries[5];
  spot.range_m = 1.0;
  spot.outer_cone_rad = 0.3;
  for (const auto& [side_m, wanted] : {std::pair(1e-8, "rounding"), std::pair(0.01, "lost")}) {
    // Its side towards the slice runs along the slice's boundary, this far behind it.
    spot.position = one.frame.view_space.origin + to_world * Vec3d(0.0, 0.0, -(end + side_m));
    spot.direction = to_world * Vec3d(std::cos(0.3), 0.0, std::sin(0.3));
    one.frame.lights = {spot};
    one.frame.count_types();
    one.truth = measure::find_truth(one.frame, one.grid, 1).lists;
    const result::CheckedSet set = verdict_on(dump_of(one, changed(one.truth, [&](auto cell, auto of) -> Moved {
                                                        if (one.grid.cell_at(cell).z == 5) return std::nullopt;
                                                        return std::pair(cell, of);
                                                      })));
    EXPECT_EQ(set.verdict, wanted) << side_m;
    ASSERT_FALSE(set.lost.empty());
    EXPECT_NEAR(set.lost[0].reach_mm, 1000.0 * side_m, 1e-3 + 10.0 * side_m) << side_m;
  }
}

TEST(LostDepths, no_dump_makes_a_deep_loss_one_of_rounding) {
  DumpFile dump = dump_of(made(), changed(made().truth, [](auto cell, auto light) -> Moved {
                            if (light == made().truth.lights[0]) return std::nullopt;
                            return std::pair(cell, light);
                          }));
  for (const double rounding : {32.0, 1048576.0}) {
    dump.record.rounding = rounding;
    const result::CheckedSet set = verdict_on(dump);
    EXPECT_EQ(set.verdict, "lost") << rounding;
    for (const result::LostInCell& lost : set.lost)
      EXPECT_EQ(lost.is_within_rounding && (lost.reach_mm > 100.0 || lost.reach_percent > 1.0), false) << lost.reach_mm;
  }
}

// The most that rounding may explain: of a light of 4 m it is 1 % of the range, of one of 40 m it is 0.1 m.
TEST(LostDepths, what_rounding_may_explain_has_two_bounds) {
  Made one = made_frame();
  one.frame.lights.resize(1);
  one.frame.count_types();
  const double end = one.grid.screen().slices.boundaries[5];
  const Vec3d ahead = -glm::transpose(one.frame.view_space.rotation)[2];
  for (const auto& [range_m, beyond_m, wanted] :
       {std::tuple(4.0, 0.039, "rounding"), std::tuple(4.0, 0.041, "lost"), std::tuple(40.0, 0.099, "rounding"),
        std::tuple(40.0, 0.101, "lost")}) {
    one.frame.lights[0].range_m = range_m;
    one.frame.lights[0].position = one.frame.view_space.origin + (end - range_m + beyond_m) * ahead;
    one.truth = measure::find_truth(one.frame, one.grid, 1).lists;
    DumpFile dump = dump_of(one, changed(one.truth, [&](auto cell, auto of) -> Moved {
                              if (one.grid.cell_at(cell).z == 5) return std::nullopt;
                              return std::pair(cell, of);
                            }));
    dump.record.rounding = 1048576.0;
    EXPECT_EQ(verdict_on(dump).verdict, wanted) << range_m << " " << beyond_m;
  }
}

// A dump in another unit: what is lost is told in metres.
TEST(LostDepths, lengths_of_a_dump_in_centimetres_are_told_in_metres) {
  Made scaled = made_frame();
  const auto lost_of = [](const Made& frame) {
    return changed(frame.truth, [&](auto cell, auto light) -> Moved {
      if (light == frame.truth.lights[0]) return std::nullopt;
      return std::pair(cell, light);
    });
  };
  const result::CheckedSet metres = verdict_on(dump_of(scaled, lost_of(scaled)));
  scaled.frame.view_space.origin *= 100.0;
  scaled.frame.projection.near_m *= 100.0;
  scaled.frame.projection.far_m *= 100.0;
  for (scene::WorldLight& light : scaled.frame.lights) light.position *= 100.0, light.range_m *= 100.0;
  for (float& end : std::get<grid::ScreenGrid>(scaled.grid.shape).slices.boundaries) end *= 100.0f;
  DumpFile dump = dump_of(scaled, lost_of(scaled));
  dump.record.metres_per_unit = 0.01;
  const result::CheckedSet centimetres = verdict_on(dump);
  ASSERT_EQ(centimetres.lost.size(), metres.lost.size());
  EXPECT_NEAR(centimetres.lost[0].reach_mm, metres.lost[0].reach_mm, 1e-3);
  EXPECT_NEAR(centimetres.lost[0].to_m, metres.lost[0].to_m, 1e-4);
  EXPECT_NEAR(centimetres.error->deepest_mm, metres.error->deepest_mm, 1e-3);
}

}  // namespace
}  // namespace clusterbench::dump
