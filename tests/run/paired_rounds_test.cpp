#include "run/timing/paired_rounds.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace clusterbench::run {
namespace {

// A program that does as it is told, and writes down what it was asked.
class Puppet : public Program {
 public:
  Puppet(std::string name, std::vector<std::string> ids, std::vector<std::string>& log)
      : name_(std::move(name)), ids_(std::move(ids)), log_(log) {
    log_.push_back("start " + name_);
  }
  std::vector<std::string> case_ids() override { return ids_; }
  std::vector<ListDigest> list_digests(const std::string&) override { return digests; }
  FrameLists frame_lists(const std::string&, int frame) override {
    log_.push_back("frame " + std::to_string(frame));
    return lists;
  }
  double assign_ns(const std::string& id) override {
    log_.push_back(name_ + " " + id);
    if (id == slow.first) return slow.second;
    return name_ == "base" ? 100.0 : 200.0;
  }

  std::vector<ListDigest> digests{{3, "a"}, {4, "b"}};
  FrameLists lists{{2, 1, 1}, {{1, 2}, {5}}};
  std::pair<std::string, double> slow;  // a case, and its time

 private:
  std::string name_;
  std::vector<std::string> ids_;
  std::vector<std::string>& log_;
};

CasePlan case_of(const std::string& id, std::size_t assigner, std::size_t storage) {
  CasePlan case_plan{};
  case_plan.id = case_plan.name = id;
  case_plan.assigner = assigner;
  case_plan.storage = storage;
  return case_plan;
}

// Two methods, the first with two storages, and a group of one case more.
Plan plan_of_four() {
  Plan plan;
  plan.groups.push_back({0, 0, 0, 0, {case_of("a", 0, 0), case_of("a2", 0, 1), case_of("b", 1, 0)}});
  plan.groups.push_back({0, 0, 0, 1, {case_of("c", 0, 0)}});
  return plan;
}

struct Stage {
  std::vector<std::string> log, base_ids{"a", "a2", "b", "c"}, next_ids = base_ids;
  std::function<void(Puppet&)> change_next = [](Puppet&) {};
  int most_launches = 0;

  std::map<std::string, PairedCase> measure(int launches, int rounds) {
    const PairedStart start{[&] { return std::make_unique<Puppet>("base", base_ids, log); },
                            [&] {
                              auto next = std::make_unique<Puppet>("new", next_ids, log);
                              change_next(*next);
                              return next;
                            }};
    return measure_paired(plan_of_four(), {launches, most_launches, 0.01, rounds}, start, [](const PairedRound&) {});
  }
};

TEST(PairedRounds, order_alternates_over_launches_rounds_and_methods) {
  Stage stage;
  stage.measure(2, 2);
  const std::vector<std::string> expected{"start base", "start new",                       //
                                          "base a",     "new a",      "new b",  "base b",  // first round
                                          "new a",      "base a",     "base b", "new b",   // second round
                                          "base c",     "new c",      "new c",  "base c",  //
                                          "start new",  "start base",  // second launch: all the other way round
                                          "new a",      "base a",     "base b", "new b",   //
                                          "base a",     "new a",      "new b",  "base b",  //
                                          "new c",      "base c",     "base c", "new c"};
  EXPECT_EQ(stage.log, expected);
}

TEST(PairedRounds, cases_of_one_method_share_its_rounds) {
  Stage stage;
  const auto cases = stage.measure(3, 4);
  ASSERT_EQ(cases.size(), 4u);
  for (const auto& [id, measured] : cases) {
    ASSERT_EQ(measured.launches.size(), 3u) << id;
    EXPECT_EQ(measured.launches[2].base_ns, std::vector<double>(4, 100.0)) << id;
    EXPECT_EQ(measured.launches[2].next_ns, std::vector<double>(4, 200.0)) << id;
    EXPECT_FALSE(measured.lists_differ) << id;
  }
}

TEST(PairedRounds, shares_of_work_add_up_to_one) {
  Stage stage;
  double done = 0.0;
  const PairedStart start{[&] { return std::make_unique<Puppet>("base", stage.base_ids, stage.log); },
                          [&] { return std::make_unique<Puppet>("new", stage.next_ids, stage.log); }};
  measure_paired(plan_of_four(), {3, 3, 0.01, 4}, start, [&](const PairedRound& round) { done += round.share; });
  EXPECT_NEAR(done, 1.0, 1e-12);
}

TEST(PairedRounds, methods_with_wide_intervals_alone_are_measured_on) {
  Stage stage;
  stage.most_launches = 7;
  int started = 0;
  stage.change_next = [&](Puppet& next) { next.slow = {"b", ++started % 2 == 0 ? 300.0 : 200.0}; };
  const auto cases = stage.measure(3, 2);
  EXPECT_EQ(cases.at("a").launches.size(), 3u);
  EXPECT_EQ(cases.at("b").launches.size(), 7u);
  EXPECT_EQ(cases.at("c").launches.size(), 3u);
  EXPECT_EQ(cases.at("b").launches[5].next_ns, std::vector<double>(2, 300.0));
}

TEST(PairedRounds, no_launch_follows_once_intervals_are_narrow) {
  Stage stage;
  stage.most_launches = 1000;
  int started = 0;
  stage.change_next = [&](Puppet& next) { next.slow = {"b", ++started % 2 == 0 ? 204.0 : 200.0}; };
  const std::size_t launches = stage.measure(2, 2).at("b").launches.size();
  EXPECT_GT(launches, 4u);
  EXPECT_LT(launches, 30u);
}

TEST(PairedRounds, only_cases_of_both_programs_are_measured) {
  Stage stage;
  stage.base_ids = {"a2", "old"};
  const auto cases = stage.measure(2, 2);
  ASSERT_EQ(cases.size(), 1u);
  EXPECT_EQ(cases.begin()->first, "a2");
  stage.base_ids = {"old"};
  try {
    stage.measure(2, 2);
    FAIL() << "nothing to measure, and no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::nothing_comparable);
  }
}

TEST(PairedRounds, lists_that_differ_are_located_in_the_first_frame_that_does) {
  Stage stage;
  stage.change_next = [](Puppet& next) {
    next.digests[1] = {5, "c"};
    next.lists.lights = {{1, 2}, {4, 5}};
  };
  const auto cases = stage.measure(2, 2);
  const ListsDiffer& differ = cases.at("b").lists_differ.value();
  EXPECT_EQ(differ.frames, 1);
  EXPECT_EQ(differ.frame, 1);
  EXPECT_EQ(differ.cell, (Vec3i{1, 0, 0}));
  EXPECT_EQ(differ.light, 4u);
  EXPECT_TRUE(differ.is_only_in_new);
  EXPECT_EQ(differ.base_pairs, 7u);
  EXPECT_EQ(differ.next_pairs, 8u);
}

TEST(PairedRounds, a_light_that_only_the_base_lists_is_told_as_such) {
  for (const std::vector<std::uint32_t>& shorter : {std::vector<std::uint32_t>{2}, {1}, {}}) {
    Stage stage;
    stage.change_next = [&](Puppet& next) {
      next.digests[0] = {2, "c"};
      next.lists.lights[0] = shorter;
    };
    const auto cases = stage.measure(2, 2);
    const ListsDiffer& differ = cases.at("a").lists_differ.value();
    EXPECT_FALSE(differ.is_only_in_new);
    EXPECT_EQ(differ.cell, (Vec3i{0, 0, 0}));
    EXPECT_EQ(differ.light, shorter == std::vector<std::uint32_t>{1} ? 2u : 1u);
  }
}

}  // namespace
}  // namespace clusterbench::run
