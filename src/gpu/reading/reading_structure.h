#pragma once
// A light structure on the device, as the shaders of a frame read it.

#include <string>

#include "assign/contract/light_structure.h"
#include "gpu/reading/reading_lookup.h"
#include "gpu/reading/reading_samples.h"
#include "view/frame.h"

namespace clusterbench::gpu {

class ReadingStructure {
 public:
  // Uploads the structure's buffers (LightStructure::shader_buffers()) and the lights that it was made from, which are
  // in the grid's space. Structure and grid must outlive it, and the structure must not change. Throws Error for a
  // structure that shaders do not read.
  ReadingStructure(const assign::LightStructure& structure, const grid::Grid& grid, const view::LightArrays& lights);

  const assign::LightStructure& on_host() const { return *structure_; }
  const grid::Grid& grid() const { return *grid_; }
  assign::LookedUp looked_up() const { return looked_up_; }
  // Where samples look up no cell they cannot walk cell by cell.
  bool allows(Walking walking) const { return walking != Walking::by_cell || looked_up_ != assign::LookedUp::position; }
  std::uint64_t bytes() const { return bytes_; }  // of the structure alone

  // For a reading: shader, mode and arguments. `given`: cells come from ReadingSamples::give_cells().
  Kernel kernel(ReadingOutput output, Walking walking, bool given) const;
  ReadingArguments arguments(const ReadingSamples& samples) const;
  // Shows its kernels the samples' buffers, until these make more room.
  void bind(ReadingSamples& samples);
  Buffers& buffers() { return buffers_; }

 private:
  void set_arguments(const assign::ShaderBuffers& shader);
  void upload(const assign::ShaderBuffers& shader, const view::LightArrays& lights,
              const std::vector<float>& boundaries);

  const assign::LightStructure* structure_;
  const grid::Grid* grid_;
  assign::LookedUp looked_up_ = assign::LookedUp::cell;
  const char* shader_ = "";
  ReadingMode mode_;
  ReadingArguments arguments_;
  std::uint64_t bytes_ = 0;
  Buffers buffers_;
};

}  // namespace clusterbench::gpu
