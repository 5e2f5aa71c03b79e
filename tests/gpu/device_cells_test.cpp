// Bounds of cells that are made on the device of the grid's boundaries.

#include <algorithm>
#include <bit>

#include <gtest/gtest.h>

#include "assign/contract/assigner_run.h"
#include "assign/settings.h"
#include "effort.h"
#include "geom/light_meets_cell.h"
#include "gpu/device/device.h"
#include "gpu/device_test.h"
#include "gpu/methods/device_frame.h"
#include "gpu/methods/methods.h"

namespace clusterbench::gpu {
namespace {

using assign::Answer;
using assign::AssignerDescriptor;
using assign::AssignerRun;
using assign::Lists;
using assign::Params;
using assign::testing::Setting;

using DeviceCells = testing::DeviceTest;

Lists lists_with_cells_of(const std::string& place, const char* spot, const Setting& setting) {
  const AssignerDescriptor& method = *assign::find_assigner("gpu-cells");
  const view::LightArrays lights = view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame));
  AssignerRun run(method, Params(method.params, {{"cells", place}, {"spot", std::string(spot)}}), Answer::lists);
  run.build(setting.grid, assign::kinds_of(lights));
  run.assign(setting.input(lights));
  return run.cell_lists();
}

std::vector<Setting> settings_of_cells(std::uint64_t seed) {
  const AssignerDescriptor& row = *assign::find_assigner("gpu-cells");
  std::vector<Setting> all = assign::testing::settings_for(row, seed);
  for (Setting& setting : test::some(assign::testing::settings_of_any_size(row, 60, seed)))
    all.push_back(std::move(setting));
  return all;
}

// Of all columns, rows and slices, as they lie on the device.
std::vector<std::uint32_t> bounds_with_cells_of(const std::string& place, const Setting& setting) {
  const AssignerDescriptor& method = *assign::find_assigner("gpu-cells");
  DeviceFrame frame(Params(method.params, {{"cells", place}}));
  frame.build(setting.grid, {});
  const FrameArguments& arguments = frame.arguments();
  Commands commands(frame.device(), frame.buffers());
  commands.download(Binding::bounds, 8ull * (arguments.first_slice + arguments.slices));
  commands.run();
  return {commands.downloaded(0).begin(), commands.downloaded(0).end()};
}

bool are_equal_as_floats(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  return std::ranges::equal(
      a, b, [](std::uint32_t x, std::uint32_t y) { return std::bit_cast<float>(x) == std::bit_cast<float>(y); });
}

TEST_F(DeviceCells, have_the_boxes_of_the_host_on_every_device) {
  for (const Setting& setting : settings_of_cells(15)) {
    EXPECT_TRUE(are_equal_as_floats(bounds_with_cells_of("device", setting), bounds_with_cells_of("host", setting)))
        << setting.name;
    const Lists expected = lists_with_cells_of("host", "sphere", setting);
    EXPECT_GT(expected.pair_count(), 0u) << setting.name;
    EXPECT_TRUE(lists_with_cells_of("device", "sphere", setting) == expected) << setting.name;
  }
}

TEST_F(DeviceCells, have_spheres_that_lose_no_cone_and_add_few) {
  std::uint64_t by_host = 0, by_device = 0;
  for (const Setting& setting : settings_of_cells(16)) {
    const view::LightArrays lights = view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame));
    const Lists host = lists_with_cells_of("host", "both", setting),
                device = lists_with_cells_of("device", "both", setting);
    by_host += host.pair_count();
    by_device += device.pair_count();
    for (std::uint32_t cell = 0; cell < host.cell_count(); ++cell)
      for (const std::uint32_t light : host.of(cell)) {
        const auto list = device.of(cell);
        if (std::binary_search(list.begin(), list.end(), light)) continue;
        EXPECT_NE(geom::decide_meets(lights.volume(light), setting.grid.cell(cell)), geom::Verdict::yes)
            << setting.name << ", light " << light << ", cell " << cell;
      }
  }
  EXPECT_GT(by_host, 1000u);
  EXPECT_LT(static_cast<double>(by_device), 1.05 * static_cast<double>(by_host));
}

}  // namespace
}  // namespace clusterbench::gpu
