#pragma once
// A light structure as a shader gets it: the bytes of its buffers, and the numbers that it needs to walk them.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace clusterbench::assign {

// How a shader gets from a sample to its lights, with the buffers in their order.
enum class Walk : std::uint8_t {
  packed,    // indices, headers; where headers are sparse header_blocks
  fixed,     // indices; where counts are kept counts
  bitfield,  // words
  linked,    // nodes, heads
  runs,      // runs, headers
  masks,     // masks, bins or ranges, order; with bin masks bin_masks
  hierarchy  // boxes (in groups of eight, coordinate by coordinate), order
};

// What a sample looks up first: a cell of the grid, a tile of it, or nothing, since its position is enough.
enum class LookedUp : std::uint8_t { cell, tile, position };

struct ShaderBuffers {
  struct Buffer {
    const char* name;
    std::uint32_t element_bytes;  // of a light index, a header, a word, as in BufferNeed
    std::vector<std::byte> bytes;
  };

  Walk walk = Walk::packed;
  LookedUp looked_up = LookedUp::cell;
  std::vector<Buffer> buffers{};  // those of LightStructure::buffers(), as much of each as a frame uploads

  std::uint32_t index_bytes = 4;            // packed, fixed, runs: of an index, of each half of a run
  std::uint32_t header_words = 0;           // packed, runs
  bool has_wide_counts = false;             // packed, runs: counts of points and spots have 32 bits, otherwise 16
  bool has_boxes = false;                   // packed, runs: a count of boxes follows them
  bool is_sparse = false;                   // packed
  std::uint32_t per_cell = 0;               // fixed: entries; bitfield: words; masks: words of a tile
  std::optional<std::uint32_t> end_mark{};  // fixed: ends a list that is not full, in place of counts
  std::uint32_t rank_bytes = 4;             // masks: of each end of a range
  bool has_range_per_cell = false;          // masks: otherwise one per slice
  bool has_bin_masks = false;               // masks: bits per slice
  // hierarchy: of each tree the group with which each level begins, from the leaves up, and the end of the last level;
  // none for an empty tree. And how many entries of order are before those of the tree.
  struct Tree {
    std::vector<std::uint32_t> level_begins{};
    std::uint32_t first_in_order = 0;
  };
  std::vector<Tree> trees{};

  std::vector<Buffer> former{};        // memory for those that are added
  std::vector<std::uint32_t> words{};  // memory for who fills a buffer word by word

  // Becomes these, without buffers. Those that are added get the memory of the former ones, in their order.
  void begin_again(ShaderBuffers description) {
    description.former = std::move(buffers);
    description.buffers = std::move(former);
    description.buffers.clear();
    description.words = std::move(words);
    *this = std::move(description);
  }
  template <class T>
  void add(const char* name, std::span<const T> data, std::uint32_t element_bytes = sizeof(T)) {
    Buffer& added = buffers.emplace_back(Buffer{name, element_bytes, {}});
    if (buffers.size() <= former.size()) added.bytes = std::move(former[buffers.size() - 1].bytes);
    added.bytes.resize(data.size_bytes());
    if (!data.empty()) std::memcpy(added.bytes.data(), data.data(), data.size_bytes());
  }
  std::uint64_t bytes() const {
    std::uint64_t sum = 0;
    for (const Buffer& buffer : buffers) sum += buffer.bytes.size();
    return sum;
  }
};

}  // namespace clusterbench::assign
