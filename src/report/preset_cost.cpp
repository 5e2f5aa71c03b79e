#include "report/preset_cost.h"

#include "config/presets.h"
#include "report/json_values.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

bool uploads_lists(const Json& result_case) {
  const config::Preset* preset = config::find_preset(result_case["preset"].get<std::string>());
  return preset == nullptr || preset->assigns_on == config::AssignsOn::cpu;
}

bool is_searched(const Json& result_case) {
  return result_case.value("samples_search", false);
}

// By points of the whole view, which stand for the picture's pixels. Older results have no price of reading.
std::optional<PresetCost> cost_in_view(const Json& result_case, const Json& config) {
  const Json* points = value_at(result_case, "/shading");
  if (!config.contains("cost") || points == nullptr || (*points)["samples"] == 0) return std::nullopt;
  const Json& prices = config["cost"];
  const double pixels = result_case["viewport"][0].get<double>() * result_case["viewport"][1].get<double>();
  const auto in_frame = [&](const char* what) {
    return pixels * points->value(what, 0.0) / (*points)["samples"].get<double>();
  };
  const double bytes_ns = prices.contains("read_gb_per_s") ? 1.0 / prices["read_gb_per_s"].get<double>() : 0.0;
  const double upload_bytes = number_at(result_case, "/buffers/upload_bytes/mean").value_or(0.0);
  return PresetCost{upload_bytes / prices["upload_gb_per_s"].get<double>(),
                    in_frame("reads") * prices.value("ns_per_read", 0.0) + in_frame("read_bytes") * bytes_ns,
                    in_frame("evaluated") * prices["ns_per_light"].get<double>(), is_searched(result_case), true};
}

}  // namespace

std::optional<PresetCost> preset_cost(const Json& result_case, const Json& config) {
  std::optional<PresetCost> cost;
  if (number_at(result_case, "/cost/shade_ns")) {
    const auto part = [&](const char* pointer) { return number_at(result_case, pointer).value_or(0.0); };
    const Json& sets = result_case["cost"]["sets"];
    cost = PresetCost{part("/cost/upload_ns"), part("/cost/read_ns"), part("/cost/shade_ns"), is_searched(result_case),
                      sets.contains("volume") && !sets.contains("opaque")};
  } else {
    cost = cost_in_view(result_case, config);
  }
  if (cost && !uploads_lists(result_case)) cost->upload_ns = 0.0;
  return cost;
}

bool are_alike(const PresetCost& less, const PresetCost& more) {
  if (more.sum_ns() <= k_alike_ratio * less.sum_ns()) return true;
  const auto at = [](const PresetCost& cost, const double(&prices)[3]) {
    return prices[0] * cost.upload_ns + prices[1] * cost.read_ns + prices[2] * cost.shade_ns;
  };
  for (int corner = 0; corner < 8; ++corner) {
    double prices[3];
    for (int i = 0; i < 3; ++i) prices[i] = (corner >> i & 1) != 0 ? k_price_factor : 1.0 / k_price_factor;
    if (at(more, prices) <= at(less, prices)) return true;
  }
  return false;
}

}  // namespace clusterbench::report
