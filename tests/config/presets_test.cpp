#include "config/presets/preset_library.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "assign/contract/assigner.h"
#include "config/config.h"
#include "config/grid_json.h"
#include "config/pre_cull_json.h"
#include "core/error.h"
#include "gpu/methods/methods.h"

namespace clusterbench::config {
namespace {

using Json = nlohmann::json;

Config with_presets(const std::string& rest, const std::vector<FlagValue>& flags = {}) {
  return parse_config(R"({"scenes": ["a.glb"])" + rest + "}", "c.json", flags);
}

// The grid as it is resolved for a viewport, the method and the storage of the only preset.
struct Resolved {
  Json grid;
  MethodRequest assigner;
  std::optional<MethodRequest> storage;
};

Resolved resolved(const std::string& name, const std::string& viewport = "[1920, 1080]") {
  const Config config = with_presets(R"(, "viewport": )" + viewport + R"(, "presets": [")" + name + R"("])");
  EXPECT_EQ(config.presets.size(), 1u) << name;
  const PresetChoice& choice = config.presets.at(0);
  Resolved out{Json::parse(grid_request(config.grids.at(choice.grid)).dump()), config.assigners.at(choice.assigner),
               std::nullopt};
  if (choice.storage) out.storage = config.storages.at(*choice.storage);
  return out;
}

std::string refusal_of(const std::string& rest, const std::vector<FlagValue>& flags = {}) {
  try {
    with_presets(rest, flags);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Presets, there_is_one_for_every_row_of_the_table_of_engines) {
  const std::vector<std::string> rows{
      "just-cause-3",    "just-cause-2",    "humus",       "ortegren-persson", "daveh355",  "black-mesa",
      "doom-2016",       "call-of-duty-iw", "olsson-2012", "filament",         "bevy",      "bevy-gpu",
      "godot",           "three-js",        "playcanvas",  "babylon",          "unity-urp", "unity-hdrp",
      "unity-hdrp-fptl", "wicked",          "unreal",      "ogre-next",        "stride",    "eevee"};
  EXPECT_EQ(preset_names(), rows);
}

TEST(Presets, each_says_where_it_comes_from_and_takes_a_method_that_takes_its_grid) {
  for (const Preset& preset : presets()) {
    EXPECT_FALSE(preset.source.empty() || preset.summary.empty()) << preset.name;
    EXPECT_FALSE(preset.version.empty()) << preset.name;
    EXPECT_EQ(preset.has_mistakes(), preset.mistakes && !preset.mistakes->empty()) << preset.name;
    EXPECT_TRUE(!preset.has_mistakes() || preset.evidence == "ran") << preset.name;
    const Config config = with_presets(R"(, "presets": [")" + preset.name + R"("])");
    ASSERT_EQ(config.presets.size(), 1u);
    const PresetChoice& choice = config.presets[0];
    const assign::AssignerDescriptor& method = *assign::find_assigner(config.assigners[choice.assigner].name);
    EXPECT_TRUE(method.takes(config.grids[choice.grid].kind)) << preset.name;
    EXPECT_TRUE(method.answers(choice.storage ? assign::Answer::lists : assign::Answer::structure)) << preset.name;
  }
}

TEST(Presets, those_of_engines_that_make_lists_in_a_shader_or_by_rasterisation_say_that_these_are_not_uploaded) {
  for (const char* name : {"three-js", "wicked", "godot", "unity-hdrp", "unreal", "call-of-duty-iw", "daveh355"})
    EXPECT_EQ(find_preset(name)->assigns_on, "gpu") << name;
  for (const char* name : {"filament", "bevy", "playcanvas", "unity-urp", "just-cause-3"})
    EXPECT_EQ(find_preset(name)->assigns_on, "cpu") << name;
}

struct Fact {
  const char *preset, *pointer, *value;
};

TEST(Presets, grids_are_those_of_the_engines) {
  constexpr Fact k_facts[] = {
      {"just-cause-3", "/tiles/pixels", "[64, 64]"},
      {"just-cause-3", "/slices/scheme", R"("exponential-first")"},
      {"just-cause-3", "/slices/count", "16"},
      {"just-cause-3", "/slices/near", "0.1"},
      {"just-cause-3", "/slices/first", "5.0"},
      {"just-cause-3", "/slices/far", "500.0"},
      {"just-cause-2", "/cells", "[128, 1, 128]"},
      {"ortegren-persson", "/tiles/count", "[24, 12]"},
      {"ortegren-persson", "/slices/count", "64"},
      {"daveh355", "/tiles/count", "[12, 12]"},
      {"daveh355", "/slices/count", "24"},
      {"daveh355", "/slices/scheme", R"("exponential")"},
      {"black-mesa", "/tiles/count", "[16, 9]"},
      {"black-mesa", "/slices/count", "128"},
      {"wicked", "/tiles/pixels", "[32, 32]"},
      {"filament", "/tiles/pixels", "[72, 72]"},
      {"filament", "/slices/count", "16"},
      {"filament", "/slices/first", "5.0"},
      {"filament", "/slices/far_at_most", "100.0"},
      {"bevy", "/tiles/count", "[17, 9]"},
      {"bevy", "/slices/orthographic", R"("linear")"},
      {"bevy-gpu", "/tiles/count", "[17, 9]"},
      {"bevy-gpu", "/slices/fit/to", R"("ranges")"},
      {"bevy", "/slices/count", "24"},
      {"bevy", "/slices/first", "5.0"},
      {"bevy", "/slices/fit/to", R"("ranges")"},
      {"godot", "/slices/count", "32"},
      {"godot", "/slices/scheme", R"("linear")"},
      {"godot", "/slices/far_default", "4000.0"},
      {"three-js", "/slices/far_default", "2000.0"},
      {"babylon", "/slices/far_default", "10000.0"},
      {"unity-urp", "/slices/far_default", "1000.0"},
      {"unity-hdrp", "/slices/far_default", "1000.0"},
      {"unreal", "/slices/fit/to", R"("ranges")"},
      {"three-js", "/tiles/pixels", "[32, 32]"},
      {"three-js", "/slices/count", "24"},
      {"playcanvas", "/cells", "[10, 3, 10]"},
      {"babylon", "/tiles/count", "[64, 64]"},
      {"babylon", "/slices/count", "16"},
      {"unity-urp", "/tiles/pixels", "[8, 8]"},
      {"unity-urp", "/react/to", R"("mask-words")"},
      {"unity-urp", "/react/most", "16384"},
      {"unity-urp", "/react/most_lights", "256"},
      {"bevy", "/react/to", R"("entries")"},
      {"bevy", "/react/most", "16384"},
      {"bevy", "/react/of", R"("sphere-refinement")"},
      {"unity-urp", "/slices/orthographic", R"("linear")"},
      {"unity-hdrp-fptl", "/tiles/pixels", "[16, 16]"},
      {"ogre-next", "/tiles/count", "[16, 8]"},
      {"stride", "/tiles/pixels", "[64, 64]"},
      {"eevee", "/tiles/pixels", "[32, 32]"},
      {"unity-urp", "/slices/scheme", R"("exponential")"},
      {"unity-hdrp", "/tiles/pixels", "[32, 32]"},
      {"unity-hdrp", "/slices/count", "64"},
      {"unreal", "/tiles/pixels", "[64, 64]"},
      {"unreal", "/slices/count", "32"},
      {"doom-2016", "/tiles/count", "[16, 8]"},
      {"doom-2016", "/slices/count", "24"},
      {"call-of-duty-iw", "/tiles/pixels", "[8, 8]"},
      {"call-of-duty-iw", "/slices/scheme", R"("linear")"},
      {"olsson-2012", "/slices/scheme", R"("cubical")"},
  };
  for (const Fact& fact : k_facts)
    EXPECT_EQ(resolved(fact.preset).grid.at(Json::json_pointer(fact.pointer)), Json::parse(fact.value))
        << fact.preset << fact.pointer;
}

TEST(Presets, just_cause_2_has_tiles_of_four_metres_around_the_camera) {
  const Json grid = resolved("just-cause-2").grid;
  EXPECT_EQ(grid["follow"], "camera");
  EXPECT_EQ(grid["cell_size"], Json::parse("[4.0, null, 4.0]"));
}

TEST(Presets, what_fits_into_a_cell_is_what_the_engines_have_room_for) {
  constexpr std::pair<const char*, double> k_caps[] = {
      {"just-cause-2", 4}, {"daveh355", 100}, {"three-js", 64}, {"playcanvas", 255}, {"ogre-next", 96}};
  for (const auto& [name, cap] : k_caps) {
    const Resolved preset = resolved(name);
    ASSERT_TRUE(preset.storage);
    EXPECT_EQ(preset.storage->name, "fixed");
    EXPECT_EQ(std::get<double>(preset.storage->params.values().at("cap")), cap) << name;
  }
  EXPECT_EQ(std::get<double>(resolved("unreal").storage->params.values().at("nodes_per_cell")), 32.0);
  EXPECT_EQ(std::get<std::string>(resolved("filament").storage->params.values().at("equal_lists")), "shared");
  EXPECT_EQ(std::get<double>(resolved("filament").storage->params.values().at("max_entries")), 65534.0)
      << "of 65535 records the last is never used";
  for (const char* name : {"bevy", "bevy-gpu"})
    EXPECT_EQ(std::get<double>(resolved(name).storage->params.values().at("header_size")), 32.0) << name;
  EXPECT_EQ(std::get<std::string>(resolved("just-cause-3").storage->params.values().at("index_bits")), "16");
}

// By the engines' own arithmetic, on paper: Filament has 512 tiles in a slice, of whole eights of pixels; Bevy 170, of
// which as many are asked for as whole pixels allow, spread evenly; EEVEE 8192 of 32 px at most.
TEST(Presets, tiles_that_follow_the_viewport_are_those_of_the_engines) {
  EXPECT_EQ(resolved("filament", "[1280, 720]").grid["tiles"]["pixels"], Json::parse("[48, 48]"));
  EXPECT_EQ(resolved("filament", "[3840, 2160]").grid["tiles"]["pixels"], Json::parse("[136, 136]"));
  EXPECT_EQ(resolved("bevy", "[1000, 1000]").grid["tiles"]["count"], Json::parse("[13, 13]"));
  EXPECT_EQ(resolved("bevy", "[1600, 900]").grid["tiles"]["count"], Json::parse("[17, 9]"));
  EXPECT_EQ(resolved("bevy", "[4000, 16]").grid["tiles"]["count"], Json::parse("[167, 1]"))
      << "170 asked for are of 24 px";
  EXPECT_EQ(resolved("eevee", "[3840, 2160]").grid["tiles"]["pixels"], Json::parse("[32, 32]"));
  EXPECT_EQ(resolved("eevee", "[7680, 4320]").grid["tiles"]["pixels"], Json::parse("[64, 64]"));
}

// OGRE-Next: 2^(k log2(500 - 5) / 24) + 5. Stride: log2(z s + b) with 1 at 2 m and 8 at 1000 m.
TEST(Presets, slices_that_are_listed_are_those_of_the_engines_formulas) {
  const auto boundaries = [](const char* name) {
    return resolved(name).grid["slices"]["boundaries"].get<std::vector<double>>();
  };
  const std::vector<double> ogre = boundaries("ogre-next"), stride = boundaries("stride");
  ASSERT_EQ(ogre.size(), 25u);
  for (std::size_t k = 1; k < 24; ++k)
    EXPECT_NEAR(ogre[k], std::exp2(static_cast<double>(k) * std::log2(495.0) / 24.0) + 5.0, 1e-3) << k;
  ASSERT_EQ(stride.size(), 9u);
  for (std::size_t k = 1; k < 9; ++k) {
    const double scale = (256.0 - 2.0) / (1000.0 - 2.0), bias = 2.0 - scale * 2.0;
    EXPECT_NEAR(std::log2(stride[k] * scale + bias), static_cast<double>(k), 1e-4) << k;
  }
}

// Lights that the engines take, by their sources.
TEST(Presets, limits_of_lights_are_those_of_the_engines_and_are_counted_in_view) {
  struct Limit {
    const char* preset;
    std::uint64_t lights;
    const char* label;
  };
  constexpr Limit k_limits[] = {{"playcanvas", 255, "frustum+most(255,first)"},
                                {"filament", 256, "frustum+most(256,shallowest)"},
                                {"godot", 512, "frustum+most(512,first,type)"},
                                {"doom-2016", 256, "frustum+most(256,first)"},
                                {"wicked", 256, "frustum+most(256,first)"},
                                {"unity-urp", 256, "frustum+most(256,first)"},
                                {"unity-hdrp", 512, "frustum+most(512,first)"},
                                {"three-js", 1024, "most(1024,first)"},
                                {"humus", 128, "most(128,first)"}};
  for (const Limit& limit : k_limits) {
    EXPECT_EQ(most_lights(*find_preset(limit.preset)), limit.lights) << limit.preset;
    const Config config = with_presets(std::string(R"(, "presets": [")") + limit.preset + R"("])");
    const std::vector<std::size_t>& pre_culls = config.presets.at(0).pre_culls;
    ASSERT_EQ(pre_culls.size(), 1u) << limit.preset;
    EXPECT_EQ(config.pre_culls.at(pre_culls[0]).label(), limit.label);
  }
  EXPECT_EQ(most_lights(*find_preset("bevy")), 0u);
  EXPECT_EQ(limit_text(*find_preset("playcanvas")), "255 lights in view, the first; 255 in a cell");
  EXPECT_EQ(limit_text(*find_preset("godot")), "512 of each type in view, the first");
  EXPECT_EQ(limit_text(*find_preset("three-js")), "1024 lights in the scene, the first; 64 in a cell");
  EXPECT_EQ(limit_text(*find_preset("stride")), "");
}

TEST(Presets, a_limit_stands_behind_the_configurations_own_pre_culls) {
  const Config config =
      with_presets(R"(, "presets": ["playcanvas", "bevy"], "pre_cull": ["none", {"distance_m": 90}, "frustum"])");
  EXPECT_EQ(config.own_pre_culls, 3u);
  std::vector<std::string> labels;
  for (const std::size_t index : config.presets[0].pre_culls) labels.push_back(config.pre_culls[index].label());
  EXPECT_EQ(labels, (std::vector<std::string>{"frustum+most(255,first)", "distance(90)+frustum+most(255,first)",
                                              "frustum+most(255,first)"}))
      << "a step that both have is done once";
  EXPECT_TRUE(config.presets[1].pre_culls.empty()) << "those of the configuration";
}

TEST(Presets, as_shipped_have_the_mistakes_of_engines_whose_code_was_run_and_else_their_schemes) {
  constexpr std::pair<const char*, const char*> k_shipped[] = {{"filament", "filament-refinement"},
                                                               {"bevy", "bevy-refinement"},
                                                               {"three-js", "three-js-boxes"},
                                                               {"babylon", "babylon-as-shipped"}};
  std::set<std::string> with_mistakes;
  for (const auto& [name, method] : k_shipped) {
    with_mistakes.insert(name);
    const std::string rest = std::string(R"(, "presets": [")") + name + R"("])";
    const Config scheme = with_presets(rest), shipped = with_presets(R"(, "as_shipped": true)" + rest);
    const auto method_of = [](const Config& config) { return config.assigners.at(config.presets.at(0).assigner).name; };
    EXPECT_EQ(method_of(shipped), method);
    EXPECT_FALSE(assign::find_assigner(method_of(shipped))->conservative) << name;
    EXPECT_TRUE(assign::find_assigner(method_of(scheme))->conservative) << name;
    EXPECT_EQ(with_presets(rest, {{"--set", "as_shipped=true"}}).assigners.size(), shipped.assigners.size());
  }
  EXPECT_EQ(Json::parse(grid_request(with_presets(R"(, "as_shipped": true, "presets": ["bevy"])").grids.at(0)).dump())
                .at("/react/of"_json_pointer),
            "bevy-refinement");
  for (const Preset& preset : presets()) {
    EXPECT_EQ(preset.has_mistakes(), with_mistakes.contains(preset.name)) << preset.name;
    if (!preset.has_mistakes()) {
      EXPECT_EQ(preset_parts(preset, {1920, 1080}, {.as_shipped = true}), preset_parts(preset, {1920, 1080}))
          << preset.name;
    }
  }
}

// --- On a device ---

TEST(Presets, take_their_methods_for_a_device_only_where_one_is_named) {
  gpu::register_methods();
  std::size_t on_device = 0;
  for (const Preset& preset : presets()) {
    const std::string rest = R"(, "presets": [")" + preset.name + R"("])";
    const Config without = with_presets(rest), unnamed = with_presets(R"(, "device": "")" + rest),
                 named = with_presets(R"(, "device": "no such device")" + rest),
                 by_flag = with_presets(rest, {{"--device", "no such device"}});
    const auto method = [](const Config& config) { return config.assigners.at(config.presets.at(0).assigner); };
    const auto is_on_device = [&](const Config& config) {
      return assign::find_assigner(method(config).name)->on_device;
    };
    EXPECT_FALSE(is_on_device(without) || is_on_device(unnamed)) << preset.name;
    EXPECT_EQ(is_on_device(named), preset.on_device.has_value()) << preset.name;
    EXPECT_EQ(method(by_flag).label(), method(named).label()) << preset.name;
    EXPECT_EQ(grid_identity(named.grids.at(0)), grid_identity(without.grids.at(0))) << preset.name;
    EXPECT_EQ(named.pre_culls, without.pre_culls) << preset.name;
    on_device += is_on_device(named) ? 1 : 0;
  }
  EXPECT_EQ(on_device, 7u);
}

// Spots, and how many lights a cell has room for: what decides which lights are listed is the same on a device.
TEST(Presets, have_on_a_device_the_same_scheme) {
  gpu::register_methods();
  constexpr std::pair<const char*, const char*> k_methods[] = {{"daveh355", "gpu-cells-fixed(spot=range,cells=device)"},
                                                               {"three-js", "gpu-cells-fixed(cap=64,spot=sphere)"},
                                                               {"black-mesa", "gpu-cells(spot=sphere,cells=device)"},
                                                               {"wicked", "gpu-tiled(spot=sphere)"},
                                                               {"unity-hdrp-fptl", "gpu-tiled(depth_mask=false)"},
                                                               {"bevy-gpu", "gpu-lights(spot=cone-sphere)"},
                                                               {"unreal", "gpu-cells"}};
  for (const auto& [name, label] : k_methods) {
    const std::string rest = std::string(R"(, "presets": [")") + name + R"("])";
    const Config scheme = with_presets(rest), on_device = with_presets(R"(, "device": "0")" + rest);
    const PresetChoice &of_scheme = scheme.presets.at(0), &choice = on_device.presets.at(0);
    const MethodRequest& method = on_device.assigners.at(choice.assigner);
    EXPECT_EQ(method.label(), label);
    const auto &values = method.params.values(),
               &of_processor = scheme.assigners.at(of_scheme.assigner).params.values();
    EXPECT_EQ(values.at("spot"), of_processor.at("spot")) << name;
    const bool has_lists = assign::find_assigner(method.name)->answers(assign::Answer::lists);
    EXPECT_EQ(choice.storage.has_value(), has_lists) << name;
    if (choice.storage) {
      EXPECT_EQ(on_device.storages.at(*choice.storage).label(), scheme.storages.at(*of_scheme.storage).label()) << name;
    }
    if (values.contains("cap")) {
      EXPECT_EQ(values.at("cap"), scheme.storages.at(*of_scheme.storage).params.values().at("cap")) << name;
    }
  }
}

TEST(Presets, as_shipped_keep_their_methods_with_mistakes_where_a_device_is_named) {
  gpu::register_methods();
  const Config config = with_presets(R"(, "presets": ["three-js", "daveh355"], "as_shipped": true, "device": "0")");
  EXPECT_EQ(config.assigners.at(config.presets.at(0).assigner).name, "three-js-boxes");
  EXPECT_EQ(config.storages.at(config.presets.at(0).storage.value()).label(), "fixed(cap=64)");
  EXPECT_EQ(config.assigners.at(config.presets.at(1).assigner).name, "gpu-cells-fixed");
}

TEST(Presets, are_counted_on_the_processor_for_sizes_whatever_device_is_named) {
  gpu::register_methods();
  const std::string presets = R"(, "presets": ["three-js", "filament"], "device": "0")";
  const auto methods = [](const Config& config) {
    std::vector<std::string> names;
    for (const MethodRequest& method : config.assigners) names.push_back(method.name);
    return names;
  };
  const Config counted = with_presets_on_processor(with_presets(presets));
  EXPECT_EQ(methods(counted), (std::vector<std::string>{"brute-force", "sphere-refinement"}));
  EXPECT_EQ(counted.storages.at(counted.presets.at(0).storage.value()).label(), "fixed(cap=64)");
  const Config own = with_presets(R"(, "assigners": ["gpu-cells"], "device": "0")");
  EXPECT_EQ(with_presets_on_processor(own).device, "0") << "no preset";
  const Config beside = with_presets(presets + R"(, "assigners": ["aabb"])");
  EXPECT_EQ(methods(with_presets_on_processor(beside)),
            (std::vector<std::string>{"aabb", "brute-force", "sphere-refinement"}));
  EXPECT_THROW(with_presets_on_processor(with_presets(presets + R"(, "assigners": ["gpu-cells"])")), Error);
}

// As a replay of a case has it.
TEST(Presets, pre_culls_are_written_as_a_configuration_has_them) {
  const std::string all = R"(["none", "frustum", {"distance_m": 90}, ["frustum", {"most": {"lights": 255}}],
      {"visible_set": {"rays": 99}}, [{"most": {"lights": 7, "keep": "nearest", "per": "type"}}]])";
  for (const cull::PreCullSpec& spec : with_presets(R"(, "pre_cull": )" + all).pre_culls) {
    const Config again = with_presets(R"(, "pre_cull": [)" + pre_cull_request(spec).dump() + "]");
    EXPECT_EQ(again.pre_culls, std::vector<cull::PreCullSpec>{spec}) << spec.label();
  }
}

TEST(Presets, as_shipped_without_presets_is_refused_with_its_place) {
  EXPECT_NE(refusal_of(R"(, "as_shipped": true)").find("/as_shipped"), std::string::npos);
  EXPECT_NE(refusal_of("", {{"--set", "as_shipped=true"}}).find("without presets"), std::string::npos);
}

TEST(Presets, each_viewport_has_its_own_choice) {
  const Config config = with_presets(R"(, "viewports": [[1920, 1080], [1280, 720]], "presets": ["filament", "godot"])");
  ASSERT_EQ(config.presets.size(), 4u);
  EXPECT_NE(config.presets[0].grid, config.presets[2].grid);
  EXPECT_EQ(config.presets[1].grid, config.presets[3].grid) << "the same pixels in both";
}

TEST(Presets, alone_they_are_all_that_is_measured) {
  const Config config = with_presets(R"(, "presets": ["filament"])");
  EXPECT_EQ(config.own_grids, 0u);
  EXPECT_EQ(config.own_assigners, 0u);
  EXPECT_FALSE(config.resolved.contains("grids"));
  EXPECT_TRUE(config.resolved["samples"].contains("opaque"));
}

TEST(Presets, stand_beside_what_a_configuration_or_a_flag_names) {
  const Config by_file = with_presets(R"(, "assigners": ["aabb"], "presets": ["filament"])");
  EXPECT_EQ(by_file.own_assigners, 1u);
  EXPECT_EQ(by_file.own_grids, with_presets("").own_grids) << "the default ones";
  const Config by_flag = with_presets("", {{"--preset", "filament"}, {"--grid", "world"}});
  EXPECT_EQ(by_flag.own_grids, 1u);
  EXPECT_EQ(by_flag.presets.size(), 1u);
  const Config alone = with_presets("", {{"--preset", "filament"}, {"--rounds", "5"}});
  EXPECT_EQ(alone.own_grids, 0u);
}

TEST(Presets, a_configuration_is_read_again_as_it_was_resolved) {
  for (const char* rest :
       {R"(, "presets": ["filament", "unity-*"])", R"(, "presets": ["bevy"], "storages": ["runs"])",
        R"(, "presets": ["bevy", "godot"], "as_shipped": true, "pre_cull": ["none", {"most": {"lights": 9}}])"}) {
    const Config config = with_presets(rest);
    const Config again = parse_config(config.resolved.dump(), "c.json");
    EXPECT_EQ(again.resolved, config.resolved);
    EXPECT_EQ(again.own_grids, config.own_grids);
    EXPECT_EQ(again.presets.size(), config.presets.size());
    EXPECT_EQ(again.pre_culls, config.pre_culls);
  }
}

TEST(Presets, patterns_name_several_and_each_once) {
  const Config config = with_presets("", {{"--preset", "unity-hdrp,unity-*"}});
  ASSERT_EQ(config.presets.size(), 3u);
  EXPECT_EQ(config.presets[0].preset, "unity-hdrp");
  EXPECT_EQ(config.presets[1].preset, "unity-urp");
  EXPECT_EQ(config.presets[2].preset, "unity-hdrp-fptl");
  EXPECT_EQ(with_presets("", {{"--preset", "*"}}).presets.size(), presets().size());
}

TEST(Presets, a_flag_of_grids_that_would_change_none_of_them_is_refused_with_what_to_write) {
  const std::string far = refusal_of("", {{"--preset", "unreal"}, {"--set", "grids.*.slices.far=4000"}});
  EXPECT_NE(far.find("--set=grids.*.slices.far=4000"), std::string::npos) << far;
  EXPECT_NE(far.find("--set 'scenes.*.far=METRES' sets it"), std::string::npos) << far;
  EXPECT_NE(far.find("--grid frustum"), std::string::npos) << far;
  const std::string count = refusal_of(R"(, "presets": ["unreal"])", {{"--set", "/grids/0/slices/count=8"}});
  EXPECT_NE(count.find("not those of presets"), std::string::npos) << count;
  EXPECT_EQ(count.find("far plane"), std::string::npos) << count;
  const std::vector<FlagValue> named{
      {"--preset", "unreal"}, {"--grid", "frustum"}, {"--set", "grids.*.slices.far=4000"}};
  EXPECT_EQ(refusal_of("", named), "") << "of a grid that is named beside the presets";
  EXPECT_EQ(refusal_of(R"(, "grids": [{}])", {{"--preset", "unreal"}, {"--set", "grids.*.slices.far=400"}}), "");
  EXPECT_EQ(refusal_of("", {{"--set", "grids.*.slices.far=400"}}), "") << "without presets";
}

TEST(Presets, a_grid_is_changed_member_by_member_and_an_axis_makes_several) {
  const std::vector<FlagValue> flags{{"--tiles", "32,64x16"}, {"--set", "grids.*.slices.count=24"}};
  const GridChange change = grid_change(flags);
  EXPECT_EQ(change.flags.at("/slices/count").value, "grids.*.slices.count=24");
  const Config config = parse_config(R"({"scenes": ["a.glb"], "presets": ["unreal"]})", "c.json", {}, {}, change);
  ASSERT_EQ(config.presets.size(), 2u);
  const auto grid = [&](std::size_t i) {
    return Json::parse(grid_request(config.grids.at(config.presets[i].grid)).dump());
  };
  EXPECT_EQ(grid(0)["tiles"]["pixels"], Json::parse("[32, 32]"));
  EXPECT_EQ(grid(1)["tiles"]["pixels"], Json::parse("[64, 16]"));
  EXPECT_EQ(grid(1)["slices"]["count"], 24);
  EXPECT_EQ(grid(1)["slices"]["scheme"], "power") << "what is not changed stays the engine's";
  EXPECT_EQ(config.assigners.at(config.presets[1].assigner).name, "brute-force");
  EXPECT_THROW(parse_config(R"({"scenes": ["a.glb"], "presets": ["unreal"]})", "c.json", {}, {},
                            grid_change(std::vector<FlagValue>{{"--slices", "0"}})),
               Error);
}

TEST(Presets, a_name_that_is_none_is_refused_with_its_place_and_near_ones) {
  const std::string in_file = refusal_of(R"(, "presets": ["filamnet"])");
  EXPECT_NE(in_file.find("/presets"), std::string::npos) << in_file;
  EXPECT_NE(in_file.find("did you mean 'filament'?"), std::string::npos) << in_file;
  const std::string by_flag = refusal_of("", {{"--preset", "unreel"}});
  EXPECT_NE(by_flag.find("--preset=unreel"), std::string::npos) << by_flag;
  EXPECT_NE(by_flag.find("did you mean 'unreal'?"), std::string::npos) << by_flag;
  EXPECT_NE(refusal_of("", {{"--preset", "x-*"}}).find("allowed: just-cause-3"), std::string::npos);
}

TEST(Presets, a_configuration_without_them_says_nothing_of_them) {
  const Config config = with_presets("");
  EXPECT_FALSE(config.resolved.contains("presets"));
  EXPECT_TRUE(config.presets.empty());
  EXPECT_EQ(config.own_grids, config.grids.size());
}

}  // namespace
}  // namespace clusterbench::config
