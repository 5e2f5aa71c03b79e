#include "acceptance/guarded_inputs.h"

#include <cstring>

#include "plugin/views.h"

namespace clusterbench::acceptance {

GuardedInputs::GuardedInputs(const SubjectFrame& frame, os::GuardedMemory::Guard guard)
    : guard_(guard), light_types_(plugin::light_types_of(frame.kinds())) {
  guard_grid(plugin::view_of(frame.grid));
  guard_frame(plugin::view_of(frame.frame, frame.input().depth), frame.depths.nearest.size());
  guard_lights(plugin::view_of(frame.lights));
}

template <class Value>
const Value* GuardedInputs::guarded(const char* name, const Value* values, std::size_t count) {
  if (values == nullptr) return nullptr;
  const os::GuardedMemory& memory = arrays_.emplace_back(name, count * sizeof(Value), guard_);
  if (count > 0) std::memcpy(memory.data(), values, count * sizeof(Value));
  memory.forbid_writing();
  return reinterpret_cast<const Value*>(memory.data());
}

void GuardedInputs::guard_grid(clusterbench_grid grid) {
  grid.x = guarded("grid.x", grid.x, grid.cells[0] + std::size_t{1});
  grid.y = guarded("grid.y", grid.y, grid.cells[1] + std::size_t{1});
  grid.z = guarded("grid.z", grid.z, grid.cells[2] + std::size_t{1});
  grid_ = guarded("grid", &grid, 1);
}

void GuardedInputs::guard_frame(clusterbench_frame frame, std::size_t pixels) {
  frame.depth = guarded("frame.depth", frame.depth, pixels);
  frame_ = guarded("frame", &frame, 1);
}

void GuardedInputs::guard_lights(clusterbench_lights lights) {
  const std::size_t spots = lights.spot_count, all = lights.point_count + spots + lights.box_count;
  lights.x = guarded("lights.x", lights.x, all);
  lights.y = guarded("lights.y", lights.y, all);
  lights.z = guarded("lights.z", lights.z, all);
  lights.radius = guarded("lights.radius", lights.radius, all);
  lights.reach = guarded("lights.reach", lights.reach, all);
  lights.axis_x = guarded("lights.axis_x", lights.axis_x, spots);
  lights.axis_y = guarded("lights.axis_y", lights.axis_y, spots);
  lights.axis_z = guarded("lights.axis_z", lights.axis_z, spots);
  lights.cos_angle = guarded("lights.cos_angle", lights.cos_angle, spots);
  lights.sin_angle = guarded("lights.sin_angle", lights.sin_angle, spots);
  lights.half_axes = guarded("lights.half_axes", lights.half_axes, std::size_t{9} * lights.box_count);
  guard_source(lights);
  lights_ = guarded("lights", &lights, 1);
}

// The members of one light lie in one struct; all of them are copied, and keep their places in it.
void GuardedInputs::guard_source(clusterbench_lights& lights) {
  if (lights.world_position == nullptr) return;
  const std::size_t all = lights.point_count + std::size_t{lights.spot_count} + lights.box_count;
  const auto* const first =
      reinterpret_cast<const std::byte*>(lights.world_position) - offsetof(scene::WorldLight, position);
  const std::byte* const copied = guarded("lights.world", first, all * lights.world_stride);
  for (const double** member :
       {&lights.world_position, &lights.world_radius, &lights.world_axis, &lights.world_angle, &lights.world_half_axes})
    *member = reinterpret_cast<const double*>(copied + (reinterpret_cast<const std::byte*>(*member) - first));
}

}  // namespace clusterbench::acceptance
