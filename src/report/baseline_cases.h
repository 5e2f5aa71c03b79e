#pragma once
// Which case of an earlier result a case is held against: the one of the same camera, viewport, grid, method and
// structure, also where the level itself has changed since.

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace clusterbench::report {

class BaselineCases {
 public:
  // Both must outlive it. `filter`: what the result's cases were selected by; others of the base are not missed.
  // `name`: what messages call the base.
  BaselineCases(const nlohmann::ordered_json& base, const nlohmann::ordered_json& result, const std::string& filter,
                std::string name);

  // Null: the base has none.
  const nlohmann::ordered_json* case_of(const nlohmann::ordered_json& result_case) const;
  // The base's cases that the result no longer has, by their names.
  const std::vector<std::string>& gone() const { return gone_; }
  const std::vector<const nlohmann::ordered_json*>& gone_cases() const { return gone_cases_; }
  const nlohmann::ordered_json& result() const { return base_; }
  const std::string& name() const { return name_; }
  // "the scene's file, its lights (300, now 250)"; "" where nothing has changed that results tell.
  std::string what_changed(const nlohmann::ordered_json& result_case) const;
  // Why instructions of these two do not compare; "" where they do.
  std::string obstacle_to_instructions(const nlohmann::ordered_json& result_case) const;

 private:
  std::string key_of(const nlohmann::ordered_json& result_case) const;

  const nlohmann::ordered_json &base_, &next_;
  std::string name_;
  bool is_one_scene_ = false;
  std::map<std::string, const nlohmann::ordered_json*> by_key_;
  std::vector<std::string> gone_;
  std::vector<const nlohmann::ordered_json*> gone_cases_;
};

}  // namespace clusterbench::report
