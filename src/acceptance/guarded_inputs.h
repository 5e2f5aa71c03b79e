#pragma once
// A frame's grid, camera and lights in memory that nobody may write to, or touch beside its arrays.

#include <deque>

#include "acceptance/subject.h"
#include "os/guarded_memory.h"
#include "plugin/clusterbench_plugin.h"

namespace clusterbench::acceptance {

class GuardedInputs {
 public:
  // Refers to nothing of the frame afterwards.
  GuardedInputs(const SubjectFrame& frame, os::GuardedMemory::Guard guard);

  const clusterbench_grid& grid() const { return *grid_; }
  const clusterbench_frame& frame() const { return *frame_; }
  const clusterbench_lights& lights() const { return *lights_; }
  std::uint32_t light_types() const { return light_types_; }

 private:
  template <class Value>
  const Value* guarded(const char* name, const Value* values, std::size_t count);
  void guard_grid(clusterbench_grid grid);
  void guard_frame(clusterbench_frame frame, std::size_t pixels);
  void guard_lights(clusterbench_lights lights);
  void guard_source(clusterbench_lights& lights);

  os::GuardedMemory::Guard guard_;
  std::deque<os::GuardedMemory> arrays_;
  std::uint32_t light_types_ = 0;
  const clusterbench_grid* grid_ = nullptr;
  const clusterbench_frame* frame_ = nullptr;
  const clusterbench_lights* lights_ = nullptr;
};

}  // namespace clusterbench::acceptance
