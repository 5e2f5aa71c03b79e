#include "report/cases/followed_settings.h"

#include "report/cases/json_values.h"

namespace clusterbench::report {
namespace {

nlohmann::ordered_json value_or_null(const result::Result& result, const char* pointer) {
  const nlohmann::ordered_json* value = value_at(result.config, pointer);
  return value == nullptr ? nlohmann::ordered_json() : *value;
}

}  // namespace

std::vector<OtherSetting> other_prices(const result::Result& base, const result::Result& next) {
  const nlohmann::ordered_json before = value_or_null(base, "/cost"), now = value_or_null(next, "/cost");
  std::vector<OtherSetting> out;
  for (const auto& [key, value] : now.items()) {
    const nlohmann::ordered_json earlier = before.contains(key) ? before[key] : nlohmann::ordered_json();
    if (earlier != value) out.push_back({"cost." + key, earlier, value});
  }
  return out;
}

std::optional<OtherSetting> other_margin(const result::Result& base, const result::Result& next) {
  OtherSetting margin{"allocation.margin", value_or_null(base, "/allocation/margin"),
                      value_or_null(next, "/allocation/margin")};
  return margin.before == margin.now ? std::nullopt : std::optional(std::move(margin));
}

}  // namespace clusterbench::report
