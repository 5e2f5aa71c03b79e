// `stress` with methods that run on a device, which fails on the way.

#include <gtest/gtest.h>

#include <algorithm>

#include "gpu/failing_method.h"
#include "stress/stress_run.h"

namespace clusterbench::stress {
namespace {

using gpu::testing::FailingMethod;

StressRequest request_of(const std::string& cases, const std::string& methods) {
  StressRequest request;
  request.cases = Pattern(cases, "--cases");
  request.methods = Pattern(methods, "--methods");
  request.tries = 0;
  return request;
}

StressResult ran(const StressRequest& request, std::vector<std::string>* left_out = nullptr) {
  const std::atomic<bool> stop{false};
  StressListener listener;
  if (left_out != nullptr)
    listener.on_left_out = [left_out](const std::string& reason) { left_out->push_back(reason); };
  return run_stress(request, listener, stop);
}

bool has_method(const StressResult& result, const std::string& label) {
  return std::ranges::find(result.methods, label, &StressMethod::label) != result.methods.end();
}

TEST(StressOnADevice, runs_only_where_one_is_named_or_the_method_is) {
  const assign::AssignerRegistration registration(gpu::testing::failing_method());
  StressRequest all = request_of("H1$", ".*");
  all.cases = Pattern("none", "--cases");
  std::vector<std::string> left_out;
  EXPECT_FALSE(has_method(ran(all, &left_out), "fails"));
  ASSERT_EQ(left_out.size(), 1u);
  EXPECT_EQ(left_out[0], "fails: run on a device, and none is named");
  all.takes_device = true;
  left_out.clear();
  EXPECT_TRUE(has_method(ran(all, &left_out), "fails"));
  EXPECT_TRUE(left_out.empty());
  EXPECT_TRUE(has_method(ran(request_of("none", "^fails$"), &left_out), "fails"));
  EXPECT_FALSE(has_method(ran(request_of("none", "^bounds$"), &left_out), "fails"));
  EXPECT_TRUE(left_out.empty()) << "nobody asked for it";
}

TEST(StressOnADevice, that_fails_keeps_the_trials_of_all_other_methods_and_cases) {
  const assign::AssignerRegistration registration(gpu::testing::failing_method());
  FailingMethod::fail_after(1'000'000);
  const StressRequest request = request_of("H[12]$", "^(fails|aabb)$");
  const StressResult whole = ran(request);
  ASSERT_EQ(whole.cells.size(), 4u);
  for (const StressCell& cell : whole.cells) EXPECT_TRUE(cell.faults.empty());
  FailingMethod::fail_after(1, 1);
  const StressResult cut = ran(request);
  ASSERT_EQ(cut.cells.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const StressCell &was = whole.cells[i], &now = cut.cells[i];
    const bool is_ended = now.hard_case == std::string("H1") && now.method == "fails";
    EXPECT_EQ(now.faults.size(), is_ended ? 1u : 0u) << now.hard_case << " " << now.method;
    EXPECT_EQ(now.true_pairs == was.true_pairs, !is_ended);
    if (!is_ended) continue;
    ASSERT_EQ(now.faults.size(), 1u);
    EXPECT_NE(now.faults[0].find("the device was lost; no further trial"), std::string::npos) << now.faults[0];
  }
}

TEST(StressOnADevice, that_fails_ends_its_search_for_losses_alone) {
  const assign::AssignerRegistration registration(gpu::testing::failing_method()),
      other(gpu::testing::failing_method("fails-too"));
  StressRequest request = request_of("H31$", "^(fails|fails-too|aabb)$");
  request.tries = 500;
  request.threads = 2;
  FailingMethod::fail_after(3, 1);
  const StressResult cut = ran(request);
  ASSERT_EQ(cut.searches.size(), 3u);
  for (const SearchResult& search : cut.searches) {
    const bool is_ended = search.method == "fails";
    EXPECT_EQ(search.fault, is_ended ? "the device was lost" : "") << search.method;
    EXPECT_EQ(search.tries >= 500, !is_ended) << search.method;
  }
}

TEST(StressOnADevice, that_fails_at_random_settings_is_one_fault_with_its_seed_and_is_not_shrunk) {
  const assign::AssignerRegistration registration(gpu::testing::failing_method());
  StressRequest request = request_of("none", "^(fails|aabb)$");
  request.random = 150;
  request.threads = 2;
  FailingMethod::fail_after(20, 1);
  const StressResult cut = ran(request);
  ASSERT_TRUE(cut.random);
  EXPECT_EQ(cut.random->counts.settings, 150u);
  ASSERT_EQ(cut.random->faults.size(), 1u);
  const RandomFault& found = cut.random->faults[0];
  EXPECT_EQ(found.fault.kind, FaultKind::error);
  EXPECT_TRUE(found.fault.is_of_device);
  EXPECT_NE(found.fault.detail.find("the device was lost"), std::string::npos);
  EXPECT_EQ(found.settings, 1u);
  EXPECT_GT(FailingMethod::frames_done, 60) << "the others were checked";
}

}  // namespace
}  // namespace clusterbench::stress
