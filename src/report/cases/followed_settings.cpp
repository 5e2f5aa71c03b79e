#include "report/cases/followed_settings.h"

#include "report/cases/json_values.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

bool is_none_or_0(const Json& value) {
  return value.is_null() || value == 0;
}

// Members of objects are settings of their own.
void add_if_other(const OtherSetting& setting, std::vector<OtherSetting>& out) {
  const auto& [name, before, now] = setting;
  if (before.is_object() && now.is_object()) {
    Json keys = before;
    keys.update(now);
    for (const auto& member : keys.items())
      add_if_other({name + "." + member.key(), before.value(member.key(), Json()), now.value(member.key(), Json())},
                   out);
  } else if (before != now && !(is_none_or_0(before) && is_none_or_0(now))) {
    out.push_back(setting);
  }
}

Json setting_of(const result::Result& result, const char* pointer, const Json& otherwise) {
  const Json* value = value_at(result.config, pointer);
  return value == nullptr ? otherwise : *value;
}

}  // namespace

std::vector<OtherSetting> other_prices(const result::Result& base, const result::Result& next) {
  std::vector<OtherSetting> out;
  add_if_other({"cost", setting_of(base, "/cost", Json::object()), setting_of(next, "/cost", Json::object())}, out);
  return out;
}

std::vector<OtherSetting> other_margin(const result::Result& base, const result::Result& next) {
  std::vector<OtherSetting> out;
  const char* pointer = "/allocation/margin";
  add_if_other({"allocation.margin", setting_of(base, pointer, {}), setting_of(next, pointer, {})}, out);
  return out;
}

}  // namespace clusterbench::report
