#pragma once
// What an assigner leaves for a shader to ask.

#include <cstdint>
#include <vector>

#include "assign/contract/lists.h"
#include "grid/grid.h"
#include "grid/occupied_cells.h"

namespace clusterbench::assign {

// What one frame takes. Entries are light indices, the words of a bitfield, the nodes of linked lists or of a
// hierarchy.
struct StructureUse {
  std::uint64_t index_entries = 0;
  std::uint64_t index_bytes = 0;
  std::uint64_t header_bytes = 0;
  std::uint64_t upload_bytes = 0;   // what is copied to the GPU this frame
  std::uint64_t traffic_bytes = 0;  // what the GPU itself reads and writes for each light that is drawn over pixels
  std::uint64_t dropped_pairs = 0;  // overflow
  std::uint64_t overflowing_cells = 0;
  std::vector<std::uint32_t> dropped_lights;  // which, ascending, each once
  std::uint64_t fallback_cells =
      0;  // overflow: cells whose samples loop over all lights of the frame in place of their list
};

// The most that this grid and rig could ever take.
struct StructureLimit {
  std::uint64_t index_entries = 0;
  std::uint64_t bytes = 0;  // headers included
};

// What one frame needs of one buffer of a structure, so that nothing is dropped; an engine allocates each buffer once,
// for the worst frame.
struct BufferNeed {
  const char* name;             // "indices"; letters and _, in lower case
  std::uint32_t element_bytes;  // of a light index, a header, a word
  std::uint64_t elements;
  std::uint64_t most;      // elements that this grid and rig could ever need
  std::uint64_t step = 1;  // elements come in multiples of it: room for one more light in each cell of `fixed`
};

// What a shader fetches to know a sample's lights: elements of buffers (headers, light indices, words, nodes, boxes),
// and their bytes. The lights themselves come on top, and are the same for all structures.
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

  // Puts what a shader would loop over at a sample into `out`, whose memory is kept: points before spots, each once, in
  // any order. `way`: how the shader takes a logarithm, if its lookup takes one. False, and none, where the structure
  // has no answer: outside of its cells, beside the picture, behind the eye.
  virtual bool lights_at(const grid::Sample& sample, grid::Log2 way, std::vector<std::uint32_t>& out) const = 0;
  // What is fetched for that, each element as often as a shader that keeps none of them has to. Nothing where the
  // structure has no answer.
  virtual Reads reads_at(const grid::Sample& sample, grid::Log2 way) const = 0;

  virtual StructureUse use() const = 0;
  virtual StructureLimit limit() const = 0;
  // All of its buffers; in every frame the same, in the same order and of elements of the same size. Their bytes are
  // those of use() and limit(), but where a storage drops pairs
  // or has room that its parameters reserve.
  virtual std::vector<BufferNeed> buffers() const = 0;
  virtual std::uint32_t index_bits() const = 0;  // of an entry

  // Whether a sample's lights depend on its cell alone: of the grid, or of occupied_cells().
  virtual bool has_cells() const = 0;
  // Whether its cells are what the depths of a frame leave of the grid's, or of its tiles; and these cells, of the
  // frame at hand. Not timed.
  virtual bool has_occupied_cells() const { return false; }
  virtual grid::OccupiedCells occupied_cells() const { return {}; }
  // Each cell's lights, as lights_at() gives them at a sample that is looked up in it. For truth, details and pictures:
  // not timed. Only with cells.
  virtual void expand(Lists& out) const = 0;
  Lists expanded() const {
    Lists lists;
    expand(lists);
    return lists;
  }
};

}  // namespace clusterbench::assign
