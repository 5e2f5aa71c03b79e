#include "run/passes/details_pass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <sstream>

#include "run/runner.h"
#include "run/walk.h"

namespace clusterbench::run {
namespace {

using testing::k_shafts;
using testing::Walk;

// The numbers of core/run_length_text.h.
std::vector<double> numbers(const std::string& text) {
  std::vector<double> out;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::size_t star = word.find('*');
    out.insert(out.end(), star == std::string::npos ? 1 : std::stoul(word.substr(star + 1)),
               std::stod(word.substr(0, star)));
  }
  return out;
}

std::uint64_t sum(const std::string& text) {
  const std::vector<double> all = numbers(text);
  return static_cast<std::uint64_t>(std::accumulate(all.begin(), all.end(), 0.0));
}

std::vector<double> places(const std::string& gaps) {
  std::vector<double> all = numbers(gaps);
  std::partial_sum(all.begin(), all.end(), all.begin());
  return all;
}

Walk crowd(const std::string& details, const std::string& grid = R"({"tiles": {"pixels": [10, 10]}})",
           const std::string& assigner = "bounds", int frames = 3) {
  Walk walk(R"("grids": [)" + grid + R"(], "assigners": [")" + assigner + R"("], "details": )" + details, frames);
  for (int i = 0; i < 40; ++i) {
    scene::Light& light =
        walk.add_light({8 * std::sin(i * 1.3), 6 * std::sin(i * 2.9), -15 + 14 * std::sin(i * 0.7)}, 1.0 + 0.05 * i);
    if (i % 4 == 0) light.type = scene::LightType::spot;
  }
  return walk;
}

std::vector<int> frames_of(const Details& details) {
  std::vector<int> frames;
  for (const DetailsFrame& frame : details.frames) frames.push_back(frame.frame);
  return frames;
}

TEST(DetailsPass, is_left_out_where_nobody_asks_for_it) {
  EXPECT_FALSE(crowd("null").run().cases.at(0).details);
}

TEST(DetailsPass, changes_nothing_else_in_a_result) {
  const CaseResult without = crowd("null").run().cases.at(0), with = crowd("{}").run().cases.at(0);
  EXPECT_EQ(with.occupancy->histogram, without.occupancy->histogram);
  EXPECT_EQ(with.error->false_positives, without.error->false_positives);
  EXPECT_EQ(with.tests_done, without.tests_done);
  EXPECT_EQ(with.grid, without.grid);
}

struct OfKind {
  const char *grid, *assigner;
};
const OfKind k_kinds[] = {{R"({"tiles": {"pixels": [10, 10]}})", "bounds"},
                          {R"({"kind": "distance", "tiles": {"pixels": [10, 10]}})", "distance"},
                          {R"({"kind": "cascades", "cells": [8, 8, 8]})", "cascades"},
                          {R"({"kind": "world", "cells": [8, 4, 8]})", "world-grid"}};

TEST(DetailsPass, counts_are_those_of_error_and_occupancy_on_every_kind_of_grid) {
  for (const OfKind& kind : k_kinds) {
    const CaseResult case_result = crowd(R"({"frames": 3})", kind.grid, kind.assigner).run().cases.at(0);
    ASSERT_EQ(frames_of(*case_result.details), (std::vector<int>{0, 1, 2})) << kind.assigner;
    std::uint64_t reported = 0, truth = 0, false_positives = 0, false_negatives = 0, most = 0, occupied = 0;
    for (const DetailsFrame& frame : case_result.details->frames) {
      reported += sum(frame.reported);
      truth += sum(frame.truth);
      false_positives += sum(frame.false_positives);
      false_negatives += sum(frame.false_negatives);
      for (const double length : numbers(frame.reported)) {
        most = std::max(most, static_cast<std::uint64_t>(length));
        occupied += length > 0.0 ? 1 : 0;
      }
    }
    EXPECT_EQ(reported, case_result.error->reported_pairs) << kind.assigner;
    EXPECT_EQ(truth, case_result.error->true_pairs) << kind.assigner;
    EXPECT_EQ(false_positives, case_result.error->false_positives) << kind.assigner;
    EXPECT_EQ(false_negatives, case_result.error->false_negatives) << kind.assigner;
    EXPECT_EQ(most, case_result.occupancy->worst_count) << kind.assigner;
    const auto& histogram = case_result.occupancy->histogram;
    EXPECT_EQ(occupied, std::accumulate(histogram.begin() + 1, histogram.end(), std::uint64_t{0})) << kind.assigner;
  }
}

TEST(DetailsPass, the_rows_of_a_frame_fit_each_other) {
  const CaseResult case_result = crowd("{}").run().cases.at(0);
  const DetailsFrame& frame = case_result.details->frames.at(0);
  for (const std::string* row :
       {&frame.cells, &frame.reported, &frame.truth, &frame.false_positives, &frame.false_negatives})
    EXPECT_EQ(numbers(*row).size(), frame.cell_count);
  const std::size_t lights = frame.light_names.size();
  EXPECT_EQ(numbers(frame.lights).size(), lights);
  EXPECT_EQ(numbers(frame.light_positions).size(), 3 * lights);
  EXPECT_EQ(numbers(frame.light_ranges).size(), lights);
  EXPECT_GT(frame.spot_count, 0u);
  EXPECT_EQ(numbers(frame.spot_axes).size(), 3 * frame.spot_count);
  EXPECT_EQ(numbers(frame.spot_half_angles).size(), frame.spot_count);
  EXPECT_EQ(numbers(frame.pair_lights).size(), sum(frame.reported) + sum(frame.false_negatives));
  EXPECT_EQ(numbers(frame.pair_marks).size(), numbers(frame.pair_lights).size());
}

TEST(DetailsPass, a_light_on_the_axis_stands_in_the_cells_that_its_depths_meet) {
  Walk walk(std::string(k_shafts) + R"(, "assigners": ["aabb"], "details": {"frames": [2]})");
  walk.add_light({0, 0, -90}, 1);  // beyond the last slice
  walk.add_light({0, 0, -9}, 2);   // in frame 2 at depth 7: 5..9 meets 4..8 and 8..16
  const Details details = *walk.run().cases.at(0).details;
  ASSERT_EQ(details.frames.size(), 1u);
  const DetailsFrame& frame = details.frames[0];
  EXPECT_EQ(frame.frame, 2);
  EXPECT_EQ(places(frame.cells), (std::vector<double>{2, 3}));
  EXPECT_EQ(frame.light_names, std::vector<std::string>{"lamp 1"});
  EXPECT_EQ(frame.lights, "1");
  EXPECT_EQ(frame.light_positions, "0*2 -7");
  EXPECT_EQ(frame.light_ranges, "2");
  EXPECT_EQ(frame.pair_lights, "1*2");
  EXPECT_EQ(frame.pair_marks, "0*2");
  EXPECT_EQ(frame.camera.origin.z, -2.0);
  EXPECT_EQ(frame.boundaries, "") << "the case's grid has them";
}

TEST(DetailsPass, worst_is_the_frame_with_each_cases_longest_list) {
  for (const CaseResult& case_result : crowd("{}", k_kinds[0].grid, R"(bounds", "aabb)", 6).run().cases)
    EXPECT_EQ(frames_of(*case_result.details), std::vector<int>{case_result.occupancy->worst_frame});
}

TEST(DetailsPass, frames_are_evenly_spaced_or_those_of_the_list_and_what_the_path_lacks_is_named) {
  const auto details = [](const std::string& request) {
    return *crowd(request, k_kinds[0].grid, "bounds", 7).run().cases.at(0).details;
  };
  EXPECT_EQ(frames_of(details(R"({"frames": 3})")), (std::vector<int>{0, 3, 6}));
  EXPECT_EQ(frames_of(details(R"({"frames": 50})")).size(), 7u);
  const Details listed = details(R"({"frames": [5, 2, 7, 2, 90]})");
  EXPECT_EQ(frames_of(listed), (std::vector<int>{2, 5}));
  EXPECT_EQ(listed.frames_not_on_path, (std::vector<int>{7, 90}));
}

TEST(DetailsPass, slices_that_follow_the_lights_are_told_where_they_are_not_the_cases) {
  const CaseResult case_result =
      crowd(R"({"frames": 3})", R"({"tiles": {"count": [4, 4]}, "slices": {"scheme": "fit", "count": 8}})", "aabb")
          .run()
          .cases.at(0);
  EXPECT_EQ(numbers(case_result.details->frames.at(0).boundaries).size(), 9u);
  EXPECT_EQ(case_result.details->frames.at(2).boundaries, "") << "the case's grid is the last frame's";
}

TEST(DetailsPass, without_lists_there_are_counts_and_no_pairs) {
  const Details details = *crowd(R"({"lists": false})").run().cases.at(0).details;
  EXPECT_FALSE(details.frames.at(0).has_pairs);
  EXPECT_GT(sum(details.frames[0].reported), 0u);
  EXPECT_TRUE(details.pairs_left_out.empty()) << "nobody asked for them";
}

TEST(DetailsPass, needs_no_accuracy_check_for_its_truth) {
  Walk walk = crowd("{}");
  walk.config.accuracy.check = false;
  const CaseResult case_result = walk.run().cases.at(0);
  EXPECT_FALSE(case_result.error);
  EXPECT_GT(sum(case_result.details->frames.at(0).truth), 0u);
}

TEST(DetailsPass, what_has_no_room_is_named_first_lists_then_frames) {
  const auto details = [](std::size_t max_bytes) {
    Walk walk = crowd(R"({"frames": 3})");
    walk.config.details->max_bytes = max_bytes;
    return *walk.run().cases.at(0).details;
  };
  EXPECT_EQ(frames_of(details(200'000)).size(), 3u);
  EXPECT_TRUE(details(200'000).pairs_left_out.empty());
  bool has_left_pairs = false, has_left_frames = false;
  for (std::size_t max_bytes = 60'000; max_bytes > 3'000; max_bytes -= 500) {
    const Details some = details(max_bytes);
    EXPECT_EQ(some.frames.size() + some.frames_left_out.size(), 3u);
    std::size_t with_pairs = 0;
    for (const DetailsFrame& frame : some.frames) with_pairs += frame.has_pairs ? 1 : 0;
    EXPECT_EQ(with_pairs + some.pairs_left_out.size(), some.frames.size());
    has_left_pairs |= some.frames_left_out.empty() && !some.pairs_left_out.empty();
    has_left_frames |= !some.frames_left_out.empty();
  }
  EXPECT_TRUE(has_left_pairs && has_left_frames);
}

}  // namespace
}  // namespace clusterbench::run
