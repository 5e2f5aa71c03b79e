#include <gtest/gtest.h>

#include <cstring>

#include "dump/made_dump.h"

namespace clusterbench::dump {
namespace {

using namespace testing;

// The ranges in the buffer of a made dump: the fourth of a light's eight doubles.
template <class Change>
void change_ranges(DumpFile& dump, Change&& change) {
  for (layout::Buffer& buffer : dump.buffers) {
    if (buffer.name != "lights") continue;
    for (std::size_t at = 24; at + 8 <= buffer.bytes.size(); at += 64) {
      double range_m = 0.0;
      std::memcpy(&range_m, buffer.bytes.data() + at, sizeof range_m);
      range_m = change(range_m);
      std::memcpy(buffer.bytes.data() + at, &range_m, sizeof range_m);
    }
  }
}

// Each light also in all cells that are so many columns, rows and slices from its own.
assign::Lists loosened(const Made& of, int by) {
  const Vec3i cells = of.grid.cells();
  std::vector<std::vector<std::uint32_t>> lists(of.truth.cell_count());
  for (std::uint32_t cell = 0; cell < of.truth.cell_count(); ++cell) {
    const Vec3i at = of.grid.cell_at(cell);
    const Vec3i from = glm::max(at - by, Vec3i(0)), to = glm::min(at + by, cells - 1);
    for (int z = from.z; z <= to.z; ++z)
      for (int y = from.y; y <= to.y; ++y)
        for (int x = from.x; x <= to.x; ++x)
          for (const std::uint32_t light : of.truth.of(cell))
            lists[grid::cell_index({x, y, z}, cells)].push_back(light);
  }
  assign::Lists out{{0}, {}};
  for (std::vector<std::uint32_t>& list : lists) {
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
    out.lights.insert(out.lights.end(), list.begin(), list.end());
    out.begin.push_back(static_cast<std::uint32_t>(out.lights.size()));
  }
  return out;
}

const Made& made_once() {
  static const Made frame = made_frame();
  return frame;
}

assign::Lists empty_lists() {
  return {std::vector<std::uint32_t>(made_once().truth.begin.size(), 0), {}};
}

TEST(LostLights, of_equal_shares_of_their_ranges_the_longest_comes_first) {
  DumpFile dump = dump_of(made_once(), empty_lists());
  change_ranges(dump, [i = 0](double range_m) mutable { return range_m * (1.0 + 0.1 * (i++ % 7)); });
  const result::CheckedSet set = verdict_on(dump);
  ASSERT_GT(set.lost.size(), 10u);
  double longest_mm = 0.0;
  for (const result::LostInCell& lost : set.lost)
    if (lost.reach_percent > 99.99) longest_mm = std::max(longest_mm, lost.reach_mm);
  ASSERT_GT(longest_mm, 6000.0);
  EXPECT_EQ(set.error->deepest_mm, longest_mm);
  EXPECT_EQ(set.lost.front().reach_mm, longest_mm);
}

TEST(LostLights, are_no_sign_of_a_limit_where_all_lists_are_empty) {
  const DumpFile dump = dump_of(made_once(), empty_lists());
  EXPECT_EQ(check_text(judge(dump, {}), 1).find("take no more lights"), std::string::npos);
}

TEST(Remarks, ranges_that_are_far_too_small_for_loose_lists_are_remarked_on_before_the_figures) {
  DumpFile dump = dump_of(made_once(), loosened(made_once(), 2));
  const result::CheckedSet sound = verdict_on(dump);
  EXPECT_EQ(sound.verdict, "right");
  ASSERT_GT(sound.error->false_positives, sound.error->listed_pairs / 2) << "loose enough";
  EXPECT_TRUE(sound.remarks.empty()) << sound.remarks.front();
  change_ranges(dump, [](double range_m) { return 0.05 * range_m; });
  const result::CheckedDump small = judge(dump, {});
  EXPECT_EQ(small.sets[0].verdict, "right");
  ASSERT_EQ(small.sets[0].remarks.size(), 1u);
  EXPECT_EQ(small.sets[0].remarks[0].find("with ranges 16 times as large, "), 0u) << small.sets[0].remarks[0];
  EXPECT_NE(small.sets[0].remarks[0].find(", and none would be lost"), std::string::npos);
  const std::string text = check_text(small, 3);
  EXPECT_LT(text.find("  Is the description right? with ranges 16 times"), text.find("lists: right")) << text;
}

TEST(Remarks, a_forgotten_inverse_of_the_range_is_remarked_on_in_loose_lists) {
  DumpFile dump = dump_of(made_once(), loosened(made_once(), 2));
  change_ranges(dump, [](double range_m) { return 1.0 / range_m; });
  const result::CheckedSet set = verdict_on(dump);
  ASSERT_EQ(set.remarks.size(), 1u);
  EXPECT_EQ(set.remarks[0].find("with lights.rows range.is 'inverse', "), 0u) << set.remarks[0];
}

// The first so many slices of the made grid alone.
void cut_slices(DumpFile& dump, std::size_t slices) {
  dump.record.grid.slices->boundaries_m->resize(slices + 1);
}

TEST(Remarks, rows_beyond_the_cells_are_remarked_on) {
  DumpFile dump = dump_of(made_once(), made_once().truth);
  EXPECT_TRUE(verdict_on(dump).remarks.empty());
  cut_slices(dump, 5);
  const result::CheckedSet set = verdict_on(dump);
  EXPECT_EQ(set.verdict, "right");
  ASSERT_EQ(set.remarks.size(), 1u);
  const auto all = std::to_string(made_once().grid.cell_count()),
             half = std::to_string(made_once().grid.cell_count() / 2);
  EXPECT_EQ(set.remarks[0], "/lists/0/rows: buffer 'headers' has " + all + " rows from there on, and the grid " + half +
                                " cells: are all of them described (grid.tiles, grid.slices)?");
}

TEST(Remarks, a_buffer_that_holds_other_things_too_may_be_longer) {
  DumpFile dump = dump_of(made_once(), made_once().truth);
  cut_slices(dump, 5);
  dump.record.lists.push_back(dump.record.lists[0]);
  dump.record.lists[1].set = "others";
  EXPECT_TRUE(verdict_on(dump).remarks.empty());
}

TEST(Remarks, cells_are_told_from_the_top_and_the_near_end_where_the_dump_counts_otherwise) {
  const std::uint32_t cell = made_once().truth.fullest_cell(), light = made_once().truth.of(cell)[0];
  const assign::Lists lists = changed(made_once().truth, [&](auto c, auto l) {
    return c == cell && l == light ? std::nullopt : std::optional(std::pair(c, l));
  });
  const auto text_in = [&](const layout::CellOrder& order) {
    return check_text(judge(dump_of(made_once(), lists, order), {}), 3);
  };
  const Vec3i at = made_once().grid.cell_at(cell);
  const std::string place =
      "cell (" + std::to_string(at.x) + ", " + std::to_string(at.y) + ", " + std::to_string(at.z) + ")";
  EXPECT_NE(text_in({}).find(place + " (number "), std::string::npos) << text_in({});
  EXPECT_NE(text_in({"xyz", true, false}).find(place + ", row from the top (number "), std::string::npos);
  EXPECT_NE(text_in({"xyz", false, true}).find(place + ", slice from the near end (number "), std::string::npos);
  EXPECT_NE(text_in({"xyz", true, true}).find(place + ", row from the top, slice from the near end (number "),
            std::string::npos);
}

TEST(Remarks, the_likely_reading_of_unreadable_lists_is_said_first_and_lists_of_chance_are_not_measured) {
  DumpFile dump = dump_of(made_once(), made_once().truth);
  dump.record.lists[0].entries->first_light = 100;
  const result::CheckedDump checked = judge(dump, {});
  ASSERT_EQ(checked.sets[0].verdict, "unreadable");
  ASSERT_TRUE(checked.sets[0].reading.likely_reading);
  const std::string text = check_text(checked, 3);
  EXPECT_LT(text.find("Probably it is the description: with indices that count from 0"),
            text.find("these are no lists"))
      << text;
  EXPECT_EQ(text.find("longest list"), std::string::npos) << text;
  EXPECT_EQ(text.find("twice"), std::string::npos) << text;
}

}  // namespace
}  // namespace clusterbench::dump
