#include "gpu/reading/reading_structure.h"

#include <algorithm>
#include <limits>

#include "core/error.h"

namespace clusterbench::gpu {
namespace {

constexpr std::uint32_t k_reading_group = 64;
constexpr std::size_t k_most_tree_levels = 8;  // read_hierarchy.comp

const char* shader_for(assign::Walk walk) {
  switch (walk) {
    case assign::Walk::packed:
      return "read_packed";
    case assign::Walk::fixed:
      return "read_fixed";
    case assign::Walk::bitfield:
      return "read_bitfield";
    case assign::Walk::linked:
      return "read_linked";
    case assign::Walk::runs:
      return "read_runs";
    case assign::Walk::masks:
      return "read_masks";
    case assign::Walk::hierarchy:
      break;
  }
  return "read_hierarchy";
}

// Centre and 1 / range^2: 0 for a light without an end. A light without volume adds nothing.
std::vector<float> packed_lights(const view::LightArrays& lights) {
  std::vector<float> packed;
  for (std::uint32_t light = 0; light < lights.size(); ++light) {
    const float range = lights.radius[light];
    const float inverse = std::min(1.0f / (range * range), std::numeric_limits<float>::max());
    packed.insert(packed.end(), {lights.x[light], lights.y[light], lights.z[light], inverse});
  }
  return packed;
}

// As read_hierarchy.comp has it: of each tree its number of levels, where its lights begin, and where its levels begin.
std::vector<std::uint32_t> tree_words(const assign::ShaderBuffers& shader) {
  std::vector<std::uint32_t> words;
  for (const assign::ShaderBuffers::Tree& tree : shader.trees) {
    const std::size_t levels = tree.level_begins.empty() ? 0 : tree.level_begins.size() - 1;
    if (levels > k_most_tree_levels)
      throw Error(
          "", "reading",
          "a hierarchy of " + std::to_string(levels) + " levels; at most 8, for 16,777,216 lights, are allowed");
    words.push_back(static_cast<std::uint32_t>(levels));
    words.push_back(tree.first_in_order);
    for (std::size_t level = 0; level < k_most_tree_levels; ++level)
      words.push_back(level < levels ? tree.level_begins[level] : 0);
  }
  return words;
}

assign::ShaderBuffers buffers_for_shader(const assign::LightStructure& structure) {
  std::optional<assign::ShaderBuffers> shader = structure.shader_buffers();
  if (!shader)
    throw Error("", "reading",
                "there is no shader for this structure; there are those for lists, bits, ranges, hierarchies");
  return *std::move(shader);
}

}  // namespace

ReadingStructure::ReadingStructure(const assign::LightStructure& structure, const grid::Grid& grid,
                                   const view::LightArrays& lights)
    : structure_(&structure), grid_(&grid), buffers_(device()) {
  if (!device().facts().has_subgroup_arithmetic)
    throw Error("", "device",
                device().facts().name + " has no arithmetic over subgroups, which readings of whole waves need");
  const assign::ShaderBuffers shader = buffers_for_shader(structure);
  looked_up_ = shader.looked_up;
  shader_ = shader_for(shader.walk);
  bytes_ = shader.bytes();
  set_arguments(shader);
  upload(shader, lights, set_lookup(grid, looked_up_, mode_, arguments_));
}

void ReadingStructure::set_arguments(const assign::ShaderBuffers& shader) {
  mode_.index_bytes = shader.index_bytes;
  mode_.has_wide_counts = shader.has_wide_counts;
  mode_.has_boxes = shader.has_boxes;
  mode_.has_end_mark = shader.end_mark.has_value();
  mode_.is_sparse = shader.is_sparse;
  mode_.has_bin_masks = shader.has_bin_masks;
  mode_.has_range_per_cell = shader.has_range_per_cell;
  mode_.has_narrow_ranks = shader.rank_bytes == 2;
  arguments_.header_words = shader.header_words;
  arguments_.per_cell = shader.per_cell;
  arguments_.end_mark = shader.end_mark.value_or(0);
}

void ReadingStructure::upload(const assign::ShaderBuffers& shader, const view::LightArrays& lights,
                              const std::vector<float>& boundaries) {
  struct Upload {
    std::uint32_t binding;
    const char* name;
    std::vector<std::byte> bytes;
  };
  std::vector<Upload> uploads;
  const auto add = [&uploads](std::uint32_t binding, const char* name, std::span<const std::byte> bytes) {
    Upload& added = uploads.emplace_back(Upload{binding, name, {bytes.begin(), bytes.end()}});
    added.bytes.resize((bytes.size() + 3) / 4 * 4);  // shaders read words
  };
  const std::vector<float> packed = packed_lights(lights);
  const std::vector<std::uint32_t> trees = tree_words(shader);
  add(ReadingBinding::lights, "lights", std::as_bytes(std::span(packed)));
  add(ReadingBinding::boundaries, "boundaries of slices", std::as_bytes(std::span(boundaries)));
  std::uint32_t binding = ReadingBinding::structure;
  for (const assign::ShaderBuffers::Buffer& buffer : shader.buffers) add(binding++, buffer.name, buffer.bytes);
  if (!trees.empty()) add(binding, "levels of trees", std::as_bytes(std::span(trees)));
  for (const Upload& one : uploads) buffers_.reserve(one.binding, one.bytes.size(), one.name);
  Commands commands(device(), buffers_);
  for (const Upload& one : uploads) commands.upload(one.binding, one.bytes.data(), one.bytes.size());
  commands.run();
}

Kernel ReadingStructure::kernel(ReadingOutput output, Walking walking, bool given) const {
  if (!allows(walking))
    throw Error("", "reading", "samples of this structure look up no cell, so they cannot walk by cell",
                ExitCode::internal);
  ReadingMode mode = mode_;
  mode.output = output;
  mode.walking = walking;
  if (given) mode.lookup = ReadingLookup::given;
  const bool is_walk = output == ReadingOutput::lights || output == ReadingOutput::check;
  return device().kernel(is_walk ? shader_ : "read_none", k_reading_group, mode.bits());
}

ReadingArguments ReadingStructure::arguments(const ReadingSamples& samples) const {
  if (looked_up_ != assign::LookedUp::tile && samples.world_origin() != grid_->world_origin())
    throw Error("", "reading", "samples are in another space than the grid", ExitCode::internal);
  ReadingArguments arguments = arguments_;
  arguments.samples = samples.invocations();
  return arguments;
}

void ReadingStructure::bind(ReadingSamples& samples) {
  for (const std::uint32_t binding :
       {ReadingBinding::positions, ReadingBinding::pixels, ReadingBinding::results, ReadingBinding::cells})
    buffers_.borrow(binding, samples.buffers());
}

}  // namespace clusterbench::gpu
