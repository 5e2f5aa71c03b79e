#include "report/results/merged_machines.h"

#include <algorithm>
#include <optional>

#include "report/cases/json_values.h"
#include "report/documents/machine_name.h"

namespace clusterbench::report {
namespace {

using result::MeasuredMachine;

// Of a case of a part; without a name.
MeasuredMachine machine_of(const result::Case& result_case, const result::Result& part) {
  if (result_case.machine && part.machines)
    for (MeasuredMachine machine : *part.machines)
      if (machine.name == *result_case.machine) {
        machine.name.clear();
        return machine;
      }
  const std::optional<std::string> of_shard = part.shard ? part.shard->host : std::optional<std::string>();
  return {"", machine_kind(part.machine), part.tool.simd_target, part.machine.host ? part.machine.host : of_shard};
}

bool is_one(const MeasuredMachine& known, MeasuredMachine machine) {
  machine.name = known.name;
  return are_same(known, machine);
}

}  // namespace

bool is_measured(const result::Case& result_case) {
  return result_case.timing || result_case.device || result_case.reading || result_case.count;
}

MachinesOfParts::MachinesOfParts(const std::vector<NamedPart>& parts) {
  for (const NamedPart& part : parts)
    for (const result::Case& result_case : part.result.cases) {
      if (!is_measured(result_case)) continue;
      MeasuredMachine machine = machine_of(result_case, part.result);
      if (std::ranges::any_of(machines_, [&](const MeasuredMachine& known) { return is_one(known, machine); }))
        continue;
      machine.name = "machine " + std::to_string(machines_.size() + 1);
      machines_.push_back(std::move(machine));
    }
}

void MachinesOfParts::name_in(result::Case& result_case, const result::Result& part) const {
  const MeasuredMachine machine = machine_of(result_case, part);
  result_case.machine.reset();
  if (machines_.size() < 2 || !is_measured(result_case)) return;
  const auto known = std::ranges::find_if(machines_, [&](const MeasuredMachine& one) { return is_one(one, machine); });
  result_case.machine = known->name;
}

void MachinesOfParts::add_to(result::Result& merged) const {
  if (!machines_.empty()) {
    merged.machine = machines_.front().machine;
    if (machines_.size() == 1) merged.machine.host = machines_.front().host;
    merged.tool.simd_target = machines_.front().simd_target;
  }
  if (machines_.size() > 1) merged.machines = machines_;
}

}  // namespace clusterbench::report
