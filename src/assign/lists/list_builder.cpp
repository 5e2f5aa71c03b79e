#include "assign/lists/list_builder.h"

#include <algorithm>
#include <numeric>

#include "core/memory.h"

namespace clusterbench::assign {

void ListBuilder::start(std::uint32_t bands, std::uint32_t rows, std::uint32_t columns, Lists& out) {
  if (rows != rows_) {
    rows_ = rows;
    pitch_ = 0;
  }
  columns_ = columns;
  band_ = 0;
  pairs_ = 0;
  most_ = 0;
  out_ = &out;
  sizes_.assign(rows, 0);
  if (pitch_ == 0) grow();
  check_memory("lists of cells", std::uint64_t{bands} * rows * columns + 1, sizeof(std::uint32_t));
  out.begin.resize(std::size_t{bands} * rows * columns + 1);
}

void ListBuilder::grow() {
  // An odd number of cache lines, so that rows do not compete for the same places of a cache.
  const std::size_t wider = 2 * pitch_ + 16;
  check_memory("spans of light lists", rows_ * wider + k_most_lanes, 2 * sizeof(std::uint32_t));
  const auto widen = [&](auto& list) {
    list.resize(rows_ * wider + k_most_lanes);
    for (std::size_t row = rows_; row-- > 1;)
      std::copy_backward(list.begin() + static_cast<std::ptrdiff_t>(row * pitch_),
                         list.begin() + static_cast<std::ptrdiff_t>(row * pitch_ + sizes_[row]),
                         list.begin() + static_cast<std::ptrdiff_t>(row * wider + sizes_[row]));
  };
  widen(lights_);
  widen(columns_of_);
  pitch_ = wider;
}

// So that each row can take some more spans.
void ListBuilder::make_room(std::uint32_t spans) {
  most_ += spans;
  if (most_ <= pitch_) return;
  most_ = *std::max_element(sizes_.begin(), sizes_.end()) + spans;
  while (most_ > pitch_) grow();
}

BandSpans ListBuilder::band_spans() {
  return {sizes_.data(), columns_of_.data(), lights_.data(), pitch_, rows_, columns_};
}

bool ListBuilder::add_batch(int first_row, int last_row, const std::uint32_t* columns, const std::uint32_t* lights,
                            std::uint8_t* is_left) {
  make_room(k_row_lanes);
  return add_batch_rows(band_spans(), first_row, last_row, columns, lights, is_left);
}

void ListBuilder::add_rows(int first_row, int last_row, const std::uint32_t* sizes, const std::uint32_t* columns,
                           const std::uint32_t* lights) {
  make_room(k_row_lanes);
  add_listed_rows(band_spans(), first_row, last_row, sizes, columns, lights);
}

void ListBuilder::finish_band(const BandHole& hole) {
  make_room(k_row_lanes);  // as a last batch would have, so that memory does not depend on how many lights a batch has
  std::vector<std::uint32_t>& lists = out_->lights;
  BandSpans band = band_spans();
  const std::uint64_t band_pairs = pairs_of(band);
  const std::size_t needed = pairs_ + band_pairs + k_most_lanes;
  // No further than this band: what is beyond the old size is filled with zeros before it is written.
  if (lists.size() < needed) {
    check_memory("pairs of light lists", needed, sizeof(std::uint32_t));
    check_pair_count(pairs_ + band_pairs);
    lists.resize(needed);
  }
  const std::uint64_t spans = std::accumulate(sizes_.begin(), sizes_.end(), std::uint64_t{0});
  band.width = spans == 0 ? 0 : static_cast<std::uint32_t>(band_pairs / spans);
  std::uint32_t* begin = out_->begin.data() + std::size_t{band_} * rows_ * columns_;
  const std::uint32_t* end = write_band_lists(band, hole, few_, lists.data() + pairs_, lists.data(), begin);
  pairs_ = static_cast<std::uint64_t>(end - lists.data());
  std::fill(sizes_.begin(), sizes_.end(), 0);
  most_ = 0;
  ++band_;
}

void ListBuilder::finish() {
  out_->begin.back() = static_cast<std::uint32_t>(pairs_);
  out_->lights.resize(pairs_);
}

std::size_t ListBuilder::capacity_bytes() const {
  return (sizes_.capacity() + lights_.capacity() + columns_of_.capacity()) * sizeof(std::uint32_t) +
         few_.capacity_bytes();
}

}  // namespace clusterbench::assign
