// What a run says of an earlier result beside the budgets: which figures have moved, from what to what.

#include "report/gates/baseline_changes.h"

#include <gtest/gtest.h>

#include "report/gates/baseline_cases.h"
#include "report/result_by_hand.h"
#include "report/results/result_record.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::Result;

Result record_by_hand() {
  return record_of(testing::result_by_hand(), {});
}

std::string changes(const Result& base, const Result& result, const std::string& filter = "") {
  return baseline_changes_text(result, BaselineCases(base, result, filter, "base.json"));
}

TEST(BaselineChanges, are_one_line_where_nothing_has_changed) {
  EXPECT_EQ(changes(record_by_hand(), record_by_hand()),
            "changes since base.json: none in 2 cases (lights, index_entries, bytes, longest, pairs.mean, missed, "
            "dropped)\n");
}

// Others have no instructions that could have changed.
TEST(BaselineChanges, of_instructions_are_none_only_where_they_were_counted) {
  run::Result counted = testing::result_by_hand();
  for (run::CaseResult& one : counted.cases) testing::add_count(one);
  const Result base = record_of(counted, {});
  const std::string text = changes(base, base);
  EXPECT_NE(text.find("missed, dropped, instructions)"), std::string::npos) << text;
}

TEST(BaselineChanges, name_old_and_new_figures_and_where_the_new_ones_are) {
  Result now = record_by_hand();
  for (Case& result_case : now.cases) result_case.lights_lit = 2;
  now.cases[1].buffers.index_entries.high_water = 50;
  now.cases[1].buffers.bytes.high_water = 242;
  now.cases[1].occupancy->lights_per_cell.max = 6;
  EXPECT_EQ(changes(record_by_hand(), now),
            "changes since base.json:\n"
            "  hall, camera walk: lights_lit 10 -> 2 (-80 %)\n"
            "  hall/walk/frustum 64px/aabb/packed: index_entries 40 -> 50 (+25 %; frame 1, cell [3,2,1]), "
            "bytes 232 -> 242 (+4.31 %), longest 7 -> 6 (-14.3 %; frame 1, cell [1,1,1])\n"
            "  none in 1 other case\n");
}

TEST(BaselineChanges, of_bytes_say_where_indices_are_wider) {
  Result now = record_by_hand();
  result::Buffers& buffers = now.cases[1].buffers;
  const std::uint64_t bits = buffers.index_bits;
  buffers.index_bits = 2 * bits;
  buffers.bytes.high_water = 464;
  const std::string width =
      "bytes 232 -> 464 (+100 %; indices of " + std::to_string(bits) + " -> " + std::to_string(2 * bits) + " bits";
  EXPECT_NE(changes(record_by_hand(), now).find(width), std::string::npos) << changes(record_by_hand(), now);
}

TEST(BaselineChanges, from_nothing_have_no_percent) {
  Result base = record_by_hand();
  base.cases[1].occupancy->lights_per_cell.max = 0;
  EXPECT_NE(changes(base, record_by_hand()).find("longest 0 -> 7 (frame 1, cell [1,1,1])\n"), std::string::npos);
}

TEST(BaselineChanges, hold_a_renamed_level_against_the_one_before) {
  Result now = record_by_hand();
  now.scenes[0].name = "hall-v2";
  for (Case& result_case : now.cases) {
    result_case.scene = "hall-v2";
    result_case.lights = 11;
  }
  EXPECT_EQ(changes(record_by_hand(), now),
            "changes since base.json:\n  hall-v2, camera walk: lights 10 -> 11 (+10 %)\n  none in 2 cases\n");
}

TEST(BaselineChanges, tell_cases_of_one_name_by_their_viewports) {
  Result base = record_by_hand();
  for (Case& result_case : base.cases) result_case.viewport = {640, 360};
  EXPECT_EQ(changes(base, record_by_hand(), "aabb"),
            "changes since base.json:\n"
            "  not in base.json: hall/walk/frustum 64px/brute-force/packed, hall/walk/frustum 64px/aabb/packed at "
            "1920x1080\n"
            "  only in base.json: hall/walk/frustum 64px/aabb/packed at 640x360\n");
}

TEST(BaselineChanges, tell_cases_that_one_of_both_lacks_and_figures_that_the_base_is_too_old_for) {
  Result base = record_by_hand(), now = record_by_hand();
  base.cases.erase(base.cases.begin());
  base.cases[0].lights_seen.reset();
  now.cases.pop_back();
  EXPECT_EQ(changes(base, now),
            "changes since base.json:\n"
            "  not in base.json: hall/walk/frustum 64px/brute-force/packed\n"
            "  only in base.json: hall/walk/frustum 64px/aabb/packed\n");
  EXPECT_EQ(changes(base, record_by_hand()),
            "changes since base.json:\n"
            "  none in 1 case\n"
            "  not in base.json: hall/walk/frustum 64px/brute-force/packed\n"
            "  base.json does not tell lights_seen\n");
  EXPECT_EQ(
      changes(record_by_hand(), now, "brute-force"),
      "changes since base.json: none in 1 case (lights, index_entries, bytes, longest, pairs.mean, missed, dropped)\n")
      << "others of the base are not looked for";
}

}  // namespace
}  // namespace clusterbench::report
