#include "report/contender.h"

#include <algorithm>

#include "report/columns.h"
#include "report/json_values.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

std::string view_of(const Json& one) {
  return Json{one["camera"], one["viewport"]}.dump();
}

measure::Costs costs_of(const Json& one) {
  measure::Costs costs;
  const auto low = number_at(one, "/timing/frame_ns/ci95/0"), high = number_at(one, "/timing/frame_ns/ci95/1");
  if (low && high) costs.time_ns = {*low, *high};
  costs.bytes = number_at(one, "/buffers/bytes/high_water").value_or(costs.k_unknown);
  costs.overshade = number_at(one, "/shading/overshade").value_or(costs.k_unknown);
  return costs;
}

}  // namespace

std::vector<double> frame_rounds(const Json& one) {
  const Json samples = one.value(Json::json_pointer("/timing/frame_ns/samples"), Json::array());
  if (!std::ranges::all_of(samples, [](const Json& ns) { return ns.is_number(); })) return {};
  return samples.get<std::vector<double>>();
}

std::uint64_t seed_of(const Json& result) {
  const Json seed = result["config"].value("seed", Json());
  return seed.is_number_unsigned() ? seed.get<std::uint64_t>() : 1;
}

run::Contender contender_of(const Json& one) {
  run::Contender out{one["id"], one["scene"], view_of(one), costs_of(one), one["eligible"], block_of(one), {}, {},
                     1,         false};
  if (!one.contains("timing")) return out;
  out.rounds_ns = frame_rounds(one);
  out.session = one["timing"].value("session", "");
  out.launches = one["timing"].value("launches", 1);
  out.is_cold = one["timing"].value("caches", "warm") == "cold";
  return out;
}

}  // namespace clusterbench::report
