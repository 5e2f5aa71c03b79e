#include "run/findings/gate.h"

#include <gtest/gtest.h>

namespace clusterbench::run {
namespace {

using Kind = Failure::Kind;

// 30 pairs in cells, all true; samples need 1000 lights.
CaseResult with_cells() {
  CaseResult case_result;
  case_result.id = "one";
  case_result.grid = {{"cells", {4, 3, 2}}};
  case_result.occupancy.emplace();
  case_result.error.emplace();
  case_result.error->true_pairs = case_result.error->reported_pairs = 30;
  case_result.shading.emplace();
  case_result.shading->needed = 1000;
  return case_result;
}

// A structure of a method's own that has none, as a light hierarchy.
CaseResult without_cells() {
  CaseResult case_result = with_cells();
  case_result.occupancy.reset();
  case_result.error.reset();
  case_result.storage_label = "own";
  return case_result;
}

void miss(CaseResult& case_result, std::uint64_t lights, std::uint64_t outside) {
  case_result.shading->missed = lights;
  case_result.shading->missed_outside = outside;
  case_result.shading->worst = {7, lights, 140};
}

std::vector<Kind> kinds(const CaseResult& case_result, const config::LimitsRequest& limits = {}) {
  std::vector<Kind> out;
  for (const Failure& failure : failures_of(case_result, limits)) out.push_back(failure.kind);
  return out;
}

config::LimitsRequest with_dropped(std::optional<std::uint64_t> pairs) {
  config::LimitsRequest limits;
  limits.dropped_pairs = pairs;
  return limits;
}

TEST(Gate, what_loses_and_drops_nothing_passes) {
  EXPECT_TRUE(kinds(with_cells()).empty());
  EXPECT_TRUE(kinds(without_cells()).empty());
  EXPECT_FALSE(loses_lights(with_cells()));
  EXPECT_FALSE(loses_lights(without_cells()));
}

// It is asked beyond the cells of which a pre-cull knows.
TEST(Gate, a_structure_without_cells_does_not_answer_for_what_a_pre_cull_keeps_from_it) {
  CaseResult case_result = without_cells();
  miss(case_result, 5, 0);
  EXPECT_EQ(kinds(case_result), (std::vector{Kind::lost_at_samples}));
  case_result.pre_cull.emplace();
  case_result.pre_cull->counts.samples.push_back({measure::SampleSet::volume, 1000, 5, true});
  EXPECT_TRUE(kinds(case_result).empty());
  EXPECT_TRUE(loses_lights(case_result));
  case_result.pre_cull->counts.samples.back().lost = 4;
  EXPECT_EQ(kinds(case_result), (std::vector{Kind::lost_at_samples})) << "the fifth is its own";
}

TEST(Gate, a_lost_pair_of_a_conservative_method_fails_and_of_another_loses_lights) {
  CaseResult case_result = with_cells();
  case_result.error->false_negatives = 3;
  EXPECT_EQ(kinds(case_result), (std::vector{Kind::lost_pairs}));
  case_result.conservative = false;
  EXPECT_TRUE(kinds(case_result).empty());
  EXPECT_TRUE(loses_lights(case_result));
}

TEST(Gate, pairs_of_lights_beside_the_view_that_a_preset_culls_are_told_apart_from_those_that_it_loses) {
  CaseResult case_result = with_cells();
  case_result.conservative = false;
  case_result.preset = "godot";
  case_result.error->true_pairs = 100;
  case_result.error->false_negatives = 30;
  case_result.error->deepest = measure::Miss{.frame = 5, .cell = 17, .light = 8, .rig_index = 9, .depth = 0.125};
  case_result.pre_cull.emplace();
  case_result.pre_cull->counts.lost_pairs = 25;
  case_result.pre_cull->counts.lost_to_limits = 4;
  ASSERT_EQ(warnings_of(case_result).size(), 1u);
  EXPECT_EQ(warnings_of(case_result)[0].text,
            "lost 9 of 100 true pairs, and leaves out 21 of lights beside the view, which it culls");
  case_result.error->false_negatives = 21;
  EXPECT_TRUE(warnings_of(case_result).empty()) << "what an engine culls is no loss";
  EXPECT_FALSE(loses_lights(case_result));
  case_result.error->false_negatives = 4;
  case_result.pre_cull->counts.lost_pairs = 4;
  EXPECT_TRUE(warnings_of(case_result)[0].text.starts_with("lost 4 of 100 true pairs; deepest in frame 5"));
}

TEST(Gate, any_difference_of_an_exact_method_fails) {
  CaseResult case_result = with_cells();
  case_result.error->false_positives = 1;
  EXPECT_TRUE(kinds(case_result).empty());
  case_result.exact = true;
  EXPECT_EQ(kinds(case_result), (std::vector{Kind::extra_pairs}));
}

TEST(Gate, a_device_that_walks_other_lights_fails_the_case) {
  CaseResult case_result = with_cells();
  case_result.reading.emplace().sets.resize(2);
  EXPECT_TRUE(kinds(case_result).empty());
  case_result.reading->sets[1].differing = 1;
  EXPECT_EQ(kinds(case_result), (std::vector{Kind::wrong_readings}));
}

TEST(Gate, without_cells_a_light_missed_at_a_sample_is_a_lost_one) {
  CaseResult case_result = without_cells();
  miss(case_result, 1, 1);
  EXPECT_EQ(kinds(case_result), (std::vector{Kind::lost_at_samples})) << "no grid whose end could excuse it";
  EXPECT_TRUE(loses_lights(case_result));
  case_result.conservative = false;
  EXPECT_TRUE(kinds(case_result).empty());
  EXPECT_TRUE(loses_lights(case_result));
  CaseResult listed = with_cells();
  miss(listed, 1, 0);
  EXPECT_TRUE(kinds(listed).empty()) << "a lookup may round at a cell boundary; its pairs are held against the truth";
  EXPECT_FALSE(loses_lights(listed));
}

TEST(Gate, without_cells_a_light_that_the_lookup_misses_is_a_lost_one) {
  CaseResult case_result = without_cells();
  measure::LookupCounts rough;
  rough.way = {measure::Logarithm::rounded, measure::DepthRead::d24};
  rough.missed = 5;
  case_result.lookup = {rough};
  EXPECT_TRUE(kinds(case_result).empty()) << "a depth buffer of 24 bits is no fault of the method";
  case_result.lookup.push_back({});
  case_result.lookup.back().missed = 2;
  case_result.lookup.back().needed = 50;
  EXPECT_EQ(kinds(case_result), (std::vector{Kind::lost_at_samples}));
  EXPECT_NE(failures_of(case_result, {})[0].text.find("2 of 50"), std::string::npos);
  EXPECT_TRUE(loses_lights(case_result));
}

TEST(Gate, dropped_pairs_fail_unless_the_configuration_allows_them) {
  CaseResult case_result = with_cells();
  case_result.buffers.dropped_pairs = 5;
  EXPECT_EQ(kinds(case_result), (std::vector{Kind::dropped_pairs}));
  EXPECT_EQ(kinds(case_result, with_dropped(4)), (std::vector{Kind::dropped_pairs}));
  EXPECT_TRUE(kinds(case_result, with_dropped(5)).empty());
  EXPECT_TRUE(kinds(case_result, with_dropped(std::nullopt)).empty());
  EXPECT_TRUE(loses_lights(case_result));
}

TEST(Gate, what_lies_outside_of_the_grid_loses_lights_and_is_told_with_its_frame) {
  CaseResult case_result = with_cells();
  miss(case_result, 100, 90);
  EXPECT_TRUE(kinds(case_result).empty()) << "a choice of the grid";
  EXPECT_TRUE(loses_lights(case_result));
  CaseResult own = without_cells();
  miss(own, 100, 90);
  const std::string text = failures_of(own, {})[0].text;
  EXPECT_EQ(text, "lost 100 of 1000 lights that random points in the view need; most in frame 7, 100 of 140");
}

// A ranking by surfaces does not suffer from what no surface is at.
TEST(Gate, lights_unlit_at_random_points_are_told_and_visible_surfaces_decide) {
  CaseResult case_result = with_cells();
  miss(case_result, 100, 90);
  SampleSetResult opaque;
  opaque.set = measure::SampleSet::opaque;
  opaque.counts.samples = opaque.counts.needed = 1000;
  case_result.samples = {opaque};
  EXPECT_FALSE(loses_lights(case_result));
  EXPECT_EQ(warnings_of(case_result)[0].kind, Warning::Kind::unlit);
  case_result.samples[0].counts.missed = 2;
  EXPECT_TRUE(loses_lights(case_result));
  case_result.samples[0].counts.needed = case_result.samples[0].counts.missed = 0;
  EXPECT_TRUE(loses_lights(case_result)) << "surfaces that no light reaches say nothing";
}

TEST(Gate, a_limit_is_one_of_lights_in_view_only_behind_a_cull_by_the_view) {
  CaseResult case_result = with_cells();
  PreCullResult cull;
  cull.counts.steps.resize(1);
  cull.counts.steps[0].label = "most(128,first)";
  cull.counts.steps[0].limit = 128;
  cull.counts.steps[0].frames = 1;
  case_result.pre_cull = cull;
  const auto text = [&] { return warnings_of(case_result)[0].text; };
  EXPECT_TRUE(text().starts_with("its limit of 128 lights in the scene is exceeded in ")) << text();
  case_result.pre_cull->counts.steps.insert(case_result.pre_cull->counts.steps.begin(), PreCullCounts::Step{});
  case_result.pre_cull->counts.steps[0].label = "frustum";
  EXPECT_TRUE(text().starts_with("its limit of 128 lights in view is exceeded in ")) << text();
}

std::vector<Warning::Kind> warned(const CaseResult& case_result) {
  std::vector<Warning::Kind> out;
  for (const Warning& warning : warnings_of(case_result)) out.push_back(warning.kind);
  return out;
}

TEST(Gate, warns_of_what_fails_nothing_and_takes_a_case_from_the_front_where_its_lists_are_no_merit) {
  using Of = Warning::Kind;
  CaseResult case_result = with_cells();
  EXPECT_TRUE(warned(case_result).empty());
  EXPECT_TRUE(is_eligible(case_result));
  miss(case_result, 1, 0);
  EXPECT_TRUE(warned(case_result).empty()) << "a thousandth is rounding";
  EXPECT_TRUE(is_eligible(case_result));
  miss(case_result, 2, 0);
  EXPECT_EQ(warned(case_result), (std::vector{Of::unlit}));
  EXPECT_FALSE(is_eligible(case_result));
  case_result = with_cells();
  case_result.buffers.dropped_pairs = 1;
  EXPECT_EQ(warned(case_result), (std::vector{Of::dropped_pairs}));
  EXPECT_FALSE(is_eligible(case_result)) << "whatever the limits allow";
  case_result = with_cells();
  case_result.error->undecided = 1;
  EXPECT_EQ(warned(case_result), (std::vector{Of::undecided}));
  EXPECT_TRUE(is_eligible(case_result));
  case_result = with_cells();
  case_result.error->false_negatives = 1;
  case_result.conservative = false;
  EXPECT_EQ(warned(case_result), (std::vector{Of::lost_pairs}));
  EXPECT_FALSE(is_eligible(case_result)) << "a naive method's";
  case_result = with_cells();
  case_result.conservative = case_result.exact = false;
  EXPECT_FALSE(is_eligible(case_result)) << "that it lost nothing here is luck";
  case_result.preset = "engine";
  EXPECT_TRUE(is_eligible(case_result)) << "presets are judged by what they lose";
  case_result = with_cells();
  case_result.error.reset();
  EXPECT_EQ(warned(case_result), (std::vector{Of::unchecked}));
  EXPECT_TRUE(warned(without_cells()).empty()) << "nothing to check";
  case_result = with_cells();
  case_result.failures = {{Kind::extra_pairs, ""}};
  EXPECT_FALSE(is_eligible(case_result));
}

Contender contender(const std::string& id, double time_ns, const std::string& view = "view") {
  return {id, "hall", view, {{time_ns, time_ns}, 100.0, 1.5}, true, "grid", "", {}, 1, false};
}

TEST(OnFront, cases_beat_each_other_within_one_scene_and_view) {
  EXPECT_EQ(on_front(std::vector{contender("slow", 2), contender("fast", 1), contender("else", 3, "other view")}, 1),
            (std::vector<std::string>{"else", "fast"}));
}

TEST(OnFront, what_is_not_eligible_beats_nothing) {
  std::vector<Contender> all{contender("slow", 2), contender("fast", 1)};
  all[1].is_eligible = false;
  EXPECT_EQ(on_front(all, 1), (std::vector<std::string>{"slow"}));
}

// Three launches of two rounds: times double from launch to launch, so that their intervals hold each other.
Contender in_launches(const std::string& id, double factor, const std::string& grid) {
  Contender one = contender(id, 0.0);
  one.grid = grid;
  one.launches = 3;
  for (const double ns : {1000.0, 1010.0, 2000.0, 2010.0, 1500.0, 1510.0}) one.rounds_ns.push_back(factor * ns);
  const measure::TimeStats stats = measure::time_stats(one.rounds_ns, 1, 3);
  one.costs.time_ns = stats.ci95;
  return one;
}

TEST(OnFront, times_of_the_same_rounds_or_launches_are_told_apart_by_their_ratio) {
  const Contender fast = in_launches("fast", 1.0, "grid"), slow = in_launches("slow", 1.1, "grid"),
                  elsewhere = in_launches("elsewhere", 1.1, "another grid");
  ASSERT_GT(fast.costs.time_ns.high, slow.costs.time_ns.low) << "intervals overlap";
  EXPECT_EQ(on_front(std::vector{slow, fast}, 1), (std::vector<std::string>{"fast"}));
  EXPECT_EQ(on_front(std::vector{elsewhere, fast}, 1), (std::vector<std::string>{"fast"})) << "by the same launches";
}

TEST(OnFront, times_of_two_sessions_have_no_ratio) {
  const Contender fast = in_launches("fast", 1.0, "grid");
  Contender slow = in_launches("slow", 1.1, "grid");
  EXPECT_TRUE(ratio_between(slow, fast, 1));
  slow.session = "another";
  EXPECT_FALSE(ratio_between(slow, fast, 1));
  EXPECT_EQ(on_front(std::vector{slow, fast}, 1), (std::vector<std::string>{"slow", "fast"}));
}

TEST(OnFront, times_without_a_ratio_are_told_apart_by_their_intervals) {
  const Contender fast = in_launches("fast", 1.0, "grid");
  Contender slow = in_launches("slow", 1.1, "grid");
  slow.is_cold = true;
  EXPECT_FALSE(ratio_between(fast, slow, 1));
  EXPECT_EQ(on_front(std::vector{slow, fast}, 1), (std::vector<std::string>{"slow", "fast"}));
}

}  // namespace
}  // namespace clusterbench::run
