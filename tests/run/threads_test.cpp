// Counts are the same for any number of threads, whatever is counted; so are the order of cases, failures and stops.

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "assign/contract/assigner.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/work_in_order.h"
#include "effort.h"
#include "places.h"
#include "result/result.h"
#include "run/records/records.h"
#include "run/runner.h"

namespace clusterbench::run {
namespace {

// A plan of a scene of ours, to be counted.
struct Planned {
  config::Config config;
  Plan plan;

  explicit Planned(const std::string& keys, const std::string& scene = "street", int frames = 11)
      : config(config::parse_config(R"({"scenes": [{"path": ")" + test::source_dir() + "/scenes/" + scene +
                                        R"(.glb", "frames": )" + std::to_string(frames) +
                                        R"(}], "viewport": [320, 180], "timing": {"measure": false}, )" + keys + "}",
                                    "c.json")),
        plan(make_plan(config, "")) {}

  Result run(int threads, const Listener& listener = {}, const std::vector<std::string>& done = {}) {
    config.threads = threads;
    return run_plan(config, plan, done, listener, stop);
  }
  std::atomic<bool> stop{false};
};

constexpr const char* k_grids_of_threads =
    R"("grids": [{"kind": "frustum", "tiles": {"pixels": [[64, 64], [48, 37]]}, "slices": {"count": [6, 12]}},
                 {"kind": "distance", "slices": {"count": 8}}, {"kind": "cascades"}, {"kind": "world", "cells": [12, 4, 12]}], )";

std::string text_of(const Result& result) {
  std::string text;
  for (const CaseResult& one : result.cases) text += result::to_json(record_of(one)).dump() + "\n";
  for (const Skipped& skipped : result.skipped) text += skipped.name + skipped.reason + "\n";
  return text;
}

struct Row {
  const char* name;
  const char* scene;
  std::string keys;
};

class Threads : public ::testing::TestWithParam<Row> {};

TEST_P(Threads, change_no_byte_of_a_result) {
  Planned planned(GetParam().keys, GetParam().scene, test::k_sanitized ? 5 : 11);
  const Result one = planned.run(1);
  EXPECT_GT(one.cases.size(), 1u);
  for (const int threads : test::some<int>({2, 3, 8}, 3, 1))
    EXPECT_EQ(text_of(planned.run(threads)), text_of(one)) << threads << " threads";
}

INSTANTIATE_TEST_SUITE_P(
    Counts, Threads,
    ::testing::Values(
        Row{"methods", "street",
            std::string(k_grids_of_threads) + R"("assigners": ["*"], "storages": ["packed", "bitfield"])"},
        Row{"precisions", "street",
            std::string(k_grids_of_threads) + R"("assigners": ["*-fast"], "precision": ["float32", "half"])"},
        Row{"many_samples", "street",
            R"("assigners": ["aabb-fast", "bvh"], "shading": {"samples": 40000}, "lookup": {"samples": 500})"},
        Row{"stability", "street", R"("assigners": ["aabb-fast", "bvh"], "stability": {"steps": 30, "step_mm": 50})"},
        Row{"details", "street",
            std::string(k_grids_of_threads) + R"("assigners": ["*-fast"], "details": {"frames": 5})"},
        Row{"pre_culls", "slope",
            R"("assigners": ["aabb-fast"], "pre_cull": ["none", ["frustum", {"distance_m": 20}],
                {"visible_set": {"view_cell_m": 4, "voxel_m": 2, "rays": 512}}])"},
        Row{"presets", "street", R"("presets": ["godot", "filament"])"},
        Row{"surfaces", "slope",
            R"("assigners": ["exact-fast", "tiled", "tiled-2.5d", "explicit", "flagged"], "samples": {"opaque": {}, "transparent": {}})"},
        Row{"shadows", "slope", R"("assigners": ["exact-fast"], "samples": {"opaque": {"divisor": 4}},
            "shadow_cull": {"resolution": [8, 16]}, "shadow_frusta": {}, "storages": ["packed", "fixed"])"},
        Row{"fit", "slope",
            R"("grids": [{"tiles": {"pixels": [64, 64]}, "slices": {"count": 8, "fit": [null, {"to": ["lights", "surfaces"]},
                {"damping": 0.9}]}}], "assigners": ["exact-fast", "aabb-fast"])"},
        Row{"reactions", "street",
            R"("grids": [{"tiles": {"pixels": [32, 32]}, "slices": {"count": 8}, "react": [null,
                {"to": "entries", "most": [500, 3000], "of": "exact-fast"}]}], "assigners": ["exact-fast", "aabb-fast"])"}),
    [](const auto& row) { return std::string(row.param.name); });

Planned several_groups() {
  return Planned(std::string(k_grids_of_threads) +
                 R"("assigners": ["aabb", "aabb-fast", "distance", "cascades", "world-grid"])");
}

TEST(Counting, tells_cases_in_the_order_of_the_plan_one_at_a_time) {
  Planned planned = several_groups();
  std::vector<std::string> told;  // not guarded: two at a time are a race
  Listener listener;
  listener.on_case = [&](const CaseResult& one) { told.push_back(one.id); };
  const Result result = planned.run(8, listener);
  EXPECT_GT(told.size(), 4u);
  EXPECT_EQ(told, result.planned_ids);
  EXPECT_EQ(result.cases.size(), told.size());
}

// All but what methods hold in memory.
std::string lists_text(Planned& planned, int threads) {
  Result result = planned.run(threads);
  for (CaseResult& one : result.cases) one.buffers.scratch_bytes = 0;
  return text_of(result);
}

TEST(Counting, without_scratch_memory_has_the_same_lists_on_any_number_of_threads) {
  for (const char* method : {"exact-fast", "aabb-fast", "distance-fast", "cascades-fast", "world-grid-fast"}) {
    Planned planned(std::string(k_grids_of_threads) + R"("assigners": [")" + method + R"("])");
    const std::string one = lists_text(planned, 1);
    planned.config.counts_scratch = false;
    for (const int threads : {2, 5}) EXPECT_EQ(lists_text(planned, threads), one) << method << ", " << threads;
  }
}

// Lists nothing. With `waits_s`, each frame waits so long for another instance that is at a frame.
class Meeting final : public assign::ListAssigner {
 public:
  static inline std::atomic<int> at_frames{0}, most{0};
  static inline double waits_s = 0.0;

  void build(const grid::Grid& grid, const assign::LightKinds&) override { cells_ = grid.cell_count(); }
  void assign(const assign::FrameInput&, assign::Lists& out) override {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    const int now = ++at_frames;
    for (int before = most; now > before && !most.compare_exchange_weak(before, now);) {
    }
    while (most < 2 && std::chrono::duration<double>(Clock::now() - begin).count() < waits_s) std::this_thread::yield();
    --at_frames;
    out = {std::vector<std::uint32_t>(cells_ + 1, 0), {}};
  }
  std::uint64_t tests_done() const override { return 0; }
  std::size_t scratch_bytes() const override { return 0; }
  assign::EarlierFrames earlier_frames() const override { return assign::EarlierFrames::matter_to_scratch; }

 private:
  std::size_t cells_ = 0;
};

TEST(Counting, of_one_method_is_at_several_frames_at_once_where_nobody_reads_its_scratch_memory) {
  if (processors() < 2) GTEST_SKIP() << "one processor does one thing at a time";
  const assign::AssignerRegistration registration(
      {.name = "meeting",
       .summary = "lists nothing",
       .source = "",
       .kinds = {grid::Kind::frustum},
       .params = {},
       .make = [](const assign::Params&) -> std::unique_ptr<assign::ListAssigner> {
         return std::make_unique<Meeting>();
       }});
  Planned planned(R"("grids": [{"slices": {"count": 8}}], "assigners": ["meeting"], "accuracy": {"check": false})");
  for (const bool counts_scratch : {true, false}) {
    Meeting::most = 0;
    Meeting::waits_s = counts_scratch ? 0.02 : 30.0;  // they meet at once, or never
    planned.config.counts_scratch = counts_scratch;
    planned.run(2);
    EXPECT_EQ(Meeting::most, counts_scratch ? 1 : 2);
  }
}

// Its place, and the cases that were told before.
std::string failure_of(Planned& planned, int threads) {
  std::string told;
  Listener listener;
  listener.on_case = [&](const CaseResult& one) { told += one.id + " "; };
  try {
    planned.run(threads, listener);
  } catch (const Error& error) {
    return told + "then " + error.what();
  }
  return "none";
}

TEST(Counting, of_groups_after_a_failure_is_not_told_and_the_failure_is_that_of_one_thread) {
  Planned planned = several_groups();
  for (const std::uint64_t bytes : {5'000u, 20'000u, 40'000u}) {
    const MemoryLimitScope limit(bytes);
    const std::string one = failure_of(planned, 1);
    EXPECT_NE(one, "none");
    for (const int threads : {2, 8}) EXPECT_EQ(failure_of(planned, threads), one) << threads << " threads";
  }
}

TEST(Counting, goes_on_from_any_case_with_another_number_of_threads) {
  Planned planned = several_groups();
  const Result whole = planned.run(1);
  for (const std::size_t cut : {std::size_t{1}, std::size_t{5}, whole.cases.size() - 1}) {
    const auto end = static_cast<std::ptrdiff_t>(cut);
    const Result rest = planned.run(3, {}, {whole.planned_ids.begin(), whole.planned_ids.begin() + end});
    Result expected = whole;
    expected.cases.erase(expected.cases.begin(), expected.cases.begin() + end);
    EXPECT_EQ(text_of(rest), text_of(expected));
  }
}

TEST(Counting, stops_with_whole_cases_alone_on_any_number_of_threads) {
  for (const int threads : {1, 2, 8}) {
    Planned planned = several_groups();
    const Result whole = planned.run(threads);
    std::atomic<int> frames = 0;
    Listener listener;
    listener.on_progress = [&](const Progress&) { planned.stop = ++frames > 40; };
    const Result part = planned.run(threads, listener);
    ASSERT_LT(part.cases.size(), part.planned_ids.size());
    for (std::size_t i = 0; i < part.cases.size(); ++i)
      EXPECT_EQ(result::to_json(record_of(part.cases[i])), result::to_json(record_of(whole.cases[i])));
  }
}

}  // namespace
}  // namespace clusterbench::run
