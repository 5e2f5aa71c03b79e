#include "run/cases/case_plan.h"

#include <algorithm>

#include "os/call_notes.h"
#include "run/cases/case_names.h"

namespace clusterbench::run {

bool compares_cells(const config::Config& config, const GroupPlan& group) {
  return config.accuracy.check &&
         std::ranges::all_of(group.cases, [](const CasePlan& case_plan) { return case_plan.cells_not_compared == 0; });
}

std::vector<Method> methods_of(const GroupPlan& group) {
  std::vector<Method> list;
  for (const CasePlan& case_plan : group.cases)
    if (std::find(list.begin(), list.end(), case_plan.method()) == list.end()) list.push_back(case_plan.method());
  return list;
}

std::uint64_t label_of(const Method& method) {
  return std::uint64_t{method.assigner} << 40 | std::uint64_t{method.precision} << 24 |
         std::uint64_t{method.pre_cull} << 8 | static_cast<std::uint64_t>(method.answer);
}

const assign::AssignerDescriptor& method_of(const config::Config& config, const CasePlan& case_plan) {
  return *assign::find_assigner(config.assigners[case_plan.assigner].name);
}

bool runs_elsewhere(const config::Config& config, const GroupPlan& group) {
  return std::ranges::any_of(group.cases, [&](const CasePlan& case_plan) {
    const assign::AssignerDescriptor& method = method_of(config, case_plan);
    return method.on_device || !method.plugin.empty();
  });
}

Error error_at(const GroupPlan& group, const Error& error) {
  return Error(error.file(), group.cases.front().name + (error.where().empty() ? "" : ": " + error.where()),
               error.message(), error.code());
}

assign::AssignerRun start_method(const config::Config& config, const Method& method) {
  const config::MethodRequest& request = config.assigners[method.assigner];
  os::note_label(label_of(method));
  return {*assign::find_assigner(request.name), request.params, method.answer};
}

std::string storage_label(const config::Config& config, const CasePlan& case_plan) {
  return case_plan.storage ? config.storages[*case_plan.storage].label() : k_own_structure;
}

std::string lights_label(const config::Config& config, const Method& method) {
  const config::PrecisionRequest& precision = config.precisions[method.precision];
  const cull::PreCullSpec& pre_cull = config.pre_culls[method.pre_cull];
  return (precision.is_lossy() ? " " + precision.label() : "") +
         (pre_cull.is_none() ? "" : " after " + pre_cull.label());
}

std::string method_label(const config::Config& config, const Method& method) {
  const config::MethodRequest& assigner = config.assigners[method.assigner];
  const bool is_one_of_two = method.answer == assign::Answer::structure &&
                             assign::find_assigner(assigner.name)->answers(assign::Answer::lists);
  return assigner.label() + (is_one_of_two ? std::string(" (") + own_structure_name(assigner.name) + ")" : "") +
         lights_label(config, method);
}

}  // namespace clusterbench::run
