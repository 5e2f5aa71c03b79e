#include <gtest/gtest.h>

#include <algorithm>

#include "cli/processes/launches.h"
#include "core/error.h"
#include "core/random.h"

namespace clusterbench::cli {
namespace {

using Ids = std::vector<std::string>;

run::GroupPlan group_of(const Ids& ids) {
  run::GroupPlan group;
  for (const std::string& id : ids) {
    run::CasePlan one;
    one.id = id;
    group.cases.push_back(one);
  }
  return group;
}

Ids ids_of(const run::GroupPlan& group) {
  Ids ids;
  for (const run::CasePlan& one : group.cases) ids.push_back(one.id);
  return ids;
}

Ids random_part(Ids ids, SplitMix64& random) {
  for (std::size_t i = ids.size(); i > 1; --i) std::swap(ids[i - 1], ids[random.below(i)]);
  ids.resize(1 + random.below(ids.size()));
  return ids;
}

// Who asks matches times with cases by their places.
TEST(Launches, measure_the_cases_that_are_asked_for_in_the_order_of_the_question) {
  SplitMix64 random(3);
  for (int draw = 0; draw < 300; ++draw) {
    run::Plan plan;
    std::vector<Ids> groups(1 + random.below(4));
    int next = 100;
    for (Ids& ids : groups) {
      for (std::uint64_t i = 0, count = 1 + random.below(8); i < count; ++i)
        ids.push_back("c" + std::to_string(next++));
      plan.groups.push_back(group_of(ids));
    }
    const Ids wanted = random_part(groups[random.below(groups.size())], random);
    Ids asked = wanted;
    if (random.below(2) == 0)
      for (std::string& id : asked) id += "-2";  // of the second scene that has it
    EXPECT_EQ(ids_of(group_to_measure(plan, asked)), wanted);
    asked.push_back("c1");
    EXPECT_THROW(group_to_measure(plan, asked), Error);
  }
}

}  // namespace
}  // namespace clusterbench::cli
