#pragma once
// Finds the case of an earlier result that a case is compared with: the one of the same camera, viewport, grid, method
// and structure, even if the level itself has changed since.

#include <map>
#include <string>
#include <vector>

#include "result/result.h"

namespace clusterbench::report {

class BaselineCases {
 public:
  // Both must outlive it. `filter`: the filter of the result's cases; other cases of the base are not reported as gone.
  // `name`: name of the base in messages.
  BaselineCases(const result::Result& base, const result::Result& result, const std::string& filter, std::string name);

  // Null: not in the base.
  const result::Case* case_of(const result::Case& result_case) const;
  // The base's cases that the result does not have.
  const std::vector<const result::Case*>& gone_cases() const { return gone_cases_; }
  const std::string& name() const { return name_; }
  // "the scene's file, its lights (300, now 250)"; "" if results show no change.
  std::string changes_of(const result::Case& result_case) const;
  // Why the instructions of both are not comparable; "" if they are.
  std::string obstacle_to_instructions(const result::Case& result_case) const;
  // Settings that figures follow and that differ: "cost.wave is "8x8" here and "8x4" in base.json"; "" if none does.
  std::string other_prices() const;
  std::string other_weights() const;  // of cost.weights alone
  std::string other_margin() const;

 private:
  std::string key_of(const result::Case& result_case) const;
  std::string changed_plugin(const result::Case& result_case) const;

  const result::Result &base_, &next_;
  std::string name_;
  std::string obstacle_;  // for the instructions of any two cases; "": none
  bool is_one_scene_ = false;
  std::map<std::string, const result::Case*> by_key_;
  std::vector<const result::Case*> gone_cases_;
};

}  // namespace clusterbench::report
