#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <set>
#include <thread>

#include "config/config.h"
#include "config/schema/documents.h"
#include "config/schema/schema_verdict.h"
#include "effort.h"
#include "geom/filter/light_filter.h"
#include "geom/light_meets_cell.h"
#include "geom/shapes/verdict.h"
#include "report/searches/stress_report.h"
#include "run/runner.h"
#include "stress/contact.h"
#include "stress/lost_light_search.h"
#include "stress/stress_run.h"

namespace clusterbench::stress {
namespace {

const std::atomic<bool> k_never{false};

StressResult stressed(const std::string& cases, const std::string& methods, int threads = 1) {
  StressRequest request;
  request.tries = 0;
  request.cases = Pattern(cases, "--cases");
  request.methods = Pattern(methods, "--methods");
  request.threads = threads;
  return run_stress(request, {}, k_never);
}

StressMethod method_named(const std::string& name, const std::map<std::string, assign::ParamValue>& params = {}) {
  const assign::AssignerDescriptor& row = *assign::find_assigner(name);
  const assign::Params resolved(row.params, params);
  return {name, &row, resolved, assign::is_conservative(row, resolved)};
}

SearchResult searched(const StressMethod& method, std::uint64_t tries) {
  StressRequest request;
  request.tries = tries;
  const std::unique_ptr<LostLightSearch> search = lost_light_search(method, request);
  while (!search->is_over()) search->climb(k_never);
  return search->result();
}

TEST(HardCases, are_all_of_h1_to_h35_but_the_search) {
  int number = 1;
  for (const HardCase& hard : hard_cases()) {
    if (number == 31) ++number;
    EXPECT_EQ(hard.id, "H" + std::to_string(number++));
    EXPECT_TRUE(hard.trials != nullptr || hard.checks != nullptr) << hard.id;
  }
  EXPECT_EQ(number, 36);
}

TEST(HardCases, lose_nothing_in_conservative_methods_and_name_what_naive_ones_lose) {
  const StressResult result = stressed(test::k_sanitized ? "H(3|32|35)" : "H(3|4|5|22|30|32|35)", ".*");
  EXPECT_EQ(report::stress_failures(result), std::vector<std::string>{});
  std::set<std::string> losers;
  for (const StressCell& cell : result.cells)
    if (cell.hard_case == "H32" && cell.lost()) losers.insert(cell.method);
  EXPECT_EQ(losers, (std::set<std::string>{"bevy-refinement", "naive-bounds(flaw=fast-log-slice)",
                                           "naive-bounds(flaw=padded-tiles)", "naive-refinement"}));
}

TEST(HardCases, of_orthographic_views_from_a_near_of_zero_lose_nothing_with_slices_of_any_scheme) {
  for (const StressCell& cell : stressed("H12", "bounds|^aabb-fast$|^exact-fast$|^sphere-refinement-fast$").cells) {
    EXPECT_EQ(cell.refused, 0) << cell.method;
    EXPECT_EQ(cell.undecided, 0u) << cell.method;
  }
}

TEST(HardCases, give_the_same_json_on_any_number_of_threads) {
  StressRequest request;
  request.tries = 500;
  request.cases = Pattern("H(2|8|31)", "--cases");
  request.methods = Pattern("^(aabb|exact|naive-refinement)$", "--methods");
  const auto json = [&](int threads) {
    request.threads = threads;
    return result::to_json(report::stress_document(run_stress(request, {}, k_never), request)).dump();
  };
  EXPECT_EQ(json(1), json(2));
}

TEST(HardCases, on_lattices_and_at_the_scales_of_maps_are_decided_and_right) {
  const StressResult result = stressed("H3[34]", "^(exact|exact-fast|distance|cascades-fast|world-grid)$");
  EXPECT_EQ(report::stress_failures(result), std::vector<std::string>{});
  for (const StressCell& cell : result.cells) EXPECT_EQ(cell.undecided, 0U) << cell.hard_case << " " << cell.method;
}

TEST(Stress, that_is_stopped_tells_of_the_cases_that_are_whole) {
  std::atomic<bool> stop{false};
  StressRequest request;
  request.tries = 100;
  request.random = 100;
  request.cases = Pattern("^H(1|2|3)$", "--cases");
  request.methods = Pattern("^bounds$", "--methods");
  StressListener listener;
  listener.on_progress = [&](const std::string& doing, double, double) { stop = doing.starts_with("H2 "); };
  const StressResult result = run_stress(request, listener, stop);
  EXPECT_TRUE(result.interrupted);
  ASSERT_EQ(result.cases.size(), 1U);
  EXPECT_STREQ(result.cases[0].id, "H1");
  EXPECT_EQ(result.checks.size(), 1U);
  for (const StressCell& cell : result.cells) EXPECT_EQ(cell.hard_case, "H1");
  EXPECT_TRUE(result.searches.empty());
  EXPECT_FALSE(result.random);
  EXPECT_EQ(report::stress_document(result, request).interrupted, true);
}

// A search climbs one world of at most 25 x 48 tries before the next method does.
TEST(Stress, that_is_stopped_within_its_searches_has_searched_all_methods_about_as_far) {
  std::atomic<bool> stop{false};
  StressRequest request;
  request.cases = Pattern("^H31$", "--cases");
  request.methods = Pattern("^(bounds|exact|aabb|naive-refinement)$", "--methods");
  request.threads = 2;
  StressListener listener;
  listener.on_progress = [&](const std::string&, double done, double) { stop = stop || done > 1.0; };
  const StressResult result = run_stress(request, listener, stop);
  EXPECT_TRUE(result.interrupted);
  ASSERT_EQ(result.searches.size(), 4U);
  for (const SearchResult& search : result.searches) {
    EXPECT_GT(search.tries, request.tries / 8) << search.method;
    EXPECT_LT(search.tries, request.tries / 2) << search.method;
  }
}

// Else it would not be known which of a plug-in's methods has crashed.
TEST(Stress, calls_plug_ins_one_at_a_time) {
  std::atomic<int> running{0}, most{0};
  assign::AssignerDescriptor first = *assign::find_assigner("bounds");
  first.name = "plugged.first";
  first.plugin = "plugged";
  first.make = [&, make = first.make](const assign::Params& params) {
    most = std::max(most.load(), ++running);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    --running;
    return make(params);
  };
  assign::AssignerDescriptor second = first;
  second.name = "plugged.second";
  const assign::AssignerRegistration one(std::move(first)), other(std::move(second));
  StressRequest request;
  request.tries = 500;
  request.cases = Pattern("^H(1|31)$", "--cases");
  request.methods = Pattern("^plugged", "--methods");
  request.threads = 4;
  const StressResult result = run_stress(request, {}, k_never);
  EXPECT_GE(result.searches.size(), 2U);
  EXPECT_EQ(most, 1);
}

TEST(Stress, is_written_as_its_schema_says) {
  StressRequest request;
  request.tries = 6000;
  request.cases = Pattern("H(12|22|31|32)", "--cases");
  request.methods = Pattern("^(bounds|exact|naive-refinement)$", "--methods");
  request.random = 3;
  StressResult result = run_stress(request, {}, k_never);
  ASSERT_TRUE(result.random);
  EXPECT_EQ(result.random->counts.settings, 3U);
  result.random->faults.push_back(
      {{FaultKind::truth, "", "a sentence", 1, 2, scene::LightType::box}, grid::Kind::world, false, 1, {7}, {}});
  const auto json = nlohmann::json::parse(result::to_json(report::stress_document(result, request)).dump());
  EXPECT_EQ(config::schema_violations(row_of(config::Document::stress).schema(), json), std::vector<std::string>{});
  EXPECT_EQ(config::document_of(json), config::Document::stress);
  const auto is_lost = [](const auto& element) { return !element["deepest_miss"].is_null(); };
  EXPECT_TRUE(std::ranges::any_of(json["results"], is_lost));
  EXPECT_TRUE(std::ranges::any_of(json["searches"], is_lost));
}

TEST(Failures, name_a_conservative_method_that_loses_and_an_exact_one_that_adds) {
  StressResult result = stressed("H32", "^(bounds|exact)$");
  ASSERT_EQ(result.cells.size(), 2U);
  EXPECT_TRUE(report::stress_failures(result).empty());
  result.cells[0].misses = 3;
  result.cells[1].extra_pairs = 1;
  EXPECT_EQ(report::stress_failures(result).size(), 2U);
}

TEST(Contacts, lie_on_their_cell_and_a_ball_against_them_touches_it_and_no_more) {
  for (const grid::GridSpec& spec : grids_of_every_kind()) {
    const Trial trial = Rig().point({0, 0, -60}, 60).on(spec);
    const view::Frame frame = frame_of(trial);
    const grid::Grid grid = grid_of(trial, frame);
    SplitMix64 random(4);
    for (int i = 0; i < 300; ++i) {
      const geom::Cell cell = grid.cell(random_cell(grid, random));
      const Contact contact = random_contact(cell, random);
      const double range = random.between(0.5, 5.0);
      geom::BallVolume light;
      light.center.position = contact.point + range * contact.outward;
      const double slack = 1e-9 * (glm::length(light.center.position) + range);
      const auto meets = [&] {
        const geom::Verdict verdict = geom::filter_meets(light, cell);
        return verdict == geom::Verdict::uncertain ? geom::prove_meets(light, cell) : verdict;
      };
      light.range = range + slack;
      EXPECT_EQ(meets(), geom::Verdict::yes) << spec.name() << " contact " << i;
      light.range = range - slack;
      EXPECT_EQ(meets(), geom::Verdict::no) << spec.name() << " contact " << i;
    }
  }
}

TEST(Search, finds_the_losses_of_a_method_without_its_padding) {
  for (const char* name : {"bounds", "aabb", "sphere-refinement", "distance", "world-grid"}) {
    const SearchResult bare = searched(method_named(name, {{"inflation", 0.0}}), 12000);
    EXPECT_GT(bare.misses, 0U) << name;
    ASSERT_TRUE(bare.deepest) << name;
    EXPECT_LT(bare.deepest->depth, 1e-3) << name;
    EXPECT_FALSE(searched(method_named(name), 12000).deepest) << name;
  }
}

TEST(Search, finds_how_deep_an_uncentred_refinement_loses_lights) {
  const SearchResult found = searched(method_named("naive-refinement"), 6000);
  ASSERT_TRUE(found.deepest);
  EXPECT_GT(found.deepest->depth, 0.01);
}

TEST(Search, ends_after_its_tries) {
  const SearchResult found = searched(method_named("bounds"), 1000);
  EXPECT_GE(found.tries, 1000U);
  EXPECT_LT(found.tries, 1100U);
}

// A loss that stress writes is a loss when `run` reads it.
TEST(Replay, reproduces_the_loss) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "clusterbench_replay_test";
  std::filesystem::remove_all(folder);
  const StressMethod naive = method_named("naive-refinement");
  std::vector<Loss> losses{*searched(naive, 6000).deepest};
  for (const StressCell& cell : stressed("H(2|13|22|32)", "naive-refinement").cells)
    if (cell.deepest) losses.push_back(*cell.deepest);
  ASSERT_GE(losses.size(), 4U);
  for (std::size_t i = 0; i < losses.size(); ++i) {
    const std::string name = "loss" + std::to_string(i);
    write_replay(folder, name, losses[i], naive);
    const config::Config config = config::load_config(folder / (name + ".json"));
    const run::Result result = run::run_plan(config, run::make_plan(config, ""), {}, {}, k_never);
    ASSERT_EQ(result.cases.size(), 1U);
    ASSERT_TRUE(result.cases[0].error && result.cases[0].error->deepest) << losses[i].trial;
    EXPECT_EQ(result.cases[0].error->deepest->cell, losses[i].cell) << losses[i].trial;
    EXPECT_NEAR(result.cases[0].error->deepest_miss, losses[i].depth, 1e-9) << losses[i].trial;
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace clusterbench::stress
