// Tiles that react, and storages whose room ends, on a dense scene.

#include <gtest/gtest.h>

#include <algorithm>

#include "assign/contract/assigner_run.h"
#include "assign/contract/storage.h"
#include "core/error.h"
#include "effort.h"
#include "measure/samples/samples.h"
#include "measure/truth/truth.h"
#include "places.h"
#include "run/cases/path_frames.h"
#include "run/passes/timing_pass.h"
#include "run/runner.h"
#include "run/timing/served_cases.h"

namespace clusterbench::run {
namespace {

constexpr int k_jam_frames = 6;

// `scenes/jam.glb`: 600 lights close together.
config::Config jam(const std::string& grids, const std::string& rest = "", int frames = k_jam_frames) {
  return config::parse_config(
      R"({"scenes": [{"path": "scenes/jam.glb", "frames": )" + std::to_string(frames) +
          R"(}], "viewport": [320, 180], "timing": {"measure": false}, "shading": {"samples": 500}, "grids": [)" +
          grids + "]" + rest + "}",
      test::source_dir() + "/c.json");
}

std::string tiles_that(const std::string& react, const std::string& tiles = R"({"pixels": [32, 32]})") {
  return R"({"tiles": )" + tiles + R"(, "slices": {"count": 8, "near": 0.1, "first": 5, "far": 200})" +
         (react.empty() ? "" : R"(, "react": )" + react) + "}";
}

Result run_all(const config::Config& config) {
  const std::atomic<bool> stop{false};
  return run_plan(config, make_plan(config, ""), {}, {}, stop);
}

// The largest k with k² · entries <= n² · most: n · sqrt(most / entries) rounded down, in whole numbers.
int shrunk_by_hand(int n, std::uint64_t entries, std::uint64_t most) {
  if (entries <= most) return n;
  const auto square = [](std::uint64_t k) { return k * k; };
  std::uint64_t k = 0;
  while (square(k + 1) * entries <= square(static_cast<std::uint64_t>(n)) * most) ++k;
  return std::max(1, static_cast<int>(k));
}

// The entries of `exact-fast` are the true pairs, which are found here by themselves.
TEST(TilesThatReactToEntries, are_those_that_the_true_pairs_of_the_frame_before_make) {
  constexpr std::uint64_t k_most = 6000;
  const config::Config config =
      jam(tiles_that(R"({"most": 6000, "of": "exact-fast"})"), R"(, "assigners": ["aabb-fast"])");
  const Plan plan = make_plan(config, "");
  const PathFrames path = path_of(config, plan, plan.groups.at(0));
  const grid::GridSpec& spec = config.grids[0];
  const Vec2i viewport{320, 180}, asked{10, 6};  // 5.6 rows
  Vec2i counts = asked;
  int reacted = 0;
  for (int i = 0; i < path.count(); ++i) {
    const view::Frame frame = path.frame(i);
    const grid::Grid grid = grid::make_grid(spec, path.inputs(spec, frame));
    const Vec2i pixels = counts == asked
                             ? Vec2i{32, 32}
                             : Vec2i{(viewport.x + counts.x - 1) / counts.x, (viewport.y + counts.y - 1) / counts.y};
    EXPECT_EQ(grid.screen().tiles.pixels, pixels) << "frame " << i;
    reacted += counts == asked ? 0 : 1;
    const std::uint64_t entries = measure::find_truth(frame, grid, 1).lists.pair_count();
    EXPECT_EQ(path.reactions(spec)[static_cast<std::size_t>(i)].amount, entries);
    counts = {shrunk_by_hand(asked.x, entries, k_most), shrunk_by_hand(asked.y, entries, k_most)};
  }
  EXPECT_GT(reacted, 0);
  EXPECT_LT(reacted, path.count());
}

TEST(TilesThatReactToEntries, are_the_same_whichever_frames_are_asked_for) {
  const config::Config config = jam(tiles_that(R"({"most": 6000})"));
  const Plan plan = make_plan(config, "");
  const grid::GridSpec& spec = config.grids[0];
  const PathFrames all = path_of(config, plan, plan.groups.at(0)), some = all.only({1, 4});
  for (const int i : {0, 1}) {
    const view::Frame frame = some.frame(i);
    EXPECT_EQ(some.inputs(spec, frame), all.inputs(spec, all.frame(frame.index)));
  }
}

TEST(TilesThatReact, lose_no_light_and_need_fewer_entries_and_longer_loops) {
  const Result result = run_all(jam(
      tiles_that(R"({"most": 6000})") + ", " + tiles_that(R"({"to": "mask-words", "most": 300})", R"({"pixels": 16})"),
      R"(, "assigners": ["exact-fast", "sphere-refinement", "z-binning"],
                                       "storages": ["packed", "bitfield"])"));
  ASSERT_EQ(result.cases.size(), 10u) << "two methods in two storages and one of its own, in two grids";
  for (const CaseResult& found : result.cases) {
    ASSERT_TRUE(found.reaction) << found.name;
    EXPECT_TRUE(found.failures.empty()) << found.name;
    EXPECT_EQ(found.error->false_negatives, 0u);
    const ReactionResult& reaction = *found.reaction;
    EXPECT_GT(reaction.moves.reacted, 0);
    EXPECT_EQ(reaction.reacting.evaluated.front().missed, 0u);
    EXPECT_GT(reaction.reacting.evaluated.front().evaluated, reaction.fixed->evaluated.front().evaluated);
    EXPECT_LT(*reaction.reacting.pairs_mean, *reaction.fixed->pairs_mean);
    EXPECT_EQ(reaction.reacting.index_entries, found.buffers.index_entries.high_water);
    EXPECT_EQ(reaction.cells.size(), static_cast<std::size_t>(k_jam_frames));
  }
}

TEST(TilesThatReact, are_compared_with_the_same_case_in_the_tiles_asked_for) {
  const std::string methods = R"(, "assigners": ["aabb-fast"])";
  const Result plain = run_all(jam(tiles_that(""), methods)),
               reacting = run_all(jam(tiles_that(R"({"most": 6000})"), methods));
  EXPECT_FALSE(plain.cases.at(0).reaction);
  const CaseSide& fixed = *reacting.cases.at(0).reaction->fixed;
  EXPECT_EQ(fixed.pairs_mean, plain.cases[0].occupancy->pairs.mean);
  EXPECT_EQ(fixed.true_pairs, plain.cases[0].error->true_pairs);
  EXPECT_EQ(fixed.false_positives, plain.cases[0].error->false_positives);
  EXPECT_EQ(fixed.bytes, plain.cases[0].buffers.bytes.high_water);
  EXPECT_EQ(fixed.evaluated.front().evaluated, plain.cases[0].shading->evaluated);
  EXPECT_NE(plain.cases[0].id, reacting.cases[0].id);
}

TEST(TilesThatReact, have_the_same_lists_as_others_where_nothing_is_too_much) {
  for (const char* react : {R"({"most": 100000000})", R"({"to": "mask-words", "most": 100000000})"}) {
    const std::string methods = R"(, "assigners": ["aabb-fast"])";
    const config::Config plain = jam(tiles_that(""), methods), reacting = jam(tiles_that(react), methods);
    const Plan plain_plan = make_plan(plain, ""), reacting_plan = make_plan(reacting, "");
    ServedCases of_plain(plain, plain_plan), of_reacting(reacting, reacting_plan);
    const auto before = of_plain.list_digests(of_plain.case_ids().at(0)),
               now = of_reacting.list_digests(of_reacting.case_ids().at(0));
    ASSERT_EQ(before.size(), now.size());
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(before[i].sha256, now[i].sha256) << react;
    const CaseResult found = run_all(reacting).cases.at(0);
    EXPECT_EQ(found.reaction->moves.reacted, 0);
    EXPECT_EQ(found.reaction->moves.over, 0);
    EXPECT_EQ(found.reaction->reacting.list_changes->changed, found.reaction->fixed->list_changes->changed);
  }
}

TEST(TilesThatReact, stay_in_a_path_of_one_frame_and_end_at_one_tile) {
  const CaseResult one = run_all(jam(tiles_that(R"({"most": 1})"), R"(, "assigners": ["exact-fast"])", 1)).cases.at(0);
  EXPECT_EQ(one.reaction->moves.reacted, 0) << "nothing is known of a frame before";
  EXPECT_EQ(one.reaction->moves.over, 1);
  EXPECT_EQ(one.reaction->moves.steps, 0);
  const CaseResult words =
      run_all(jam(tiles_that(R"({"to": "mask-words", "most": 1})"), R"(, "assigners": ["exact-fast"])", 1)).cases.at(0);
  EXPECT_EQ(words.reaction->moves.fewest, (Vec2i{1, 1}));
  EXPECT_EQ(words.reaction->moves.over, 1);
  const CaseResult several = run_all(jam(tiles_that(R"({"most": 1})"), R"(, "assigners": ["exact-fast"])")).cases.at(0);
  EXPECT_EQ(several.reaction->moves.fewest, (Vec2i{1, 1}));
  EXPECT_EQ(several.reaction->moves.over, k_jam_frames);
  EXPECT_EQ(several.reaction->moves.reacted, k_jam_frames - 1);
}

// 2 px and 128 slices: 160 x 90 x 128 cells.
TEST(TilesThatReact, are_not_compared_with_tiles_that_make_more_cells_than_anybody_could_have) {
  const Result result = run_all(jam(R"({"tiles": {"pixels": 2}, "slices": {"count": 128, "far": 200},
      "react": {"to": "mask-words", "most": 100}})",
                                    R"(, "assigners": ["exact-fast"])", 1));
  ASSERT_TRUE(result.cases.at(0).reaction);
  EXPECT_EQ(result.cases[0].reaction->moves.requested, (Vec2i{160, 90}));
  EXPECT_FALSE(result.cases[0].reaction->fixed);
}

TEST(TilesThatReact, double_within_the_frame_for_the_lights_in_view) {
  const config::Config config =
      jam(tiles_that(R"({"to": "mask-words", "most": 1000, "most_lights": 64})", R"({"pixels": 8})"));
  const Plan plan = make_plan(config, "");
  const PathFrames path = path_of(config, plan, plan.groups.at(0));
  for (int i = 0; i < path.count(); ++i) {
    const view::Frame frame = path.frame(i);
    const std::uint64_t lights = std::min<std::uint64_t>(64, grid::count_lights_in_view(frame));
    // 40 x 23 = 920 tiles of 8 px have one word each, or two: then 20 x 12 of 16 px.
    EXPECT_EQ(path.inputs(config.grids[0], frame).tiles->pixels, lights > 32 ? (Vec2i{16, 16}) : (Vec2i{8, 8}));
    EXPECT_GT(lights, 0u);
  }
}

TEST(TilesThatReact, are_timed_with_every_storage) {
  const config::Config config = [] {
    config::Config out = jam(tiles_that(R"({"most": 6000})"), R"(, "assigners": ["exact-fast"],
        "storages": ["packed", "fixed", "bitfield", "linked", "runs", {"name": "packed", "max_entries": 4000}])");
    out.timing.min_time_ms = 0.01;
    out.timing.cold = false;
    return out;
  }();
  const Plan plan = make_plan(config, "");
  const GroupPlan& group = plan.groups.at(0);
  const PathFrames path = path_of(config, plan, group);
  const std::atomic<bool> stop{false};
  const std::vector<GroupSamples> launches{measure_launch(
      config, group, path, {0, 2, {0}, {}}, [](int) {}, stop)};
  const std::vector<TimingResult> timings = timing_results(config, group, launches);
  ASSERT_EQ(timings.size(), 6u);
  for (const TimingResult& timing : timings) {
    EXPECT_GT(timing.frame_ns.median, 0.0);
    EXPECT_GT(timing.builds_per_frame, 0.0) << "other tiles in some frames";
  }
}

// The last frame's tiles are other ones than the fullest frame's.
TEST(TilesThatReact, name_cells_by_the_tiles_of_their_own_frame) {
  const Result result = run_all(jam(tiles_that(R"({"most": 6000})"), R"(, "assigners": ["exact-fast"],
      "details": {"frames": [0, 1, 2, 3, 4, 5]}, "stability": {"steps": 4})"));
  const CaseResult& found = result.cases.at(0);
  const auto count_in = [&](int frame) {
    const Vec3i cells = cells_in(found, frame);
    EXPECT_EQ(cells, found.reaction->cells[static_cast<std::size_t>(frame)]);
    return static_cast<std::uint32_t>(cells.x * cells.y * cells.z);
  };
  EXPECT_LT(found.occupancy->worst_cell, count_in(found.occupancy->worst_frame));
  EXPECT_LT(*found.buffers.worst_cell, count_in(found.buffers.worst_frame));
  const Vec3i last = found.reaction->cells.back();
  int other = 0;
  for (const DetailsFrame& frame : found.details->frames) {
    const Vec3i cells = found.reaction->cells[static_cast<std::size_t>(frame.frame)];
    ASSERT_EQ(frame.tiles.has_value(), cells != last) << frame.frame;
    other += frame.tiles ? 1 : 0;
    if (frame.tiles) {
      EXPECT_EQ(frame.tiles->count, (Vec2i{cells.x, cells.y}));
    }
  }
  EXPECT_GT(other, 0);
  std::uint64_t counted = 0;
  for (const std::uint64_t cells : found.occupancy->histogram) counted += cells;
  std::uint64_t all = 0;
  for (const Vec3i& cells : found.reaction->cells) all += static_cast<std::uint64_t>(cells.x) * cells.y * cells.z;
  EXPECT_EQ(counted, all) << "each cell of each frame once";
}

TEST(TilesThatReact, are_asked_for_by_keys_that_are_checked) {
  const auto refusal = [](const std::string& grid) {
    try {
      jam(grid);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto expect = [&](const std::string& grid, const std::string& place, const std::string& text) {
    const std::string found = refusal(grid);
    EXPECT_NE(found.find(place), std::string::npos) << found;
    EXPECT_NE(found.find(text), std::string::npos) << found;
  };
  expect(tiles_that(R"({"of": "exact-fats"})"), "/grids/0/react/of", "did you mean 'exact-fast'?");
  expect(tiles_that(R"({"of": "z-binning"})"), "/grids/0/react/of", "fills no lists");
  expect(tiles_that(R"({"of": "world-grid"})"), "/grids/0/react/of", "fills no lists of frustum grids");
  expect(tiles_that(R"({"to": "mask-words"})", R"({"count": [4, 4]})"), "/grids/0/react/to", "tiles.pixels");
  expect(tiles_that(R"({"to": "mask-words", "of": "exact"})"), "/grids/0/react/of", "is used by to entries");
  expect(tiles_that(R"({"most_lights": 5})"), "/grids/0/react/most_lights", "is used by to mask-words");
  expect(tiles_that(R"({"most": 0})"), "/grids/0/react/most", "from 1 to");
  expect(tiles_that("{}", R"({"aspect": 1})"), "/grids/0/react", "tiles.aspect");
  expect(R"({"react": {}, "slices": {"scheme": "cubical"}})", "/grids/0/react", "cubical");
  expect(R"({"kind": "world", "react": {}})", "/grids/0/react", "belongs to");
}

TEST(TilesThatReact, can_be_an_axis_and_are_written_as_they_are_read) {
  const config::Config config = jam(tiles_that(R"([null, {"most": [100, 200], "of": "aabb"}, {"to": "mask-words"}])"));
  ASSERT_EQ(config.grids.size(), 4u);
  EXPECT_FALSE(config.grids[0].reaction);
  EXPECT_EQ(config.grids[1].reaction, (grid::Reaction{grid::Reaction::To::entries, 100, "aabb", 0}));
  EXPECT_EQ(config.grids[2].reaction->most, 200u);
  EXPECT_EQ(config.grids[3].reaction, (grid::Reaction{grid::Reaction::To::mask_words, 16384, "", 0}));
  const config::Config again = config::parse_config(config.resolved.dump(), test::source_dir() + "/c.json");
  EXPECT_EQ(again.resolved, config.resolved);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(again.grids[i].reaction, config.grids[i].reaction);
}

// --- A storage whose room ends ---

constexpr const char* k_limited = R"({"name": "packed", "equal_lists": "shared", "max_entries": 3000})";

TEST(ListsWithoutRoom, give_samples_all_lights_from_the_first_list_on_that_has_none) {
  const config::Config config = jam(
      tiles_that(""), R"(, "assigners": ["exact-fast"], "storages": [)" + std::string(k_limited) + R"(, "packed"])");
  const Plan plan = make_plan(config, "");
  const PathFrames path = path_of(config, plan, plan.groups.at(0));
  const grid::GridSpec& spec = config.grids[0];
  const auto make = [&](std::size_t i) { return assign::find_storage("packed")->make(config.storages[i].params); };
  const auto limited = make(0), roomy = make(1);
  const assign::AssignerDescriptor& exact = *assign::find_assigner("exact-fast");
  assign::AssignerRun run(exact, assign::Params(exact.params), assign::Answer::lists);
  int fell_back = 0;
  for (int i = 0; i < path.count(); ++i) {
    const view::Frame frame = path.frame(i);
    const grid::Grid grid = grid::make_grid(spec, path.inputs(spec, frame));
    run.build(grid);
    run.assign({frame, view::lights_in(frame, frame.view_space)});
    const assign::Lists& lists = *run.filled_lists();
    std::vector<std::uint32_t> all = lists.lights;
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    // As Filament: one after the other; equal to the left or the upper neighbour's costs nothing.
    std::uint64_t used = all.size();
    std::uint32_t full_from = lists.cell_count();
    const auto nx = static_cast<std::uint32_t>(grid.cells().x);
    for (std::uint32_t cell = 0; cell < lists.cell_count() && full_from == lists.cell_count(); ++cell) {
      const auto equals = [&](std::uint32_t back) {
        return cell >= back && std::ranges::equal(lists.of(cell), lists.of(cell - back));
      };
      if (equals(1) || equals(nx)) continue;
      if (used + lists.of(cell).size() > 3000)
        full_from = cell;
      else
        used += lists.of(cell).size();
    }
    limited->start(grid, frame.ranges());
    limited->store(lists);
    roomy->start(grid, frame.ranges());
    roomy->store(lists);
    EXPECT_EQ(limited->use().index_entries, used);
    EXPECT_LE(limited->use().index_entries, 3000u);
    EXPECT_LE(limited->use().index_entries, limited->limit().index_entries);
    EXPECT_EQ(limited->use().dropped_pairs, 0u);
    fell_back += limited->use().fallback_cells > 0 ? 1 : 0;
    std::vector<std::uint32_t> given, plain;
    std::uint64_t of_all = 0;
    for (const grid::Sample& sample : measure::volume_samples(frame, 200.0, 2000, 1)) {
      limited->lights_at(sample, grid::Log2::rounded, given);
      roomy->lights_at(sample, grid::Log2::rounded, plain);
      const std::int64_t cell = grid::lookup(grid, sample);
      const bool is_full = cell >= full_from && !plain.empty();
      EXPECT_EQ(given, is_full ? all : plain) << "frame " << i << ", cell " << cell;
      of_all += is_full ? 1 : 0;
    }
    EXPECT_EQ(of_all > 0, limited->use().fallback_cells > 0);
  }
  EXPECT_GT(fell_back, 0);
}

TEST(ListsWithoutRoom, lose_nothing_and_are_compared_with_the_same_lists_with_room) {
  const Result result =
      run_all(jam(tiles_that(""), R"(, "assigners": ["exact-fast"], "storages": [)" + std::string(k_limited) +
                                      R"(, {"name": "packed", "equal_lists": "shared"}])"));
  const CaseResult &limited = result.cases.at(0), &roomy = result.cases.at(1);
  ASSERT_TRUE(limited.fallback);
  EXPECT_FALSE(roomy.fallback);
  EXPECT_TRUE(limited.failures.empty());
  EXPECT_EQ(limited.shading->missed, roomy.shading->missed);
  EXPECT_EQ(limited.buffers.dropped_pairs, 0u);
  EXPECT_GT(limited.fallback->frames, 0);
  EXPECT_GT(limited.fallback->cells, 0u);
  EXPECT_EQ(limited.fallback->limited.evaluated.front().evaluated, limited.shading->evaluated);
  EXPECT_EQ(limited.fallback->roomy.evaluated.front().evaluated, roomy.shading->evaluated);
  EXPECT_EQ(limited.fallback->roomy.index_entries, roomy.buffers.index_entries.high_water);
  EXPECT_GT(limited.shading->evaluated, roomy.shading->evaluated);
  EXPECT_LE(limited.buffers.index_entries.high_water, 3000u);
  EXPECT_LE(limited.buffers.index_entries.theoretical_max, 3000u);
}

TEST(ListsWithoutRoom, that_cannot_hold_one_list_of_all_lights_are_skipped_with_the_reason) {
  const config::Config config =
      jam(tiles_that(""),
          R"(, "assigners": ["exact-fast"], "storages": [{"name": "packed", "max_entries": 599}, "packed"])");
  const Plan plan = make_plan(config, "");
  ASSERT_EQ(plan.skipped.size(), 1u);
  EXPECT_NE(plan.skipped[0].reason.find("max_entries: is 599"), std::string::npos) << plan.skipped[0].reason;
}

// --- configs/react.json in a small picture ---

TEST(ConfigsReact, shows_all_three) {
  std::vector<config::FlagValue> flags{{"--viewport", "320x180"}, {"--set", "timing.measure=false"}};
  if (test::k_sanitized) flags.push_back({"--set", "scenes.*.frames=3"});
  const config::Config config =
      config::load_config(std::filesystem::path(test::source_dir()) / "configs/react.json", flags);
  int entries = 0, words = 0, fallbacks = 0;
  for (const CaseResult& found : run_all(config).cases) {
    EXPECT_TRUE(found.failures.empty()) << found.name;
    if (found.reaction && found.reaction->moves.reacted > 0)
      ++(found.reaction->reaction.to == grid::Reaction::To::entries ? entries : words);
    if (found.fallback && found.fallback->frames > 0) ++fallbacks;
  }
  EXPECT_GT(entries, 0);
  EXPECT_GT(words, 0);
  EXPECT_GT(fallbacks, 0);
}

}  // namespace
}  // namespace clusterbench::run
