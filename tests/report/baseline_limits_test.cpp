// Budgets in percent against an earlier result, also of a level that has changed, and the lights of both.

#include <gtest/gtest.h>

#include "report/gates/baseline_cases.h"
#include "report/gates/light_gate.h"
#include "report/gates/limits.h"
#include "report/result_by_hand.h"
#include "report/results/result_record.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::Result;
using Lines = std::vector<std::string>;

Result baseline_record(const run::Result& result = testing::result_by_hand()) {
  return record_of(result, {});
}

// Of a level that has another file and other lights, with so many more in the longest list of `aabb`.
Result changed_level(std::uint64_t longest) {
  run::Result result = testing::result_by_hand();
  result.scenes[0].sha256 = std::string(64, 'c');
  result.scenes[0].points = 12;
  result.scenes[0].light_digest = std::string(16, 'd');
  for (run::CaseResult& changed : result.cases) changed.id += " changed";
  result.planned_ids = {"slow changed", "fast changed"};
  result.cases[1].occupancy->lights_per_cell.max = static_cast<double>(longest);
  return record_of(result, {});
}

LimitFindings against(const Result& base, const Result& result, const std::string& rule,
                      const std::string& filter = "") {
  const config::LimitRule rules[] = {config::limit_rule(rule, "", "--fail-if")};
  const BaselineCases cases(base, result, filter, "base.json");
  return limit_findings(result, rules, &cases);
}

TEST(BaselineLimits, fail_by_the_change_in_percent_and_say_both_numbers) {
  const Result base = baseline_record(), next = changed_level(8);
  EXPECT_EQ(against(base, next, "longest > +5 %").broken,
            (Lines{"hall/walk/frustum 64px/aabb/packed: longest is 8 (frame 1, cell [1,1,1]), +14.3 % against 7 in "
                   "base.json, and fails with longest > +5 %"}));
  EXPECT_EQ(against(base, next, "longest > +15 %").broken, Lines{});
  EXPECT_EQ(against(base, next, "longest > +15 %").checked, 2u);
  EXPECT_EQ(against(base, changed_level(6), "longest < -10 %").broken.size(), 1u);
  EXPECT_EQ(against(base, changed_level(6), "longest -10..+10 %").broken.size(), 1u);
}

TEST(BaselineLimits, of_a_changed_level_say_what_has_changed) {
  const Lines warnings = against(baseline_record(), changed_level(7), "longest > +5 %").warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0],
            "changed since base.json (2 cases): the scene itself (sha256), its lights (9 points, 1 spot, now 12 "
            "points, 1 spot); hall/walk/frustum 64px/brute-force/packed, hall/walk/frustum "
            "64px/aabb/packed");
  EXPECT_EQ(against(baseline_record(), baseline_record(), "longest > +5 %").warnings, Lines{});
}

TEST(BaselineLimits, match_a_renamed_scene_where_each_result_has_one) {
  Result next = changed_level(8);
  next.scenes[0].name = "hall-v2";
  for (Case& result_case : next.cases) result_case.scene = "hall-v2";
  EXPECT_EQ(against(baseline_record(), next, "longest > +5 %").broken.size(), 1u);
}

TEST(BaselineLimits, from_nothing_are_exceeded_by_anything) {
  run::Result base = testing::result_by_hand();
  base.cases[1].occupancy->lights_per_cell.max = 0.0;
  const Lines broken = against(baseline_record(base), baseline_record(), "aabb: longest > +5 %").broken;
  ASSERT_EQ(broken.size(), 1u);
  EXPECT_NE(broken[0].find("longest is 7 (frame 1, cell [1,1,1]), was 0 in base.json"), std::string::npos) << broken[0];
}

TEST(BaselineLimits, that_match_nothing_fail_on_either_side) {
  Result fewer = baseline_record();
  fewer.cases.pop_back();
  EXPECT_EQ(against(fewer, baseline_record(), "longest > +5 %").broken,
            (Lines{"'longest > +5 %' could not be checked for 1 case that base.json does not have (of that camera, "
                   "viewport, grid, method and structure): hall/walk/frustum 64px/aabb/packed; measure the baseline "
                   "again, or name cases before a colon"}));
  EXPECT_EQ(against(baseline_record(), fewer, "longest > +5 %").broken,
            (Lines{"'longest > +5 %' could not be checked for 1 case of base.json that this result does not have: "
                   "hall/walk/frustum 64px/aabb/packed; measure the baseline again, or name cases before a colon"}));
  EXPECT_EQ(against(baseline_record(), fewer, "longest > +5 %", "brute").broken, Lines{}) << "--filter leaves it out";
  EXPECT_EQ(against(baseline_record(), fewer, "brute: longest > +5 %").broken, Lines{});
  const config::LimitRule rules[] = {config::limit_rule("longest > +5 %", "", "--fail-if")};
  EXPECT_EQ(limit_findings(fewer, rules).broken,
            (Lines{"'longest > +5 %' could not be checked: there is no baseline (--baseline FILE)"}));
}

TEST(BaselineLimits, of_instructions_hold_only_what_was_counted_alike) {
  run::Result base = testing::result_by_hand(), next = base;
  for (run::Result* result : {&base, &next})
    for (run::CaseResult& counted : result->cases) testing::add_count(counted);
  next.cases[1].count->assign.instructions = 44000;  // of 40,000; 3,001 of conversion beside them
  const Result before = baseline_record(base), now = baseline_record(next);
  EXPECT_EQ(against(before, now, "instructions > +9 %").broken.size(), 1u);
  EXPECT_EQ(against(before, now, "instructions > +9.5 %").broken, Lines{}) << "of both together it is 9.3 %";
  EXPECT_EQ(against(before, now, "assign_instructions > +9.5 %").broken.size(), 1u);
  EXPECT_EQ(against(before, now, "convert_instructions > +0.1 %").broken, Lines{});
  next.machine.cpu = "another processor";
  const Lines broken = against(before, baseline_record(next), "instructions > +50 %").broken;
  ASSERT_EQ(broken.size(), 1u);
  EXPECT_NE(broken[0].find("instructions do not compare, /machine/cpu is \"a processor\" and \"another processor\""),
            std::string::npos)
      << broken[0];
  EXPECT_EQ(against(before, baseline_record(next), "longest > +5 %").broken, Lines{})
      << "counts are the same everywhere";
  EXPECT_EQ(against(baseline_record(), now, "instructions > +5 %").broken.size(), 1u) << "the base has none";
}

TEST(BaselineLimits, of_a_figure_that_the_baseline_is_too_old_for_fail_and_say_so) {
  Result older = baseline_record();
  for (Case& result_case : older.cases) result_case.lights_lit.reset();
  EXPECT_EQ(
      against(older, baseline_record(), "lights_lit < -10 %").broken,
      (Lines{"'lights_lit < -10 %' could not be checked for 2 cases, since only one of this result and base.json "
             "has lights_lit (a result of an older version tells none): hall/walk/frustum 64px/brute-force/packed, "
             "hall/walk/frustum 64px/aabb/packed"}));
}

Result with_costs(double ns_per_light, double opaque_weight = 1.0) {
  Result result = baseline_record();
  result.config["cost"] = {{"ns_per_light", ns_per_light}, {"weights", {{"volume", 1.0}, {"opaque", opaque_weight}}}};
  result.config["allocation"] = {{"margin", 2.0}};
  for (Case& result_case : result.cases) {
    result_case.cost.emplace().gpu_ns = 1e9 * ns_per_light;
    result_case.cost->sets = {{"opaque", {}}};
  }
  return result;
}

TEST(BaselineLimits, of_modelled_costs_are_not_checked_at_other_prices) {
  const Result base = with_costs(0.25);
  EXPECT_EQ(against(base, with_costs(0.5), "gpu_cost_us > +3 %").broken,
            (Lines{"'gpu_cost_us > +3 %' could not be checked: cost.ns_per_light is 0.5 here and 0.25 in base.json; "
                   "measure the baseline again"}));
  EXPECT_EQ(against(with_costs(0.5), base, "gpu_cost_us > +3 %").broken.size(), 1u) << "cheaper by its prices alone";
  EXPECT_EQ(against(base, with_costs(0.25, 2.0), "gpu_cost_us > +3 %").broken,
            (Lines{"'gpu_cost_us > +3 %' could not be checked: cost.weights.opaque is 2.0 here and 1.0 in base.json; "
                   "measure the baseline again"}));
  Result older = base;
  older.config["cost"].erase("ns_per_light");
  EXPECT_EQ(against(older, base, "gpu_cost_us > +3 %").broken,
            (Lines{"'gpu_cost_us > +3 %' could not be checked: cost.ns_per_light is 0.25 here and not set in "
                   "base.json; measure the baseline again"}));
  EXPECT_EQ(against(base, with_costs(0.5), "longest > +3 %").broken, Lines{}) << "no figure of prices";
  EXPECT_EQ(against(base, base, "gpu_cost_us > +3 %").broken, Lines{});
  EXPECT_EQ(against(base, base, "gpu_cost_us > +3 %").checked, 2u);
}

TEST(BaselineLimits, of_modelled_costs_are_not_checked_at_other_samples) {
  Result base = with_costs(0.25), next = base;
  next.cases[1].cost->sets.emplace_back("fog", result::SetCost{});
  EXPECT_EQ(
      against(base, next, "gpu_cost_us > +3 %").broken,
      (Lines{"'gpu_cost_us > +3 %' could not be checked for hall/walk/frustum 64px/aabb/packed: gpu_cost_us is at "
             "samples of opaque, fog here and of opaque in base.json; measure the baseline again"}));
}

TEST(BaselineLimits, of_recommended_sizes_are_not_checked_at_another_margin) {
  const Result base = with_costs(0.25);
  Result next = base;
  next.config["allocation"]["margin"] = 1.5;
  for (const std::string figure : {"bytes_recommended", "entries_recommended"})
    EXPECT_EQ(against(base, next, figure + " > +3 %").broken,
              (Lines{"'" + figure +
                     " > +3 %' could not be checked: allocation.margin is 1.5 here and 2.0 in "
                     "base.json; measure the baseline again"}));
  EXPECT_EQ(against(base, next, "bytes > +3 %").broken, Lines{});
  EXPECT_EQ(against(base, base, "bytes_recommended > +3 %").checked, 2u);
}

// A mean over several sets of samples is by their weights, also where the rest of the price is the same.
TEST(BaselineLimits, of_means_over_several_sets_are_not_checked_at_other_weights) {
  const auto two_sets = [](double weight) {
    Result result = with_costs(0.25, weight);
    for (Case& result_case : result.cases) {
      result_case.samples.emplace().opaque =
          result::SampleSet{.samples = 10, .evaluated = 30, .needed = 20, .missed = 0};
      result_case.cost->sets = {{"volume", {.samples = 1.0}}, {"opaque", {.samples = weight}}};
    }
    return result;
  };
  EXPECT_EQ(against(two_sets(1.0), two_sets(2.0), "evaluated > +3 %").broken,
            (Lines{"'evaluated > +3 %' could not be checked: cost.weights.opaque is 2.0 here and 1.0 in base.json; "
                   "measure the baseline again"}));
  EXPECT_EQ(against(two_sets(1.0), two_sets(2.0), "opaque.evaluated > +3 %").checked, 2u);
}

TEST(LightGate, fails_where_the_lights_are_not_those_of_the_baseline) {
  const Result base = baseline_record(), next = changed_level(7);
  const LightGate gate{.base = &base, .base_name = "base.json"};
  EXPECT_EQ(light_findings(next, gate).broken,
            (Lines{"hall: its lights are not those of base.json: 9 points, 1 spot then, 12 points, 1 spot now "
                   "(--allow-changed-lights, limits.allow_changed_lights, if that is meant)"}));
  EXPECT_EQ(light_findings(base, gate).broken, Lines{});
  const LightGate allowing{.allows_changed_lights = true, .base = &base, .base_name = "base.json"};
  EXPECT_EQ(light_findings(next, allowing).broken, Lines{});
  EXPECT_EQ(light_findings(next, allowing).warnings.size(), 1u) << "it is told all the same";
}

TEST(LightGate, tells_moved_lights_by_their_digest_and_older_results_by_their_number) {
  const Result next = baseline_record();
  Result base = next;
  const auto gate = [&] { return LightGate{.base = &base, .base_name = "base.json"}; };
  base.scenes[0].light_digest = "another";
  ASSERT_EQ(light_findings(next, gate()).broken.size(), 1u);
  EXPECT_NE(light_findings(next, gate()).broken[0].find("still 9 points, 1 spot, some of them moved or changed"),
            std::string::npos);
  base.scenes[0].light_digest.reset();
  EXPECT_EQ(light_findings(next, gate()).broken, Lines{});
  EXPECT_EQ(light_findings(next, gate()).warnings.size(), 1u) << "not sure";
  base.scenes[0].lights.point = 8;
  EXPECT_EQ(light_findings(next, gate()).broken.size(), 1u);
}

TEST(LightGate, tells_a_camera_that_has_another_path) {
  const auto with_path = [](double to_s, const char* digest) {
    Result out = baseline_record();
    for (Case& result_case : out.cases) result_case.camera_path = {0.0, to_s, digest};
    return out;
  };
  const Result base = with_path(15.0, "a");
  const LightGate gate{.base = &base, .base_name = "base.json"};
  EXPECT_EQ(light_findings(with_path(15.0, "a"), gate).warnings, Lines{});
  EXPECT_EQ(light_findings(with_path(7.5, "b"), gate).warnings,
            (Lines{"the path of camera walk in hall has changed: 0 to 15 s, now 0 to 7.5 s, so budgets against "
                   "base.json compare other views"}));
  EXPECT_EQ(light_findings(with_path(15.0, "b"), gate).warnings.size(), 1u) << "as long, and another way";
  EXPECT_EQ(light_findings(with_path(7.5, "b"), gate).broken, Lines{});
}

TEST(LightGate, fails_where_there_are_no_lights_or_none_is_ever_in_view) {
  Result result = baseline_record();
  EXPECT_EQ(light_findings(result, {}).broken, Lines{});
  for (Case& result_case : result.cases) result_case.lights_in_view->max = 0;
  EXPECT_EQ(light_findings(result, {}).broken,
            (Lines{"hall, camera walk: none of 10 lights is ever in view, so budgets say nothing of it "
                   "(--allow-no-lights, limits.allow_no_lights, if that is meant)"}));
  for (Case& result_case : result.cases) result_case.lights = 0;
  EXPECT_EQ(light_findings(result, {}).broken, (Lines{"hall: has no point or spot lights, so budgets say nothing of it "
                                                      "(--allow-no-lights, limits.allow_no_lights, if "
                                                      "that is meant)"}));
  EXPECT_EQ(light_findings(result, {.allows_no_lights = true}).broken, Lines{});
  EXPECT_EQ(light_findings(result, {.allows_no_lights = true}).warnings.size(), 1u);
}

// Of the ten lights of the level so many shine, and so many of these in view.
void set_lit(Result& result, std::uint64_t lit, std::uint64_t seen) {
  result.scenes[0].lights.dark = 10 - lit;
  for (Case& result_case : result.cases) {
    result_case.lights_lit = lit;
    result_case.lights_seen = seen;
  }
}

TEST(LightGate, fails_where_all_lights_are_dark) {
  Result result = baseline_record();
  set_lit(result, 7, 5);
  EXPECT_EQ(light_findings(result, {}).broken, Lines{});
  EXPECT_EQ(light_findings(result, {}).warnings, Lines{}) << "the scene's own warnings tell of some";
  const Result base = baseline_record();
  result.scenes[0].light_digest = "another";
  const Lines fewer = light_findings(result, {.base = &base, .base_name = "base.json"}).broken;
  ASSERT_EQ(fewer.size(), 1u);
  EXPECT_NE(fewer[0].find("9 points, 1 spot then, 9 points, 1 spot, 3 of them dark now"), std::string::npos)
      << fewer[0];
  set_lit(result, 0, 0);
  EXPECT_EQ(light_findings(result, {}).broken,
            (Lines{"hall: of 10 lights all are dark (intensity 0, black, or range 0), so budgets say nothing of it "
                   "(--allow-no-lights, limits.allow_no_lights, if that is meant)"}));
  EXPECT_EQ(light_findings(result, {.allows_no_lights = true}).broken, Lines{});
}

TEST(LightGate, fails_where_the_lights_in_view_are_dark_and_others_are_not) {
  Result result = baseline_record();
  set_lit(result, 4, 0);
  EXPECT_EQ(light_findings(result, {}).broken,
            (Lines{"hall, camera walk: none of 4 lit lights is ever in view (of 10 lights 6 are dark: intensity 0, "
                   "black, or range 0), so budgets say nothing of it (--allow-no-lights, limits.allow_no_lights, if "
                   "that is meant)"}));
  EXPECT_EQ(light_findings(result, {.allows_no_lights = true}).broken, Lines{});
  set_lit(result, 4, 1);
  EXPECT_EQ(light_findings(result, {}).broken, Lines{});
}

TEST(LightGate, takes_lights_of_older_results_as_lit) {
  Result result = baseline_record();
  for (Case& result_case : result.cases)
    for (auto* count : {&result_case.lights_lit, &result_case.lights_seen}) count->reset();
  EXPECT_EQ(light_findings(result, {}).broken, Lines{});
  EXPECT_EQ(light_findings(result, {}).warnings, Lines{});
}

// Its level as a second one, "attic", behind the first.
Result with_attic(Result result) {
  result.scenes.push_back(result.scenes[0]);
  result.scenes.back().name = "attic";
  for (std::size_t i = 0, count = result.cases.size(); i < count; ++i) {
    Case copy = result.cases[i];
    copy.scene = "attic";
    copy.name = "attic" + copy.name.substr(4);
    result.cases.push_back(copy);
  }
  return result;
}

TEST(LightGate, fails_where_a_level_or_a_camera_of_the_baseline_is_missing) {
  const Result base = with_attic(baseline_record()), both = base, hall = baseline_record();
  const LightGate gate{.base = &base, .base_name = "base.json"};
  EXPECT_EQ(light_findings(both, gate).broken, Lines{});
  EXPECT_EQ(light_findings(hall, gate).broken,
            (Lines{"attic: was measured in base.json, and this result has no case of it, so budgets say nothing of it; "
                   "measure it or the baseline again, or leave it out (--filter)"}));
  Result renamed = hall;
  renamed.scenes[0].name = "hall-v2";
  for (Case& result_case : renamed.cases) result_case.scene = "hall-v2";
  EXPECT_EQ(light_findings(renamed, gate).broken.size(), 2u) << "of two levels, neither";
  const LightGate filtered{.base = &base, .base_name = "base.json", .filter = "^hall/"};
  EXPECT_EQ(light_findings(hall, filtered).broken, Lines{});
  Result other_camera = both;
  for (Case& result_case : other_camera.cases)
    if (result_case.scene == "attic") result_case.camera = "fly";
  const Lines broken = light_findings(other_camera, gate).broken;
  ASSERT_EQ(broken.size(), 1u);
  EXPECT_TRUE(broken[0].starts_with("attic, camera walk: was measured in base.json")) << broken[0];
  Result other_viewport = both;
  for (Case& result_case : other_viewport.cases) result_case.viewport = {640, 360};
  EXPECT_EQ(light_findings(other_viewport, gate).broken.size(), 2u) << "nothing is compared";
  EXPECT_TRUE(light_findings(other_viewport, gate).broken[0].starts_with("hall, camera walk, 1920x1080: was measured"))
      << light_findings(other_viewport, gate).broken[0];
}

TEST(LightGate, fails_where_a_case_of_the_baseline_cannot_be_measured_any_more) {
  const Result base = baseline_record();
  Result next = baseline_record();
  next.cases.erase(next.cases.begin());
  const auto broken = [&](const std::string& filter = "") {
    return light_findings(next, {.base = &base, .base_name = "base.json", .filter = filter}).broken;
  };
  EXPECT_EQ(broken(), Lines{}) << "a configuration may have fewer methods";
  next.skipped.push_back({"hall/walk/frustum 64px/brute", "another method", {}});
  EXPECT_EQ(broken(), Lines{});
  next.skipped.push_back({"hall/walk/frustum 64px/brute-force", "no driver", {}});
  EXPECT_EQ(broken(), (Lines{"hall/walk/frustum 64px/brute-force: was measured in base.json (1 case) and not here: no "
                             "driver"}));
  EXPECT_EQ(broken("/aabb/"), Lines{}) << "what is filtered out is not missed";
  Result packed = base;  // of lights in another precision, whose name follows the storage's
  packed.cases[0].name += "/half";
  next.skipped = {{"hall/walk/frustum 64px/brute-force/half", "no driver", {}}};
  EXPECT_EQ(light_findings(next, {.base = &packed, .base_name = "base.json"}).broken.size(), 1u);
  next.skipped = {{"hall/walk/frustum 64px/half", "no driver", {}}};
  EXPECT_EQ(light_findings(next, {.base = &packed, .base_name = "base.json"}).broken, Lines{});
  // A structure that has nothing of its grid is measured in one grid; others are lost where theirs is skipped.
  for (const char* method : {"bvh", "z-binning"}) {
    Result own = base;
    own.cases[0].storage = "own";
    own.cases[0].assigner.name = method;
    Result elsewhere = own;
    elsewhere.cases[0].name = "hall/walk/another grid/brute-force/own";
    elsewhere.skipped = {{"hall/walk/frustum 64px/brute-force", "a reason", {}}};
    EXPECT_EQ(light_findings(elsewhere, {.base = &own, .base_name = "base.json"}).broken.size(),
              std::string_view(method) == "bvh" ? 0u : 1u)
        << method;
  }
}

TEST(LightGate, fails_where_nothing_of_a_level_could_be_measured) {
  Result result = with_attic(baseline_record());
  for (std::size_t i = 0; i < 2; ++i) {
    result.skipped.push_back({result.cases.back().name, "slices.count: must be at least 1", {}});
    result.cases.pop_back();
  }
  EXPECT_EQ(light_findings(result, {}).broken,
            (Lines{"attic/walk: none of its 2 combinations could be measured, so budgets say nothing of it: "
                   "slices.count: must be at least 1"}));
  EXPECT_EQ(light_findings(result, {.allows_no_lights = true}).broken.size(), 1u) << "it has lights";
  result.scenes[1].lights.point = result.scenes[1].lights.spot = 0;
  const Lines broken = light_findings(result, {}).broken;
  ASSERT_EQ(broken.size(), 1u);
  EXPECT_TRUE(broken[0].starts_with("attic/walk: has no point or spot lights, and none of its 2 combinations"))
      << broken[0];
  EXPECT_EQ(light_findings(result, {.allows_no_lights = true}).broken, Lines{});
  Result one_left = with_attic(baseline_record());
  one_left.skipped.push_back({"attic/walk/frustum/brute-force/packed", "too many pairs", {}});
  one_left.skipped.push_back({"hall/samples visible", "the scene has no triangles", {}});
  EXPECT_EQ(light_findings(one_left, {}).broken, Lines{});
}

}  // namespace
}  // namespace clusterbench::report
