#include "measure/lists/cell_details.h"

#include <gtest/gtest.h>

namespace clusterbench::measure {
namespace {

using Row = std::vector<std::uint32_t>;

assign::Lists lists_of(const std::vector<Row>& cells) {
  assign::Lists lists{{0}, {}};
  for (const Row& cell : cells) {
    lists.lights.insert(lists.lights.end(), cell.begin(), cell.end());
    lists.begin.push_back(static_cast<std::uint32_t>(lists.lights.size()));
  }
  return lists;
}

TEST(Details, each_pair_is_marked_as_both_false_positive_or_false_negative) {
  const FrameDetails found =
      find_details(lists_of({{}, {1, 4, 7}, {}, {2}, {}}), lists_of({{}, {0, 4, 9}, {}, {}, {3}}));
  EXPECT_EQ(found.cells, (Row{1, 3, 4})) << "cells without a reported or true light are left out";
  EXPECT_EQ(found.reported, (Row{3, 0, 1}));
  EXPECT_EQ(found.truth, (Row{3, 1, 0}));
  EXPECT_EQ(found.false_positives, (Row{2, 0, 1}));
  EXPECT_EQ(found.false_negatives, (Row{2, 1, 0}));
  EXPECT_EQ(found.pair_lights, (Row{0, 1, 4, 7, 9, 2, 3}));
  EXPECT_EQ(found.pair_marks, (Row{1, 2, 0, 2, 1, 2, 1}));
  EXPECT_EQ(found.lights, (Row{0, 1, 2, 3, 4, 7, 9}));
}

TEST(Details, empty_lists_have_none) {
  EXPECT_TRUE(find_details(lists_of({{}, {}}), lists_of({{}, {}})).cells.empty());
}

}  // namespace
}  // namespace clusterbench::measure
