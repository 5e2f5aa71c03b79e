#include "report/case_sides.h"

#include "report/columns.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

std::string more_than_other(const Json& share_saved) {
  if (!share_saved.is_number()) return "-";
  const double share = share_saved.get<double>();
  return text("%+.1f %%", share == 0.0 ? 0.0 : -100.0 * share);
}

}  // namespace

std::string against_other(const Json& saved, const char* key) {
  return saved.contains(key) ? more_than_other(saved[key]) : "-";
}

std::string evaluated_against_other(const Json& saved) {
  const Json& sets = saved["evaluated"];
  return sets.empty() ? "-" : more_than_other(*sets.begin());
}

}  // namespace clusterbench::report
