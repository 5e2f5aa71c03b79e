#pragma once
// The same check on every instruction set.

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstdint>
#include <set>
#include <string>

#include "assign/lists/list_builder.h"

namespace clusterbench::assign::testing {

// Calls check(name) once per instruction set, the scalar one included.
template <class Check>
void on_each_target(Check&& check) {
  const std::int64_t all = hwy::SupportedTargets();
  std::set<std::string> tried;
  for (std::int64_t left = all; left != 0; left &= left - 1) {
    hwy::SetSupportedTargetsForTest(left & -left);
    hwy::GetChosenTarget().DeInit();
    const std::string name = simd_target_name();
    if (tried.insert(name).second) check(name);  // one that is not compiled in falls back to another
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
  std::string names;
  for (const std::string& name : tried) names += name + " ";
  ::testing::Test::RecordProperty("targets", names);
  // Beside a machine's own ones there is SCALAR or, by clang, EMU128. Machines with NEON have nothing else.
  EXPECT_TRUE(tried.contains("SCALAR") || tried.contains("NEON") || tried.size() > 1) << names;
}

}  // namespace clusterbench::assign::testing
