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
      for (const Params& params : test::every_nth(assign::testing::params_of(*row), 4, turn++ % 4))
        EXPECT_EQ(
            testing::first_difference(testing::lists_of(*row, params, thin), testing::reference_lists(params, thin)),
            "")
            << row->name << " on " << setting.name;
    }
    ++turn;
  }
}

}  // namespace
}  // namespace clusterbench::gpu
