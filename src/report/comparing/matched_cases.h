#pragma once
// The cases that two results have in common, and those of one side.

#include <string>
#include <vector>

#include "result/documents/comparison.h"
#include "result/result.h"

namespace clusterbench::report {

// A case that both results have: the one with the same id. Both results must outlive it.
struct Match {
  const result::Case& base;
  const result::Case& next;
};

// In the order of `next`.
std::vector<Match> matches_of(const result::Result& base, const result::Result& next);
// The cases of `result` that `other` does not have.
std::vector<const result::Case*> missing_from(const result::Result& other, const result::Result& result);
// Cases with the same name on both sides that are not the same case. `only_in_base`, `only_in_new`: of missing_from().
std::vector<result::RenamedCase> renamed_cases(const result::Result& base,
                                               const std::vector<const result::Case*>& only_in_base,
                                               const result::Result& next,
                                               const std::vector<const result::Case*>& only_in_new);
// For each part that cases may not have, the number of matches that have it on only one side.
std::vector<result::PartOfOne> parts_of_one(const std::vector<Match>& matches);

}  // namespace clusterbench::report
