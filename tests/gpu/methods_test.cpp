// What holds for every method that runs on a device: the contract of all assigners, and lists equal to those of the
// same tests on the processor.

#include "assign/contract.h"
#include "core/text.h"
#include "effort.h"
#include "gpu/device_test.h"
#include "gpu/reference_lists.h"

namespace clusterbench::gpu {
namespace {

using assign::AssignerDescriptor;
using assign::Lists;
using assign::Params;
using assign::testing::Setting;

class DeviceMethods : public testing::DeviceTest {};

std::vector<const AssignerDescriptor*> methods_on_device() {
  std::vector<const AssignerDescriptor*> methods;
  for (const AssignerDescriptor* row : assign::assigner_descriptors())
    if (row->on_device) methods.push_back(row);
  return methods;
}

TEST_F(DeviceMethods, are_registered) {
  EXPECT_GE(methods_on_device().size(), 4u);
  EXPECT_GE(testing::list_methods().size(), 4u);
}

// Drivers allocate as they like.
std::string faults_of(const AssignerDescriptor& row, const Params& params, const Setting& setting) {
  std::vector<std::string> faults = assign::testing::contract_faults(row, params, setting);
  std::erase_if(faults, [](const std::string& fault) { return fault.find("allocates") != std::string::npos; });
  return joined(faults, "; ");
}

// Software devices are slow: one choice in each view, another one for the next method, with a twelfth of the lights.
TEST_F(DeviceMethods, keep_the_contract_in_every_view) {
  std::uint32_t turn = 0;
  for (const AssignerDescriptor* row : methods_on_device()) {
    for (const Setting& setting : assign::testing::settings_for(*row, 7)) {
      const Setting thin = testing::thinned(setting, 12, turn);
      for (const Params& params : test::every_nth(assign::testing::params_of(*row), 4, turn++ % 4))
        EXPECT_EQ(faults_of(*row, params, thin), "") << row->name << " on " << setting.name;
    }
    ++turn;
  }
}

// The same steps with the same padding: where a device may round either way, its methods count each step twice, and pad
// by 10 roundoffs in place of 6.
Params params_of_reference(const AssignerDescriptor& reference) {
  const double inflation = device().facts().rounds_to_nearest ? 1.0 : 10.0 / 6.0;
  return {reference.params, {{"inflation", inflation}}};
}

TEST_F(DeviceMethods, have_the_lists_of_brute_force_for_points) {
  const AssignerDescriptor& reference = *assign::find_assigner("brute-force");
  for (const AssignerDescriptor* row : testing::list_methods())
    for (Setting setting : assign::testing::settings_for(*row, 9)) {
      if (!row->answers(Answer::lists)) continue;
      setting = testing::thinned(std::move(setting), 4, 0);
      std::erase_if(setting.frame.lights,
                    [](const scene::WorldLight& light) { return light.type != scene::LightType::point; });
      setting.frame.count_types();
      const Lists expected = testing::lists_of(reference, params_of_reference(reference), setting);
      ASSERT_GT(expected.pair_count(), 0u);
      EXPECT_EQ(testing::first_difference(testing::lists_of(*row, Params(row->params), setting), expected), "")
          << row->name << " on " << setting.name;
    }
}

// Points and spots that touch cells by a hair, by each choice of the test of spots.
TEST_F(DeviceMethods, have_the_lists_of_the_same_steps_on_the_processor) {
  std::uint32_t turn = 0;
  for (const AssignerDescriptor* row : testing::list_methods()) {
    for (const Setting& setting : assign::testing::settings_for(*row, 11)) {
      const Setting thin = testing::thinned(setting, 8, turn);
      for (const Params& params : test::every_nth(testing::choices_with_cells_of_host(*row), 4, turn++ % 4))
        EXPECT_EQ(
            testing::first_difference(testing::lists_of(*row, params, thin), testing::reference_lists(params, thin)),
            "")
            << row->name << " on " << setting.name;
    }
    ++turn;
  }
}

// Whole numbers, so that nothing is rounded, and no padding: lights that end just where a slice, column or row begins.
TEST_F(DeviceMethods, list_what_touches_a_cell_exactly) {
  Setting setting;
  setting.name = "boxes of 1 m";
  setting.frame = assign::testing::frame_of({true, -8, 8, -8, 8, 0, 16}, {64, 64}, {});
  grid::GridSpec spec;
  spec.tiles = {{0, 0}, {16, 16}};
  spec.slices = {.scheme = grid::Scheme::linear, .count = 16, .near_m = 0, .far_m = 16, .boundaries_m = {}};
  setting.grid = assign::testing::grid_of(spec, setting.frame);
  for (const double range : {0.5, 1.5, 2.5})
    for (const double depth : {2.5, 5.5, 14.5})
      setting.frame.lights.push_back(assign::testing::point_light({depth - 8, 8 - depth, -depth}, range));
  setting.frame.count_types();
  for (const AssignerDescriptor* row : testing::list_methods()) {
    const Params params(row->params, {{"inflation", 0.0}});
    const Lists lists = testing::lists_of(*row, params, setting);
    EXPECT_EQ(testing::first_difference(lists, testing::reference_lists(params, setting)), "") << row->name;
    // 2.5 m around the middle of the cell at column, row and slice 5: its faces are those of the third cell on.
    const auto lists_light_at = [&](int x, int y, int z) {
      return assign::testing::lists_light(lists, (z * 16 + y) * 16 + x, 7);
    };
    EXPECT_TRUE(lists_light_at(5, 5, 2) && lists_light_at(5, 5, 8)) << row->name;
    EXPECT_TRUE(lists_light_at(2, 5, 5) && lists_light_at(8, 5, 5)) << row->name;
    EXPECT_TRUE(lists_light_at(5, 2, 5) && lists_light_at(5, 8, 5)) << row->name;
    EXPECT_FALSE(lists_light_at(5, 5, 1) || lists_light_at(9, 5, 5) || lists_light_at(5, 1, 5)) << row->name;
  }
}

}  // namespace
}  // namespace clusterbench::gpu
