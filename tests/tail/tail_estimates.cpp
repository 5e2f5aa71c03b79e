// For scripts/sizing_holdout: reads one JSON object per line, {"paths": [[needs]], "capacities": [..]}, and writes one
// per line, the estimate: {"refusal"} or {"fits", "peaks", "chances": [[estimate, low, high]]}.

#include <iostream>
#include <nlohmann/json.hpp>

#include "measure/statistics/peaks_over_threshold.h"

namespace {

using Json = nlohmann::json;

Json estimate(const Json& asked) {
  const auto needs = asked["paths"].get<std::vector<std::vector<std::uint64_t>>>();
  std::vector<clusterbench::measure::PathNeeds> paths;
  for (const std::vector<std::uint64_t>& path : needs) paths.push_back({path, 1});
  const clusterbench::measure::TailEstimate found = clusterbench::measure::tail_of(paths);
  if (!found.tail) return {{"refusal", found.refusal}};
  Json out{{"fits", found.tail->fits},
           {"peaks", found.tail->peaks},
           {"threshold", found.tail->threshold},
           {"shape", found.tail->shape},
           {"chances", Json::array()}};
  for (const Json& capacity : asked["capacities"]) {
    const clusterbench::measure::Chance chance = found.tail->chance_above(capacity.get<std::uint64_t>());
    out["chances"].push_back({chance.estimate, chance.ci95.low, chance.ci95.high});
  }
  return out;
}

}  // namespace

int main() {
  for (std::string line; std::getline(std::cin, line);) std::cout << estimate(Json::parse(line)).dump() << std::endl;
}
