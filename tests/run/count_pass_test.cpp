#include "run/passes/count_pass.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include "core/error.h"
#include "run/walk.h"

namespace clusterbench::run {
namespace {

using testing::k_shafts;
using testing::Walk;

// Says 10, 20, 30 ... and how much more memory was in use at each stop than at its start.
class StepCounter final : public InstructionCounter {
 public:
  const char* source() const override { return "steps"; }
  bool counts_all_threads() const override { return sees_all_threads; }
  void start() override {
    ++starts;
    in_use_ = mallinfo2().uordblks;
  }
  Counted stop() override {
    grown.push_back(static_cast<long>(mallinfo2().uordblks) - static_cast<long>(in_use_));
    return {10 * ++steps_, {}};
  }

  bool sees_all_threads = false;
  int starts = 0;
  std::vector<long> grown;

 private:
  std::uint64_t steps_ = 0;
  std::size_t in_use_ = 0;
};

Walk walk_of(const std::string& more, int frames = 5) {
  Walk walk(std::string(k_shafts) + ", " + more, frames);
  for (int i = 0; i < 200; ++i) walk.add_light({0.0, 0.0, -2.0 - i % 50}, 3.0);
  walk.config.timing.frames = 4;
  return walk;
}

struct Told {
  std::vector<std::string> ids;
  Counts counts;
};

Told count(
    const Walk& walk, StepCounter& counter,
    const std::function<bool(const CasePlan&)>& is_wanted = [](const CasePlan&) { return true; }) {
  Told told;
  const std::atomic<bool> never{false};
  count_pass(
      walk.config, walk.plan, is_wanted, counter,
      [&](const CasePlan& case_plan, const CountResult& result) {
        told.ids.push_back(case_plan.id);
        told.counts[case_plan.id] = result;
      },
      never);
  return told;
}

TEST(CountPass, build_assignment_and_each_conversion_are_counted_apart) {
  StepCounter counter;
  const Told told = count(walk_of(R"("assigners": ["aabb"], "storages": ["packed", "fixed"])"), counter);
  ASSERT_EQ(told.ids, (std::vector<std::string>{"0-0-0", "0-0-1"}));
  const CountResult &packed = told.counts.at("0-0-0"), &fixed = told.counts.at("0-0-1");
  EXPECT_EQ(packed.source, "steps");
  EXPECT_FALSE(packed.simd_target.empty());
  EXPECT_EQ(packed.frames, 4) << "those that are timed";
  for (const CountResult* count_result : {&packed, &fixed}) {
    EXPECT_EQ(count_result->build.instructions, 10u);
    EXPECT_EQ(count_result->assign.instructions, 20u);
  }
  EXPECT_EQ(packed.convert->instructions, 30u);
  EXPECT_EQ(fixed.convert->instructions, 40u);
  EXPECT_EQ(counter.starts, 4);
}

TEST(CountPass, memory_has_grown_before_anything_is_counted) {
  StepCounter counter;
  count(walk_of(R"("assigners": ["brute-force", "aabb", "exact-fast"], "storages": ["packed", "fixed"])"), counter);
  ASSERT_EQ(counter.grown.size(), 12u);
  for (std::size_t i = 0; i < counter.grown.size(); ++i) {
    const bool is_build = i % 4 == 0;  // which may take what it likes
    EXPECT_TRUE(is_build || counter.grown[i] == 0) << "stage " << i << " has grown by " << counter.grown[i];
  }
}

TEST(CountPass, only_wanted_cases_are_counted) {
  StepCounter counter;
  const Told told = count(walk_of(R"("assigners": ["aabb", "planes"], "storages": ["packed", "fixed"])"), counter,
                          [](const CasePlan& case_plan) { return case_plan.id == "0-1-1"; });
  EXPECT_EQ(told.ids, std::vector<std::string>{"0-1-1"});
  EXPECT_EQ(counter.starts, 3);
}

TEST(CountPass, all_frames_are_counted_where_all_are_timed) {
  Walk walk = walk_of(R"("assigners": ["aabb"])");
  walk.config.timing.frames = 0;
  StepCounter counter;
  EXPECT_EQ(count(walk, counter).counts.at("0-0-0").frames, 5);
}

TEST(CountPass, a_stop_ends_it_between_methods) {
  const Walk walk = walk_of(R"("assigners": ["aabb", "planes"])");
  std::atomic<bool> stop{false};
  StepCounter counter;
  count_pass(
      walk.config, walk.plan, [](const CasePlan&) { return true; }, counter,
      [&](const CasePlan&, const CountResult&) { stop = true; }, stop);
  EXPECT_EQ(counter.starts, 3);
}

TEST(CountPass, a_method_on_several_threads_needs_a_counter_that_sees_them) {
  const Walk walk = walk_of(R"("assigners": ["aabb", {"name": "exact-fast", "threads": 2}])");
  StepCounter counter;
  try {
    count(walk, counter);
    FAIL() << "counted one thread of two";
  } catch (const Error& error) {
    EXPECT_NE(error.message().find("exact-fast(threads=2)"), std::string::npos) << error.what();
  }
  counter.sees_all_threads = true;
  EXPECT_EQ(count(walk, counter).ids.size(), 2u);
}

TEST(Runner, a_count_goes_to_the_result_of_its_case) {
  Walk walk = walk_of(R"("assigners": ["aabb", "planes"])");
  const std::atomic<bool> never{false};
  const Result result = run_plan(walk.config, walk.plan, {}, {}, never,
                                 {{"0-1-0", {"steps", "AVX2", 4, {10, {}}, {20, {}}, Counted{30, {}}}}});
  EXPECT_FALSE(result.cases[0].count);
  ASSERT_TRUE(result.cases[1].count);
  EXPECT_EQ(result.cases[1].count->assign.instructions, 20u);
}

}  // namespace
}  // namespace clusterbench::run
