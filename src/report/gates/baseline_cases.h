#pragma once
// Which case of an earlier result a case is held against: the one of the same camera, viewport, grid, method and
// structure, also where the level itself has changed since.

#include <map>
#include <string>
#include <vector>

#include "result/result.h"

namespace clusterbench::report {

class BaselineCases {
 public:
  // Both must outlive it. `filter`: what the result's cases were selected by; others of the base are not missed.
  // `name`: what messages call the base.
  BaselineCases(const result::Result& base, const result::Result& result, const std::string& filter, std::string name);

  // Null: the base has none.
  const result::Case* case_of(const result::Case& result_case) const;
  // The base's cases that the result no longer has.
  const std::vector<const result::Case*>& gone_cases() const { return gone_cases_; }
  const std::string& name() const { return name_; }
  // "the scene's file, its lights (300, now 250)"; "" where nothing has changed that results tell.
  std::string what_changed(const result::Case& result_case) const;
  // Why instructions of these two do not compare; "" where they do.
  std::string obstacle_to_instructions(const result::Case& result_case) const;

 private:
  std::string key_of(const result::Case& result_case) const;

  const result::Result &base_, &next_;
  std::string name_;
  std::string obstacle_;  // to instructions of any two cases; "": none
  bool is_one_scene_ = false;
  std::map<std::string, const result::Case*> by_key_;
  std::vector<const result::Case*> gone_cases_;
};

}  // namespace clusterbench::report
