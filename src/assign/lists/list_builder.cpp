#include "assign/lists/list_builder.h"

#include <algorithm>
#include <numeric>

#include "core/memory.h"

namespace clusterbench::assign {

void ListBuilder::start(std::uint32_t bands, std::uint32_t rows, std::uint32_t columns, Lists& out) {
  if (rows != band_.rows) band_.pitch = 0;
  band_.rows = rows;
  band_.row_columns = columns;
  bands_done_ = 0;
  pairs_ = 0;
  most_ = 0;
  out_ = &out;
  sizes_.assign(rows, 0);
  if (band_.pitch == 0) grow();
  point_to_spans();
  check_memory("lists of cells", std::uint64_t{bands} * rows * columns + 1, sizeof(std::uint32_t));
  out.begin.resize(std::size_t{bands} * rows * columns + 1);
}

void ListBuilder::point_to_spans() {
  band_.sizes = sizes_.data();
  band_.columns = columns_.data();
  band_.lights = lights_.data();
}

void ListBuilder::grow() {
  // An odd number of cache lines, so that rows do not compete for the same cache sets.
  const std::size_t wider = 2 * band_.pitch + 16;
  check_memory("spans of light lists", band_.rows * wider + k_most_lanes, 2 * sizeof(std::uint32_t));
  const auto widen = [&](auto& list) {
    list.resize(band_.rows * wider + k_most_lanes);
    for (std::size_t row = band_.rows; row-- > 1;)
      std::copy_backward(list.begin() + static_cast<std::ptrdiff_t>(row * band_.pitch),
                         list.begin() + static_cast<std::ptrdiff_t>(row * band_.pitch + sizes_[row]),
                         list.begin() + static_cast<std::ptrdiff_t>(row * wider + sizes_[row]));
  };
  widen(lights_);
  widen(columns_);
  band_.pitch = wider;
  point_to_spans();
}

// Makes room for this many more spans in each row.
void ListBuilder::make_room(std::uint32_t spans) {
  most_ += spans;
  if (most_ <= band_.pitch) return;
  most_ = *std::max_element(sizes_.begin(), sizes_.end()) + spans;
  while (most_ > band_.pitch) grow();
}

bool ListBuilder::add_batch(int first_row, int last_row, const std::uint32_t* columns, const std::uint32_t* lights,
                            std::uint8_t* is_left) {
  make_room(k_row_lanes);
  return add_batch_rows(band_, first_row, last_row, columns, lights, is_left);
}

void ListBuilder::add_rows(int first_row, int last_row, const std::uint32_t* sizes, const std::uint32_t* columns,
                           const std::uint32_t* lights) {
  make_room(k_row_lanes);
  add_listed_rows(band_, first_row, last_row, sizes, columns, lights);
}

void ListBuilder::finish_band(const BandHole& hole) {
  make_room(k_row_lanes);  // as for a last batch, so that memory does not depend on the number of lights in a batch
  std::vector<std::uint32_t>& lists = out_->lights;
  const std::uint64_t band_pairs = pairs_of(band_);
  const std::size_t needed = pairs_ + band_pairs + k_most_lanes;
  // Whatever memory is there, so that the limit does not depend on earlier frames.
  check_memory("pairs of light lists", needed, sizeof(std::uint32_t));
  check_pair_count(pairs_ + band_pairs);
  // No further than this band: resizing first fills the new part with zeros.
  if (lists.size() < needed) lists.resize(needed);
  const std::uint64_t spans = std::accumulate(sizes_.begin(), sizes_.end(), std::uint64_t{0});
  band_.width = spans == 0 ? 0 : static_cast<std::uint32_t>(band_pairs / spans);
  std::uint32_t* begin = out_->begin.data() + std::size_t{bands_done_} * band_.rows * band_.row_columns;
  const std::uint32_t* end = write_band_lists(band_, hole, few_, lists.data() + pairs_, lists.data(), begin);
  pairs_ = static_cast<std::uint64_t>(end - lists.data());
  std::fill(sizes_.begin(), sizes_.end(), 0);
  most_ = 0;
  ++bands_done_;
}

void ListBuilder::finish() {
  out_->begin.back() = static_cast<std::uint32_t>(pairs_);
  out_->lights.resize(pairs_);
}

std::size_t ListBuilder::capacity_bytes() const {
  return (sizes_.capacity() + lights_.capacity() + columns_.capacity()) * sizeof(std::uint32_t) + few_.capacity_bytes();
}

}  // namespace clusterbench::assign
