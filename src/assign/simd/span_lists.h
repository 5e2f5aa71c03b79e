#pragma once
// Lists by compression, not by scattering: spans are collected per row of cells; then each cell of a row compares all
// of the row's spans at once and compress-stores the lights whose span holds it. SIMD, dispatched at run time; the same
// lists as PairBuffer on every target.

#include <cstdint>
#include <vector>

#include "assign/lists.h"

namespace clusterbench::assign {

// The instruction set that is used: "AVX3", "AVX2", "SSE4", "NEON", "SCALAR" ... as Highway names it.
const char* simd_target_name();

// Collects spans (row, first column .. last column, light) and sorts them by cell. Keeps its memory between frames.
class SpanLists {
 public:
  void start(std::uint32_t rows, std::uint32_t columns);
  // Lights must come in ascending order; a light has at most one span in a row. 0 <= first <= last < columns.
  void add(std::uint32_t row, std::uint32_t first, std::uint32_t last, std::uint32_t light) {
    spans_.push_back({row, light, first | last << 16});
    pairs_ += last - first + 1;
  }
  // Throws Error (ExitCode::internal) beyond 2^32 - 1 pairs.
  void finish(Lists& out);

  std::uint64_t pairs() const { return pairs_; }
  std::size_t capacity_bytes() const;

 private:
  struct Span {
    std::uint32_t row, light, columns;  // columns: first | last << 16
  };
  void sort_by_row();

  std::uint32_t rows_ = 0, columns_ = 0;
  std::uint64_t pairs_ = 0;
  std::vector<Span> spans_;
  std::vector<std::uint32_t> row_begin_;
  // Of the spans, by row; padded at the end for whole vectors.
  std::vector<std::uint32_t> lights_;
  std::vector<std::int32_t> before_, after_;
};

}  // namespace clusterbench::assign
