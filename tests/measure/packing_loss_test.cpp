#include "measure/samples/packing_loss.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "assign/dense_check.h"

namespace clusterbench::measure {
namespace {

using assign::testing::frame_of;
using assign::testing::perspective;
using assign::testing::point_light;
using assign::testing::spot_light;

constexpr double k_endless = std::numeric_limits<double>::infinity();

view::Frame frame_of_rig(const std::vector<scene::WorldLight>& lights) {
  return frame_of(perspective(1.0, 1.0, 0.1, 100), {64, 64}, lights);
}

TEST(PackingLoss, is_what_the_formats_definition_says) {
  // Near 1000 halves stand 0.5 apart, near 2000 1 apart.
  const view::Frame frame = frame_of_rig({point_light({1000.125, 0, 0}, 8), point_light({0, 1000.25, 2000}, 2000.25)});
  PackingLossMeter meter;
  meter.add_frame(view::packed(view::lights_in(frame, {}), view::Packing::half));
  const PackingLoss loss = meter.result();
  EXPECT_DOUBLE_EQ(loss.position_error_m.mean, 0.5 * (0.125 + 0.25));
  EXPECT_DOUBLE_EQ(loss.position_error_m.max, 0.25);
  EXPECT_DOUBLE_EQ(loss.range_error_m.mean, 0.5 * 0.75);
  EXPECT_DOUBLE_EQ(loss.range_error_m.max, 0.75);
  EXPECT_TRUE(std::isnan(loss.axis_error_rad.mean)) << "no spot";
  EXPECT_NEAR(loss.safe_inflation_m.max, std::hypot(0.25, 0.5), 1e-3);
  EXPECT_NEAR(loss.safe_inflation_m.mean, 0.5 * (0.25 + std::hypot(0.25, 0.5)), 1e-3);
  EXPECT_EQ(loss.unrepresentable_frames, 0);
}

TEST(PackingLoss, of_spots_is_their_axis_and_angle_too) {
  const double angle = 0.5 + 0x1p-13;  // halves stand 2^-11 apart
  const view::Frame frame = frame_of_rig({spot_light({0, 0, 0}, 64, {0, 0, -1}, angle)});
  PackingLossMeter meter;
  meter.add_frame(view::packed(view::lights_in(frame, {}), view::Packing::half));
  const PackingLoss loss = meter.result();
  EXPECT_NEAR(loss.angle_error_rad.max, 0x1p-13, 1e-7);
  EXPECT_EQ(loss.axis_error_rad.max, 0.0);
  EXPECT_NEAR(loss.safe_inflation_m.max, 64 * (0x1p-12 + 0x1p-11), 1e-3) << "of angle and axis, at the range's end";
}

TEST(PackingLoss, of_float32_is_its_rounding_and_needs_no_inflation) {
  const view::Frame frame = frame_of_rig({point_light({1000.1, 0, 0}, 0.1), point_light({0, 0, 0}, k_endless)});
  PackingLossMeter meter;
  meter.add_frame(view::packed(view::lights_in(frame, {}), view::Packing::float32));
  const PackingLoss loss = meter.result();
  EXPECT_GT(loss.position_error_m.max, 0.0);
  EXPECT_LE(loss.position_error_m.max, 0x1p-15);
  EXPECT_LE(loss.range_error_m.max, 0x1p-26);
  EXPECT_EQ(loss.safe_inflation_m.max, 0.0);
}

TEST(PackingLoss, of_lights_that_the_format_does_not_hold_is_counted_apart) {
  const view::Frame one = frame_of_rig({point_light({7e4, 0, 0}, 8), point_light({1, 0, 0}, 8)});
  const view::Frame two =
      frame_of_rig({point_light({7e4, 0, 0}, 8), point_light({1, 0, 0}, 7e4), point_light({1000.125, 0, 0}, 8)});
  const view::Frame none = frame_of_rig({point_light({1, 0, 0}, 8)});
  PackingLossMeter meter;
  for (const view::Frame* frame : {&one, &two, &none, &one})
    meter.add_frame(view::packed(view::lights_in(*frame, {}), view::Packing::half));
  const PackingLoss loss = meter.result();
  EXPECT_EQ(loss.unrepresentable_lights, 2u);
  EXPECT_EQ(loss.unrepresentable_frames, 3);
  EXPECT_DOUBLE_EQ(loss.position_error_m.mean, 0.125 / 4) << "over the four lights that are held";
}

}  // namespace
}  // namespace clusterbench::measure
