#include <gtest/gtest.h>

#include <set>

#include "dump/made_dump.h"

namespace clusterbench::dump {
namespace {

using namespace testing;

TEST(CheckPage, has_the_lists_of_the_cells_that_lose_lights) {
  const Deepest deepest = deepest_pair();
  const auto here = made().truth.of(deepest.cell);
  Moved moved;  // of another cell, listed in this one
  const DumpFile dump =
      dump_of(made(), changed(made().truth, [&](auto cell, auto light) -> Moved {
                if (cell == deepest.cell && light == deepest.light) return std::nullopt;
                if (!moved && !std::ranges::binary_search(here, light)) moved = {cell, light};
                return moved == std::pair(cell, light) ? std::pair(deepest.cell, light) : std::pair(cell, light);
              }));
  result::CheckPageFrame page;
  std::size_t room = k_most_page_entries;
  const result::CheckedDump checked = judge(dump, {.page = &page, .page_room = &room});
  EXPECT_EQ(page.checked.sets[0].error->lost_pairs, checked.sets[0].error->lost_pairs);
  ASSERT_EQ(page.sets.size(), 1u);
  EXPECT_EQ(page.grid.shape, "slopes");
  EXPECT_EQ(page.grid.x.size(), 13u);
  EXPECT_EQ(page.grid.z.size(), 11u);
  std::set<std::uint64_t> named;
  std::size_t lost = 0;
  for (const result::CheckPageCell& cell : page.sets[0].cells) {
    std::set<std::uint64_t> exact(cell.listed.begin(), cell.listed.end());
    for (const std::uint64_t light : cell.excess) EXPECT_EQ(exact.erase(light), 1u);
    for (const std::uint64_t light : cell.lost) EXPECT_TRUE(exact.insert(light).second);
    const auto truth = made().truth.of(static_cast<std::uint32_t>(cell.index));
    EXPECT_TRUE(std::ranges::equal(exact, truth));
    named.insert(cell.listed.begin(), cell.listed.end());
    named.insert(cell.lost.begin(), cell.lost.end());
    lost += cell.lost.size();
  }
  EXPECT_EQ(lost, checked.sets[0].error->lost_pairs);
  EXPECT_EQ(page.sets[0].cells[0].index, deepest.cell);
  ASSERT_EQ(page.lights.size(), named.size());
  for (const result::CheckPageLight& light : page.lights) {
    const Vec3d seen =
        made().frame.view_space.rotation * (made().frame.lights[light.index].position - made().frame.view_space.origin);
    EXPECT_NEAR(light.position[2], seen.z, 1e-9);
    EXPECT_EQ(light.direction.has_value(), made().frame.ranges().is_spot(static_cast<std::uint32_t>(light.index)));
  }
  EXPECT_LT(room, k_most_page_entries);
  room = 0;
  judge(dump, {.page = &page, .page_room = &room});
  EXPECT_TRUE(page.sets[0].cells.empty());
  EXPECT_EQ(page.sets[0].cells_left_out, 2u);
}

}  // namespace
}  // namespace clusterbench::dump
