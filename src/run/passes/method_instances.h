#pragma once
// Instances of a method that fills lists, so that several threads can be at frames of a path at the same time.

#include <memory>
#include <mutex>
#include <vector>

#include "assign/contract/assigner_run.h"
#include "config/config.h"
#include "run/cases/case_plan.h"
#include "run/passes/list_memory.h"
#include "run/passes/prepared_frame.h"

namespace clusterbench::run {

class MethodInstances {
 public:
  // `order`: of the cells' lists. `config` must outlive this object.
  MethodInstances(const config::Config& config, const Method& method, assign::ListOrder order)
      : config_(config), method_(method), order_(order) {}

  // With an instance that no other thread uses: on one thread always the same, which gets all frames in their order.
  void fill(const PreparedFrame& now, ListMemory& memory, ListsOfFrame& out);

 private:
  struct Instance {
    assign::AssignerRun run;
    std::shared_ptr<const grid::Grid> grid;  // for which it is built
  };
  std::unique_ptr<Instance> idle_or_new();

  const config::Config& config_;
  const Method method_;
  const assign::ListOrder order_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Instance>> idle_;
};

}  // namespace clusterbench::run
