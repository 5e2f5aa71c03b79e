#include "gpu/methods/device_lists.h"

#include <algorithm>

#include "core/error.h"
#include "gpu/methods/repeated_work.h"

namespace clusterbench::gpu {
namespace {

constexpr std::uint32_t k_block = 256;      // common.glsl
constexpr std::uint32_t k_cell_group = 64;  // invocations of groups that take a cell each
constexpr std::uint32_t k_word = sizeof(std::uint32_t);
constexpr std::uint32_t k_first_capacity = 1u << 16;

}  // namespace

DeviceLists::DeviceLists(const assign::Params& params)
    : frame_(params),
      floor_(frame_.device()),
      sum_blocks_(kernel("sum_blocks", k_block)),
      sum_sums_(kernel("sum_sums", k_block)) {}

void DeviceLists::build(const grid::Grid& grid, const assign::LightKinds& kinds) {
  frame_.build(grid, kinds);
  const std::uint64_t cells = grid.cell_count();
  buffers().reserve(Binding::counts, cells * k_word, "counts of cells");
  buffers().reserve(Binding::begins, (cells + 1) * k_word, "begins of lists");
  buffers().reserve(Binding::offsets, cells * k_word, "offsets of cells");
  buffers().reserve(Binding::sums, groups_for(cells, k_block) * k_word, "sums of counts");
}

void DeviceLists::assign(const assign::FrameInput& input, assign::Lists& out) {
  spans_ = {};
  tests_ = 0;
  out.lights.clear();
  const std::uint32_t cells = frame_.arguments().cells;
  if (frame_.count_of(input.lights) == 0) {
    out.begin.assign(cells + 1, 0);
    return;
  }
  std::uint32_t entries = run_all(input.lights, std::max(capacity_, k_first_capacity), out);
  if (entries > capacity_) {  // now it is known how long all lists are
    assign::check_pair_count(entries == 0xffffffffu ? std::uint64_t{1} << 32 : entries);
    entries = run_all(input.lights, capacity_for(entries), out);
  }
  read_lists(entries, out);
}

// With room for more in the next frames, as far as the device allows it.
std::uint32_t DeviceLists::capacity_for(std::uint32_t entries) {
  const std::uint64_t most = std::min<std::uint64_t>(frame_.device().facts().max_buffer_bytes / k_word, 0xfffffffeu);
  return std::max(entries, static_cast<std::uint32_t>(std::min(std::uint64_t{entries} + entries / 4, most)));
}

std::uint32_t DeviceLists::run_all(const view::LightArrays& lights, std::uint32_t capacity, assign::Lists& out) {
  buffers().reserve(Binding::lists, std::uint64_t{capacity} * k_word, "lists");
  capacity_ = capacity;  // not where that is refused: the next frame may have fewer lights
  frame_.prepare(lights);
  FrameArguments arguments = frame_.arguments();
  arguments.capacity = capacity_;
  reserve(arguments);
  Commands commands(frame_.device(), buffers());
  RepeatedWork work(commands, frame_.repeats());
  work.record([&] { frame_.upload(commands); }, [&] { record_run(commands, arguments); });
  commands.download(Binding::begins, (std::uint64_t{arguments.cells} + 1) * k_word);
  commands.run();
  spans_ = work.spans();
  tests_ = tests_of(arguments);
  const auto begins = commands.downloaded(0);
  out.begin.assign(begins.begin(), begins.end());
  spans_.result_bytes = (begins.size() + begins.back()) * std::uint64_t{k_word};
  return begins.back();
}

void DeviceLists::record_run(Commands& commands, const FrameArguments& arguments) {
  record_counts(commands, arguments);
  commands.barrier();
  commands.dispatch(sum_blocks_, arguments, groups_for(arguments.cells, k_block));
  commands.barrier();
  commands.dispatch(sum_sums_, arguments, 1);
  commands.barrier();
  record_lists(commands, arguments);
}

void DeviceLists::read_lists(std::uint32_t entries, assign::Lists& out) {
  if (entries == 0) return;
  Commands commands(frame_.device(), buffers());
  commands.mark();
  commands.download(Binding::lists, std::uint64_t{entries} * k_word);
  commands.run();
  spans_.readback_ns += commands.ns_between(0, 1);
  const auto lights = commands.downloaded(0);
  out.lights.assign(lights.begin(), lights.end());
}

MaskLists::MaskLists(const assign::Params& params)
    : DeviceLists(params),
      count_(kernel("mask_lists", k_cell_group, Mode::count)),
      fill_(kernel("mask_lists", k_cell_group, Mode::fill)) {}

void MaskLists::reserve(const FrameArguments& arguments) {
  buffers().reserve(Binding::masks, mask_bytes(arguments), "bits of cells and lights");
}

void MaskLists::record_counts(Commands& commands, const FrameArguments& arguments) {
  record_masks(commands, arguments);
  commands.barrier();
  record_beside_counts(commands);
  commands.dispatch(count_, arguments, groups_for(arguments.cells, k_cell_group));
}

void MaskLists::record_lists(Commands& commands, const FrameArguments& arguments) {
  commands.dispatch(fill_, arguments, groups_for(arguments.cells, k_cell_group));
}

}  // namespace clusterbench::gpu
