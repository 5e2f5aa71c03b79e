#include "report/preset_losses.h"

#include <algorithm>
#include <string>

#include "report/json_values.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

std::uint64_t loss_at(const Json& from, const char* pointer) {
  return static_cast<std::uint64_t>(number_at(from, pointer).value_or(0.0));
}

// Of all sets of samples that cost something, the one that lacks most.
double unlit_share(const Json& result_case, const Json& samples) {
  double most = samples["missed"].get<double>() / samples["needed"].get<double>();
  if (const Json* sets = value_at(result_case, "/cost/sets"))
    for (const auto& [set, paid] : sets->items())
      most = std::max(
          most, number_at(result_case, (set == "volume" ? "/shading" : "/samples/" + set) + "/unlit").value_or(0.0));
  return most;
}

}  // namespace

const Json* ranking_samples(const Json& result_case) {
  const Json* opaque = value_at(result_case, "/samples/opaque");
  return opaque != nullptr ? opaque : value_at(result_case, "/shading");
}

PresetLosses preset_losses(const Json& result_case) {
  PresetLosses losses;
  losses.is_compared = value_at(result_case, "/error") != nullptr;
  losses.true_pairs = loss_at(result_case, "/error/true_pairs");
  const std::uint64_t missed = loss_at(result_case, "/error/false_negatives");
  losses.by_method = missed - std::min(missed, loss_at(result_case, "/pre_cull/lost_pairs"));
  losses.by_limit = loss_at(result_case, "/pre_cull/over_limit/lost_pairs");
  losses.dropped = loss_at(result_case, "/buffers/overflow/dropped_pairs");
  const Json* samples = ranking_samples(result_case);
  if (samples != nullptr) losses.needed = number_at(*samples, "/needed").value_or(0.0);
  if (losses.needed > 0.0) losses.unlit = unlit_share(result_case, *samples);
  return losses;
}

}  // namespace clusterbench::report
