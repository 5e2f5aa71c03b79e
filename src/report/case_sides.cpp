#include "report/case_sides.h"

#include <limits>

#include "report/columns.h"
#include "report/result_json.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

Json share_saved(const Json& with, const Json& without) {
  const auto number = [](const Json& value) {
    return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
  };
  return number_or_null(1.0 - number(with) / number(without));
}

std::string more_than_other(const Json& share_saved) {
  if (!share_saved.is_number()) return "-";
  const double share = share_saved.get<double>();
  return text("%+.1f %%", share == 0.0 ? 0.0 : -100.0 * share);
}

}  // namespace

Json to_json(const run::Extremes& extremes) {
  if (extremes.count == 0) return {{"min", nullptr}, {"mean", nullptr}, {"max", nullptr}};
  return {{"min", number_or_null(extremes.least)},
          {"mean", number_or_null(extremes.mean())},
          {"max", number_or_null(extremes.greatest)}};
}

Json to_json(const run::CaseSide& side) {
  Json out = Json::object();
  if (side.pairs_mean) out["pairs"] = number_or_null(*side.pairs_mean);
  if (side.true_pairs) {
    out["true_pairs"] = *side.true_pairs;
    out["false_positives"] = *side.false_positives;
  }
  if (side.list_changes) out["lists_changed"] = number_or_null(side.list_changes->share());
  out["index_entries"] = side.index_entries;
  out["bytes"] = side.bytes;
  out["evaluated"] = Json::object();
  out["missed"] = Json::object();
  for (const run::EvaluatedLights& set : side.evaluated) {
    out["evaluated"][set.set] = set.evaluated;
    out["missed"][set.set] = set.missed;
  }
  return out;
}

Json saved(const Json& with, const Json& without) {
  Json out = Json::object();
  for (const char* key : {"pairs", "false_positives", "lists_changed", "index_entries", "bytes"})
    if (with.contains(key)) out[key] = share_saved(with[key], without[key]);
  out["evaluated"] = Json::object();
  for (const auto& [set, value] : with["evaluated"].items())
    out["evaluated"][set] = share_saved(value, without["evaluated"][set]);
  return out;
}

std::string against_other(const Json& saved, const char* key) {
  return saved.contains(key) ? more_than_other(saved[key]) : "-";
}

std::string evaluated_against_other(const Json& saved) {
  const Json& sets = saved["evaluated"];
  return sets.empty() ? "-" : more_than_other(*sets.begin());
}

}  // namespace clusterbench::report
