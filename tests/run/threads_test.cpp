// Counts are the same for any number of threads, whatever is counted; so are the order of cases, failures and stops.

#include <gtest/gtest.h>

#include <mutex>

#include "core/error.h"
#include "core/memory.h"
#include "places.h"
#include "result/result.h"
#include "run/records/records.h"
#include "run/walk.h"

namespace clusterbench::run {
namespace {

using testing::Walk;

// Several grids, each a group, with lights of both kinds.
Walk crowd(const std::string& more, int frames = 11) {
  Walk walk(R"("grids": [{"tiles": {"pixels": [[10, 10], [25, 20]]}, "slices": {"count": [4, 8]}}, {"kind": "distance"},
                         {"kind": "cascades"}, {"kind": "world", "cells": [6, 3, 6]}], )" +
                more,
            frames);
  for (int i = 0; i < 60; ++i) {
    scene::Light& light =
        walk.add_light({8 * std::sin(i * 1.3), 6 * std::sin(i * 2.9), -15 + 14 * std::sin(i * 0.7)}, 0.5 + 0.05 * i);
    if (i % 2 == 0) light.type = scene::LightType::spot;
  }
  return walk;
}

std::string text_of(const Result& result) {
  std::string text;
  for (const CaseResult& one : result.cases) {
    result::Case record = record_of(one);
    text += result::to_json(record).dump() + "\n";
  }
  return text;
}

std::string counted(Walk& walk, int threads) {
  walk.config.threads = threads;
  return text_of(walk.run());
}

class Threads : public ::testing::TestWithParam<const char*> {};

TEST_P(Threads, change_no_byte_of_a_result) {
  Walk walk = crowd(GetParam());
  const std::string one = counted(walk, 1);
  EXPECT_GT(one.size(), 1000u);
  for (const int threads : {2, 3, 8}) EXPECT_EQ(counted(walk, threads), one) << threads << " threads";
}

INSTANTIATE_TEST_SUITE_P(
    Counts, Threads,
    ::testing::Values(R"("assigners": ["aabb", "sphere-refinement", "distance", "cascades", "world-grid"])",
                      R"("assigners": ["*-fast"], "storages": ["packed", "bitfield", "linked"])",
                      R"("assigners": ["bvh", "z-binning"], "storages": ["packed"], "precision": ["float32", "half"])",
                      R"("assigners": ["aabb-fast"], "shading": {"samples": 40000}, "lookup": {"samples": 500})",
                      R"("assigners": ["aabb-fast", "bvh"], "stability": {"steps": 30, "step_mm": 50})",
                      R"("assigners": ["aabb-fast", "bvh"], "details": {"frames": 5})",
                      R"("assigners": ["aabb-fast"], "pre_cull": ["none", "frustum", {"distance_m": 20}])"));

TEST(Counting, of_grids_that_follow_and_react_is_the_same_on_any_number_of_threads) {
  const auto make = [] {
    Walk walk(R"("grids": [{"tiles": {"pixels": [10, 10]}, "slices": {"count": 6, "fit": [null, {"damping": 0.5}]},
                            "react": [null, {"to": "entries", "most": 300, "of": "aabb"}]}],
                 "assigners": ["aabb", "exact-fast"])",
              13);
    for (int i = 0; i < 40; ++i) walk.add_light({6 * std::sin(i * 1.3), 0.0, -12 + 9 * std::sin(i * 0.7)}, 2.0);
    return walk;
  };
  Walk walk = make();
  ASSERT_EQ(walk.plan.groups.size(), 4u);
  const std::string one = counted(walk, 1);
  for (const int threads : {2, 3, 8}) EXPECT_EQ(counted(walk, threads), one);
}

TEST(Counting, tells_cases_in_the_order_of_the_plan_one_at_a_time) {
  Walk walk = crowd(R"("assigners": ["aabb", "aabb-fast"])", 3);
  walk.config.threads = 8;
  std::vector<std::string> told;  // not guarded: two at a time are a race
  Listener listener;
  listener.on_case = [&](const CaseResult& one) { told.push_back(one.id); };
  const Result result = walk.run(listener);
  EXPECT_EQ(told, result.planned_ids);
  EXPECT_EQ(result.cases.size(), told.size());
}

TEST(Counting, of_groups_after_a_failure_is_not_told_and_the_failure_is_the_first_of_the_plan) {
  Walk walk = crowd(R"("assigners": ["brute-force"])", 40);
  ASSERT_GE(walk.plan.groups.size(), 6u);
  const MemoryLimitScope limit(20'000);  // the larger grids fail
  std::string of_one;
  for (const int threads : {1, 2, 8}) {
    walk.config.threads = threads;
    std::vector<std::string> told;
    Listener listener;
    listener.on_case = [&](const CaseResult& one) { told.push_back(one.id); };
    std::string failure;
    try {
      walk.run(listener);
    } catch (const Error& error) {
      failure = error.where();
    }
    ASSERT_FALSE(failure.empty());
    for (const std::string& id : told) failure += ", after " + id;
    if (threads == 1) of_one = failure;
    EXPECT_EQ(failure, of_one) << threads << " threads";
  }
}

TEST(Counting, goes_on_from_any_case_with_another_number_of_threads) {
  Walk walk = crowd(R"("assigners": ["aabb", "aabb-fast"])", 5);
  walk.config.threads = 1;
  const Result whole = walk.run();
  for (const std::size_t cut : {std::size_t{1}, std::size_t{5}, whole.cases.size() - 1}) {
    walk.config.threads = 3;
    const std::vector<std::string> done(whole.planned_ids.begin(),
                                        whole.planned_ids.begin() + static_cast<std::ptrdiff_t>(cut));
    Result rest = walk.run({}, done);
    Result expected = whole;
    expected.cases.erase(expected.cases.begin(), expected.cases.begin() + static_cast<std::ptrdiff_t>(cut));
    EXPECT_EQ(text_of(rest), text_of(expected));
  }
}

TEST(Counting, stops_with_whole_cases_alone_on_any_number_of_threads) {
  Walk walk = crowd(R"("assigners": ["aabb", "aabb-fast"])", 20);
  const std::string whole = counted(walk, 1);
  for (const int threads : {1, 2, 8}) {
    walk.config.threads = threads;
    std::atomic<bool> stop{false};
    int frames = 0;
    Listener listener;
    listener.on_progress = [&](const Progress&) { stop = ++frames > 50; };
    const Result part = run_plan(walk.config, walk.plan, {}, listener, stop);
    const std::string text = text_of(part);
    EXPECT_LT(part.cases.size(), part.planned_ids.size());
    EXPECT_EQ(text, whole.substr(0, text.size()));
  }
}

}  // namespace
}  // namespace clusterbench::run
