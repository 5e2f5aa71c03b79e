#include "report/machine.h"

#include <array>
#include <utility>
#include <vector>

#include "core/text.h"
#include "run/records/records.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array k_numbers{"family", "model", "stepping"};

std::string size_text(std::uint64_t bytes) {
  constexpr std::uint64_t k_mebibyte = 1u << 20;
  return bytes % k_mebibyte == 0 ? std::to_string(bytes / k_mebibyte) + " MiB" : std::to_string(bytes >> 10) + " KiB";
}

}  // namespace

Json machine_to_json(const run::MachineFacts& machine) {
  return result::to_json(run::record_of(machine));
}

Json without_state(Json machine) {
  for (const char* key : {"clock_mhz", "load"}) machine.erase(key);
  return machine;
}

std::string machine_name(const Json& machine) {
  std::vector<std::string> numbers, caches, parts;
  for (const char* key : k_numbers)
    if (machine.contains(key)) numbers.push_back(std::string(key) + " " + machine[key].get<std::string>());
  if (machine.contains("caches"))
    for (const auto& [level, bytes] : machine["caches"].items())
      caches.push_back("L" + level.substr(1) + " " + size_text(bytes.get<std::uint64_t>()));
  for (const std::vector<std::string>* sizes : {&numbers, &caches})
    if (!sizes->empty()) parts.push_back(joined(*sizes));
  const std::string name = machine.at("cpu").get<std::string>();
  return parts.empty() ? name : name + " (" + joined(parts, "; ") + ")";
}

}  // namespace clusterbench::report
