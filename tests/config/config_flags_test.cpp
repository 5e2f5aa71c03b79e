#include "config/config_flags.h"

#include <gtest/gtest.h>

#include "config/config.h"
#include "core/error.h"

namespace clusterbench::config {
namespace {

using Flags = std::vector<FlagValue>;
using Names = std::vector<std::string>;

// A configuration with every kind of entry that flags change.
constexpr const char* k_flagged = R"({"scenes": [{"path": "a.glb", "frames": 3}],
  "grids": [{"tiles": {"pixels": [64, 64]}, "slices": {"scheme": "exponential-first", "count": 8, "near": 0.1, "far": 90}},
            {"kind": "world", "cells": [8, 4, 8]},
            {"tiles": {"count": [16, 9]}, "slices": {"scheme": "exponential-first", "count": 8, "near": 0.1, "far": 90}}],
  "assigners": ["aabb", {"name": "exact-fast", "threads": 2}]})";

Config flagged(const Flags& flags) {
  return parse_config(k_flagged, "c.json", flags);
}

Names grid_names(const Flags& flags) {
  Names names;
  for (const grid::GridSpec& grid : flagged(flags).grids) names.push_back(grid.name());
  return names;
}

Names assigner_labels(const Flags& flags) {
  Names labels;
  for (const MethodRequest& assigner : flagged(flags).assigners) labels.push_back(assigner.label());
  return labels;
}

std::string refusal_of(const Flags& flags) {
  try {
    flagged(flags);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ConfigFlags, grids_of_the_named_kinds_stay_and_others_come_with_their_defaults) {
  EXPECT_EQ(grid_names({{"--grid", "world,cascades"}}), (Names{"world 8x4x8", "cascades 5 x 16x16x16 of 0.5"}));
  EXPECT_EQ(grid_names({{"--grid", "frustum"}}).size(), 2u);
}

TEST(ConfigFlags, tiles_are_pixels_or_a_count_on_the_screen) {
  EXPECT_EQ(grid_names({{"--tiles", "32,16x9t,64x48px"}}),
            (Names{"frustum 32px x 8 exponential-first 0.1..5..90", "frustum 64x48px x 8 exponential-first 0.1..5..90",
                   "frustum 16x9 x 8 exponential-first 0.1..5..90", "world 8x4x8"}))
      << "grids that differed only in their tiles are one";
  EXPECT_EQ(grid_names({{"--tiles", "16,32"}, {"--grid", "frustum"}}).size(), 2u) << "two squares, not one of 16 x 32";
}

TEST(ConfigFlags, slices_are_counted_in_every_grid_that_has_them) {
  EXPECT_EQ(grid_names({{"--slices", "4,12"}}),
            (Names{"frustum 64px x 4 exponential-first 0.1..5..90", "frustum 64px x 12 exponential-first 0.1..5..90",
                   "world 8x4x8", "frustum 16x9 x 4 exponential-first 0.1..5..90",
                   "frustum 16x9 x 12 exponential-first 0.1..5..90"}));
  EXPECT_EQ(grid_names({{"--grid", "distance"}, {"--slices", "4"}}),
            (Names{"distance 64px x 4 exponential-first first 5"}));
}

TEST(ConfigFlags, a_scheme_is_that_of_every_grid_with_slices) {
  EXPECT_EQ(grid_names({{"--grid", "frustum"}, {"--tiles", "16x9t"}, {"--slices", "24"}, {"--scheme", "exponential"}}),
            (Names{"frustum 16x9 x 24 exponential 0.1..90"}));
  EXPECT_EQ(grid_names({{"--grid", "distance"}, {"--scheme", "linear,exponential"}}).size(), 2u);
  EXPECT_NE(refusal_of({{"--scheme", "logarithmic"}}).find("--scheme=logarithmic"), std::string::npos);
}

TEST(ConfigFlags, chosen_assigners_keep_the_parameters_of_the_configuration) {
  EXPECT_EQ(assigner_labels({{"--assigner", "exact-fast,bounds,bounds"}}), (Names{"exact-fast(threads=2)", "bounds"}));
  EXPECT_EQ(assigner_labels({{"--assigner", "exact*"}}), (Names{"exact", "exact-fast(threads=2)"}));
}

TEST(ConfigFlags, assigners_take_parameters_as_names_of_cases_have_them) {
  EXPECT_EQ(assigner_labels({{"--assigner", "exact-fast(threads=3),aabb(spot=sphere, inflation=1.5),bounds"}}),
            (Names{"exact-fast(threads=3)", "aabb(spot=sphere,inflation=1.5)", "bounds"}));
  EXPECT_EQ(assigner_labels({{"--assigner", R"(aabb(spot=["both","sphere"]))"}}), (Names{"aabb", "aabb(spot=sphere)"}));
  EXPECT_NE(refusal_of({{"--assigner", "exact-fast(thraeds=3)"}}).find("--assigner=exact-fast(thraeds=3)"),
            std::string::npos);
  for (const char* wrong : {"aabb()", "aabb(spot)", "aabb(=1)", "aabb(spot=both,spot=sphere)", "aabb(name=exact)"})
    EXPECT_NE(refusal_of({{"--assigner", wrong}}).find("takes NAME(PARAMETER=VALUE,...)"), std::string::npos) << wrong;
}

TEST(ConfigFlags, simple_settings_are_those_of_the_configuration) {
  const Config config =
      flagged({{"--viewport", "640x360,1280x720"}, {"--rounds", "7"}, {"--threads", "3"}, {"--set", "seed=9"}});
  EXPECT_EQ(config.viewports, (std::vector<Vec2i>{{640, 360}, {1280, 720}}));
  EXPECT_EQ(config.timing.rounds, 7);
  EXPECT_EQ(config.threads, 3);
  EXPECT_EQ(config.seed, 9u);
  EXPECT_EQ(config.resolved["timing"]["rounds"], 7);
  EXPECT_EQ(parse_config(config.resolved.dump(), "c.json").resolved, config.resolved);
}

TEST(ConfigFlags, any_key_can_be_set_by_its_place) {
  const Config config = flagged({{"--set", "grids.*.slices.far=200,500"},
                                 {"--set", "/grids/1/cells=[4,4,4],[8,8,8]"},
                                 {"--set", "scenes.*.frames={\"rate\": 30}"},
                                 {"--set", "stability.steps=5"},
                                 {"--set", "viewport=[640,360]"},
                                 {"--set", "storages=packed,bitfield"}});
  EXPECT_EQ(config.grids.size(), 6u);
  EXPECT_EQ(config.scenes[0].camera.rate_hz, 30.0);
  EXPECT_EQ(config.stability->steps, 5);
  EXPECT_EQ(config.viewports, (std::vector<Vec2i>{{640, 360}}));
  EXPECT_EQ(config.storages.size(), 2u);
}

TEST(ConfigFlags, another_scheme_leaves_out_what_only_the_old_one_used) {
  EXPECT_EQ(grid_names({{"--grid", "frustum"}, {"--set", "grids.*.slices.scheme=linear,power"}})[0],
            "frustum 64px x 8 linear 0.1..90");
  EXPECT_NE(refusal_of({{"--set", "grids.0.slices.scheme=linear"}, {"--set", "grids.0.slices.first=2"}})
                .find("--set=grids.0.slices.first=2 /grids/0/slices/first: 'first' is used by scheme"),
            std::string::npos);
}

TEST(ConfigFlags, a_whole_slices_object_may_not_have_keys_that_its_scheme_does_not_use) {
  EXPECT_NE(
      refusal_of({{"--set", R"(grids.0.slices={"scheme": "linear", "count": 8, "near": 1, "far": 9, "first": 2})"}})
          .find("/grids/0/slices/first: 'first' is used by scheme"),
      std::string::npos);
}

TEST(ConfigFlags, a_far_plane_is_that_of_all_scenes) {
  const Config config = default_config({"a.glb", "b.glb"}, Flags{{"--set", "scenes.*.far=400"}});
  for (const SceneRequest& scene : config.scenes) EXPECT_EQ(scene.camera.far_m, 400.0);
  EXPECT_FALSE(default_config({"a.glb"}).scenes[0].camera.far_m);
  EXPECT_NE(refusal_of({{"--set", "scenes.*.far=0"}}).find("/scenes/0/far"), std::string::npos);
}

TEST(ConfigFlags, a_field_of_view_is_that_of_all_scenes_and_refused_where_it_cannot_be) {
  const Config config = default_config({"a.glb", "b.glb"}, Flags{{"--fov", "90h"}});
  for (const SceneRequest& scene : config.scenes) {
    ASSERT_TRUE(scene.camera.field_of_view);
    EXPECT_TRUE(scene.camera.field_of_view->is_horizontal);
  }
  EXPECT_EQ(config.resolved["scenes"][0]["fov"], "90h");
  EXPECT_NE(refusal_of({{"--fov", "200v"}}).find("'200v' is no field of view; takes degrees above 0"),
            std::string::npos);
  EXPECT_NE(refusal_of({{"--fov", "90h"}, {"--viewport", "800x100"}}).find("wider than 64:9"), std::string::npos);
}

TEST(ConfigFlags, tiles_or_slices_of_the_default_sweep_give_one_grid_of_each_kind) {
  const auto names = [](const Flags& flags) {
    Names all;
    for (const grid::GridSpec& grid : default_config({"level.glb"}, flags).grids) all.push_back(grid.name());
    return all;
  };
  EXPECT_EQ(names({{"--tiles", "16x9t"}, {"--grid", "frustum"}}),
            (Names{"frustum 16x9 x 16 exponential-first first 5"}));
  EXPECT_EQ(names({{"--tiles", "16,32"}, {"--slices", "8,24"}, {"--grid", "frustum"}}).size(), 4u);
  EXPECT_EQ(names({{"--slices", "8"}}).size(), 4u) << "of frustum, distance, cascades and world one each";
  EXPECT_EQ(names({{"--grid", "frustum"}}).size(), 4u) << "whose tiles and slices are the default's";
  EXPECT_EQ(parse_config(R"({"scenes": ["a.glb"]})", "c.json", Flags{{"--slices", "8"}}).grids.size(), 4u);
}

TEST(ConfigFlags, a_star_goes_over_lists_of_lists_and_a_pointer_has_its_escapes) {
  const Flags sizes{{"--viewport", "640x360,1280x720"}};
  const auto with = [&](const std::string& set) { return Flags{sizes[0], {"--set", set}}; };
  EXPECT_EQ(flagged(with("viewports.*.1=400")).viewports, (std::vector<Vec2i>{{640, 400}, {1280, 400}}));
  EXPECT_EQ(flagged(with("/viewports/1/0=800")).viewports, (std::vector<Vec2i>{{640, 360}, {800, 720}}));
  const std::pair<const char*, const char*> rows[] = {
      {"viewports.*.2=1", "--set=viewports.*.2=1: no entry has this key"},
      {"/na~1me=x", "c.json: --set=/na~1me=x /na~1me: unknown key 'na/me' (did you mean 'name'?)"},
      {"/na~0me=x", "c.json: --set=/na~0me=x /na~0me: unknown key 'na~me' (did you mean 'name'?)"},
      {"/na~2me=x", "--set=/na~2me=x: in a JSON pointer ~ stands before 0 (~) or 1 (/) only"},
      {"/name~=x", "--set=/name~=x: in a JSON pointer ~ stands before 0 (~) or 1 (/) only"},
      {"na~me=x", "c.json: --set=na~me=x /na~0me: unknown key 'na~me'"},
  };
  for (const auto& [set, message] : rows)
    EXPECT_EQ(refusal_of(with(set)).substr(0, std::string(message).size()), message) << refusal_of(with(set));
}

TEST(ConfigFlags, two_equal_viewports_are_refused) {
  const std::string refusal = refusal_of({{"--viewport", "640x360,1280x360"}, {"--set", "viewports.*.0=640"}});
  EXPECT_NE(refusal.find(" /viewports/1: this viewport stands here twice"), std::string::npos) << refusal;
  EXPECT_NE(refusal_of({{"--viewport", "640x360,640x360"}}).find("this viewport stands here twice"), std::string::npos);
}

TEST(ConfigFlags, budgets_are_added_to_those_of_the_file) {
  const Config config = parse_config(R"({"scenes": ["a.glb"], "limits": {"fail_if": ["dropped > 0"]}})", "c.json",
                                     Flags{{"--fail-if", "unlit > 0"}, {"--fail-if", "longest>64"}});
  ASSERT_EQ(config.limits.fail_if.size(), 3u);
  EXPECT_EQ(config.limits.fail_if[2].figure, "longest");
  EXPECT_TRUE(refusal_of({{"--fail-if", "lngest > 64"}})
                  .starts_with("c.json: --fail-if=lngest > 64 /limits/fail_if/0: 'lngest > 64' names no figure of a "
                               "case (did you mean 'longest'?); there are: "));
}

TEST(ConfigFlags, a_key_of_thousands_of_steps_is_refused_at_once_and_in_short) {
  std::string deep = "a";
  for (int i = 0; i < 50'000; ++i) deep += ".a";
  EXPECT_EQ(refusal_of({{"--set", deep + "=1"}}), "--set: a key with 50000 steps; at most 16");
  EXPECT_EQ(refusal_of({{"--set", "details=" + std::string(50'000, '[') + std::string(50'000, ']')}}),
            "--set: a value nested deeper than 256 levels");
}

TEST(ConfigFlags, what_is_wrong_is_said_with_the_flag) {
  const std::pair<Flags, const char*> rows[] = {
      {{{"--grid", "frustrum"}}, "c.json: --grid=frustrum /grids/0/kind: found 'frustrum' (did you mean 'frustum'?)"},
      {{{"--tiles", "16t"}}, "--tiles=16t: '16t' is no tile size"},
      {{{"--tiles", "0"}}, "c.json: --tiles=0 /grids/0/tiles/pixels/0/0: found 0"},
      {{{"--grid", "world"}, {"--tiles", "8"}}, "--tiles=8: no grid has tiles"},
      {{{"--grid", "world"}, {"--slices", "8"}}, "--slices=8: no grid has slices"},
      {{{"--slices", "many"}}, "c.json: --slices=many /grids/0/slices/count: found 'many'"},
      {{{"--viewport", "1280"}}, "--viewport=1280: '1280' is no image size"},
      {{{"--assigner", "exat"}}, "c.json: --assigner=exat /assigners/0/name: found 'exat' (did you mean 'exact'?)"},
      {{{"--assigner", "*-fsat"}}, "--assigner=*-fsat: '*-fsat' matches none of brute-force, "},
      {{{"--rounds", "0"}}, "c.json: --rounds=0 /timing/rounds: found 0"},
      {{{"--set", "timing.rounds"}}, "--set=timing.rounds: takes KEY=VALUE"},
      {{{"--set", "timng.rounds=1"}},
       "c.json: --set=timng.rounds=1 /timng: unknown key 'timng' (did you mean 'timing'?)"},
      {{{"--set", "seed=1,2"}}, "c.json: --set=seed=1,2 /seed: found a list of 2"},
      {{{"--set", "seed.x=1"}}, "--set=seed.x=1: /seed has no keys"},
      {{{"--set", "grids.3.levels=1"}}, "--set=grids.3.levels=1: /grids has 3 entries"},
      {{{"--set", "grids.*.levels=1"}}, "--set=grids.*.levels=1: no entry has this key"},
      // What only together is wrong stands at a key that no flag has set.
      {{{"--rounds", "3"}, {"--set", "grids.0.slices.near=100"}},
       "c.json: --rounds=3 --set=grids.0.slices.near=100 /grids/0/slices/far: found 90"},
  };
  for (const auto& [flags, message] : rows)
    EXPECT_EQ(refusal_of(flags).substr(0, std::string(message).size()), message) << refusal_of(flags);
}

TEST(ConfigFlags, the_file_is_told_before_a_flag) {
  const Flags flags{{"--rounds", "0"}};
  EXPECT_THROW(
      {
        try {
          parse_config(R"({"scenes": ["a.glb"], "threads": 0})", "c.json", flags);
        } catch (const Error& error) {
          EXPECT_EQ(error.where(), "1:34 /threads");
          throw;
        }
      },
      Error);
}

TEST(ConfigFlags, scenes_without_a_configuration_take_them_too) {
  const Config config = default_config({"level.glb"}, Flags{{"--grid", "cascades"}, {"--rounds", "4"}});
  EXPECT_EQ(config.grids.size(), 1u);
  EXPECT_EQ(config.timing.rounds, 4);
  EXPECT_EQ(config.name, "level");
}

TEST(ConfigFlags, every_scheme_of_slices_is_one_for_the_default_sweep) {
  const Names schemes = {"linear", "exponential", "exponential-first", "power",
                         "fit",    "cubical",     "cubical-first",     "exponential-first,linear"};
  for (const std::string& scheme : schemes) {
    const Flags flags{{"--set", "grids.*.slices.scheme=" + scheme}};
    const Config config = default_config({"level.glb"}, flags);
    EXPECT_GE(config.grids.size(), 4u) << scheme;
    EXPECT_EQ(parse_config(config.resolved.dump(), "c.json").grids.size(), config.grids.size()) << scheme;
  }
  const Flags first{{"--set", "grids.*.slices.scheme=exponential-first"}};
  Names names;
  for (const grid::GridSpec& grid : default_config({"level.glb"}, first).grids) names.push_back(grid.name());
  EXPECT_NE(std::find(names.begin(), names.end(), "frustum 32px x 1 linear"), names.end()) << names[3];
  EXPECT_THROW(parse_config(R"({"scenes": ["a.glb"], "grids": [{"slices": {"scheme": "linear", "count": 1}}]})",
                            "c.json", first),
               Error)
      << "a file's own grid";
}

TEST(ConfigFlags, a_single_value_is_a_list_of_one_where_only_a_list_can_be) {
  const Config config =
      flagged({{"--set", "precision=half"}, {"--set", "storages=bitfield"}, {"--set", "limits.fail_if=unlit > 0"}});
  ASSERT_EQ(config.precisions.size(), 1u);
  EXPECT_EQ(config.precisions[0].label(), "half");
  EXPECT_EQ(config.storages.size(), 1u);
  EXPECT_EQ(config.limits.fail_if.size(), 1u);
  EXPECT_EQ(flagged({{"--set", "seed=9"}}).seed, 9u) << "nothing else is made a list";
}

}  // namespace
}  // namespace clusterbench::config
