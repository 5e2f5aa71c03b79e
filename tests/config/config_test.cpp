#include "config/config.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "assign/contract/storage.h"
#include "config/parsed.h"
#include "config/schema/documents.h"
#include "config/schema/schema_verdict.h"
#include "core/error.h"
#include "core/text.h"
#include "gpu/methods/methods.h"
#include "places.h"

namespace clusterbench::config {
namespace {

using testing::parsed;

std::string message_of(const std::string& text) {
  try {
    parse_config(text, "configs/c.json");
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

struct Broken {
  const char* text;
  const char* message;         // without the file
  bool schema_refuses = true;  // false: beyond what a JSON Schema can say
};

const Broken k_broken[] = {
    {"[1]", "1:1 /: found a list of 1, allowed: an object"},
    {"{}", "1:1 /: lacks the key 'scenes'"},
    {R"({"scenes": []})", "1:12 /scenes: found an empty list, allowed: a list, each text or an object; at least 1"},
    {R"({"scenes": [""]})", "1:13 /scenes/0: found an empty text, allowed: a text that is not empty"},
    {R"({"scenes": [7]})", "1:13 /scenes/0: found 7, allowed: text or an object"},
    {R"({"scenes": [{"frames": 3}]})", "1:13 /scenes/0: a scene takes exactly one of path, paths, rig"},
    {R"({"scenes": [{"path": "a.glb", "rig": {}}]})", "1:13 /scenes/0: a scene takes exactly one of path, paths, rig"},
    {R"({"scenes": [{"rig": {"lights": 0}}]})",
     "1:32 /scenes/0/rig/lights: found 0, allowed: an integer from 1 to 10000000"},
    {R"({"scenes": [{"rig": {"lights": [10, 2.5]}}]})",
     "1:37 /scenes/0/rig/lights/1: found 2.5, allowed: an integer from 1 to 10000000"},
    {R"({"scenes": [{"rig": {"radius": 2}}]})",
     "1:22 /scenes/0/rig/radius: unknown key 'radius', allowed: lights, range, seed, size, spots"},
    {R"({"scenes": [{"rig": {"size": [1, 2]}}]})",
     "1:30 /scenes/0/rig/size: found a list of 2, allowed: a list of 3, each a number above 0, at most 1000000.0"},
    {R"({"scenes": [{"path": "a.glb", "frames": "all"}]})",
     "1:41 /scenes/0/frames: found 'all', allowed: an integer from 1 to 1000000 or 'keys' or an object"},
    {R"({"scenes": [{"path": "a.glb", "frames": {"rate": 0}}]})",
     "1:50 /scenes/0/frames/rate: found 0, allowed: a number above 0, at most 10000"},
    {R"({"scenes": [{"path": "a.glb", "range_rule": {"cutof_lux": 1}}]})",
     "1:46 /scenes/0/range_rule/cutof_lux: unknown key 'cutof_lux' (did you mean 'cutoff_lux'?), allowed: cutoff_lux, "
     "max_range"},
    {"{\"scenes\": [\"a.glb\"],\n  // comment\n  \"thread\": 1}",
     "3:3 /thread: unknown key 'thread' (did you mean 'threads'?), allowed: $schema, accuracy, allocation, as_shipped, "
     "assigners, "
     "cost, "
     "details, device, grids, jitter, limits, lookup, name, plugins, pre_cull, precision, presets, rank_by, reading, "
     "samples, "
     "scenes, "
     "seed, shaders, "
     "shading, "
     "shadow_cull, shadow_frusta, stability, "
     "storages, "
     "threads, "
     "timing, "
     "viewport, viewports"},
    {R"({"scenes": ["a.glb"], "threads": 0})", "1:34 /threads: found 0, allowed: an integer from 1 to 1024"},
    {R"({"scenes": ["a.glb"], "threads": "2"})",
     "1:34 /threads: found '2', allowed: an integer from 1 to 1024 or null"},
    {R"({"scenes": ["a.glb"], "threads": 1025})", "1:34 /threads: found 1025, allowed: an integer from 1 to 1024"},
    {R"({"scenes": ["a.glb"], "seed": 1.5})", "1:31 /seed: found 1.5, allowed: an integer from 0 to 9007199254740991"},
    {R"({"scenes": ["a.glb"], "accuracy": {"check": 1}})", "1:45 /accuracy/check: found 1, allowed: true or false"},
    {R"({"scenes": ["a.glb"], "allocation": {"margin": 0.5}})",
     "1:48 /allocation/margin: found 0.5, allowed: a number from 1 to 1000"},
    {R"({"scenes": ["a.glb"], "stability": {"steps": 0}})",
     "1:46 /stability/steps: found 0, allowed: an integer from 1 to 100000"},
    {R"({"scenes": ["a.glb"], "stability": {"step_mm": 0}})",
     "1:48 /stability/step_mm: found 0, allowed: a number from 0.001 to 1000"},
    {R"({"scenes": ["a.glb"], "stability": {"step_degrees": 1}})",
     "1:37 /stability/step_degrees: unknown key 'step_degrees' (did you mean 'step_deg'?), allowed: step_deg, step_mm, "
     "steps, window"},
    {R"({"scenes": ["a.glb"], "stability": true})", "1:36 /stability: found true, allowed: null or an object"},
    {R"({"scenes": ["a.glb"], "details": true})", "1:34 /details: found true, allowed: null or an object"},
    {R"({"scenes": ["a.glb"], "details": {"frames": "best"}})",
     "1:45 /details/frames: found 'best', allowed: 'worst' or an integer from 1 to 100 or a list, each an integer from "
     "0 to 999999"},
    {R"({"scenes": ["a.glb"], "details": {"frames": 0}})",
     "1:45 /details/frames: found 0, allowed: an integer from 1 to 100"},
    {R"({"scenes": ["a.glb"], "details": {"frames": [3, -1]}})",
     "1:49 /details/frames/1: found -1, allowed: an integer from 0 to 999999"},
    {R"({"scenes": ["a.glb"], "details": {"max_bytes": 500}})",
     "1:48 /details/max_bytes: found 500, allowed: an integer from 10000 to 1000000000"},
    {R"({"scenes": ["a.glb"], "details": {"max_byte": 50000}})",
     "1:35 /details/max_byte: unknown key 'max_byte' (did you mean 'max_bytes'?), allowed: frames, lists, max_bytes"},
    {R"({"scenes": ["a.glb"], "precision": "half"})",
     "1:36 /precision: found 'half', allowed: a list, each float32, half, unorm16 or an object"},
    {R"({"scenes": ["a.glb"], "precision": []})",
     "1:36 /precision: found an empty list, allowed: a list, each float32, half, unorm16 or an object; at least 1"},
    {R"({"scenes": ["a.glb"], "precision": ["float16"]})",
     "1:37 /precision/0: found 'float16' (did you mean 'float32'?), allowed: float32, half, unorm16"},
    {R"({"scenes": ["a.glb"], "precision": [{"inflate": true}]})", "1:37 /precision/0: lacks the key 'packing'"},
    {R"({"scenes": ["a.glb"], "precision": [{"packing": "half", "inflate": 1}]})",
     "1:68 /precision/0/inflate: found 1, allowed: true or false or a list, each true or false"},
    {R"({"scenes": ["a.glb"], "precision": [{"packing": "half", "pad": true}]})",
     "1:57 /precision/0/pad: unknown key 'pad', allowed: inflate, packing"},
    {R"({"scenes": ["a.glb"], "precision": [{"packing": "float32", "inflate": true}]})",
     "1:37 /precision/0: float32 loses nothing that assigners do not pad for themselves; inflate what half or unorm16 "
     "loses"},
    {R"({"scenes": ["a.glb"], "precision": [{"packing": ["half", "float32"], "inflate": true}]})",
     "1:37 /precision/0: float32 loses nothing that assigners do not pad for themselves; inflate what half or unorm16 "
     "loses",
     false},
    {R"({"scenes": ["a.glb"], "precision": ["half", {"packing": "half"}]})",
     "1:45 /precision/1: 'half' stands here twice", false},
    {R"({"scenes": ["a.glb"], "viewport": [0, 5]})", "1:36 /viewport/0: found 0, allowed: an integer from 1 to 32768"},
    {R"({"scenes": ["a.glb"], "viewport": [1, 2], "viewports": [[1, 2]]})",
     "1:23 /viewport: viewport and viewports exclude each other"},
    {R"({"scenes": ["a.glb"], "storages": ["paked"]})",
     "1:36 /storages/0: found 'paked' (did you mean 'packed'?), allowed: STORAGES"},
    {R"({"scenes": ["a.glb"], "assigners": ["aaab"]})",
     "1:37 /assigners/0: found 'aaab' (did you mean 'aabb'?), allowed: ASSIGNERS"},
    {R"({"scenes": ["a.glb"], "assigners": ["aabb", "*-fsat"]})",
     "1:45 /assigners/1: '*-fsat' matches none of ASSIGNERS", false},
    {R"({"scenes": ["a.glb"], "assigners": ["*-fast", "aabb", "aabb"]})",
     "1:36 /assigners: 'aabb' stands here twice with the same parameters", false},
    {R"({"scenes": ["a.glb"], "assigners": [{}]})", "1:37 /assigners/0: lacks the key 'name', allowed: ASSIGNERS"},
    {R"({"scenes": ["a.glb"], "assigners": ["aabb", "aabb"]})",
     "1:45 /assigners/1: 'aabb' stands here twice with the same parameters", false},
    {R"({"scenes": ["a.glb"], "grids": [5]})", "1:33 /grids/0: found 5, allowed: an object"},
    {R"({"scenes": ["a.glb"], "grids": [{"kind": "frustrum"}]})",
     "1:42 /grids/0/kind: found 'frustrum' (did you mean 'frustum'?), allowed: frustum, distance, cascades, world"},
    {R"({"scenes": ["a.glb"], "grids": [{"kind": "frustum", "levels": 3}]})",
     "1:53 /grids/0/levels: 'levels' belongs to cascades, not to frustum, allowed: kind, react, slices, tiles"},
    {R"({"scenes": ["a.glb"], "grids": [{"kind": "world", "cells": [1, 2]}]})",
     "1:60 /grids/0/cells: found a list of 2, allowed: a list of 3, each an integer from 1 to 4096"},
    {R"({"scenes": ["a.glb"], "grids": [{"kind": "cascades", "cells": [6, 4, 4]}]})",
     "1:63 /grids/0/cells: found [6,4,4], allowed: multiples of 4, 4 and 2", false},
    {R"({"scenes": ["a.glb"], "grids": [{"tiles": {"pixels": ["a", "b"]}}]})",
     "1:55 /grids/0/tiles/pixels/0: found 'a', allowed: a list of 2, each an integer from 1 to 32768 or an integer "
     "from 1 to 32768"},
    {R"({"scenes": ["a.glb"], "grids": [{"tiles": {"pixels": [16, 0, 64]}}]})",
     "1:59 /grids/0/tiles/pixels/1: found 0, allowed: an integer from 1 to 32768"},
    {R"({"scenes": ["a.glb"], "grids": [{"tiles": {"pixels": "64"}}]})",
     "1:54 /grids/0/tiles/pixels: found '64', allowed: a list of 2, each an integer from 1 to 32768 or an integer from "
     "1 to 32768 or a list, each a list of 2, each an integer from 1 to 32768 or an integer from 1 to 32768"},
    {R"({"scenes": ["a.glb"], "grids": [{"tiles": {"pixels": [64, 64], "count": [1, 1]}}]})",
     "1:43 /grids/0/tiles: found 2 keys, allowed: exactly one of aspect, count, pixels"},
    {R"({"scenes": ["a.glb"], "grids": [{"slices": {"scheme": "lineer"}}]})",
     "1:55 /grids/0/slices/scheme: found 'lineer' (did you mean 'linear'?), allowed: linear, exponential, "
     "exponential-first, power, list, fit, cubical, cubical-first"},
    {R"({"scenes": ["a.glb"], "grids": [{"slices": {"scheme": "linear", "lambda": 0.5}}]})",
     "1:65 /grids/0/slices/lambda: 'lambda' is used by scheme power, not by linear"},
    {R"({"scenes": ["a.glb"], "grids": [{"slices": {"boundaries": [1, 2]}}]})",
     "1:45 /grids/0/slices/boundaries: 'boundaries' is used by scheme list, not by exponential-first"},
    {R"({"scenes": ["a.glb"], "grids": [{"slices": {"near": 10, "far": 5}}]})",
     "1:64 /grids/0/slices/far: found 5, allowed: a number above near, 10", false},
    {R"({"scenes": ["a.glb"], "grids": [{"slices": {"scheme": "list", "boundaries": [1, 3, 2]}}]})",
     "1:84 /grids/0/slices/boundaries/2: found 2 after 3, allowed: ascending numbers", false},
    {R"({"scenes": ["a.glb"], "rank_by": {}})", "1:34 /rank_by: found an object, allowed: frame_time, frame_cost"},
    {R"({"scenes": ["a.glb"], "rank_by": []})", "1:34 /rank_by: found a list of 0, allowed: frame_time, frame_cost"},
    {R"({"scenes": ["a.glb"], "samples": {"fog": {}}, "cost": {"weights": {"fog": 0}}, "rank_by": "frame_cost"})",
     "1:91 /rank_by: is frame_cost, and no set of samples with a weight is asked for; add \"samples\": {\"opaque\": "
     "{}}",
     false},
    {R"({"scenes": ["a.glb"], "cost": {"wave": "16x2"}})", "1:40 /cost/wave: found '16x2', allowed: 8x4, 8x8", true},
    {R"({"scenes": ["${CLUSTERBENCH_NO_SUCH}/a.glb"]})",
     "1:13 /scenes/0: the environment variable 'CLUSTERBENCH_NO_SUCH' is not set; set it to use "
     "'${CLUSTERBENCH_NO_SUCH}/a.glb'",
     false},
};

std::string with_names(std::string message) {
  const std::pair<std::string, std::vector<std::string>> lists[] = {{"ASSIGNERS", assign::assigner_names()},
                                                                    {"STORAGES", assign::storage_names()}};
  for (const auto& [word, names] : lists)
    if (const std::size_t at = message.find(word); at != std::string::npos)
      message.replace(at, word.size(), joined(names));
  return message;
}

// Flags, defaults and places stay: a change is no other way to read a configuration.
TEST(Config, is_what_its_keys_say_after_a_change) {
  const Config config = parsed(R"(, "limits": {"fail_if": ["bytes > 1e6"]}, "lookup": {}, "stability": {"steps": 7})");
  const Config next = changed(config, {{"stability", nullptr}, {"timing", {{"measure", false}}}});
  EXPECT_TRUE(config.stability && config.timing.measure && config.resolved["stability"]["steps"] == 7);
  EXPECT_FALSE(next.stability || next.timing.measure);
  EXPECT_TRUE(next.resolved["stability"].is_null());
  EXPECT_EQ(next.resolved["timing"]["measure"], false);
  EXPECT_TRUE(next.lookup);
  EXPECT_EQ(next.limits.fail_if.at(0).text(), "bytes > 1000000");
  EXPECT_EQ(next.scenes.at(0).named_at, config.scenes.at(0).named_at);
  EXPECT_EQ(changed(next, {{"stability", {{"steps", 7}}}, {"timing", {{"measure", true}}}}).resolved, config.resolved);
}

TEST(Config, a_fault_is_named_with_its_place_what_was_found_and_what_is_allowed) {
  for (const Broken& broken : k_broken)
    EXPECT_EQ(message_of(broken.text), "configs/c.json: " + with_names(broken.message)) << broken.text;
}

TEST(Config, the_schema_alone_refuses_what_the_reader_refuses) {
  const nlohmann::json schema = config_schema();
  for (const Broken& broken : k_broken) {
    const nlohmann::json document = nlohmann::json::parse(broken.text, nullptr, true, true);
    EXPECT_EQ(schema_violations(schema, document).empty(), !broken.schema_refuses) << broken.text;
  }
}

TEST(Config, a_scene_alone_is_enough) {
  const Config config = parsed("");
  EXPECT_EQ(config.name, "c");
  ASSERT_EQ(config.scenes.size(), 1U);
  EXPECT_EQ(config.scenes[0].path, std::filesystem::path("configs/a.glb"));
  EXPECT_EQ(config.viewports, (std::vector<Vec2i>{{1920, 1080}}));
  EXPECT_EQ(config.assigners.size(), assign::default_assigner_names().size());
  EXPECT_EQ(config.storages.size(), 1U);
  EXPECT_EQ(config.grids.size(), 7U);
}

TEST(Config, sets_of_samples_are_measured_where_they_are_named) {
  const Config config =
      parsed(R"(, "samples": {"fog": {"froxels": [3, 4, 5]}, "opaque": {}, "transparent": {"layers": 7}})");
  ASSERT_EQ(config.sample_sets.size(), 4U);
  const SampleSetRequest plain;
  EXPECT_EQ(config.sample_sets[1].set, measure::SampleSet::opaque);
  EXPECT_EQ(config.sample_sets[1].divisor, plain.divisor);
  EXPECT_EQ(config.sample_sets[2].layers, 7);
  EXPECT_EQ(config.sample_sets[3].froxels, Vec3i(3, 4, 5));
  const Config all =
      parsed(R"(, "shading": {"samples": 0}, "samples": {"transparent": {}, "mirror": {}, "anywhere": {}, "fog": {}})");
  ASSERT_EQ(all.sample_sets.size(), 4U);
  EXPECT_EQ(all.sample_sets[0].layers, plain.layers);
  EXPECT_EQ(all.sample_sets[1].froxels, plain.froxels);
  EXPECT_EQ(all.sample_sets[2].count, plain.count);
}

TEST(Config, defaults_of_the_schema_agree_with_the_defaults_of_the_code) {
  const Config config = parsed(R"(, "grids": [{}, {"kind": "cascades"}, {"kind": "world"}])");
  const Config plain;
  EXPECT_EQ(config.threads_asked.has_value(), plain.threads_asked.has_value());
  EXPECT_EQ(config.seed, plain.seed);
  ASSERT_EQ(config.sample_sets.size(), 1U);
  EXPECT_EQ(config.sample_sets[0].set, measure::SampleSet::volume);
  EXPECT_EQ(config.sample_sets[0].count, SampleSetRequest{}.count);
  EXPECT_EQ(config.scenes[0].camera.count, scene::PathRequest{}.count);
  const grid::GridSpec defaults;
  EXPECT_EQ(config.grids[0].tiles.pixels, defaults.tiles.pixels);
  EXPECT_EQ(config.grids[0].slices.scheme, defaults.slices.scheme);
  EXPECT_EQ(config.grids[0].slices.count, defaults.slices.count);
  EXPECT_EQ(config.grids[0].slices.first_m, defaults.slices.first_m);
  EXPECT_EQ(config.grids[0].slices.near_m, defaults.slices.near_m);
  EXPECT_EQ(config.grids[0].slices.far_m, defaults.slices.far_m);
  EXPECT_EQ(config.grids[1].levels, defaults.levels);
  EXPECT_EQ(config.grids[1].finest_m, defaults.finest_m);
  EXPECT_EQ(config.grids[2].cells, defaults.cells);
  EXPECT_EQ(config.grids[2].has_bounds, defaults.has_bounds);
}

TEST(Config, a_world_grid_follows_the_camera_by_cells_of_4_m_unless_told_otherwise) {
  const auto spec = [](const std::string& rest) {
    return parsed(R"(, "grids": [{"kind": "world")" + rest + R"(}], "assigners": ["world-grid"])").grids.at(0);
  };
  EXPECT_EQ(spec("").follow, grid::Follow::nothing);
  EXPECT_EQ(spec(R"(, "cell_size": [1, 1, 1])").name(), spec("").name()) << "of a grid that stays, it has no meaning";
  EXPECT_EQ(spec(R"(, "follow": "camera")").cell_size_m, (Vec3d{4.0, 0.0, 4.0}));
  EXPECT_EQ(spec(R"(, "follow": "camera", "cell_size": [2, 8, null])").cell_size_m, (Vec3d{2.0, 8.0, 0.0}));
  EXPECT_THROW(spec(R"(, "follow": "lights", "bounds": {"min": [0, 0, 0], "max": [1, 2, 3]})"), Error);
  EXPECT_THROW(spec(R"(, "follow": "sun")"), Error);
  EXPECT_THROW(spec(R"(, "follow": "camera", "cell_size": [0, 1, 1])"), Error);
}

TEST(Config, stability_is_measured_only_where_it_is_asked_for) {
  EXPECT_FALSE(parsed("").stability);
  const Config config = parsed(R"(, "stability": {})");
  ASSERT_TRUE(config.stability);
  const StabilityRequest plain;
  EXPECT_EQ(config.stability->steps, plain.steps);
  EXPECT_EQ(config.stability->step_mm, plain.step_mm);
  EXPECT_EQ(config.stability->step_deg, plain.step_deg);
  EXPECT_EQ(config.stability->window, plain.window);
  const Config own = parsed(R"(, "stability": {"steps": 7, "step_mm": 0.5, "step_deg": 0.25, "window": 3})");
  EXPECT_EQ(own.stability->steps, 7);
  EXPECT_EQ(own.stability->step_mm, 0.5);
  EXPECT_EQ(own.stability->step_deg, 0.25);
  EXPECT_EQ(own.stability->window, 3);
}

TEST(Config, jitter_is_a_halton_sequence_or_a_list_of_offsets) {
  const auto jitter = [](const std::string& value) {
    return parsed(R"(, "jitter": )" + value).scenes[0].camera.jitter_px;
  };
  EXPECT_TRUE(parsed("").scenes[0].camera.jitter_px.empty());
  EXPECT_EQ(jitter(R"([[0.25, -0.25], [-0.5, 0]])"), (std::vector<Vec2d>{{0.25, -0.25}, {-0.5, 0.0}}));
  EXPECT_EQ(jitter(R"("halton")").size(), 8u);
  EXPECT_EQ(jitter(R"({"halton": 16})").size(), 16u);
  EXPECT_EQ(message_of(R"({"scenes": ["a.glb"], "jitter": "hlton"})"),
            "configs/c.json: 1:33 /jitter: found 'hlton', allowed: null or 'halton' or an object or a list, each a "
            "list of 2, "
            "each a number from -16 to 16");
}

TEST(Config, budgets_are_checked_with_their_place) {
  const Config config = parsed(R"(, "limits": {"fail_if": ["frame_us.max > 200", "unlit>=1e-3"]})");
  ASSERT_EQ(config.limits.fail_if.size(), 2u);
  EXPECT_EQ(config.limits.fail_if[0].figure, "frame_us.max");
  EXPECT_EQ(config.limits.fail_if[0].limit, 200.0);
  EXPECT_FALSE(config.limits.fail_if[0].is_inclusive);
  EXPECT_TRUE(config.limits.fail_if[1].is_inclusive);
  const auto refusal = [](const std::string& rule) {
    return message_of(R"({"scenes": ["a.glb"], "limits": {"fail_if": [")" + rule + R"("]}})").substr(16);
  };
  const std::string place = "1:46 /limits/fail_if/0: ";
  EXPECT_TRUE(refusal("frme_us > 1")
                  .starts_with(place + "'frme_us > 1' names no figure of a case (did you mean 'frame_us'?); there are: "
                                       "frame_us, frame_us.max, "))
      << refusal("frme_us > 1");
  EXPECT_TRUE(refusal("unlit").starts_with(place + "'unlit' is no budget; takes a figure, then >, >=, <, <= or == "));
  for (const char* number : {"", "x", "nan", "inf", "1e999", "1 2", "= 3"})
    EXPECT_NE(refusal("unlit > " + std::string(number)).find("which is no number"), std::string::npos) << number;
}

TEST(Config, a_baseline_is_beside_the_configuration_and_lights_may_be_allowed_to_be_gone) {
  const Config config = parsed(R"(, "limits": {"baseline": "base.json", "allow_no_lights": true,
                                               "allow_changed_lights": true})");
  EXPECT_EQ(config.limits.baseline, "configs/base.json");
  EXPECT_TRUE(config.limits.allows_no_lights);
  EXPECT_TRUE(config.limits.allows_changed_lights);
  EXPECT_EQ(parsed("").limits.baseline, "");
  EXPECT_FALSE(parsed("").limits.allows_no_lights);
}

TEST(Config, lights_are_in_float32_unless_another_precision_is_named) {
  EXPECT_EQ(parsed("").precisions, std::vector<PrecisionRequest>{{}});
  EXPECT_FALSE(parsed("").compares_precisions());
  EXPECT_FALSE(parsed(R"(, "precision": ["float32"])").compares_precisions());
  EXPECT_TRUE(parsed(R"(, "precision": ["half"])").compares_precisions());
  std::vector<std::string> labels;
  for (const PrecisionRequest& request :
       parsed(R"(, "precision": ["float32", {"packing": ["half", "unorm16"], "inflate": [true, false]}])").precisions)
    labels.push_back(request.label());
  EXPECT_EQ(labels, (std::vector<std::string>{"float32", "half+inflate", "unorm16+inflate", "half", "unorm16"}));
}

// Every key of a schema, with its place.
void collect_keys(const nlohmann::json& schema, const std::string& place,
                  std::vector<std::pair<std::string, nlohmann::json>>& out) {
  if (!schema.is_structured()) return;
  if (schema.is_object() && schema.contains("type") && schema.contains("properties"))
    for (const auto& [key, property] : schema["properties"].items()) out.emplace_back(place + "/" + key, property);
  for (const auto& [key, member] : schema.items()) collect_keys(member, place + "/" + key, out);
}

TEST(Config, every_key_of_the_schema_has_an_example_that_the_schema_accepts) {
  const nlohmann::json schema = config_schema();
  std::vector<std::pair<std::string, nlohmann::json>> keys;
  collect_keys(schema, "", keys);
  int examples = 0;
  for (const auto& [place, property] : keys) {
    if (place.starts_with("/properties/assigners/") || place.starts_with("/properties/storages/")) continue;
    ASSERT_TRUE(property.contains("examples")) << place;
    const nlohmann::json alone{{"definitions", schema["definitions"]}, {"allOf", {property}}};
    for (const nlohmann::json& example : property["examples"]) {
      EXPECT_EQ(schema_violations(alone, example), std::vector<std::string>{}) << place << " " << example;
      ++examples;
    }
  }
  EXPECT_GT(examples, 60);
}

TEST(Config, a_path_is_relative_to_the_file_and_may_name_an_environment_variable) {
  setenv("CLUSTERBENCH_TEST_FOLDER", "/maps", 1);
  const Config config = parse_config(
      R"({"scenes": ["../s/a.glb", {"paths": ["b.glb", "${CLUSTERBENCH_TEST_FOLDER}/c.glb"], "frames": "keys"}]})",
      "configs/c.json");
  ASSERT_EQ(config.scenes.size(), 3U);
  EXPECT_EQ(config.scenes[0].path, std::filesystem::path("s/a.glb"));
  EXPECT_EQ(config.scenes[1].path, std::filesystem::path("configs/b.glb"));
  EXPECT_EQ(config.scenes[2].path, std::filesystem::path("/maps/c.glb"));
  EXPECT_EQ(config.scenes[2].camera.choice, scene::FrameChoice::keys);
}

TEST(Config, the_resolved_configuration_is_a_configuration_that_means_the_same) {
  for (const char* rest :
       {"", R"(, "stability": {"steps": 5})", R"(, "precision": ["half", {"packing": "unorm16", "inflate": true}])",
        R"(, "viewport": [640, 480], "grids": [{"slices": {"scheme": ["linear", "power"], "near": 1}}])",
        R"(, "grids": [{"kind": "world", "bounds": {"min": [0, 0, 0], "max": [1, 2, 3]}}], "assigners": ["aabb"])",
        R"(, "grids": [{"kind": "world", "follow": ["nothing", "lights"]}], "assigners": ["world-grid"])",
        R"(, "grids": [{"kind": "world", "follow": "camera", "cell_size": [[4, null, 4], [2, 1, 2]]}],
             "assigners": ["world-grid"])"}) {
    const Config config = parsed(rest);
    const Config again = parse_config(config.resolved.dump(), config.file);
    EXPECT_EQ(again.resolved, config.resolved);
    ASSERT_EQ(again.grids.size(), config.grids.size());
    for (std::size_t i = 0; i < config.grids.size(); ++i) EXPECT_EQ(again.grids[i].name(), config.grids[i].name());
    EXPECT_EQ(again.scenes[0].path, config.scenes[0].path);
    EXPECT_EQ(again.precisions, config.precisions);
    EXPECT_TRUE(schema_violations(config_schema(), config.resolved).empty());
  }
}

TEST(Config, the_committed_configurations_are_valid_for_reader_and_schema_and_name_what_exists) {
  setenv("CLUSTERBENCH_SCENE_LIBRARY", "library", 0);
  gpu::register_methods();
  namespace fs = std::filesystem;
  std::size_t configurations = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(test::source_dir() + "/configs")) {
    const fs::path folder = entry.path().parent_path().filename();
    if (entry.path().extension() != ".json" || folder == "presets" || folder == "dumps" || folder == "shaders")
      continue;
    ++configurations;
    const fs::path& path = entry.path();
    const Config config = load_config(path);
    EXPECT_TRUE(config.name.ends_with(path.stem().string())) << path << " is called " << config.name;
    EXPECT_EQ(schema_violations(config_schema(), config.resolved), std::vector<std::string>{}) << path;
    std::ifstream in(path);
    const nlohmann::json document = nlohmann::json::parse(in, nullptr, true, true);
    EXPECT_EQ(schema_violations(config_schema(), document), std::vector<std::string>{}) << path;
    const std::string schema = document.value("$schema", "");
    EXPECT_TRUE(schema.empty() || fs::exists(path.parent_path() / schema)) << path;
    if (path.stem().string().ends_with("library")) continue;  // its scenes are others'
    for (const SceneRequest& scene : config.scenes)
      EXPECT_TRUE(scene.rig || fs::exists(scene.path)) << path << ": " << scene.path;
  }
  EXPECT_GE(configurations, 14U);
}

TEST(Config, scenes_of_the_command_line_get_the_default_sweep) {
  const Config config = default_config({"maps/level.glb"});
  EXPECT_EQ(config.name, "level");
  EXPECT_EQ(config.scenes[0].path, std::filesystem::path("maps/level.glb"));
  EXPECT_EQ(config.scenes[0].camera.count, 30);
  EXPECT_EQ(config.timing.rounds, 15);
  EXPECT_EQ(config.timing.frames, 4);
  EXPECT_EQ(config.timing.min_time_ms, 2.0);
  EXPECT_EQ(config.grids.size(), 7U);
  std::ifstream in(test::source_dir() + "/docs/configuration.md");
  const std::string page(std::istreambuf_iterator<char>(in), {});
  EXPECT_NE(page.find("`frames` 30, `timing.frames` 4,\n  `timing.rounds` 15, `timing.min_time_ms` 2"),
            std::string::npos)
      << "where the page says what differs from its tables";
}

TEST(Config, runs_that_nobody_set_up_compare_what_can_be_compared_soon_and_take_fewer_frames_where_these_are_dear) {
  const Config plain = default_config({"a.glb"});
  EXPECT_EQ(plain.accuracy.most_pairs, 4'000'000u);
  EXPECT_EQ(plain.scenes[0].camera.count, 30);
  EXPECT_EQ(plain.scenes[0].camera.most_lights, 1200.0);
  const std::vector<FlagValue> presets{{"--preset", "*"}};
  EXPECT_EQ(default_config({"a.glb"}, presets).scenes[0].camera.most_lights, 1200.0);
  EXPECT_EQ(default_config({"a.glb"}, presets).accuracy.most_pairs, 4'000'000u);
  const std::vector<FlagValue> all_frames{{"--preset", "*"}, {"--set", "scenes.*.frames=30"}};
  EXPECT_EQ(default_config({"a.glb"}, all_frames).scenes[0].camera.most_lights, 0.0);
  const std::vector<FlagValue> asked{{"--set", "accuracy.check=true"}};
  EXPECT_EQ(default_config({"a.glb"}, asked).accuracy.most_pairs, std::nullopt);
  const Config again = parse_config(plain.resolved.dump(), "");
  EXPECT_EQ(again.resolved, plain.resolved);
}

TEST(Config, presets_take_samples_of_surfaces_beside_other_sets_unless_these_or_none_are_asked_for) {
  const auto sets = [](const std::string& more, const std::string& setting) {
    const std::string text = R"({"scenes": ["a.glb"], "presets": ["godot"])" + more + "}";
    std::vector<FlagValue> flags;
    if (!setting.empty()) flags.push_back({"--set", setting});
    std::vector<std::pair<std::string, int>> found;
    for (const SampleSetRequest& set : parse_config(text, "c.json", flags).sample_sets)
      found.emplace_back(measure::name_of(set.set), set.divisor);
    return found;
  };
  using Sets = std::vector<std::pair<std::string, int>>;
  EXPECT_EQ(sets("", ""), (Sets{{"volume", 8}, {"opaque", 16}}));
  EXPECT_EQ(sets("", "shading.samples=0"), (Sets{{"opaque", 16}}));
  EXPECT_EQ(sets(R"(, "samples": {"fog": {}})", ""), (Sets{{"volume", 8}, {"opaque", 16}, {"fog", 8}}));
  EXPECT_EQ(sets("", "samples.fog={}"), (Sets{{"volume", 8}, {"opaque", 16}, {"fog", 8}}));
  EXPECT_EQ(sets(R"(, "samples": {"opaque": {"divisor": 8}})", ""), (Sets{{"volume", 8}, {"opaque", 8}}));
  EXPECT_EQ(sets("", "samples.opaque.divisor=8"), (Sets{{"volume", 8}, {"opaque", 8}}));
  EXPECT_EQ(sets(R"(, "samples": {})", ""), (Sets{{"volume", 8}}));
  EXPECT_EQ(sets("", "samples={}"), (Sets{{"volume", 8}}));
  EXPECT_THROW(parse_config(R"({"scenes": ["a.glb"], "presets": ["godot"], "samples": 5})", "c.json"), Error);
}

TEST(Config, of_a_file_only_presets_are_compared_in_part_and_only_where_it_says_nothing_of_accuracy) {
  EXPECT_EQ(parse_config(R"({"scenes": ["a.glb"]})", "c.json").accuracy.most_pairs, std::nullopt);
  EXPECT_EQ(parse_config(R"({"scenes": ["a.glb"], "presets": ["godot"]})", "c.json").accuracy.most_pairs, 4'000'000u);
  EXPECT_EQ(parse_config(R"({"scenes": ["a.glb"], "presets": ["godot"], "accuracy": {"check": true}})", "c.json")
                .accuracy.most_pairs,
            std::nullopt);
  EXPECT_EQ(parse_config(R"({"scenes": ["a.glb"], "accuracy": {"most_pairs": 5}})", "c.json").accuracy.most_pairs, 5u);
}

TEST(Config, frames_are_of_a_rate_or_at_most_so_many) {
  for (const char* frames : {R"({"rate": 30, "most": 5})", R"({"lights": 5})", "{}"}) {
    try {
      parse_config(std::string(R"({"scenes": [{"path": "a.glb", "frames": )") + frames + "}]}", "c.json");
      FAIL() << frames;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("takes either rate, or most"), std::string::npos) << error.what();
    }
  }
}

TEST(Config, a_label_names_only_parameters_that_differ_from_the_default) {
  EXPECT_EQ(parsed(R"(, "storages": ["packed"])").storages[0].label(), "packed");
  const assign::StorageDescriptor& fixed = *assign::find_storage("fixed");
  ASSERT_FALSE(fixed.params.empty());
  const nlohmann::json storage{{"name", "fixed"}, {fixed.params[0].name, 7}};
  EXPECT_EQ(parsed(R"(, "storages": [)" + storage.dump() + "]").storages[0].label(),
            "fixed(" + fixed.params[0].name + "=7)");
}

// Three lists of 100 values each.
TEST(Config, lists_that_multiply_to_too_many_combinations_are_refused_before_they_are_expanded) {
  std::string list = "[8";
  for (int i = 9; i < 108; ++i) list += ", " + std::to_string(i);
  list += "]";
  const auto refusal = [](const std::string& text) {
    try {
      static_cast<void>(parse_config(text, "c.json"));
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const std::string most = "lists make 1000000 combinations here; allowed: at most 100000";
  const std::string grid = R"({"kind": "frustum", "tiles": {"pixels": )" + list + R"(}, "slices": {"count": )" + list;
  const std::string grids = R"({"scenes": ["a.glb"], "assigners": ["exact"], "grids": [)";
  const std::string found = refusal(grids + grid + R"(, "far": )" + list + "}}]}");
  EXPECT_NE(found.find("/grids/0/slices/far: " + most), std::string::npos) << found;
  const std::string rig =
      refusal(R"({"scenes": [{"rig": {"lights": )" + list + R"(, "seed": )" + list + R"(, "range": )" + list + "}}]}");
  EXPECT_NE(rig.find(most), std::string::npos) << rig;
  EXPECT_NE(rig.find("/scenes/0/rig/"), std::string::npos) << rig;
}

}  // namespace
}  // namespace clusterbench::config
