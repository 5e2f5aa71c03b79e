#pragma once
// A light structure that was made of some of a rig's lights, in the rig's indices.

#include <span>

#include "assign/contract/light_structure.h"

namespace clusterbench::assign {

// lists' lights i become rig_lights[i], which ascend.
inline void map_lights(std::vector<std::uint32_t>& lights, std::span<const std::uint32_t> rig_lights) {
  for (std::uint32_t& light : lights) light = rig_lights[light];
}

// Answers as the structure does, in the rig's indices; what it takes stays that of the lights it was made of. Refers to
// both.
class MappedStructure final : public LightStructure {
 public:
  MappedStructure(const LightStructure& structure, std::span<const std::uint32_t> rig_lights)
      : structure_(&structure), rig_lights_(rig_lights) {}

  bool lights_at(const grid::Sample& sample, grid::Log2 way, std::vector<std::uint32_t>& out) const override {
    const bool is_answered = structure_->lights_at(sample, way, out);
    map_lights(out, rig_lights_);
    return is_answered;
  }
  Reads reads_at(const grid::Sample& sample, grid::Log2 way) const override {
    return structure_->reads_at(sample, way);
  }
  StructureUse use() const override {
    StructureUse use = structure_->use();
    map_lights(use.dropped_lights, rig_lights_);
    return use;
  }
  void expand(Lists& out) const override {
    structure_->expand(out);
    map_lights(out.lights, rig_lights_);
  }

  StructureLimit limit() const override { return structure_->limit(); }
  std::vector<BufferNeed> buffers() const override { return structure_->buffers(); }
  std::uint32_t index_bits() const override { return structure_->index_bits(); }
  bool has_cells() const override { return structure_->has_cells(); }
  bool has_occupied_cells() const override { return structure_->has_occupied_cells(); }
  grid::OccupiedCells occupied_cells() const override { return structure_->occupied_cells(); }

 private:
  const LightStructure* structure_;
  std::span<const std::uint32_t> rig_lights_;
};

}  // namespace clusterbench::assign
