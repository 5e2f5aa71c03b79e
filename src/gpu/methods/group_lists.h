#pragma once
// Methods with a group per block of 4 x 4 x 4 cells (group.comp), by the test that a light's ball and a cell must pass.

#include "gpu/methods/device_lists.h"

namespace clusterbench::gpu {

class GroupLists : public DeviceLists {
 protected:
  // The box around the cell; then the cell itself, too. A bit of group.comp's modes.
  enum class CellTest : std::uint32_t { box = 0, cell = 4 };

  GroupLists(const assign::Params& params, CellTest test)
      : DeviceLists(params),
        count_(kernel("group", k_block_cells, Mode::count | static_cast<std::uint32_t>(test))),
        fill_(kernel("group", k_block_cells, Mode::fill | static_cast<std::uint32_t>(test))) {
    if (test == CellTest::cell) frame().take_boundaries();
  }

 private:
  static constexpr std::uint32_t k_block_cells = 64;

  static std::uint64_t blocks_of(const FrameArguments& arguments) {
    return groups_for(arguments.columns, 4) * groups_for(arguments.rows, 4) * groups_for(arguments.slices, 4);
  }
  void record_counts(Commands& commands, const FrameArguments& arguments) final {
    commands.dispatch(count_, arguments, blocks_of(arguments));
  }
  void record_lists(Commands& commands, const FrameArguments& arguments) final {
    commands.dispatch(fill_, arguments, blocks_of(arguments));
  }
  std::uint64_t tests_of(const FrameArguments& arguments) const final {  // of the blocks
    return blocks_of(arguments) * arguments.lights;
  }

  Kernel count_, fill_;
};

}  // namespace clusterbench::gpu
