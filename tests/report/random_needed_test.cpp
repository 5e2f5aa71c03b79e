// The budget of the lights that samples need, of cases with several sets of samples: each set is held by itself, so
// that none makes up for what another one has lost, and a set that one of two results lacks is no pass.

#include <gtest/gtest.h>

#include <map>

#include "core/random.h"
#include "records.h"
#include "report/gates/baseline_cases.h"
#include "report/gates/limits.h"
#include "report/result_by_hand.h"
#include "report/results/result_record.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t k_samples = 1000;
constexpr const char* k_sets[] = {"opaque", "fog", "mirror"};

// Lights that the samples of a set need; what has no samples is not there.
using Needed = std::map<std::string, std::uint64_t>;

Needed random_sets(SplitMix64& random) {
  Needed sets;
  for (const char* set : k_sets)
    if (random.below(3) > 0) sets[set] = random.below(4) == 0 ? 0 : 900 + random.below(200);
  return sets;
}

// Some sets gone, new, or with other needs.
Needed changed(Needed sets, SplitMix64& random) {
  for (const char* set : k_sets) {
    const std::uint64_t way = random.below(8);
    if (way == 0) sets.erase(set);
    if (way == 1) sets[set] = 1000;
    if (way == 2 && sets.contains(set)) sets[set] = sets[set] * (90 + random.below(20)) / 100;
  }
  return sets;
}

Json result_of_sets(const Needed& sets) {
  Json result = result::to_json(record_of(testing::result_by_hand(), {}));
  Json one = result["cases"][0];
  one.erase("shading");
  Json counts = Json::object(), costs = Json::object();
  for (const auto& [set, needed] : sets) {
    counts[set] = {{"samples", k_samples}, {"evaluated", needed}, {"needed", needed}, {"missed", 0}};
    costs[set] = {{"samples", 1.0}};
  }
  one["samples"] = counts;
  one["cost"] = {{"sets", costs}, {"lit", true}};
  Json other = result["cases"][1];  // of another method, which has samples of its own and does not change
  other["samples"] = {{"opaque", {{"samples", k_samples}, {"evaluated", 9}, {"needed", 9}, {"missed", 0}}}};
  other["cost"] = {{"sets", {{"opaque", {{"samples", 1.0}}}}}, {"lit", true}};
  result["cases"] = Json::array({one, other});
  return result;
}

bool is_green(const Needed& before, const Needed& after) {
  const result::Result base = test::result_of(result_of_sets(before)), result = test::result_of(result_of_sets(after));
  const config::LimitRule rules[] = {config::limit_rule("needed < -5 %", "", "--fail-if")};
  const BaselineCases cases(base, result, "", "base.json");
  return limit_findings(result, rules, &cases).broken.empty();
}

// Without any set before and after there is nothing to hold, and the other case is held.
bool is_held(const Needed& before, const Needed& after) {
  if (before.size() != after.size()) return false;
  for (const auto& [set, then] : before) {
    const auto now = after.find(set);
    if (now == after.end() || 100 * now->second < 95 * then) return false;
  }
  return true;
}

TEST(RandomNeeds, are_held_set_by_set) {
  SplitMix64 random(8);
  int green = 0, red = 0;
  for (int draw = 0; draw < 400; ++draw) {
    const Needed before = random_sets(random), after = changed(before, random);
    EXPECT_EQ(is_green(before, after), is_held(before, after)) << Json(before) << " to " << Json(after);
    ++(is_held(before, after) ? green : red);
  }
  EXPECT_GT(green, 50);
  EXPECT_GT(red, 50);
}

}  // namespace
}  // namespace clusterbench::report
