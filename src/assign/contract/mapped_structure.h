#pragma once
// A light structure made from some of a rig's lights, with results in the rig's indices.

#include <span>

#include "assign/contract/light_structure.h"

namespace clusterbench::assign {

// Replaces each light i of the lists by rig_lights[i]; rig_lights ascends.
inline void map_lights(std::vector<std::uint32_t>& lights, std::span<const std::uint32_t> rig_lights) {
  for (std::uint32_t& light : lights) light = rig_lights[light];
}

// Returns the structure's results in the rig's indices; its sizes stay those of the lights that it was made from.
// Refers to both arguments.
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
