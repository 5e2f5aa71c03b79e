#include "assign/contract/storage.h"

#include <algorithm>

#include "assign/storages/index_array.h"
#include "core/memory.h"

namespace clusterbench::assign {
namespace {

// A u32 count and room for `cap` indices per cell. Without counts, a list that is not full ends with an index that no
// light has. Lights that do not fit are dropped: the last of the list, which are the highest light indices if lists
// ascend.
class Fixed final : public Storage {
 public:
  explicit Fixed(const Params& params)
      : cap_(static_cast<std::uint32_t>(params.number("cap"))), has_counts_(params.text("counts") == "kept") {}

  void start(std::uint32_t cell_count, const view::LightRanges& lights) override {
    lights_ = lights.size();
    cell_count_ = cell_count;
    const std::uint32_t bits = narrowest_bits(has_counts_ ? lights_ : lights_ + 1);
    check_memory("entries of fixed lists", std::uint64_t{cell_count} * cap_, bits / 8);
    indices_.make_room(static_cast<std::size_t>(cell_count) * cap_, bits);
    if (has_counts_) check_memory("counts of fixed lists", cell_count, sizeof(std::uint32_t));
    counts_.assign(has_counts_ ? cell_count : 0, 0);
    if (!has_counts_)
      for (std::uint32_t cell = 0; cell < cell_count; ++cell) end_list(cell, 0);
    is_dropped_.assign(lights_, false);
  }

  void store(const Lists& lists) override {
    kept_ = dropped_pairs_ = overflowing_cells_ = longest_ = 0;
    is_dropped_.assign(lights_, false);
    for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
      const auto list = lists.of(cell);
      const std::size_t kept = std::min<std::size_t>(list.size(), cap_);
      longest_ = std::max<std::uint64_t>(longest_, list.size());
      indices_.write(static_cast<std::size_t>(cell) * cap_, list.data(), kept);
      end_list(cell, static_cast<std::uint32_t>(kept));
      kept_ += kept;
      if (kept == list.size()) continue;
      ++overflowing_cells_;
      dropped_pairs_ += list.size() - kept;
      for (const std::uint32_t light : list.subspan(kept)) is_dropped_[light] = true;
    }
  }

  StructureUse use() const override {
    StructureUse use;
    use.index_entries = kept_;
    use.index_bytes = std::uint64_t{cell_count_} * cap_ * (indices_.bits() / 8);
    use.header_bytes = counts_.size() * sizeof(std::uint32_t);
    use.upload_bytes = use.index_bytes + use.header_bytes;
    use.dropped_pairs = dropped_pairs_;
    use.overflowing_cells = overflowing_cells_;
    for (std::uint32_t light = 0; light < lights_; ++light)
      if (is_dropped_[light]) use.dropped_lights.push_back(light);
    return use;
  }

  // Its size never changes.
  StructureLimit limit() const override {
    const std::uint64_t entries = std::uint64_t{cell_count_} * cap_;
    return {entries, entries * (indices_.bits() / 8) + counts_.size() * sizeof(std::uint32_t)};
  }

  // Room for the longest list in every cell, whatever the cap.
  std::vector<BufferNeed> buffers() const override {
    const std::uint64_t cells = cell_count_;
    std::vector<BufferNeed> all{{"indices", indices_.bits() / 8, cells * longest_, cells * lights_, cells}};
    if (has_counts_) all.push_back({"counts", sizeof(std::uint32_t), cells, cells});
    return all;
  }

  void read_cell(std::uint32_t cell, std::vector<std::uint32_t>& out) const override {
    const std::uint32_t length = length_of(cell);
    for (std::uint32_t i = 0; i < length; ++i) out.push_back(indices_.read(std::size_t{cell} * cap_ + i));
  }

  Reads reads_of_cell(std::uint32_t cell) const override {
    const std::uint64_t lights = length_of(cell), end_mark = !has_counts_ && lights < cap_ ? 1 : 0;
    return Reads::of(has_counts_ ? 1 : 0, sizeof(std::uint32_t)) + Reads::of(lights + end_mark, indices_.bits() / 8);
  }

  std::optional<ShaderBuffers> shader_buffers() const override {
    ShaderBuffers shader{.walk = Walk::fixed, .index_bytes = indices_.bits() / 8, .per_cell = cap_};
    shader.add("indices", indices_.bytes(std::size_t{cell_count_} * cap_));
    if (has_counts_)
      shader.add("counts", std::span<const std::uint32_t>(counts_));
    else
      shader.end_mark = lights_;
    return shader;
  }
  std::uint32_t cell_count() const override { return cell_count_; }

  std::uint32_t index_bits() const override { return indices_.bits(); }

 private:
  std::uint32_t length_of(std::uint32_t cell) const {
    if (has_counts_) return counts_[cell];
    std::uint32_t length = 0;
    while (length < cap_ && indices_.read(std::size_t{cell} * cap_ + length) != lights_) ++length;
    return length;
  }
  void end_list(std::uint32_t cell, std::uint32_t length) {
    if (has_counts_)
      counts_[cell] = length;
    else if (length < cap_)
      indices_.write(std::size_t{cell} * cap_ + length, &lights_, 1);
  }

  std::uint32_t cap_, lights_ = 0, cell_count_ = 0;
  bool has_counts_;
  std::uint64_t kept_ = 0, dropped_pairs_ = 0, overflowing_cells_ = 0;
  std::uint64_t longest_ = 0;  // before dropping
  std::vector<std::uint32_t> counts_;
  std::vector<bool> is_dropped_;
  IndexArray indices_;
};

}  // namespace

extern const StorageDescriptor fixed_descriptor;
const StorageDescriptor fixed_descriptor{
    .name = "fixed",
    .summary =
        "room for the same number of lights in every cell; what does not fit is dropped, the highest light indices "
        "first",
    .source = "DaveH355, three.js, PlayCanvas",
    .params = {{.name = "cap",
                .summary = "room for lights in each cell",
                .default_value = 100.0,
                .unit = "lights",
                .min = 1.0,
                .max = 65535.0,
                .choices = {},
                .whole = true},
               {.name = "counts",
                .summary =
                    "how a shader knows where a list ends. kept: by a count of 4 bytes per cell; none: by an index "
                    "that is no light's, unless the list is full (PlayCanvas, Just Cause 2)",
                .default_value = std::string("kept"),
                .unit = "",
                .choices = {"kept", "none"},
                .is_late = true}},
    .make = make_storage<Fixed>,
};

}  // namespace clusterbench::assign
