// What holds for every method that runs on a device: the contract of all assigners, and lists equal to those of the
// same tests on the processor.

#include "gpu/methods/methods.h"
#include "assign/contract.h"
#include "assign/contract/assigner_run.h"
#include "core/text.h"
#include "effort.h"
#include "gpu/device/device.h"

namespace clusterbench::gpu {
namespace {

using assign::Answer;
using assign::AssignerDescriptor;
using assign::Lists;
using assign::Params;
using assign::testing::Setting;

class DeviceMethods : public ::testing::Test {
 protected:
  void SetUp() override {
    register_methods();
    if (const std::string obstacle = device_obstacle(); !obstacle.empty()) GTEST_SKIP() << "skipped: " << obstacle;
  }

  static std::vector<const AssignerDescriptor*> all() {
    std::vector<const AssignerDescriptor*> methods;
    for (const AssignerDescriptor* row : assign::assigner_descriptors())
      if (row->on_device) methods.push_back(row);
    return methods;
  }
};

Lists lists_of(const AssignerDescriptor& method, const Params& params, const Setting& setting) {
  const view::LightArrays lights = view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame));
  assign::AssignerRun run(method, params, Answer::lists);
  run.build(setting.grid, assign::kinds_of(lights));
  run.assign(setting.input(lights));
  return run.cell_lists();
}

TEST_F(DeviceMethods, are_registered) {
  EXPECT_GE(all().size(), 4u);
}

// Drivers allocate as they like.
std::string faults_of(const AssignerDescriptor& row, const Params& params, const Setting& setting) {
  std::vector<std::string> faults = assign::testing::contract_faults(row, params, setting);
  std::erase_if(faults, [](const std::string& fault) { return fault.find("allocates") != std::string::npos; });
  return joined(faults, "; ");
}

// Each choice in a quarter of the views: software devices are slow.
TEST_F(DeviceMethods, keep_the_contract_in_every_view) {
  std::size_t turn = 0;
  for (const AssignerDescriptor* row : all())
    for (const Setting& setting : assign::testing::settings_for(*row, 7))
      for (const Params& params : test::every_nth(assign::testing::params_of(*row), 4, turn++ % 4))
        EXPECT_EQ(faults_of(*row, params, setting), "")
            << row->name << " " << params.text("spot") << " on " << setting.name;
}

// The same steps with the same padding: where a device may round either way, its methods count each step twice, and pad
// by 10 roundoffs in place of 6.
Params params_of_reference(const AssignerDescriptor& reference) {
  const double inflation = device().facts().rounds_to_nearest ? 1.0 : 10.0 / 6.0;
  return {reference.params, {{"inflation", inflation}}};
}

TEST_F(DeviceMethods, have_the_lists_of_brute_force_for_points) {
  const AssignerDescriptor& reference = *assign::find_assigner("brute-force");
  for (const AssignerDescriptor* row : all())
    for (Setting setting : assign::testing::settings_for(*row, 9)) {
      if (!row->answers(Answer::lists)) continue;
      std::erase_if(setting.frame.lights,
                    [](const scene::WorldLight& light) { return light.type != scene::LightType::point; });
      setting.frame.count_types();
      const Lists expected = lists_of(reference, params_of_reference(reference), setting);
      ASSERT_GT(expected.pair_count(), 0u);
      EXPECT_TRUE(lists_of(*row, Params(row->params), setting) == expected) << row->name << " on " << setting.name;
    }
}

}  // namespace
}  // namespace clusterbench::gpu
