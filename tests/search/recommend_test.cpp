#include "search/recommend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "run/walk.h"
#include "search/recommend_space.h"

namespace clusterbench::search {
namespace {

using run::testing::Walk;

constexpr const char* k_space = R"("grids": [{"kind": "frustum", "tiles": {"pixels": [25, 50, 100]},
    "slices": {"scheme": "exponential", "count": [2, 4, 8, 16]}}],
    "assigners": ["bounds", "aabb", "exact"], "storages": ["packed", "bitfield"], "shading": {"samples": 16})";

Walk small_walk(int frames) {
  Walk walk(k_space, frames);
  for (int i = 0; i < 12; ++i)
    walk.add_light({0.3 * i - 2.0, 0.2 * (i % 5) - 0.4, -3.0 - 0.9 * i}, 1.0 + 0.2 * (i % 3));
  return walk;
}

double entries(std::span<const run::CaseResult> cases) {
  double most = 0.0;
  for (const run::CaseResult& one : cases)
    most = std::max(most, static_cast<double>(one.buffers.index_entries.high_water));
  return most;
}

// The least entries of all candidates that `evaluate` lets pass, over all frames, by run_plan().
double least_of_all(const Walk& walk, const Evaluate& evaluate) {
  std::map<std::string, std::vector<run::CaseResult>> candidates;
  for (const run::CaseResult& one : walk.run().cases) candidates[one.name.substr(one.name.find("grid"))].push_back(one);
  double least = 1e300;
  for (const auto& [name, cases] : candidates)
    if (const Verdict verdict = evaluate(cases); verdict.broken.empty()) least = std::min(least, verdict.objective);
  return least;
}

Found searched(Walk& walk, const Request& request, bool is_stopped = false) {
  std::vector<View> views = views_of(walk.config, walk.plan);
  EXPECT_EQ(views.size(), 1u);
  const std::atomic<bool> stop{is_stopped};
  return search_view(walk.config, walk.plan, views[0], request, {}, {{}, stop});
}

double best_of(const Found& found) {
  double best = 1e300;
  for (const Finalist& finalist : found.finalists)
    if (const Verdict& verdict = found.records[finalist.candidate].verdict; verdict.broken.empty())
      best = std::min(best, verdict.objective);
  return best;
}

TEST(SearchView, finds_the_least_high_water_mark_and_measures_all_frames_of_the_last_ones) {
  Walk walk = small_walk(20);
  const Evaluate evaluate = [](std::span<const run::CaseResult> cases) {
    return Verdict{entries(cases), 0.0, {}, false};
  };
  const Found found = searched(walk, {.evaluate = evaluate, .only_grows = true, .keep_one_in = 24, .least = 1});
  EXPECT_TRUE(found.is_complete);
  EXPECT_EQ(best_of(found), least_of_all(walk, evaluate));
  for (const Finalist& finalist : found.finalists) EXPECT_EQ(finalist.cases[0].frames, 20);
  EXPECT_EQ(found.work.all_evaluations, 72u * 20);
}

TEST(SearchView, has_measured_what_it_planned_when_it_is_stopped_before_the_last_frames) {
  Walk walk = small_walk(20);
  const Evaluate evaluate = [](std::span<const run::CaseResult> cases) {
    return Verdict{entries(cases), 0.0, {}, false};
  };
  const Request request{.evaluate = evaluate, .keep_one_in = 24, .least = 2};
  std::vector<View> views = views_of(walk.config, walk.plan);
  const Halving planned = planned_halving(views[0], request);
  ASSERT_EQ(planned.rungs.size(), 2u);
  EXPECT_EQ(planned.rungs[0].candidates, 72u);
  EXPECT_EQ(planned.finalists.size(), 2u);
  std::atomic<bool> stop = false;
  std::vector<double> shares;
  std::vector<std::string> stages;
  const Watch watch{[&](const run::Progress& now) { shares.push_back(now.cost_done / now.cost_total); }, stop,
                    [&](const std::string& stage) {
                      stages.push_back(stage);
                      stop = stage.find("all 20 frames") != std::string::npos;
                    }};
  const Found found = search_view(walk.config, walk.plan, views[0], request, {}, watch);
  EXPECT_FALSE(found.is_complete);
  EXPECT_TRUE(found.finalists.empty());
  ASSERT_EQ(stages.size(), 4u) << "lights, two rungs, all frames";
  for (const Rung& rung : planned.rungs) {
    const auto on_frames = [&](const Record& record) { return record.frames >= rung.frames; };
    EXPECT_EQ(std::ranges::count_if(found.records, on_frames), static_cast<std::ptrdiff_t>(rung.candidates));
  }
  EXPECT_TRUE(std::ranges::is_sorted(shares)) << "of the whole search";
  EXPECT_LT(shares.back(), 1.0);
}

TEST(SearchView, tells_how_far_the_whole_search_is_also_while_the_last_ones_are_timed) {
  Walk walk = small_walk(6);
  walk.config.timing = {.measure = true, .rounds = 2, .min_time_ms = 0.01, .frames = 2, .launches = 1, .sweep_mib = 4};
  const Evaluate evaluate = [](std::span<const run::CaseResult> cases) {
    return Verdict{entries(cases), 0.0, {}, false};
  };
  std::vector<View> views = views_of(walk.config, walk.plan);
  const std::atomic<bool> stop = false;
  std::vector<double> shares;
  std::vector<std::string> doing;
  const Watch watch{[&](const run::Progress& now) {
                      shares.push_back(now.cost_done / now.cost_total);
                      doing.push_back(now.doing);
                    },
                    stop};
  const SearchCosts costs{.grid_ns = 5.0, .candidate_ns = 1.0, .last_timing_ns = 100.0};
  const Found found = search_view(walk.config, walk.plan, views[0],
                                  {.evaluate = evaluate, .is_timed = true, .least = 2}, {}, watch, costs);
  EXPECT_TRUE(found.is_complete);
  EXPECT_TRUE(std::ranges::is_sorted(shares)) << "of the whole search";
  EXPECT_GT(shares.back(), 0.8);
  EXPECT_LE(shares.back(), 1.0);
  EXPECT_TRUE(doing.back().starts_with("walk: all 6 frames: ")) << doing.back();
}

TEST(SearchView, counts_what_it_measured_once_and_so_never_more_than_all) {
  for (const std::size_t least : {1u, 6u, 100u}) {
    Walk walk = small_walk(20);
    const Evaluate evaluate = [](std::span<const run::CaseResult> cases) {
      return Verdict{entries(cases), 0.0, {}, false};
    };
    const Work work = searched(walk, {.evaluate = evaluate, .only_grows = true, .keep_one_in = 2, .least = least}).work;
    EXPECT_LE(work.evaluations, work.all_evaluations) << least;
    EXPECT_LE(work.tests, work.all_tests) << least;
    EXPECT_GE(work.measurements, work.evaluations + 20) << "the frames are ordered first";
    if (least == 100) {
      EXPECT_EQ(work.evaluations, work.all_evaluations) << "all are measured on all frames";
      EXPECT_EQ(work.tests, work.all_tests);
    }
  }
}

// The best at first is the worst in the end; only the bound of a mark that grows tells.
TEST(SearchView, looks_again_at_what_was_dropped_while_it_could_still_be_better) {
  Walk walk = small_walk(20);
  const Evaluate evaluate = [](std::span<const run::CaseResult> cases) {
    const bool turns = cases[0].grid["cells"][2] == 16;  // poor at first, and no worse later
    const double frames = cases[0].frames;
    return Verdict{turns ? 10.0 : 9.0 + 0.1 * (frames - 1.0), 0.0, {}, false};
  };
  const Found found = searched(walk, {.evaluate = evaluate, .only_grows = true, .keep_one_in = 24, .least = 1});
  EXPECT_GT(found.challengers, 0u);
  EXPECT_EQ(best_of(found), 10.0);
  EXPECT_EQ(searched(walk, {.evaluate = evaluate, .keep_one_in = 24, .least = 1}).challengers, 0u);
}

TEST(SearchView, a_constraint_on_an_unknown_figure_is_broken_only_if_no_frame_has_the_figure) {
  Walk walk = small_walk(20);
  for (const int known_from : {2, 100}) {
    const Evaluate evaluate = [known_from](std::span<const run::CaseResult> cases) {
      Verdict verdict{entries(cases), 0.0, {1}, false, {7.0}};
      if (cases[0].frames < known_from) verdict.unknown = {0, 2};
      return verdict;
    };
    const Found found = searched(walk, {.evaluate = evaluate, .keep_one_in = 24, .least = 2});
    ASSERT_FALSE(found.finalists.empty());
    for (std::size_t i = 0; i < found.records.size(); ++i) {
      const Verdict& verdict = found.records[i].verdict;
      const bool is_unknown = found.records[i].frames == 20 && known_from == 100;
      EXPECT_EQ(verdict.broken, is_unknown ? (std::vector<std::size_t>{0, 1, 2}) : std::vector<std::size_t>{1});
      ASSERT_EQ(verdict.broken_by.size(), verdict.broken.size());
      EXPECT_EQ(verdict.broken_by[is_unknown ? 1 : 0], 7.0);
      if (!is_unknown) continue;
      EXPECT_TRUE(std::isnan(verdict.broken_by[0]) && std::isnan(verdict.broken_by[2]));
    }
  }
}

TEST(SearchView, measures_nothing_again_that_is_out) {
  Walk walk = small_walk(12);
  std::map<std::string, int> evaluated;
  const Evaluate evaluate = [&](std::span<const run::CaseResult> cases) {
    ++evaluated[cases[0].name];
    const bool is_out = cases[0].assigner != "exact";
    return Verdict{entries(cases), 0.0, is_out ? std::vector<std::size_t>{0} : std::vector<std::size_t>{}, is_out};
  };
  const Found found = searched(walk, {.evaluate = evaluate, .only_grows = true});
  EXPECT_EQ(found.rungs[0].out, 48u);
  for (const auto& [name, count] : evaluated) {
    const bool is_exact = name.find("-2-") != std::string::npos;
    EXPECT_TRUE(is_exact || count == 1) << name;
  }
  for (const Finalist& finalist : found.finalists) EXPECT_EQ(finalist.cases[0].assigner, "exact");
}

TEST(SearchView, keeps_what_breaks_a_mean_behind_all_others_as_more_frames_can_mend_it) {
  Walk walk = small_walk(12);
  const Evaluate evaluate = [](std::span<const run::CaseResult> cases) {
    const bool is_broken = cases[0].frames < 12 && cases[0].assigner != "exact";
    const double objective = cases[0].assigner == "exact" ? 2.0 : 1.0;
    return Verdict{objective, 0.0, is_broken ? std::vector<std::size_t>{0} : std::vector<std::size_t>{}, false};
  };
  const Found found = searched(walk, {.evaluate = evaluate});
  ASSERT_FALSE(found.finalists.empty());
  EXPECT_EQ(found.rungs[0].out, 0u);
  EXPECT_EQ(best_of(found), 2.0) << "they came first while the others broke it";
}

TEST(SearchView, adds_the_best_of_coarse_grids_that_are_within_the_share) {
  Walk walk = small_walk(12);
  const Evaluate evaluate = [](std::span<const run::CaseResult> cases) {
    const bool is_coarsest = cases[0].grid["cells"] == nlohmann::json{1, 1, 2};
    const double bytes = cases[0].grid["cells"][0].get<double>() * 100.0 + cases[0].grid["cells"][2].get<double>();
    return Verdict{is_coarsest ? 1.04 : 1.0, bytes, {}, false};
  };
  const auto has_coarsest = [](const Found& found) {
    return std::ranges::any_of(found.finalists, [](const Finalist& finalist) {
      return finalist.cases[0].grid["cells"] == nlohmann::json{1, 1, 2};
    });
  };
  EXPECT_TRUE(has_coarsest(searched(walk, {.evaluate = evaluate, .within = 0.05})));
  EXPECT_FALSE(has_coarsest(searched(walk, {.evaluate = evaluate, .within = 0.03})));
}

TEST(SearchView, measures_candidates_on_all_cameras_and_leaves_out_what_one_of_them_lacks) {
  Walk walk = small_walk(6);
  scene::CameraPath other = walk.plan.scenes[0].paths[0];
  other.camera = "other";
  other.shots.resize(3);
  walk.plan.scenes[0].paths.push_back(other);
  std::vector<run::GroupPlan> second = walk.plan.groups;
  second.pop_back();
  for (run::GroupPlan& group : second) {
    group.camera = 1;
    for (run::CasePlan& plan : group.cases) {
      plan.camera = 1;
      plan.id += "-other";
    }
  }
  walk.plan.groups.insert(walk.plan.groups.end(), second.begin(), second.end());
  std::vector<View> views = views_of(walk.config, walk.plan);
  ASSERT_EQ(views.size(), 1u);
  EXPECT_EQ(views[0].frames, 9u);
  EXPECT_EQ(views[0].incomplete, 6u);
  EXPECT_EQ(views[0].candidates.size(), 66u);
  const Evaluate evaluate = [](std::span<const run::CaseResult> cases) {
    return Verdict{entries(cases), 0.0, {}, false};
  };
  const Found found = searched(walk, {.evaluate = evaluate, .only_grows = true});
  for (const Finalist& finalist : found.finalists) {
    ASSERT_EQ(finalist.cases.size(), 2u);
    EXPECT_EQ(finalist.cases[0].frames, 6);
    EXPECT_EQ(finalist.cases[1].frames, 3);
  }
}

// Frames of a part of the path have their own neighbours, from which it is told whether grids change.
TEST(SearchView, times_single_frames_of_a_path) {
  Walk walk = small_walk(6);
  walk.config.timing = {true, 2, 0.01, 2, 1, false};
  const Evaluate evaluate = [](std::span<const run::CaseResult> cases) {
    EXPECT_TRUE(cases[0].timing.has_value());
    return Verdict{cases[0].timing ? cases[0].timing->frame_ns.median : 0.0, 0.0, {}, false};
  };
  const Found found = searched(walk, {.evaluate = evaluate, .is_timed = true});
  EXPECT_FALSE(found.finalists.empty());
}

TEST(SearchView, lets_one_of_equals_go_on) {
  Walk walk = small_walk(40);
  const Evaluate evaluate = [](std::span<const run::CaseResult> cases) {
    const nlohmann::json& cells = cases[0].grid["cells"];
    return Verdict{100.0 * cells[0].get<double>() + cells[2].get<double>(),
                   static_cast<double>(cases[0].assigner.size()),
                   {},
                   false};
  };
  const Found found = searched(walk, {.evaluate = evaluate, .keep_one_in = 18, .least = 4});
  std::set<std::size_t> slices;
  for (const Finalist& finalist : found.finalists) {
    EXPECT_EQ(finalist.cases[0].assigner, "aabb") << "it is the smallest here";
    slices.insert(finalist.cases[0].grid["cells"][2].get<std::size_t>());
  }
  EXPECT_EQ(slices, (std::set<std::size_t>{2, 4, 8, 16})) << "of the best tile size, and not one grid in all its forms";
}

TEST(SearchView, lets_one_of_equals_in_all_grids_go_on) {
  Walk walk = small_walk(40);
  const Evaluate evaluate = [](std::span<const run::CaseResult> cases) {
    const bool is_exact = cases[0].assigner == "exact";  // as a structure that has nothing of its grid
    return Verdict{is_exact ? 1.0 : 2.0 + static_cast<double>(cases[0].grid["cells"][2].get<int>()), 7.0, {}, false};
  };
  const Found found = searched(walk, {.evaluate = evaluate, .within = -1.0, .keep_one_in = 18, .least = 4});
  const auto is_exact = [](const Finalist& finalist) { return finalist.cases[0].assigner == "exact"; };
  EXPECT_EQ(std::ranges::count_if(found.finalists, is_exact), 1);
  for (const Finalist& finalist : found.finalists) {
    if (!is_exact(finalist)) continue;
    EXPECT_EQ(finalist.cases[0].grid["cells"], (nlohmann::json{1, 1, 2})) << "of the fewest cells";
  }
}

TEST(SearchView, stops_when_it_is_to) {
  Walk walk = small_walk(6);
  const Evaluate evaluate = [](std::span<const run::CaseResult> cases) {
    return Verdict{entries(cases), 0.0, {}, false};
  };
  const Found found = searched(walk, {.evaluate = evaluate, .only_grows = true}, true);
  EXPECT_FALSE(found.is_complete);
  EXPECT_TRUE(found.finalists.empty());
}

TEST(SearchView, keeps_what_it_has_measured_of_the_stage_in_which_it_is_stopped) {
  for (const bool is_timed : {false, true}) {
    Walk walk = small_walk(20);
    walk.config.timing = {is_timed, 2, 0.01, 2, 1, false};
    std::atomic<bool> stop{false};
    std::set<std::string> grids;
    const Evaluate evaluate = [&](std::span<const run::CaseResult> cases) {
      grids.insert(cases[0].grid["cells"].dump());
      stop = stop || grids.size() == 3;
      return Verdict{entries(cases), 0.0, {}, false};
    };
    std::vector<View> views = views_of(walk.config, walk.plan);
    const Found found =
        search_view(walk.config, walk.plan, views[0], {.evaluate = evaluate, .is_timed = is_timed}, {}, {{}, stop});
    EXPECT_FALSE(found.is_complete);
    EXPECT_TRUE(found.finalists.empty());
    const auto is_measured = [](const Record& record) { return record.frames == 1; };
    EXPECT_EQ(std::ranges::count_if(found.records, is_measured), 3 * 6) << "three methods in two storages on each grid";
  }
}

TEST(RecommendSpace, has_conservative_methods_of_all_kinds_of_grids_and_fast_forms_alone) {
  const nlohmann::json space = recommend_space();
  const auto has = [&](const char* name) {
    return std::ranges::find(space["assigners"], name) != space["assigners"].end();
  };
  for (const char* name :
       {"exact-fast", "planes", "bvh", "z-binning", "world-grid-fast", "cascades-fast", "distance-fast"})
    EXPECT_TRUE(has(name)) << name;
  for (const char* name : {"exact", "aabb", "brute-force", "naive-planes", "tiled"}) EXPECT_FALSE(has(name)) << name;
  const config::Config config =
      config::parse_config(R"({"scenes": ["a.glb"], "storages": ["packed"]})", "c.json", {}, space);
  EXPECT_EQ(config.grids.size(), 113u);
  EXPECT_EQ(config.storages.size(), 1u) << "what a file names stays";
}

}  // namespace
}  // namespace clusterbench::search
