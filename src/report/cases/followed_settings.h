#pragma once
// Settings of a configuration that figures of a result follow: the prices of `cost`, and allocation.margin. They are no
// part of a case's id, so two results of the same cases can have other ones.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "result/result.h"

namespace clusterbench::report {

struct OtherSetting {
  std::string key;                     // "cost.ns_per_light", "cost.weights.opaque"
  nlohmann::ordered_json before, now;  // null: not set, or the result is older than the setting
};
// Prices that differ. Those that an older result lacks were 0.
std::vector<OtherSetting> other_prices(const result::Result& base, const result::Result& next);
// Empty: the same margin.
std::vector<OtherSetting> other_margin(const result::Result& base, const result::Result& next);

}  // namespace clusterbench::report
