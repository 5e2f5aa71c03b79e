#include "report/documents/machine_name.h"

#include <utility>
#include <vector>

#include "core/text.h"

namespace clusterbench::report {
namespace {

std::string size_text(std::uint64_t bytes) {
  constexpr std::uint64_t k_mebibyte = 1u << 20;
  return bytes % k_mebibyte == 0 ? std::to_string(bytes / k_mebibyte) + " MiB" : std::to_string(bytes >> 10) + " KiB";
}

}  // namespace

result::Machine machine_kind(result::Machine machine) {
  machine.clock_mhz.reset();
  machine.load.reset();
  machine.host.reset();
  return machine;
}

std::string machine_name(const result::Machine& machine) {
  std::vector<std::string> numbers, caches, parts;
  if (machine.family) numbers.push_back("family " + *machine.family);
  if (machine.model) numbers.push_back("model " + *machine.model);
  if (machine.stepping) numbers.push_back("stepping " + *machine.stepping);
  if (machine.caches)
    for (const auto& [level, bytes] : *machine.caches) caches.push_back("L" + level.substr(1) + " " + size_text(bytes));
  for (const std::vector<std::string>* sizes : {&numbers, &caches})
    if (!sizes->empty()) parts.push_back(joined(*sizes));
  return parts.empty() ? machine.cpu : machine.cpu + " (" + joined(parts, "; ") + ")";
}

}  // namespace clusterbench::report
