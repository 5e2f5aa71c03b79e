#include "config/presets/preset_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "assign/contract/assigner.h"
#include "config/config.h"
#include "config/grid_json.h"
#include "config/presets/preset_library.h"
#include "config/presets/preset_text.h"
#include "config/presets/preset_tiles.h"
#include "core/error.h"
#include "gpu/methods/methods.h"
#include "places.h"

namespace clusterbench::config {
namespace {

using Json = nlohmann::json;

const std::string k_device_method = R"({"assigner": {"name": "gpu-cells"}, "approximated": "groups"})";

constexpr const char* k_sound = R"({"name": "mine", "engine": "Mine", "version": "1", "evidence": "read",
  "source": "its code", "summary": "tiles", "approximated": "", "unverified": "", "assigns_on": "cpu",
  "grid": {"kind": "frustum"}, "assigner": {"name": "aabb"}})";

// The sound preset with a member in place of another, or beside the others; null takes it out.
std::string preset_with(const std::string& key, const Json& value) {
  Json document = Json::parse(k_sound);
  document[key] = value;
  if (value.is_null()) document.erase(key);
  return document.dump();
}

std::string fault_of(const std::string& text) {
  try {
    read_preset(text, "presets/mine.json");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string gpu_preset_with(const std::string& key, const Json& value) {
  Json document = Json::parse(preset_with("assigns_on", "gpu"));
  if (!key.empty()) document[key] = value;
  return document.dump();
}

Config config_with(Json document) {
  gpu::register_methods();
  document["scenes"] = Json::array({"a.glb"});
  return parse_config(document.dump(), "c.json");
}

TEST(PresetFiles, are_all_in_the_program_under_their_names) {
  std::set<std::string> files, embedded;
  for (const auto& entry : std::filesystem::directory_iterator(test::source_dir() + "/configs/presets"))
    files.insert(entry.path().filename().string());
  for (const PresetText& text : preset_texts()) {
    EXPECT_TRUE(embedded.insert(std::string(text.name) + ".json").second) << text.name << " is there twice";
    EXPECT_EQ(find_preset(std::string(text.name))->name, text.name);
  }
  EXPECT_EQ(embedded, files);
  EXPECT_EQ(presets().size(), files.size());
}

// Read as an entry of a configuration, each part is what the preset measures.
TEST(PresetFiles, have_parts_that_a_configuration_takes_as_they_are) {
  for (const Preset& preset : presets()) {
    Json document{{"grids", Json::array({preset.grid})}, {"assigners", Json::array({preset.assigner})}};
    if (preset.storage) document["storages"] = Json::array({*preset.storage});
    if (preset.pre_cull) document["pre_cull"] = Json::array({*preset.pre_cull});
    const Config copied = config_with(document), by_name = config_with({{"presets", {preset.name}}});
    const PresetChoice& choice = by_name.presets.at(0);
    ASSERT_EQ(copied.grids.size(), 1u) << preset.name;
    EXPECT_EQ(grid_identity(copied.grids[0]), grid_identity(by_name.grids.at(choice.grid))) << preset.name;
    EXPECT_EQ(copied.assigners.at(0).label(), by_name.assigners.at(choice.assigner).label()) << preset.name;
    EXPECT_EQ(choice.storage.has_value(), preset.storage.has_value()) << preset.name;
    if (choice.storage) {
      EXPECT_EQ(copied.storages.at(0).label(), by_name.storages.at(*choice.storage).label());
    }
    EXPECT_EQ(choice.pre_culls.size(), preset.pre_cull ? 1u : 0u) << preset.name;
    if (preset.pre_cull) {
      EXPECT_EQ(copied.pre_culls.at(0), by_name.pre_culls.at(choice.pre_culls.at(0))) << preset.name;
    }
  }
}

TEST(PresetFiles, have_methods_for_a_device_that_a_configuration_takes_as_they_are) {
  for (const Preset& preset : presets()) {
    if (!preset.on_device) continue;
    const Config copied = config_with({{"assigners", Json::array({preset.on_device->assigner})}}),
                 by_name = config_with({{"presets", {preset.name}}, {"device", "0"}});
    ASSERT_EQ(copied.assigners.size(), 1u) << preset.name;
    EXPECT_EQ(copied.assigners[0].label(), by_name.assigners.at(by_name.presets.at(0).assigner).label()) << preset.name;
    EXPECT_TRUE(assign::find_assigner(copied.assigners[0].name)->on_device) << preset.name;
  }
}

TEST(PresetFiles, have_the_tiles_of_1920_x_1080_pixels_where_these_follow_the_viewport) {
  std::set<std::string> used;
  for (const Preset& preset : presets()) {
    if (!preset.tiles_by) continue;
    used.insert(*preset.tiles_by);
    EXPECT_EQ(Json(preset.grid.at("tiles")), find_tiles_by(*preset.tiles_by)({1920, 1080})) << preset.name;
  }
  const std::vector<std::string> names = tiles_by_names();
  EXPECT_EQ(used, std::set<std::string>(names.begin(), names.end())) << "each is used";
}

TEST(PresetFiles, may_have_comments) {
  const Preset preset = read_preset("// mine\n" + std::string(k_sound), "presets/mine.json");
  EXPECT_EQ(preset.engine, "Mine");
  EXPECT_FALSE(preset.storage || preset.pre_cull || preset.tiles_by || preset.has_mistakes());
}

TEST(PresetFiles, of_engines_that_assign_on_a_gpu_have_a_method_for_a_device_or_the_reason_why_not) {
  gpu::register_methods();
  const Json method = Json::parse(k_device_method);
  EXPECT_EQ(fault_of(gpu_preset_with("on_device", method)), "");
  EXPECT_EQ(fault_of(gpu_preset_with("not_on_device", "it rasterises")), "");
  Json both = Json::parse(gpu_preset_with("on_device", method));
  both["not_on_device"] = "it rasterises";
  const auto with_method = [&](const Json& assigner) {
    return gpu_preset_with("on_device", {{"assigner", assigner}, {"approximated", ""}});
  };
  const std::pair<std::string, const char*> faults[] = {
      {gpu_preset_with("", {}), "/assigns_on: is gpu, and neither of on_device and not_on_device is there"},
      {both.dump(), "/assigns_on: is gpu, and both of on_device and not_on_device is there; allowed: one of them"},
      {preset_with("on_device", method), "/on_device: is allowed only beside \"assigns_on\": \"gpu\""},
      {preset_with("not_on_device", ""), "/not_on_device: is allowed only beside"},
      {gpu_preset_with("on_device", "gpu-cells"), "/on_device"},
      {gpu_preset_with("on_device", {{"approximated", ""}}), "/on_device/assigner is missing"},
      {gpu_preset_with("on_device", {{"assigner", {{"name", "gpu-cells"}}}}), "/on_device/approximated is missing"},
      {gpu_preset_with("on_device", {{"name", "gpu-cells"}}), "/on_device"},
      {with_method("gpu-cells"), "/on_device/assigner: found \"gpu-cells\", allowed: an entry of assigners"},
      {with_method({{"nam", "gpu-cells"}}), "/on_device/assigner: found {"},
      {with_method({{"name", "aabb"}}),
       "/on_device/assigner/name: found 'aabb', allowed: a method that runs on a device (gpu-*)"}};
  for (const auto& [broken, message] : faults)
    EXPECT_NE(fault_of(broken).find(message), std::string::npos) << fault_of(broken) << "\nnot: " << message;
  const std::string text = with_method({{"name", "aabb"}});
  EXPECT_TRUE(fault_of(text).starts_with("presets/mine.json: 1:" + std::to_string(text.find("\"aabb\"", 140) + 1)))
      << fault_of(text) << "\n"
      << text;
}

TEST(PresetFiles, with_a_fault_are_refused_with_their_place) {
  const std::string text = preset_with("assigns_on", "cpus");
  EXPECT_EQ(fault_of(text), "presets/mine.json: 1:" + std::to_string(text.find("\"cpus\"") + 1) +
                                " /assigns_on: found 'cpus' (did you mean 'cpu'?), allowed: cpu, gpu");
  const std::pair<std::string, const char*> faults[] = {
      {"{", "presets/mine.json: 1:"},
      {"[]", "1:1 /: /name is missing"},
      {preset_with("engine", nullptr), "1:1 /: /engine is missing"},
      {preset_with("engine", 1), "/engine: must be a text"},
      {preset_with("grids", 1), "/grids: is not known"},
      {preset_with("evidence", "seen"), "/evidence: found 'seen', allowed: ran, read, memory"},
      {preset_with("name", "yours"), "/name: found 'yours', allowed: the name of the file, 'mine'"},
      {preset_with("tiles_by", "beevy"),
       "/tiles_by: found 'beevy' (did you mean 'bevy'?), allowed: filament, bevy, eevee"},
      {preset_with("mistakes", "some"), "1:1 /: has one of mistakes and as_shipped"},
      {preset_with("as_shipped", {{"tiles", 1}}), "/as_shipped/tiles: is not known"}};
  for (const auto& [broken, message] : faults)
    EXPECT_NE(fault_of(broken).find(message), std::string::npos) << fault_of(broken) << "\nnot: " << message;
  EXPECT_EQ(fault_of(k_sound), "");
}

}  // namespace
}  // namespace clusterbench::config
