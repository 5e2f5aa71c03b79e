// Shaders of users as methods: those of configs/shaders on a device, beside the same steps on the processor.

#include "gpu/user_shaders/shader_method.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "assign/contract/assigner_run.h"
#include "assign/settings.h"
#include "core/error.h"
#include "core/file_text.h"
#include "gpu/device/device.h"
#include "gpu/device_test.h"
#include "gpu/user_shaders/capability_names.h"
#include "gpu/user_shaders/known_values.h"
#include "places.h"
#include "result/documents/shader.h"

namespace clusterbench::gpu {
namespace {

using assign::Answer;
using assign::AssignerRun;
using assign::Lists;
using assign::Params;
using assign::testing::Setting;

class DeviceUserShaders : public testing::DeviceTest {
 protected:
  void TearDown() override { remove_shader_methods(); }
};

const assign::AssignerDescriptor& shader_of(const char* name) {
  return add_shader_method(test::source_dir() + "/configs/shaders/" + name + ".json");
}

// Frames without boxes; where the tests of a setting want spots as balls of their range.
std::vector<Setting> settings_of(const assign::AssignerDescriptor& row) {
  std::vector<Setting> settings = assign::testing::settings_for(row, 5);
  for (Setting& setting : settings) {
    std::erase_if(setting.frame.lights,
                  [](const scene::WorldLight& light) { return light.type == scene::LightType::box; });
    setting.frame.count_types();
  }
  std::erase_if(settings, [](const Setting& setting) { return setting.frame.projection.orthographic; });
  return settings;
}

AssignerRun run_of(const assign::AssignerDescriptor& row, const std::map<std::string, assign::ParamValue>& values,
                   Answer answer, const Setting& setting) {
  const view::LightArrays lights = view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame));
  AssignerRun run(row, Params(row.params, values), answer);
  run.build(setting.grid, assign::kinds_of(lights));
  run.assign(setting.input(lights));
  return run;
}

// Balls of range against boxes, with ranges that are shorter or longer by what the shaders' roundings can be off by.
Lists lists_of_brute_force(Setting setting, double sign) {
  for (scene::WorldLight& light : setting.frame.lights) {
    const double size = glm::length(light.position) + glm::length(setting.frame.view_space.origin) + light.range_m;
    if (light.range_m > 0.0) light.range_m = std::max(0.0, light.range_m + sign * 1e-5 * size);
  }
  return run_of(*assign::find_assigner("brute-force"), {{"spot", std::string("range")}, {"inflation", 0.0}},
                Answer::lists, setting)
      .cell_lists();
}

struct Beside {
  std::uint64_t cells = 0, pairs = 0, full = 0, beyond_fewest = 0, lacks = 0, beside_most = 0;
};

// Each list has all that shorter ranges give, and nothing beyond longer ones. Full lists have `cap` of them.
Beside compared(const Lists& found, const Lists& fewest, const Lists& most, std::size_t cap) {
  Beside out;
  for (std::uint32_t cell = 0; cell < found.cell_count(); ++cell) {
    const auto list = found.of(cell), needed = fewest.of(cell), allowed = most.of(cell);
    ++out.cells;
    out.pairs += list.size();
    out.beside_most += std::ranges::includes(allowed, list) ? 0 : 1;
    out.full += list.size() == cap ? 1 : 0;
    if (list.size() < cap) out.lacks += std::ranges::includes(list, needed) ? 0 : 1;
    out.beyond_fewest += list.size() > needed.size() ? list.size() - needed.size() : 0;
  }
  return out;
}

// Lights that are off give no light, and are in no list of ours; a shader may list the cell that they are in.
void remove_dark(Setting& setting) {
  std::erase_if(setting.frame.lights, [](const scene::WorldLight& light) { return !(light.range_m > 0.0); });
  setting.frame.count_types();
}

TEST_F(DeviceUserShaders, of_the_tutorial_list_what_balls_against_boxes_do) {
  const assign::AssignerDescriptor& row = shader_of("tutorial");
  EXPECT_FALSE(row.conservative);
  std::uint64_t settings = 0, pairs = 0;
  for (Setting setting : settings_of(row)) {
    remove_dark(setting);
    std::optional<AssignerRun> run;
    try {
      run.emplace(run_of(row, {}, Answer::structure, setting));
    } catch (const DeviceError& error) {
      EXPECT_NE(error.message().find("tutorial-loop has exponential slices; those of this grid are others"),
                std::string::npos)
          << error.message();
      continue;
    }
    const Beside beside =
        compared(run->cell_lists(), lists_of_brute_force(setting, -1), lists_of_brute_force(setting, 1), 100);
    EXPECT_EQ(beside.lacks, 0u) << setting.name;
    EXPECT_EQ(beside.beside_most, 0u) << setting.name;
    ++settings;
    pairs += beside.pairs;
    const assign::StructureUse use = run->structure()->use();
    EXPECT_EQ(use.index_bytes + use.header_bytes, setting.grid.cell_count() * 448u);
    EXPECT_EQ(use.index_entries, beside.pairs);
  }
  EXPECT_GT(settings, 0u);
  EXPECT_GT(pairs, 1000u);
}

TEST_F(DeviceUserShaders, that_append_list_the_same_in_any_order) {
  const assign::AssignerDescriptor& row = shader_of("append");
  std::uint64_t settings = 0;
  for (Setting setting : settings_of(row)) {
    remove_dark(setting);
    const Lists fewest = lists_of_brute_force(setting, -1), most = lists_of_brute_force(setting, 1);
    for (const double group : {1.0, 32.0, 64.0}) {
      const AssignerRun run = run_of(row, {{"group", group}, {"per_cell", 1000.0}}, Answer::structure, setting);
      const Beside beside = compared(run.cell_lists(), fewest, most, ~std::size_t{0});
      EXPECT_EQ(beside.lacks, 0u) << setting.name;
      EXPECT_EQ(beside.beside_most, 0u) << setting.name;
      EXPECT_EQ(run.structure()->use().dropped_pairs, 0u) << setting.name;
      EXPECT_EQ(run.structure()->use().index_bytes, 4 * beside.pairs) << setting.name;
      EXPECT_EQ(run.structure()->use().header_bytes, std::uint64_t{8} * setting.grid.cell_count());
    }
    ++settings;
  }
  EXPECT_GT(settings, 1u);
}

TEST_F(DeviceUserShaders, whose_buffer_is_full_have_what_they_drop_counted) {
  const assign::AssignerDescriptor& row = shader_of("append");
  std::uint64_t dropped = 0;
  for (Setting setting : settings_of(row)) {
    remove_dark(setting);
    const AssignerRun all = run_of(row, {{"per_cell", 1000.0}}, Answer::structure, setting),
                      some = run_of(row, {{"per_cell", 1.0}}, Answer::structure, setting);
    const assign::StructureUse use = some.structure()->use();
    EXPECT_EQ(use.index_entries + use.dropped_pairs, all.structure()->use().index_entries) << setting.name;
    EXPECT_LE(use.index_entries, setting.grid.cell_count()) << setting.name;
    EXPECT_EQ(some.structure()->limit().index_entries, setting.grid.cell_count()) << setting.name;
    dropped += use.dropped_pairs;
  }
  EXPECT_GT(dropped, 0u);
}

TEST_F(DeviceUserShaders, leave_the_same_lists_however_often_their_work_is_repeated) {
  using Repeats = assign::DeviceRepeats;
  for (const char* name : {"tutorial", "append"}) {
    const assign::AssignerDescriptor& row = shader_of(name);
    Setting setting = settings_of(row).front();
    const view::LightArrays lights = view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame));
    std::map<std::string, assign::ParamValue> values;
    if (name == std::string("append")) values["per_cell"] = 1000.0;  // what is dropped would be another light each time
    const auto method = row.make_own(Params(row.params, values));
    const auto structure = method->make_structure();
    method->build(setting.grid, assign::kinds_of(lights));
    method->assign(setting.input(lights), *structure);
    const Lists once = structure->expanded();
    for (const Repeats::Caches caches : {Repeats::Caches::warm, Repeats::Caches::cold}) {
      method->repeat_on_device({.caches = caches, .upload = 3, .run = 5, .floor = 2, .build = 2});
      method->assign(setting.input(lights), *structure);
      EXPECT_EQ(structure->expanded(), once) << name;
      EXPECT_EQ(method->device_spans()->dispatches, name == std::string("append") ? 2u : 1u);
      EXPECT_GT(method->device_spans()->result_bytes, 0u);
      EXPECT_EQ(method->device_build_ns().has_value(), name == std::string("tutorial"));
      method->device_floor_ns();
      method->assign(setting.input(lights), *structure);
      EXPECT_EQ(structure->expanded(), once) << name << ", after its build was repeated";
    }
  }
}

TEST_F(DeviceUserShaders, take_frames_with_other_numbers_of_lights_and_other_grids_in_turn) {
  const assign::AssignerDescriptor& row = shader_of("append");
  const auto method = row.make_own(Params(row.params, {{"per_cell", 1000.0}}));
  const auto structure = method->make_structure();
  for (int round = 0; round < 2; ++round)
    for (Setting setting : settings_of(row))
      for (const std::size_t kept : {std::size_t{0}, std::size_t{7}, setting.frame.lights.size()}) {
        Setting part = setting;
        part.frame.lights.resize(kept);
        part.frame.count_types();
        const view::LightArrays lights = view::lights_in(part.frame, grid::space_of(part.grid, part.frame));
        method->build(part.grid, assign::kinds_of(lights));
        method->assign(part.input(lights), *structure);
        EXPECT_EQ(structure->expanded(), run_of(row, {{"per_cell", 1000.0}}, Answer::structure, part).cell_lists())
            << part.name << ", " << kept << " lights";
      }
}

TEST(UserShaders, have_all_known_values_in_their_document) {
  const std::string page = file_text(test::source_dir() + "/docs/shaders.md");
  for (const KnownValue& value : known_values())
    EXPECT_NE(page.find("`" + std::string(value.name) + "`"), std::string::npos) << value.name;
}

TEST(UserShaders, have_their_documents_example_beside_its_shader) {
  const std::string page = file_text(test::source_dir() + "/docs/shaders.md"),
                    file = file_text(test::source_dir() + "/configs/shaders/counted.json");
  EXPECT_NE(page.find("```json\n" + file + "```"), std::string::npos);
}

// What the example says of itself, with other values at these places.
std::string refusal_of_append(const std::vector<std::pair<const char*, const char*>>& changes) {
  const std::string folder = test::source_dir() + "/configs/shaders/";
  auto json = result::Json::parse(file_text(folder + "append.json"));
  for (const auto& [pointer, value] : changes) json[result::Json::json_pointer(pointer)] = result::Json::parse(value);
  try {
    make_shader_file("append.json", json.dump(),
                     [&](const std::string& name, const std::string&) { return file_text(folder + name); });
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(UserShaders, may_have_formulas_of_lists_that_only_numbers_of_a_frame_make_right) {
  for (const char* formula :
       {R"("per_cell / 4")", R"("per_cell - 1")", R"("viewport_width / 15")", R"("(columns - 2) * 4")"}) {
    EXPECT_EQ(refusal_of_append({{"/lists/0/rows/at", formula}}), "") << formula;
    EXPECT_EQ(refusal_of_append({{"/lists/0/lights", formula}}), "") << formula;
  }
  EXPECT_NE(
      refusal_of_append({{"/lists/0/rows/at", R"("(columns - 2")"}}).find("/lists/0/rows/at: '(columns - 2' lacks"),
      std::string::npos);
  EXPECT_NE(refusal_of_append({{"/lists/0/rows/at", R"("colums")"}}).find("did you mean 'columns'"), std::string::npos);
}

TEST(UserShaders, whose_description_cannot_be_right_in_any_frame_are_refused) {
  const std::tuple<std::vector<std::pair<const char*, const char*>>, const char*> rows[] = {
      {{{"/lists/0/layout", R"("linked")"}}, "/lists/0/head: is missing: layout 'linked' needs it"},
      {{{"/lists/0/layout", R"("bits_and_bins")"}}, "/lists/0/ranges: is missing"},
      {{{"/lists/0/counts/0/bits", "[0, 33]"}},
       "/lists/0/counts/0/bits: is [0,33]; allowed: the first bit and how many, at least 1, within the 32 bits of u32"},
      {{{"/lists/0/counts/0/at", "6"}}, "/lists/0/counts/0/at: is 6: its 4 bytes end beyond the stride of 8 bytes"},
      {{{"/lists/0/offset/at", "5"}}, "/lists/0/offset/at: is 5"},
      {{{"/lists/0/end", R"({"at": 4, "type": "u32"})"}}, "/lists/0/end: does not go with counts"},
      {{{"/lists/0/rows/stride", "0"}}, "/lists/0/rows/stride: is 0; allowed: at least 1"},
      {{{"/buffers/indices/bytes", "64"}, {"/lists/0/entries/at", "64"}},
       "/lists/0/entries/at: is 64; buffer 'indices' has 64 bytes"},
      {{{"/buffers/indices/bytes", "0"}},
       "/buffers/indices/bytes: is 0; allowed: a whole number from 1 to 2^53, or a formula"},
      {{{"/passes/0/groups/0", "0"}}, "/passes/0/groups/0: is 0; allowed: a whole number from 1"},
      {{{"/passes/0/groups/0", R"("4 - 4")"}}, "/passes/0/groups/0: '4 - 4' is 0 here; allowed: a whole number from 1"},
      {{{"/buffers/indices/bytes", R"("4 - 8")"}},
       "/buffers/indices/bytes: '4 - 8' is -4 here; allowed: a whole number"},
      {{{"/lists/0/rows/at", R"("8 / 3")"}}, "/lists/0/rows/at: '8 / 3' is 2.6"},
      {{{"/passes/0/push/1/at", "8"}}, "/passes/0/push/1/at: is 8: byte 8 is one of /passes/0/push/0, too"},
      {{{"/passes/0/push/2/at", "17"}}, "/passes/0/push/2/at: is 17: its 4 bytes end beyond the 20 that there are"},
      {{{"/passes/0/push", R"([{"at": 0, "type": "u32", "is": "grid_size"}])"}},
       "/passes/0/push: say nothing of byte 12, which the push constants of append.spv have"},
      {{{"/passes/0/constants/0/type", R"("f32")"}},
       "/passes/0/constants/0/type: is f32; constant 0 of append.spv is u32"},
      {{{"/parameters/0/default", "5000"}},
       "/parameters/0/default: is 5000; allowed: whole numbers from min to max, here 1 to 4096"},
      {{{"/lights/rows/0/fields/0/at", "0"}, {"/lights/rows/0/fields/1", R"({"at": 8, "type": "f32", "is": "range"})"}},
       "/lights/rows/0/fields/1/at: is 8: byte 8 is one of /lights/rows/0/fields/0, too"},
      {{{"/lights/rows/1/buffer", R"("positions")"}, {"/lights/rows/1/at", "8"}},
       "/lights/rows/1/fields/0/at: is 0: byte 8 is one of /lights/rows/0/fields/0, too"},
      {{{"/buffers/positions/values", R"([{"at": "2 * 2", "type": "u32", "is": "lights"}])"}},
       "/buffers/positions/values/0/at: is 4: byte 4 is one of /lights/rows/0/fields/0, too"},
      {{{"/buffers/positions/bytes", "8"}},
       "/lights/rows/0: take 12 bytes for the first light; buffer 'positions' has 8"},
      {{{"/parameters/0/default", "0.5"}, {"/parameters/0/min", "0"}},
       "/parameters/0/default: is 0.5; allowed: whole numbers from min to max, here 0 to 4096"},
      {{{"/parameters/0/min", "0.5"}}, "/parameters/0/min: is 0.5; allowed: a whole number"},
      {{{"/buffers/boundaries/values/0/at", "0"}, {"/buffers/boundaries/values/1/at", "4"}},
       "/buffers/boundaries/values/1/at: is 4: byte 4 is one of /buffers/boundaries/values/0, too"},
      {{{"/passes/0/push/3", R"({"at": 20, "type": "f32", "is": "slice_boundaries"})"}},
       "/passes/0/push/3/at: is 20: its first 8 bytes end beyond the 20 that there are"},
      {{{"/passes/0/constants/0/is", R"("1 / 0")"}}, "/passes/0/constants/0/is: '1 / 0' divides by 0"},
      {{{"/passes/0/constants/0/is", R"("-1")"}}, "/passes/0/constants/0/is: is -1 here, which no u32 is"},
      {{{"/passes/0/constants/0/is", R"("0")"}}, "/passes/0/module: append.spv has groups of 0 invocations"},
      {{{"/buffers/boundaries/values/0/is", R"("1e300")"}},
       "/values/0/is: is 1.0000000000000001e+300 here, which no f32"},
      {{{"/buffers/boundaries/values/0/is", R"("1e6")"}, {"/buffers/boundaries/values/0/type", R"("f16")"}},
       "/values/0/is: is 1000000 here, which no f16 is"},
      {{{"/passes/0/push/1/type", R"("f32")"}},
       "/passes/0/push/1/type: is f32; byte 12 of the push constants of append.spv is u32"},
      {{{"/buffers/boundaries/values/0/type", R"("u32")"}},
       "/buffers/boundaries/values/0/type: is u32; byte 0 of set 0"},
      {{{"/lights/rows/0/fields/0/type", R"("u32")"}},
       "/lights/rows/0/fields/0/type: is u32; byte 0 of set 0, binding 0"},
      {{{"/bufers", "{}"}}, "/bufers: is not known (did you mean 'buffers'?); allowed: shader_version, name"}};
  EXPECT_EQ(refusal_of_append({}), "");
  for (const auto& [changes, message] : rows)
    EXPECT_NE(refusal_of_append(changes).find(message), std::string::npos)
        << refusal_of_append(changes) << "\nnot: " << message;
}

TEST_F(DeviceUserShaders, lack_a_capability_or_have_one_that_no_device_is_asked_for) {
  for (const std::uint32_t capability : device().facts().capabilities)
    EXPECT_TRUE(is_capability_asked_for(capability)) << capability;
}

TEST(UserShaders, of_the_name_of_a_method_of_ours_are_refused_and_those_of_another_shader_are_not) {
  ShaderFile file;
  file.record.name = "aabb";
  EXPECT_THROW(check_shader_name(file), Error);
  shader_of("append");
  file.record.name = "append";
  EXPECT_NO_THROW(check_shader_name(file));
  remove_shader_methods();
}

TEST_F(DeviceUserShaders, are_registered_once_and_by_names_of_their_own) {
  const assign::AssignerDescriptor& row = shader_of("append");
  EXPECT_EQ(&row, &shader_of("append"));
  EXPECT_EQ(assign::find_assigner("append"), &row);
  ASSERT_TRUE(row.origin);
  EXPECT_EQ(row.origin->sha256.size(), 64u);
  EXPECT_TRUE(row.own_lists);
  EXPECT_EQ(row.params.size(), 2u);
  remove_shader_methods();
  EXPECT_EQ(assign::find_assigner("append"), nullptr);
}

}  // namespace
}  // namespace clusterbench::gpu
