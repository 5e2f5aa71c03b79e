#pragma once
// The result of an assigner, as a shader reads it.

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "assign/contract/lists.h"
#include "assign/contract/shader_buffers.h"
#include "grid/grid.h"
#include "grid/occupied_cells.h"

namespace clusterbench::assign {

// The size of one frame. Entries are light indices, the words of a bitfield, or the nodes of linked lists or of a
// hierarchy.
struct StructureUse {
  std::uint64_t index_entries = 0;
  std::uint64_t index_bytes = 0;
  std::uint64_t header_bytes = 0;
  std::uint64_t upload_bytes = 0;   // copied to the GPU in this frame
  std::uint64_t traffic_bytes = 0;  // read and written by the GPU itself for each light that is drawn over pixels
  std::uint64_t dropped_pairs = 0;  // overflow
  std::uint64_t overflowing_cells = 0;
  std::vector<std::uint32_t> dropped_lights;  // ascending, each once
  std::uint64_t fallback_cells =
      0;  // overflow: cells whose samples loop over all lights of the frame in place of their list
  std::uint64_t repeated_pairs = 0;  // a light in a list where it is already: left out of lists, and never of bytes
};

// The largest size for any frame of this grid and rig.
struct StructureLimit {
  std::uint64_t index_entries = 0;
  std::uint64_t bytes = 0;  // headers included
};

// The room that one frame needs in one buffer of a structure, so that nothing is dropped. An engine allocates each
// buffer once, for the worst frame.
struct BufferNeed {
  const char* name;             // "indices"; letters and _, in lower case
  std::uint32_t element_bytes;  // size of a light index, a header, a word
  std::uint64_t elements;
  std::uint64_t most;      // the most elements for any frame of this grid and rig
  std::uint64_t step = 1;  // elements come in multiples of it: for `fixed`, room for one more light in each cell
};

// The elements of buffers (headers, light indices, words, nodes, boxes) that a shader reads to find a sample's lights,
// and their bytes. The lights themselves are read in addition; that cost is the same for all structures.
struct Reads {
  std::uint64_t elements = 0, bytes = 0;

  static Reads of(std::uint64_t elements, std::uint64_t element_bytes) { return {elements, elements * element_bytes}; }
  Reads& operator+=(const Reads& more) {
    elements += more.elements;
    bytes += more.bytes;
    return *this;
  }
  friend Reads operator+(Reads a, const Reads& b) { return a += b; }
  friend bool operator==(const Reads&, const Reads&) = default;
};

class LightStructure {
 public:
  virtual ~LightStructure() = default;

  // Writes the lights that a shader would loop over at a sample to `out`, whose memory is reused: points before spots,
  // each once, otherwise in any order. `way`: how the shader computes a logarithm, if its lookup needs one. False, and
  // no lights, if the sample is outside of the structure: outside of its cells, beside the picture, behind the eye.
  virtual bool lights_at(const grid::Sample& sample, grid::Log2 way, std::vector<std::uint32_t>& out) const = 0;
  // The reads for that, as often as a shader without a cache has to do them. None if the sample is outside of the
  // structure.
  virtual Reads reads_at(const grid::Sample& sample, grid::Log2 way) const = 0;

  virtual StructureUse use() const = 0;
  virtual StructureLimit limit() const = 0;
  // All of its buffers; in every frame the same, in the same order and with elements of the same size. Their bytes add
  // up to those of use() and limit(), unless a storage drops pairs or has room that its parameters reserve.
  virtual std::vector<BufferNeed> buffers() const = 0;
  virtual std::uint32_t index_bits() const = 0;  // of an entry
  // The bytes of its buffers in the current frame, as many as use() counts: a copy, not timed. None where shaders do
  // not read it.
  virtual std::optional<ShaderBuffers> shader_buffers() const {
    ShaderBuffers out;
    return fill_shader_buffers(out) ? std::optional(std::move(out)) : std::nullopt;
  }
  // The same into buffers whose memory is reused; false where shaders do not read it. Structures override this one.
  virtual bool fill_shader_buffers(ShaderBuffers&) const { return false; }

  // Do a sample's lights depend on its cell alone: of the grid, or of occupied_cells()?
  virtual bool has_cells() const = 0;
  // Are its cells the parts of the grid's cells or tiles that contain the frame's depths? And these cells, for the
  // current frame. Not timed.
  virtual bool has_occupied_cells() const { return false; }
  virtual grid::OccupiedCells occupied_cells() const { return {}; }
  // Each cell's lights, equal to lights_at() for samples in that cell. For truth, details and pictures: not timed. Only
  // with cells.
  virtual void expand(Lists& out) const = 0;
  Lists expanded() const {
    Lists lists;
    expand(lists);
    return lists;
  }
};

}  // namespace clusterbench::assign
