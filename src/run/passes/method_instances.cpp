#include "run/passes/method_instances.h"

#include <utility>

namespace clusterbench::run {

void MethodInstances::fill(const PreparedFrame& now, ListMemory& memory, ListsOfFrame& out) {
  std::unique_ptr<Instance> one = idle_or_new();
  assign::AssignerRun& run = one->run;
  const view::LightArrays& lights = now.lights.in_precision(method_.precision);
  if (one->grid != now.grid) run.build(*(one->grid = now.grid), assign::kinds_of(lights));
  run.use_memory_of(memory.take());
  run.assign({now.frame, lights, now.depth.get()});
  run.hand_over(order_, out.filled, out.ascending);
  out.scratch_bytes = run.scratch_bytes();
  out.tests_done = run.tests_done();
  out.fallbacks = run.fallbacks();

  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(one));
}

std::unique_ptr<MethodInstances::Instance> MethodInstances::idle_or_new() {
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      std::unique_ptr<Instance> last = std::move(idle_.back());
      idle_.pop_back();
      return last;
    }
  }
  return std::make_unique<Instance>(Instance{start_method(config_, method_), nullptr});
}

}  // namespace clusterbench::run
