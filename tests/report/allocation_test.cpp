#include "report/sizing/allocation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "core/random.h"
#include "records.h"
#include "report/result_by_hand.h"
#include "run/records/records.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

// One case per camera, all of one structure; of each the elements that its buffer needs frame by frame.
struct NeedOfCamera {
  std::string camera;
  std::vector<std::uint64_t> elements;
};

Json case_of_camera(const NeedOfCamera& need, std::uint64_t theoretical_max, std::uint64_t element_bytes = 1,
                    std::uint64_t step = 1) {
  Json out = result::to_json(run::record_of(testing::case_by_hand(need.camera, "aabb", 1.0)));
  out["camera"] = need.camera;
  out["name"] = "hall/" + need.camera + "/frustum 64px/aabb/packed";
  out["frames"] = need.elements.size();
  const auto worst = std::ranges::max_element(need.elements);
  Json buffer = {{"name", "indices"},
                 {"element_bytes", element_bytes},
                 {"step", step},
                 {"high_water", need.elements.empty() ? 0 : *worst},
                 {"theoretical_max", theoretical_max},
                 {"worst_frame", worst - need.elements.begin()},
                 {"worst_cell", {1, 2, 3}}};
  buffer["along_path"] = {{"frames_per_entry", 1}, {"elements", need.elements}};
  out["buffers"]["each"] = Json::array({buffer});
  return out;
}

result::Result result_of(const std::vector<Json>& cases) {
  return test::result_of({{"cases", cases}});
}

SizedBuffer sized(const std::vector<Json>& cases, const AllocationRules& rules = {}) {
  const result::Result result = result_of(cases);
  const std::vector<SizedStructure> structures = sized_structures(result, "", rules);
  EXPECT_EQ(structures.size(), 1u);
  EXPECT_EQ(structures[0].buffers.size(), 1u);
  return structures[0].buffers[0];
}

SizedBuffer sized(std::uint64_t high_water, std::uint64_t most, std::uint64_t element_bytes, std::uint64_t step,
                  const AllocationRules& rules) {
  return sized({case_of_camera({"walk", {high_water}}, most, element_bytes, step)}, rules);
}

TEST(Allocation, serves_all_cameras_of_a_scene_and_names_the_frame_that_decides) {
  const SizedBuffer buffer = sized({case_of_camera({"walk", {5, 9, 7}}, 100),
                                    case_of_camera({"fly", {4, 4, 8, 30}}, 90), case_of_camera({"still", {30}}, 80)});
  EXPECT_EQ(buffer.high_water, 30u);
  EXPECT_EQ(buffer.worst_camera, "fly") << "the first of those that are equal";
  EXPECT_EQ(buffer.worst_frame, 3u);
  EXPECT_EQ(buffer.worst_cell, (result::CellIndex{{1, 2, 3}}));
  EXPECT_EQ(buffer.theoretical_max, 100u) << "the largest: grids may differ";
  ASSERT_EQ(buffer.paths.size(), 3u);
  EXPECT_EQ(buffer.paths[1].camera, "fly");
  EXPECT_EQ(buffer.paths[1].elements, (std::vector<std::uint64_t>{4, 4, 8, 30})) << "in the order of frames";
}

// Nearest rank: the least value that at least so many per cent of all frames do not exceed.
std::uint64_t percentile_by_count(const std::vector<std::uint64_t>& all, int percent) {
  for (std::uint64_t value = 0;; ++value) {
    const auto below =
        static_cast<std::size_t>(std::ranges::count_if(all, [&](std::uint64_t v) { return v <= value; }));
    if (100 * below >= static_cast<std::size_t>(percent) * all.size()) return value;
  }
}

TEST(Allocation, the_spread_is_that_of_the_frames_of_all_cameras_together) {
  SplitMix64 random(3);
  for (int round = 0; round < 50; ++round) {
    std::vector<Json> cases;
    std::vector<std::uint64_t> all;
    for (int camera = 0; camera < 3; ++camera) {
      NeedOfCamera need{"c" + std::to_string(camera), {}};
      const std::uint64_t frames = 1 + random.below(60);
      for (std::uint64_t i = 0; i < frames; ++i) need.elements.push_back(random.below(40));
      all.insert(all.end(), need.elements.begin(), need.elements.end());
      cases.push_back(case_of_camera(need, 1000));
    }
    const SizedBuffer buffer = sized(cases);
    ASSERT_TRUE(buffer.spread);
    EXPECT_TRUE(buffer.spread->is_exact);
    EXPECT_EQ(buffer.spread->min, std::ranges::min(all));
    EXPECT_EQ(buffer.spread->max, std::ranges::max(all));
    EXPECT_EQ(buffer.spread->p50, percentile_by_count(all, 50));
    EXPECT_EQ(buffer.spread->p90, percentile_by_count(all, 90));
    EXPECT_EQ(buffer.spread->p99, percentile_by_count(all, 99));
  }
}

TEST(Allocation, entries_of_several_frames_count_for_each_and_make_the_spread_a_bound) {
  Json one = case_of_camera({"walk", {10, 20}}, 1000), other = case_of_camera({"fly", {1, 2, 3}}, 1000);
  one["buffers"]["each"][0]["along_path"]["frames_per_entry"] = 4;
  const SizedBuffer buffer = sized({one, other});
  EXPECT_FALSE(buffer.spread->is_exact);
  EXPECT_EQ(buffer.spread->p50, 10u) << "1 2 3 10 10 10 10 20 20 20 20: the sixth of eleven";
}

TEST(Allocation, a_buffer_that_is_the_same_in_every_frame_has_its_spread_without_a_list) {
  Json one = case_of_camera({"walk", {7, 7, 7}}, 7);
  one["buffers"]["each"][0].erase("along_path");
  const SizedBuffer buffer = sized({one});
  EXPECT_TRUE(buffer.spread->is_exact);
  EXPECT_EQ(buffer.spread->min, 7u);
  EXPECT_EQ(buffer.spread->max, 7u);
  one["frames"] = 1000000000000ull;  // as a file by hand may say
  EXPECT_EQ(sized({one}).spread->p99, 7u);
}

TEST(Allocation, capacity_is_high_water_with_margin_rounded_up_to_whole_pages_and_at_most_what_is_possible) {
  const AllocationRules page{.margin = 2.0, .warn_at = 0.9, .rounding = Rounding::page};
  const SizedBuffer plain = sized(1500, 100000, 2, 1, page);  // 3000 elements, 6000 bytes
  EXPECT_EQ(plain.bytes, 8192u);
  EXPECT_EQ(plain.capacity, 4096u);
  EXPECT_EQ(plain.warn_above, 3686u) << "0.9 of it, rounded down";
  EXPECT_EQ(plain.double_buffered_bytes(), 16384u);
  const SizedBuffer headers = sized(24, 24, 12, 1, page);
  EXPECT_EQ(headers.capacity, 24u);
  EXPECT_EQ(headers.bytes, 4096u);
  EXPECT_EQ(headers.warn_above, 24u) << "nothing can overflow, so nothing warns";
  const SizedBuffer odd = sized(1000, 100000, 12, 1, page);  // 24000 bytes: 6 pages, of which 2048 elements
  EXPECT_EQ(odd.bytes, 24576u);
  EXPECT_EQ(odd.capacity, 2048u);
  EXPECT_EQ(sized(3000, 5000, 4, 1, page).capacity, 5000u);
  EXPECT_EQ(sized(3000, 5000, 4, 1, page).bytes, 20480u);
}

TEST(Allocation, rounds_to_powers_of_two_or_not_at_all) {
  const SizedBuffer power =
      sized(1500, 100000, 4, 1, {.margin = 1.5, .warn_at = 0.8, .rounding = Rounding::power_of_two});
  EXPECT_EQ(power.bytes, 16384u) << "2250 elements of 4 bytes are 9000";
  EXPECT_EQ(power.capacity, 4096u);
  EXPECT_EQ(power.warn_above, 3276u);
  const SizedBuffer none = sized(1001, 100000, 4, 1, {.margin = 1.5, .warn_at = 0.9, .rounding = Rounding::none});
  EXPECT_EQ(none.capacity, 1502u) << "1501.5";
  EXPECT_EQ(none.bytes, 6008u);
}

TEST(Allocation, of_elements_that_come_together_whole_steps_are_allocated) {
  const AllocationRules rules{.margin = 1.5, .warn_at = 0.9, .rounding = Rounding::page};
  const SizedBuffer cap = sized(7 * 100, 50 * 100, 2, 100, rules);  // 10.5 lights in each of 100 cells are 11
  EXPECT_EQ(cap.bytes, 4096u);
  EXPECT_EQ(cap.capacity, 2000u) << "20 lights per cell fit into the page";
}

TEST(Allocation, of_what_is_never_needed_nothing_is_allocated) {
  const SizedBuffer none = sized(0, 0, 4, 1, {});
  EXPECT_EQ(none.capacity, 0u);
  EXPECT_EQ(none.bytes, 0u);
  const SizedBuffer unused = sized(0, 100, 4, 1, {});
  EXPECT_EQ(unused.capacity, 0u);
  EXPECT_EQ(unused.bytes, 0u);
}

TEST(Allocation, numbers_of_a_file_by_hand_end_where_64_bits_do) {
  constexpr std::uint64_t k_most = std::numeric_limits<std::uint64_t>::max();
  const SizedBuffer huge = sized(k_most, k_most, k_most, k_most, {.margin = 1000.0});
  EXPECT_EQ(huge.capacity, k_most);
  EXPECT_EQ(huge.double_buffered_bytes(), k_most);
  const SizedBuffer wrong = sized(500, 3, 1, 1, {});  // more than is possible
  EXPECT_GE(wrong.capacity, 500u) << "never below what was needed";
}

TEST(Allocation, cases_without_frames_have_no_spread) {
  EXPECT_FALSE(sized({case_of_camera({"walk", {}}, 100)}).spread) << "an empty list of elements";
  Json none = case_of_camera({"walk", {}}, 100);
  none["buffers"]["each"][0].erase("along_path");
  EXPECT_FALSE(sized({none}).spread);
  EXPECT_TRUE(sized({none, case_of_camera({"fly", {3}}, 100)}).spread);
  EXPECT_TRUE(sized_structures(result_of({}), "no such", {}).empty());
}

TEST(Allocation, results_of_earlier_versions_have_entries_and_headers) {
  Json old = case_of_camera({"walk", {9}}, 100);
  old["buffers"].erase("each");
  const result::Result result = result_of({old});
  const std::vector<SizedBuffer> buffers = sized_structures(result, "", {})[0].buffers;
  ASSERT_EQ(buffers.size(), 2u);
  EXPECT_EQ(buffers[0].name, "entries");
  EXPECT_EQ(buffers[0].high_water, 40u);
  EXPECT_EQ(buffers[0].theoretical_max, 480u);
  EXPECT_EQ(buffers[1].name, "header_bytes");
  EXPECT_EQ(buffers[1].high_water, 192u);
  EXPECT_FALSE(buffers[0].spread);
}

TEST(Allocation, cases_of_one_name_and_camera_are_structures_of_their_own) {
  const Json one = case_of_camera({"walk", {9}}, 100);
  const result::Result result = result_of({one, one});
  EXPECT_EQ(sized_structures(result, "", {}).size(), 2u);
}

TEST(Allocation, the_filter_selects_cases_by_name) {
  const result::Result result = result_of({case_of_camera({"walk", {9}}, 100), case_of_camera({"fly", {70}}, 100)});
  EXPECT_EQ(sized_structures(result, "/walk/", {})[0].buffers[0].high_water, 9u);
  EXPECT_THROW(sized_structures(result, "no such", {}), Error);
  EXPECT_THROW(sized_structures(result, "(", {}), Error);
}

}  // namespace
}  // namespace clusterbench::report
