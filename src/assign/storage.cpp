#include "assign/storage.h"

#include <algorithm>
#include <limits>

#include "core/error.h"

namespace clusterbench::assign {
namespace {

std::uint32_t narrowest_bits(std::uint32_t lights) {
  if (lights <= 1u << 8) return 8;
  return lights <= 1u << 16 ? 16 : 32;
}

// Light indices, little-endian, of a width known at run time.
class IndexArray {
 public:
  void resize(std::size_t entries, std::uint32_t bits) {
    bytes_.resize(entries * (bits / 8));
    bits_ = bits;
  }
  template <class T>
  void copy(std::size_t at, const std::uint32_t* from, std::size_t count) {
    T* to = reinterpret_cast<T*>(bytes_.data()) + at;
    for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<T>(from[i]);
  }
  void write(std::size_t at, const std::uint32_t* from, std::size_t count) {
    if (bits_ == 8) return copy<std::uint8_t>(at, from, count);
    if (bits_ == 16) return copy<std::uint16_t>(at, from, count);
    copy<std::uint32_t>(at, from, count);
  }
  std::uint32_t read(std::size_t at) const {
    std::uint32_t value = 0;
    for (std::uint32_t byte = 0; byte < bits_ / 8; ++byte)
      value |= static_cast<std::uint32_t>(bytes_[at * (bits_ / 8) + byte]) << (8 * byte);
    return value;
  }
  std::uint32_t bits() const { return bits_; }

 private:
  std::vector<unsigned char> bytes_;
  std::uint32_t bits_ = 8;
};

std::uint32_t fullest_cell(const Lists& lists) {
  std::uint32_t longest = 0, fullest = 0;
  for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
    const std::uint32_t count = lists.begin[cell + 1] - lists.begin[cell];
    if (count > longest) {
      longest = count;
      fullest = cell;
    }
  }
  return fullest;
}

// offset u32 + point count u16 + spot count u16 per cell; 12 bytes with u32 counts where a count needs it.
class Packed final : public Storage {
 public:
  explicit Packed(const Params& params) : wanted_bits_(params.text("index_bits")) {}

  void start(std::uint32_t cell_count, std::uint32_t points, std::uint32_t spots) override {
    lights_ = points + spots;
    points_ = points;
    const std::uint32_t needed = narrowest_bits(lights_);
    bits_ = wanted_bits_ == "auto" ? needed : static_cast<std::uint32_t>(std::stoul(wanted_bits_));
    if (bits_ < needed)
      throw Error("", "index_bits",
                  "is " + wanted_bits_ + ", but " + std::to_string(lights_) + " lights need " + std::to_string(needed) +
                      " bits");
    headers_.resize(cell_count);
  }

  void store(const Lists& lists) override {
    indices_.resize(lists.lights.size(), bits_);
    indices_.write(0, lists.lights.data(), lists.lights.size());
    widest_count_ = 0;
    for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
      const auto list = lists.of(cell);
      const auto spots_from = std::lower_bound(list.begin(), list.end(), points_);
      Header& header = headers_[cell];
      header = {lists.begin[cell], static_cast<std::uint32_t>(spots_from - list.begin()),
                static_cast<std::uint32_t>(list.end() - spots_from)};
      widest_count_ = std::max({widest_count_, header.points, header.spots});
    }
    entries_ = lists.pair_count();
    largest_cell_ = fullest_cell(lists);
  }

  StorageUse use() const override {
    StorageUse use;
    use.index_entries = entries_;
    use.index_bytes = entries_ * (bits_ / 8);
    use.header_bytes = headers_.size() * header_size();
    use.upload_bytes = use.index_bytes + use.header_bytes;
    use.largest_cell = largest_cell_;
    return use;
  }

  StorageLimit limit() const override {
    const std::uint64_t entries = static_cast<std::uint64_t>(headers_.size()) * lights_;
    const bool wide = std::max(points_, lights_ - points_) > k_narrow_count;
    return {entries, entries * (bits_ / 8) + headers_.size() * (wide ? k_wide_header : k_header)};
  }

  Lists read_back() const override {
    Lists lists;
    lists.begin.push_back(0);
    for (const Header& header : headers_) {
      for (std::uint32_t i = 0; i < header.points + header.spots; ++i)
        lists.lights.push_back(indices_.read(header.offset + i));
      lists.begin.push_back(static_cast<std::uint32_t>(lists.lights.size()));
    }
    return lists;
  }

  std::uint32_t index_bits() const override { return bits_; }

 private:
  static constexpr std::uint32_t k_narrow_count = std::numeric_limits<std::uint16_t>::max();
  static constexpr std::uint64_t k_header = 8, k_wide_header = 12;
  struct Header {
    std::uint32_t offset = 0, points = 0, spots = 0;
  };
  std::uint64_t header_size() const { return widest_count_ > k_narrow_count ? k_wide_header : k_header; }

  std::string wanted_bits_;
  std::uint32_t bits_ = 8, lights_ = 0, points_ = 0, widest_count_ = 0, largest_cell_ = 0;
  std::uint64_t entries_ = 0;
  std::vector<Header> headers_;
  IndexArray indices_;
};

// A u32 count and room for `cap` indices per cell. What does not fit is dropped: the highest light indices.
class Fixed final : public Storage {
 public:
  explicit Fixed(const Params& params) : cap_(static_cast<std::uint32_t>(params.number("cap"))) {}

  void start(std::uint32_t cell_count, std::uint32_t points, std::uint32_t spots) override {
    lights_ = points + spots;
    counts_.assign(cell_count, 0);
    indices_.resize(static_cast<std::size_t>(cell_count) * cap_, narrowest_bits(lights_));
    is_dropped_.assign(lights_, false);
  }

  void store(const Lists& lists) override {
    kept_ = dropped_pairs_ = overflowing_cells_ = 0;
    is_dropped_.assign(lights_, false);
    for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
      const auto list = lists.of(cell);
      const std::size_t kept = std::min<std::size_t>(list.size(), cap_);
      counts_[cell] = static_cast<std::uint32_t>(kept);
      indices_.write(static_cast<std::size_t>(cell) * cap_, list.data(), kept);
      kept_ += kept;
      if (kept == list.size()) continue;
      ++overflowing_cells_;
      dropped_pairs_ += list.size() - kept;
      for (const std::uint32_t light : list.subspan(kept)) is_dropped_[light] = true;
    }
    largest_cell_ = fullest_cell(lists);
  }

  StorageUse use() const override {
    StorageUse use;
    use.index_entries = kept_;
    use.index_bytes = counts_.size() * cap_ * (indices_.bits() / 8);
    use.header_bytes = counts_.size() * sizeof(std::uint32_t);
    use.upload_bytes = use.index_bytes + use.header_bytes;
    use.dropped_pairs = dropped_pairs_;
    use.overflowing_cells = overflowing_cells_;
    for (std::uint32_t light = 0; light < lights_; ++light)
      if (is_dropped_[light]) use.dropped_lights.push_back(light);
    use.largest_cell = largest_cell_;
    return use;
  }

  // Its size never changes.
  StorageLimit limit() const override {
    const std::uint64_t entries = counts_.size() * cap_;
    return {entries, entries * (indices_.bits() / 8) + counts_.size() * sizeof(std::uint32_t)};
  }

  Lists read_back() const override {
    Lists lists;
    lists.begin.push_back(0);
    for (std::size_t cell = 0; cell < counts_.size(); ++cell) {
      for (std::uint32_t i = 0; i < counts_[cell]; ++i) lists.lights.push_back(indices_.read(cell * cap_ + i));
      lists.begin.push_back(static_cast<std::uint32_t>(lists.lights.size()));
    }
    return lists;
  }

  std::uint32_t index_bits() const override { return indices_.bits(); }

 private:
  std::uint32_t cap_, lights_ = 0, largest_cell_ = 0;
  std::uint64_t kept_ = 0, dropped_pairs_ = 0, overflowing_cells_ = 0;
  std::vector<std::uint32_t> counts_;
  std::vector<bool> is_dropped_;
  IndexArray indices_;
};

template <class T>
std::unique_ptr<Storage> make(const Params& params) {
  return std::make_unique<T>(params);
}

const std::vector<StorageRow>& rows() {
  static const std::vector<StorageRow> k_rows{
      {.name = "packed",
       .summary = "offset and counts per cell (8 bytes), one tight index list for all cells",
       .source = "Persson 2015, Practical Clustered Shading",
       .params = {{.name = "index_bits",
                   .summary = "width of a light index; auto takes the narrowest that holds the rig",
                   .standard = std::string("auto"),
                   .unit = "",
                   .choices = {"auto", "8", "16", "32"}}},
       .make = make<Packed>},
      {.name = "fixed",
       .summary = "room for the same number of lights in every cell; what does not fit is dropped, the highest light "
                  "indices first",
       .source = "DaveH355, three.js, PlayCanvas",
       .params = {{.name = "cap",
                   .summary = "lights per cell",
                   .standard = 100.0,
                   .unit = "lights",
                   .min = 1.0,
                   .max = 65535.0,
                   .choices = {},
                   .whole = true}},
       .make = make<Fixed>}};
  return k_rows;
}

}  // namespace

std::span<const StorageRow> storage_rows() {
  return rows();
}

const StorageRow* find_storage(const std::string& name) {
  for (const StorageRow& row : rows())
    if (row.name == name) return &row;
  return nullptr;
}

std::vector<std::string> storage_names() {
  std::vector<std::string> names;
  for (const StorageRow& row : rows()) names.push_back(row.name);
  return names;
}

}  // namespace clusterbench::assign
