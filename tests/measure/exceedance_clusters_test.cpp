#include "measure/statistics/exceedance_clusters.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/random.h"

namespace clusterbench::measure {
namespace {

std::vector<std::uint64_t> heights_of(const Clusters& clusters) {
  std::vector<std::uint64_t> out;
  for (const Peak& peak : clusters.peaks) out.push_back(peak.height);
  return out;
}

// Above 10 at 1, 2, 3, 20, 21, 40: distances 1, 1, 17, 1, 19. The estimator by hand: 2 (0 + 0 + 16 + 0 + 18)^2 /
// (5 (16 15 + 18 17)) = 2312 / 2730, so floor(5 x 0.847) = 4 distances lie between clusters, but of the equal ones
// none.
TEST(Clusters, are_parted_by_the_largest_distances) {
  std::vector<std::uint64_t> needs(50, 5);
  needs[1] = 11, needs[2] = 30, needs[3] = 12, needs[20] = 13, needs[21] = 13, needs[40] = 99;
  const PathNeeds path{needs, 1};
  const Clusters clusters = clusters_above({&path, 1}, 10);
  EXPECT_DOUBLE_EQ(clusters.extremal_index, 2312.0 / 2730.0);
  EXPECT_EQ(clusters.run, 1u);
  EXPECT_EQ(heights_of(clusters), (std::vector<std::uint64_t>{30, 13, 99}));
  EXPECT_EQ(clusters.peaks[0].entries_above, 3u);
  EXPECT_EQ(clusters.peaks[1].entries_above, 2u);
}

TEST(Clusters, do_not_reach_from_one_path_to_the_next) {
  const std::vector<std::uint64_t> first{1, 1, 1, 20}, second{30, 1, 1, 1};
  const std::array<PathNeeds, 2> paths{PathNeeds{first, 1}, PathNeeds{second, 8}};
  const Clusters clusters = clusters_above(paths, 10);
  EXPECT_EQ(heights_of(clusters), (std::vector<std::uint64_t>{20, 30}));
  EXPECT_TRUE(clusters.peaks[0].is_cut && clusters.peaks[1].is_cut);
  EXPECT_EQ(clusters.peaks[1].frames_above, 8u) << "an entry of eight frames";
}

TEST(Clusters, are_cut_off_only_where_the_path_ends_at_their_top) {
  const std::vector<std::uint64_t> falling{5, 9, 12, 11}, level{5, 9, 12, 12};
  const PathNeeds falls{falling, 1}, ends_level{level, 1};
  EXPECT_FALSE(clusters_above({&falls, 1}, 8).peaks[0].is_cut);
  EXPECT_FALSE(clusters_above({&ends_level, 1}, 8).peaks[0].is_cut) << "the top was reached before the end";
  EXPECT_TRUE(clusters_above({&falls, 1}, 11).peaks.empty() || !clusters_above({&falls, 1}, 11).peaks[0].is_cut);
}

TEST(Clusters, of_a_single_hill_are_one) {
  std::vector<std::uint64_t> needs;
  for (std::uint64_t i = 0; i < 100; ++i) needs.push_back(i < 50 ? i : 99 - i);
  const PathNeeds path{needs, 1};
  const Clusters hill = clusters_above({&path, 1}, 30);
  EXPECT_EQ(heights_of(hill), (std::vector<std::uint64_t>{49}));
  EXPECT_DOUBLE_EQ(hill.extremal_index, 1.0 / 38.0);
  needs[40] = 0;
  EXPECT_EQ(heights_of(clusters_above({&path, 1}, 30)), (std::vector<std::uint64_t>{49})) << "a gap of one frame";
}

TEST(Clusters, of_nothing_above_are_none) {
  const std::vector<std::uint64_t> needs{1, 2, 3};
  const PathNeeds path{needs, 1};
  EXPECT_TRUE(clusters_above({&path, 1}, 3).peaks.empty());
  EXPECT_TRUE(clusters_above({}, 3).peaks.empty());
}

// x = max((1 - index) x, index z), z of unit Frechet: its extremal index is known.
TEST(Clusters, have_the_known_extremal_index_of_moving_maxima) {
  for (const double index : {0.2, 0.5, 1.0}) {
    SplitMix64 random(3);
    std::vector<std::uint64_t> needs;
    double x = 1.0;
    for (int i = 0; i < 40000; ++i) {
      x = std::max((1.0 - index) * x, index / -std::log1p(-random.unit()));
      needs.push_back(static_cast<std::uint64_t>(100.0 * x));
    }
    const PathNeeds path{needs, 1};
    const Clusters clusters = clusters_above({&path, 1}, 5000);  // one of 50 frames is above
    EXPECT_NEAR(clusters.extremal_index, index, 0.08);
    double above = 0.0;
    for (const Peak& peak : clusters.peaks) above += static_cast<double>(peak.entries_above);
    EXPECT_NEAR(static_cast<double>(clusters.peaks.size()) / above, index, 0.1);
  }
}

}  // namespace
}  // namespace clusterbench::measure
