// Waves of pixels against counts by hand.

#include "measure/samples/coherence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "measure/samples/samples.h"

namespace clusterbench::measure {
namespace {

// Lights 0 .. n - 1 at a sample n pixels from the left, in the upper half of the picture; none below.
class Stairs final : public assign::LightStructure {
 public:
  bool lights_at(const grid::Sample& sample, grid::Log2, std::vector<std::uint32_t>& out) const override {
    out.clear();
    const int length = sample.pixel_y < 4.0f ? static_cast<int>(sample.pixel_x) : 0;
    for (int light = 0; light < length; ++light) out.push_back(static_cast<std::uint32_t>(light));
    return true;
  }
  assign::Reads reads_at(const grid::Sample&, grid::Log2) const override { return {}; }
  assign::StructureUse use() const override { return {}; }
  assign::StructureLimit limit() const override { return {}; }
  std::vector<assign::BufferNeed> buffers() const override { return {}; }
  std::uint32_t index_bits() const override { return 32; }
  bool has_cells() const override { return false; }
  void expand(assign::Lists&) const override {}
};

view::Frame frame_of(Vec2i viewport) {
  view::Frame frame;
  frame.viewport = viewport;
  return frame;
}

Coherence of(Vec2i viewport, std::vector<float> depths = {}) {
  const view::Frame frame = frame_of(viewport);
  depth::DepthImage image{depth::PixelGrid(viewport, 1), std::move(depths)};
  if (image.nearest.empty()) image.nearest.assign(image.pixels.count(), 3.0f);
  Coherence coherence;
  add_frame(coherence, image, opaque_samples(frame, image), Stairs());
  return coherence;
}

TEST(Coherence, lanes_wait_for_the_longest_list_of_their_wave) {
  const auto [half, whole] = of({8, 8}).sizes;
  EXPECT_EQ(half.lanes(), 32);
  EXPECT_EQ(half.waves, 2u);
  EXPECT_EQ(half.distinct_lists, 8u + 1u);
  EXPECT_EQ(half.longest, 7u);  // 0, 1 .. 7 lights, and none
  EXPECT_EQ(half.united, 7u);
  EXPECT_DOUBLE_EQ(half.mean, 3.5);
  EXPECT_DOUBLE_EQ(half.divergence(), 2.0);
  EXPECT_EQ(whole.lanes(), 64);
  EXPECT_EQ(whole.waves, 1u);
  EXPECT_EQ(whole.most_distinct, 8u);
  EXPECT_DOUBLE_EQ(whole.mean, 1.75);
  EXPECT_DOUBLE_EQ(whole.divergence(), 4.0);
  EXPECT_DOUBLE_EQ(whole.scalarised(), 4.0);
}

TEST(Coherence, waves_beyond_the_picture_and_lanes_in_the_sky_do_not_count) {
  const auto [half, whole] = of({9, 4}).sizes;
  EXPECT_EQ(half.waves, 2u);
  EXPECT_EQ(whole.waves, 2u);
  EXPECT_EQ(whole.longest, 7u + 8u);
  std::vector<float> sky(64, std::numeric_limits<float>::infinity());
  sky[5] = 2.0f;
  const auto [one, same] = of({8, 8}, sky).sizes;
  EXPECT_EQ(one.waves, 1u);
  EXPECT_DOUBLE_EQ(same.mean, 5.0);
  EXPECT_DOUBLE_EQ(same.divergence(), 1.0);
}

TEST(Coherence, lists_of_other_lights_are_united) {
  // Each pixel has a light of its own.
  class Own final : public assign::LightStructure {
   public:
    bool lights_at(const grid::Sample& sample, grid::Log2, std::vector<std::uint32_t>& out) const override {
      out.assign(1, static_cast<std::uint32_t>(sample.pixel_y) * 8 + static_cast<std::uint32_t>(sample.pixel_x));
      return true;
    }
    assign::Reads reads_at(const grid::Sample&, grid::Log2) const override { return {}; }
    assign::StructureUse use() const override { return {}; }
    assign::StructureLimit limit() const override { return {}; }
    std::vector<assign::BufferNeed> buffers() const override { return {}; }
    std::uint32_t index_bits() const override { return 32; }
    bool has_cells() const override { return false; }
    void expand(assign::Lists&) const override {}
  };
  const view::Frame frame = frame_of({8, 8});
  const depth::DepthImage image{depth::PixelGrid(frame.viewport, 1), std::vector<float>(64, 3.0f)};
  Coherence coherence;
  add_frame(coherence, image, opaque_samples(frame, image), Own());
  EXPECT_EQ(coherence.sizes[1].united, 64u);
  EXPECT_EQ(coherence.sizes[1].distinct_lists, 64u);
  EXPECT_DOUBLE_EQ(coherence.sizes[1].divergence(), 1.0);
  EXPECT_DOUBLE_EQ(coherence.sizes[1].scalarised(), 64.0);
}

TEST(Coherence, where_nothing_is_seen_there_is_none) {
  EXPECT_TRUE(
      std::isnan(of({8, 8}, std::vector<float>(64, std::numeric_limits<float>::infinity())).sizes[0].divergence()));
}

}  // namespace
}  // namespace clusterbench::measure
