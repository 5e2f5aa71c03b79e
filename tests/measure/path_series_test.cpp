#include "measure/lists/path_series.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace clusterbench::measure {
namespace {

PathSeries series_of(const std::vector<std::uint64_t>& values) {
  PathSeries series;
  for (const std::uint64_t value : values) series.add_frame(value);
  return series;
}

TEST(PathSeries, a_path_of_some_hundred_frames_is_kept_frame_by_frame) {
  std::vector<std::uint64_t> values(PathSeries::k_most_entries);
  std::iota(values.begin(), values.end(), 7);
  const PathSeries series = series_of(values);
  EXPECT_EQ(series.frames_per_entry(), 1u);
  EXPECT_EQ(series.entries(), values);
}

TEST(PathSeries, of_a_longer_path_each_entry_is_the_largest_of_its_frames) {
  std::vector<std::uint64_t> values(3 * PathSeries::k_most_entries + 5);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = i * 2654435761u % 1000;
  const PathSeries series = series_of(values);
  ASSERT_EQ(series.frames_per_entry(), 4u);
  ASSERT_EQ(series.entries().size(), (values.size() + 3) / 4);
  for (std::size_t i = 0; i < series.entries().size(); ++i) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(4 * i);
    const auto last = values.begin() + static_cast<std::ptrdiff_t>(std::min(values.size(), 4 * i + 4));
    EXPECT_EQ(series.entries()[i], *std::max_element(first, last)) << i;
  }
}

TEST(PathSeries, one_frame_more_than_fits_starts_an_entry_of_its_own) {
  std::vector<std::uint64_t> values(PathSeries::k_most_entries, 9);
  values.push_back(3);
  const PathSeries series = series_of(values);
  EXPECT_EQ(series.frames_per_entry(), 2u);
  ASSERT_EQ(series.entries().size(), PathSeries::k_most_entries / 2 + 1);
  EXPECT_EQ(series.entries().back(), 3u);
}

}  // namespace
}  // namespace clusterbench::measure
