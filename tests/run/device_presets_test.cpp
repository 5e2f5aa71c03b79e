// Presets whose cases run on a device, beside the same presets on the processor. CTest runs them on each software
// driver, as gpu.DRIVER.DevicePresets.NAME.

#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <set>

#include "config/presets/preset_library.h"
#include "gpu/device/device.h"
#include "gpu/methods/methods.h"
#include "places.h"
#include "run/cases/case_names.h"
#include "run/cases/plan.h"
#include "run/runner.h"

namespace clusterbench::run {
namespace {

class DevicePresets : public ::testing::Test {
 protected:
  void SetUp() override {
    gpu::register_methods();
    if (const std::string obstacle = gpu::device_obstacle(); !obstacle.empty()) GTEST_SKIP() << "skipped: " << obstacle;
  }
};

constexpr Vec2i k_viewport{320, 180};
constexpr const char *k_on_device = R"(, "device": "0")", *k_untimed = R"("timing": {"measure": false})";

config::Config device_preset_config(const std::string& scene, const std::string& rest, const std::string& timing) {
  return config::parse_config(R"({"scenes": [{"path": ")" + test::source_dir() + "/scenes/" + scene +
                                  R"(", "frames": 2}], "viewport": [320, 180], "presets": ["*"],
      "shading": {"samples": 256}, )" +
                                  timing + rest + "}",
                              "c.json");
}

struct DevicePresetRun {
  Plan plan;
  Result result;
};

DevicePresetRun run_device_presets(const std::string& scene, const std::string& rest,
                                   const std::string& timing = k_untimed, const std::string& filter = "") {
  const std::atomic<bool> stop{false};
  const config::Config config = device_preset_config(scene, rest, timing);
  DevicePresetRun out;
  out.plan = make_plan(config, filter);
  out.result = run_plan(config, out.plan, {}, {}, stop);
  return out;
}

std::set<std::string> presets_with_device_methods() {
  std::set<std::string> names;
  for (const config::Preset& preset : config::presets())
    if (preset.on_device) names.insert(preset.name);
  return names;
}

TEST_F(DevicePresets, are_all_run_and_timed_by_the_device) {
  const std::string timing = R"("timing": {"rounds": 2, "frames": 1, "launches": 1, "cold": false})";
  const DevicePresetRun run =
      run_device_presets("mix.glb", k_on_device, timing, "daveh355|three-js|black-mesa|wicked|fptl|bevy-gpu|unreal");
  std::set<std::string> told;
  for (const CaseResult& one : run.result.cases) {
    EXPECT_TRUE(told.insert(one.preset).second) << one.name;
    EXPECT_TRUE(one.on_device) << one.name;
    EXPECT_FALSE(one.timing) << one.name;
    EXPECT_TRUE(one.failures.empty()) << one.name << ": " << one.failures[0].text;
    ASSERT_EQ(one.device.has_value(), gpu::device().facts().timestamp_bits > 0) << one.name;
    if (one.device) {
      EXPECT_GT(one.device->first().run_ns.median, 0.0) << one.name;
    }
  }
  EXPECT_EQ(told, presets_with_device_methods());
  for (const Skipped& skipped : run.plan.skipped) ADD_FAILURE() << skipped.name << ": " << skipped.reason;
}

// Over all frames, before anything is dropped: lists of a structure of the method's own are without what they have no
// room for, those of a storage are not.
double pairs_found(const CaseResult& one) {
  const bool has_own_lists = one.storage_label == k_own_structure;
  return one.occupancy->pairs.mean * one.frames +
         (has_own_lists ? static_cast<double>(one.buffers.dropped_pairs) : 0.0);
}

// What a preset lists on the processor, by its name. No method there is light by light and without a rectangle on the
// screen: `bevy-gpu` is compared with every light against every cell.
std::map<std::string, CaseResult> references_on_processor(const std::string& scene) {
  std::map<std::string, CaseResult> by_preset;
  for (CaseResult& one : run_device_presets(scene, "").result.cases) by_preset.emplace(one.preset, std::move(one));
  nlohmann::json parts = config::preset_parts(*config::find_preset("bevy-gpu"), k_viewport);
  const std::string all = R"(, "grids": [)" + parts["grid"].dump() + R"(], "storages": [)" + parts["storage"].dump() +
                          R"(], "assigners": [{"name": "brute-force", "spot": "cone-sphere"}])";
  by_preset.at("bevy-gpu") = run_device_presets(scene, all, k_untimed, "brute-force.*cone-sphere").result.cases.at(0);
  return by_preset;
}

// A device's tests are padded by their roundoffs: by how much its pairs may be more.
constexpr double k_most_more = 1e-3;

void expect_lists_of(const CaseResult& reference, const CaseResult& one, const std::string& name) {
  EXPECT_EQ(one.grid, reference.grid) << name;
  EXPECT_TRUE(one.failures.empty()) << name << ": " << one.failures[0].text;
  ASSERT_TRUE(one.error && reference.error && one.occupancy) << name;
  EXPECT_EQ(one.error->true_pairs, reference.error->true_pairs) << name;
  EXPECT_GE(one.error->false_negatives, reference.error->false_negatives) << name;
  const bool has_own_lists = one.storage_label == k_own_structure;
  EXPECT_LE(one.error->false_negatives,
            reference.error->false_negatives + (has_own_lists ? one.buffers.dropped_pairs : 0))
      << name;
  EXPECT_GE(pairs_found(one), pairs_found(reference)) << name;
  EXPECT_LE(pairs_found(one), pairs_found(reference) * (1.0 + k_most_more)) << name;
  EXPECT_GE(one.buffers.dropped_pairs, reference.buffers.dropped_pairs) << name;
  EXPECT_EQ(one.buffers.dropped_lights, reference.buffers.dropped_lights) << name;
  if (pairs_found(one) != pairs_found(reference) || !one.shading) return;
  EXPECT_EQ(one.shading->missed, reference.shading->missed) << name;
  EXPECT_EQ(one.shading->evaluated, reference.shading->evaluated) << name;
}

// Points, spots, surfaces, and a place where cells are full.
TEST_F(DevicePresets, list_what_their_schemes_list_on_the_processor) {
  std::uint64_t dropped = 0;
  for (const char* scene : {"street.glb", "mix.glb", "steps.glb", "jam.glb"}) {
    const std::map<std::string, CaseResult> references = references_on_processor(scene);
    for (const CaseResult& one : run_device_presets(scene, k_on_device).result.cases) {
      const std::string name = std::string(scene) + ": " + one.name;
      EXPECT_EQ(one.on_device, config::find_preset(one.preset)->on_device.has_value()) << name;
      EXPECT_EQ(one.id == references.at(one.preset).id, !one.on_device) << name;
      if (one.on_device) expect_lists_of(references.at(one.preset), one, name);
      if (one.on_device) dropped += one.buffers.dropped_pairs;
    }
  }
  EXPECT_GT(dropped, 0u) << "a cell was full";
}

TEST_F(DevicePresets, that_need_surfaces_are_skipped_with_the_reason_where_there_are_none) {
  const DevicePresetRun run = run_device_presets("street.glb", k_on_device, k_untimed, "wicked|fptl|daveh355");
  std::set<std::string> skipped;
  for (const Skipped& one : run.plan.skipped)
    if (one.reason == "gpu-tiled needs a depth buffer, and the scene has no triangles") skipped.insert(one.preset);
  EXPECT_EQ(skipped, (std::set<std::string>{"unity-hdrp-fptl", "wicked"}));
}

}  // namespace
}  // namespace clusterbench::run
