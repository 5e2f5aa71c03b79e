#pragma once
// Settings of a configuration that figures of a result follow: the prices of `cost`, and allocation.margin. They are no
// part of a case's id, so two results of the same cases can have other ones.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "result/result.h"

namespace clusterbench::report {

struct OtherSetting {
  std::string key;                     // "cost.ns_per_light"
  nlohmann::ordered_json before, now;  // null: older than the setting
};
// Prices that differ, by the members of `cost`; with all weights as one value.
std::vector<OtherSetting> other_prices(const result::Result& base, const result::Result& next);
// None: the same margin.
std::optional<OtherSetting> other_margin(const result::Result& base, const result::Result& next);

}  // namespace clusterbench::report
