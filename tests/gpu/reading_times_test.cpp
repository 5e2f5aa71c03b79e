// Readings that take turns, the order of invocations, and constants of the cost model. No test asserts a time.

#include <gtest/gtest.h>

#include <set>

#include "core/random.h"
#include "gpu/device/span_length.h"
#include "gpu/reading/cost_fit.h"
#include "gpu/reading/reading.h"
#include "gpu/reading_scenes.h"

namespace clusterbench::gpu {
namespace {

using assign::testing::Setting;

// --- Spans ---

TEST(ReadingSpans, last_a_thousand_periods_of_the_clock) {
  EXPECT_EQ(repeats_for(50'000.0, 1.0, 1e8), 1u);   // NVIDIA, lavapipe: 1 ns
  EXPECT_EQ(repeats_for(5'000.0, 1.0, 1e8), 4u);    // at least 20 us
  EXPECT_EQ(repeats_for(40'000.0, 83.0, 1e8), 3u);  // Intel: 83 ns
  EXPECT_EQ(repeats_for(83'000.0, 83.0, 1e8), 1u);
  EXPECT_EQ(repeats_for(0.0, 10.0, 1e8), 2000u);  // shorter than a period
  EXPECT_EQ(repeats_for(4e6, 1e6, 1e8), 25u);     // as many as a submission may hold
  EXPECT_EQ(repeats_for(1e9, 1e6, 1e8), 1u);
  EXPECT_EQ(repeats_for(100.0, 0.0, 1e8), 200u);
}

TEST(DeviceReadingSpans, of_a_device_take_turns_and_keep_every_round) {
  if (const std::string obstacle = device_obstacle(); !obstacle.empty()) GTEST_SKIP() << "skipped: " << obstacle;
  const assign::AssignerDescriptor& row = testing::method_named("exact");
  const Setting setting = assign::testing::settings_for(row, 11).front();
  const testing::Picture picture(setting.frame, 16, 3);
  ReadingSamples samples(picture.samples, in_pixel_blocks(picture.image), setting.grid);
  const testing::Held packed = testing::stored(row, {"packed", {}}, setting);
  const testing::Held bits = testing::stored(testing::method_named("bounds"), {"packed", {}}, setting);
  ReadingStructure exact(packed.structure(), setting.grid, packed.lights);
  ReadingStructure loose(bits.structure(), setting.grid, bits.lights);
  const std::vector<ReadingTask> tasks{{&loose, Walking::by_lane, ReadingOutput::lights},
                                       {&loose, Walking::by_light, ReadingOutput::lights},
                                       {&exact, Walking::by_lane, ReadingOutput::lights},
                                       {&loose, Walking::by_lane, ReadingOutput::nothing},
                                       {&loose, Walking::by_lane, ReadingOutput::write_only}};
  ReadingPlan plan;
  plan.rounds = 3;
  plan.flushed_bytes = plan.flushed_bytes_of_software = 1 << 20;
  const std::vector<ReadingTimes> times = read_in_turns(tasks, samples, plan);
  ASSERT_EQ(times.size(), tasks.size());
  const std::size_t spans = device().facts().timestamp_bits > 0 ? 3 : 0;
  for (const ReadingTimes& one : times) {
    EXPECT_EQ(one.warm_ns.size(), spans);
    EXPECT_EQ(one.cold_ns.size(), spans);
    EXPECT_EQ(one.is_software, device().facts().is_software());
    EXPECT_GE(one.repeats, 1u);
    for (const double ns : one.warm_ns) EXPECT_GT(ns, 0.0);
    for (const double ns : one.cold_ns) EXPECT_GT(ns, 0.0);
  }
  plan.longest_submit_ns = 1.0;  // each span in a submission of its own
  EXPECT_EQ(read_in_turns(tasks, samples, plan).back().warm_ns.size(), spans);
}

TEST(ReadingTimes, have_the_median_of_all_rounds) {
  ReadingTimes times;
  EXPECT_EQ(times.warm_median_ns(), 0.0);
  times.warm_ns = {5, 1, 100};
  times.cold_ns = {4, 1, 2, 100};
  EXPECT_EQ(times.warm_median_ns(), 5.0);
  EXPECT_EQ(times.cold_median_ns(), 3.0);
}

// --- The order of invocations ---

TEST(ReadingOrder, of_a_picture_has_each_surface_once_in_blocks_of_8_by_8) {
  view::Frame frame;
  frame.viewport = {21, 10};
  depth::DepthImage image{{frame.viewport, 1}, std::vector<float>(210, 1.0f)};
  image.nearest[22] = std::numeric_limits<float>::infinity();  // (1, 1)
  const WaveOrder order = in_pixel_blocks(image);
  ASSERT_EQ(order.size(), 3u * 2u * 64u);
  // The first pixels two by two: (0, 0) (1, 0) (0, 1) (1, 1), then (2, 0).
  EXPECT_EQ(order[0], 0u);
  EXPECT_EQ(order[1], 1u);
  EXPECT_EQ(order[2], 21u);
  EXPECT_EQ(order[3], k_idle);
  EXPECT_EQ(order[4], 2u);
  EXPECT_EQ(order[64], 8u);                  // the next block
  EXPECT_EQ(order[63], 7u + 7u * 21u - 1u);  // one pixel before it has no surface
  std::multiset<std::uint32_t> seen;
  for (const std::uint32_t sample : order)
    if (sample != k_idle) seen.insert(sample);
  ASSERT_EQ(seen.size(), 209u);
  for (std::uint32_t sample = 0; sample < 209; ++sample) EXPECT_EQ(seen.count(sample), 1u);
}

// --- Constants of the cost model ---

ReadingWork work(std::uint64_t lights, std::uint64_t reads, std::uint64_t read_bytes, double divergence) {
  return {1000, lights, reads, read_bytes, divergence};
}

std::vector<CostObservation> observations(double ns_per_light, double ns_per_read, double ns_per_byte, double noise) {
  SplitMix64 random(4);
  std::vector<CostObservation> all;
  for (int i = 0; i < 40; ++i) {
    const std::uint64_t lights = 1000 + random.below(1u << (10 + i % 12)),
                        reads = lights / 4 + random.below(3 * lights);
    const ReadingWork one = work(lights, reads, reads * (1 + random.below(16)), 1.0 + random.unit());
    const double ns = one.divergence *
                      (static_cast<double>(one.lights) * ns_per_light + static_cast<double>(one.reads) * ns_per_read +
                       static_cast<double>(one.read_bytes) * ns_per_byte);
    all.push_back({ns * (1.0 + noise * (2.0 * random.unit() - 1.0)), one});
  }
  return all;
}

TEST(CostFit, finds_the_constants_that_times_were_made_of) {
  const CostFit fit = fit_cost(observations(0.02, 0.005, 1.0 / 2283.0, 0.0));
  EXPECT_NEAR(fit.ns_per_light.value, 0.02, 1e-9);
  EXPECT_NEAR(fit.ns_per_read.value, 0.005, 1e-9);
  EXPECT_NEAR(fit.read_gb_per_s(), 2283.0, 1e-3);
  EXPECT_TRUE(fit.is_determined());
  EXPECT_LT(fit.residual_rms, 1e-9);
}

TEST(CostFit, is_near_them_with_noise_and_says_how_far_off_the_times_are) {
  const CostFit fit = fit_cost(observations(0.02, 0.005, 1.0 / 200.0, 0.05));
  EXPECT_NEAR(fit.ns_per_light.value, 0.02, 0.004);
  EXPECT_NEAR(fit.ns_per_read.value, 0.005, 0.004);
  EXPECT_NEAR(fit.read_gb_per_s(), 200.0, 40.0);
  EXPECT_GT(fit.residual_rms, 0.01);
  EXPECT_LT(fit.residual_rms, 0.05);
  ASSERT_EQ(fit.residuals.size(), 40u);
}

TEST(CostFit, gives_no_negative_constant) {
  std::vector<CostObservation> all = observations(0.02, 0.0, 0.0, 0.0);
  for (CostObservation& one : all) one.ns -= 1e-4 * static_cast<double>(one.work.read_bytes) * one.work.divergence;
  const CostFit fit = fit_cost(all);
  EXPECT_GT(fit.ns_per_light.value, 0.0);
  EXPECT_EQ(fit.ns_per_byte.value, 0.0);
  EXPECT_EQ(fit.read_gb_per_s(), std::numeric_limits<double>::infinity());
  EXPECT_GE(fit.ns_per_read.value, 0.0);
}

TEST(CostFit, says_where_observations_do_not_tell_constants_apart) {
  std::vector<CostObservation> all;  // one index of 2 bytes for each light
  for (const std::uint64_t lights : {1000u, 2000u, 5000u, 70000u})
    all.push_back({static_cast<double>(lights), work(lights, lights, 2 * lights, 1.0)});
  const CostFit fit = fit_cost(all);
  EXPECT_FALSE(fit.is_determined());
  EXPECT_FALSE(fit.ns_per_light.is_determined());
  EXPECT_LT(fit.residual_rms, 1e-9);
  EXPECT_FALSE(fit_cost({}).is_determined());
  EXPECT_FALSE(fit_cost(std::span(all).first(1)).is_determined());
}

TEST(ReadingWork, is_what_the_structure_says_and_waves_wait_for_their_longest_list) {
  if (const std::string obstacle = device_obstacle(); !obstacle.empty()) GTEST_SKIP() << "skipped: " << obstacle;
  const assign::AssignerDescriptor& row = testing::method_named("exact");
  const Setting setting = assign::testing::settings_for(row, 11).front();
  const testing::Held held = testing::stored(row, {"packed", {}}, setting);
  const testing::Picture picture(setting.frame, 16, 3);
  const ReadingSamples samples(picture.samples, in_pixel_blocks(picture.image), setting.grid);
  std::uint64_t lights = 0;
  assign::Reads reads;
  std::vector<std::uint32_t> list;
  for (const grid::Sample& sample : picture.samples) {
    held.structure().lights_at(sample, grid::Log2::rounded, list);
    lights += list.size();
    reads += held.structure().reads_at(sample, grid::Log2::rounded);
  }
  const ReadingWork alone = work_of(held.structure(), samples, 1), in_waves = work_of(held.structure(), samples, 32);
  for (const ReadingWork& one : {alone, in_waves}) {
    EXPECT_EQ(one.samples, picture.samples.size());
    EXPECT_EQ(one.lights, lights);
    EXPECT_EQ(one.reads, reads.elements);
    EXPECT_EQ(one.read_bytes, reads.bytes);
  }
  EXPECT_EQ(alone.divergence, 1.0);
  EXPECT_GT(in_waves.divergence, 1.0);
}

}  // namespace
}  // namespace clusterbench::gpu
