// What the SIMD conversions of lists and the row builders give is what plain loops give, on every instruction set.

#include "assign/storages/list_encodings.h"

#include <gtest/gtest.h>

#include <array>
#include <numeric>

#include "assign/each_target.h"
#include "assign/lists/row_lists.h"
#include "core/random.h"

namespace clusterbench::assign {
namespace {

using testing::on_each_target;

// More than is asked for stays untouched: one place beyond.
template <class T>
void expect_narrowed(const std::string& target) {
  for (const std::size_t count : {0u, 1u, 3u, 15u, 16u, 17u, 63u, 64u, 257u})
    for (const std::size_t from : {0u, 1u}) {
      std::vector<std::uint32_t> wide(from + count);
      for (std::size_t i = 0; i < wide.size(); ++i) wide[i] = static_cast<T>(std::numeric_limits<T>::max() - 37 * i);
      std::vector<T> expected(wide.begin() + static_cast<std::ptrdiff_t>(from), wide.end());
      expected.push_back(T{77});
      std::vector<T> slim(count, T{0});
      slim.push_back(T{77});
      narrow(wide.data() + from, count, slim.data());
      EXPECT_EQ(slim, expected) << target << ", " << count << " from " << from;
    }
}

TEST(ListForms, narrow_indices_are_the_wide_ones_on_every_target) {
  on_each_target([](const std::string& target) {
    expect_narrowed<std::uint8_t>(target);
    expect_narrowed<std::uint16_t>(target);
  });
}

// Cells of every density, with runs that end at the edges of words.
Lists lists_of_all_densities(std::uint32_t lights, std::uint64_t seed) {
  SplitMix64 random(seed);
  Lists lists;
  lists.begin.push_back(0);
  for (const double share : {0.0, 0.01, 0.05, 0.1, 0.2, 0.4, 0.8, 1.0})
    for (int cell = 0; cell < 3; ++cell) {
      const std::uint64_t first = random.below(lights + 1);
      for (std::uint32_t light = cell == 0 ? 0 : static_cast<std::uint32_t>(first); light < lights; ++light)
        if (random.unit() < share) lists.lights.push_back(light);
      lists.begin.push_back(lists.pair_count());
    }
  return lists;
}

std::vector<std::uint32_t> bits_one_by_one(const Lists& lists, std::uint32_t words_per_cell) {
  std::vector<std::uint32_t> words(std::size_t{lists.cell_count()} * words_per_cell, 0);
  for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell)
    for (const std::uint32_t light : lists.of(cell))
      words[std::size_t{cell} * words_per_cell + light / 32] |= 1u << light % 32;
  return words;
}

TEST(ListForms, bits_are_those_set_one_by_one_on_every_target) {
  on_each_target([](const std::string& target) {
    for (const std::uint32_t lights : {1u, 31u, 32u, 33u, 64u, 500u, 3001u}) {
      const std::uint32_t words_per_cell = (lights + 31) / 32;
      const Lists lists = lists_of_all_densities(lights, lights);
      std::vector<std::uint32_t> words(std::size_t{lists.cell_count()} * words_per_cell, 0xdeadbeef);
      write_bits(lists, words_per_cell, words.data());
      EXPECT_EQ(words, bits_one_by_one(lists, words_per_cell)) << target << ", " << lights << " lights";
    }
  });
}

// A row's spans, with room to read beyond them, and its lists by a plain loop over the cells.
struct Row {
  std::vector<std::uint32_t> lights;
  std::vector<std::uint32_t> spans;
  std::uint32_t count = 0, columns = 0;

  BandSpans band(std::uint32_t width = 1) { return {&count, spans.data(), lights.data(), 0, 1, columns, width}; }
  Lists lists() const {
    Lists lists;
    lists.begin.push_back(0);
    for (std::uint32_t column = 0; column < columns; ++column) {
      for (std::size_t i = 0; i < count; ++i)
        if (ColumnSpan::first(spans[i]) <= column && column <= ColumnSpan::last(spans[i]))
          lists.lights.push_back(lights[i]);
      lists.begin.push_back(lists.pair_count());
    }
    return lists;
  }
};

// Of lights 0 .. most_lights - 1, every third one. What is beyond the spans would be in every list.
Row random_row(std::uint32_t columns, std::uint32_t most_lights, std::uint32_t longest, std::uint64_t seed) {
  SplitMix64 random(seed);
  Row row;
  row.columns = columns;
  for (std::uint32_t light = 0; light < most_lights; ++light) {
    if (random.below(3) != 0) continue;
    const auto a = static_cast<std::uint32_t>(random.below(columns)),
               b = static_cast<std::uint32_t>(random.below(columns));
    row.lights.push_back(light);
    row.spans.push_back(ColumnSpan::of(std::min(a, b), std::min(std::max(a, b), std::min(a, b) + longest - 1)));
    ++row.count;
  }
  row.lights.insert(row.lights.end(), k_most_lanes, 0u);
  row.spans.insert(row.spans.end(), k_most_lanes, ColumnSpan::of(0, ColumnSpan::k_most_columns));
  return row;
}

// Columns, lights, and how many columns a span has at most. Rows of many short spans are written strip by strip.
constexpr std::array<std::array<std::uint32_t, 3>, 12> k_rows{{{1, 1, 1},
                                                               {7, 0, 7},
                                                               {30, 17, 30},
                                                               {12, 64, 12},
                                                               {126, 256, 126},
                                                               {1, 200, 1},
                                                               {120, 100, 120},
                                                               {33, 255, 33},
                                                               {12, 256, 2},
                                                               {32, 250, 3},
                                                               {65, 256, 1},
                                                               {70, 150, 9}}};

// Whatever the spans' width is said to be.
void expect_row_lists(Row& row, const std::string& what) {
  const Lists expected = row.lists();
  for (const std::uint32_t width : {1u, row.columns}) {
    FewColumns few;
    std::vector<std::uint32_t> lights(3 + expected.pair_count() + k_most_lanes);
    std::vector<std::uint32_t> begin(row.columns);
    const std::uint32_t* end =
        write_band_lists(row.band(width), {}, few, lights.data() + 3, lights.data(), begin.data());
    ASSERT_EQ(end - lights.data(), 3 + static_cast<std::ptrdiff_t>(expected.pair_count())) << what;
    for (std::uint32_t cell = 0; cell < row.columns; ++cell) EXPECT_EQ(begin[cell], expected.begin[cell] + 3);
    lights.resize(3 + expected.pair_count());
    EXPECT_EQ(std::vector<std::uint32_t>(lights.begin() + 3, lights.end()), expected.lights) << what << " of " << width;
  }
}

void expect_row_lists_on(const std::string& target) {
  for (const auto& size : k_rows)
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      Row row = random_row(size[0], size[1], size[2], seed);
      const std::string what =
          target + ", " + std::to_string(size[0]) + " columns, " + std::to_string(size[1]) + " lights";
      expect_row_lists(row, what);
      // Spans of all columns, and then the last one without the first of them.
      std::fill_n(row.spans.begin(), row.count, ColumnSpan::of(0, row.columns - 1));
      expect_row_lists(row, what + ", full");
      if (row.count == 0 || row.columns == 1) continue;
      row.spans[row.count - 1] = ColumnSpan::of(1, row.columns - 1);
      expect_row_lists(row, what + ", full but one");
    }
}

TEST(RowLists, are_those_of_a_plain_loop_on_every_target) {
  on_each_target(expect_row_lists_on);
}

TEST(RowLists, take_columns_and_lights_up_to_the_ends_of_their_types) {
  on_each_target([](const std::string& target) {
    constexpr std::uint32_t k_columns = ColumnSpan::k_most_columns;
    Row row = random_row(k_columns, 4, k_columns, 1);
    row.lights[0] = 0xffffffff;
    row.spans[0] = ColumnSpan::of(0, k_columns - 1);
    row.count = 1;
    std::vector<std::uint32_t> lights(k_columns + k_most_lanes), begin(row.columns);
    FewColumns few;
    const auto* end = write_band_lists(row.band(), {}, few, lights.data(), lights.data(), begin.data());
    EXPECT_EQ(end - lights.data(), k_columns) << target;
    EXPECT_EQ(lights[k_columns - 1], 0xffffffff) << target;
  });
}

// Columns 8 .. 20 of 30.
void expect_empty_hole(std::uint32_t longest) {
  Row row = random_row(30, 170, longest, 1);
  const Lists all = row.lists();
  Lists expected;
  expected.begin.push_back(0);
  for (std::uint32_t column = 0; column < row.columns; ++column) {
    if (column < 8 || column > 20)
      expected.lights.insert(expected.lights.end(), all.of(column).begin(), all.of(column).end());
    expected.begin.push_back(expected.pair_count());
  }
  on_each_target([&](const std::string& target) {
    std::vector<std::uint32_t> lights(expected.pair_count() + k_most_lanes), begin(30);
    FewColumns few;
    const auto* end = write_band_lists(row.band(), {{0, 0}, {8, 20}}, few, lights.data(), lights.data(), begin.data());
    begin.push_back(static_cast<std::uint32_t>(end - lights.data()));
    EXPECT_EQ(begin, expected.begin) << target;
    lights.resize(expected.pair_count());
    EXPECT_EQ(lights, expected.lights) << target;
  });
}

TEST(RowLists, are_empty_in_a_hole) {
  for (const std::uint32_t longest : {30u, 2u}) expect_empty_hole(longest);
}

}  // namespace
}  // namespace clusterbench::assign
