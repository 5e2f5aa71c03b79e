#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "cli/lamps.h"
#include "cli/recommended.h"
#include "cli/tool.h"

namespace clusterbench::test::recommending {
namespace {

TEST(Recommend, names_what_a_configuration_asks_for_in_vain) {
  const Folder folder;
  const auto notes = [&](const std::string& more) {
    const std::string input = folder.write("space.json", space(more)).string();
    const Outcome done =
        tool("recommend " + input + " --no-timing --by bytes --tiles 64 --slices 8 --assigner aabb-fast");
    EXPECT_EQ(done.code, 0) << done.err;
    return done.err;
  };
  EXPECT_NE(notes(R"(, "details": {"frames": [0]}, "shadow_cull": {"resolution": 16})")
                .find("recommend compares costs and leaves out details, shadow_cull; run reports them"),
            std::string::npos);
  EXPECT_EQ(notes("").find("leaves out"), std::string::npos);
}

TEST(Recommend, refuses_presets_on_a_device_whose_times_do_not_compare) {
  const Outcome refused =
      tool("recommend " + test::source_dir() + "/scenes/street.glb --preset three-js,filament --device 0 -q");
  EXPECT_EQ(refused.code, 2) << refused.err;
  EXPECT_NE(
      refused.err.find("device: with a device presets take methods that run on it (gpu-cells-fixed), whose times do "
                       "not compare with those of the processor; leave the device out"),
      std::string::npos)
      << refused.err;
}

TEST(Recommend, ranks_what_samples_search_apart_and_never_takes_it_while_there_are_lists) {
  std::string config = space();
  config.replace(config.find(R"("aabb-fast", "exact-fast")"), 25, R"("aabb-fast", "bvh", "z-binning")");
  for (const std::string by : {"bytes", "gpu_cost_us"}) {
    const Recommended found = recommended(config, "--no-timing --by " + by);
    ASSERT_EQ(found.outcome.code, 0) << found.outcome.err;
    EXPECT_FALSE(found.answer["choice"]["storage"].is_null()) << by;
    for (const Json& runner_up : found.answer["runners_up"]) EXPECT_FALSE(runner_up["storage"].is_null()) << by;
    ASSERT_FALSE(found.answer["searched"].empty()) << by;
    std::set<std::string> names;
    for (const Json& record : found.answer["searched"]) {
      EXPECT_TRUE(record["storage"].is_null());
      EXPECT_GT(record["figures"]["read_bytes"], found.answer["choice"]["figures"]["read_bytes"]);
      names.insert(record["assigner"]["name"]);
    }
    const std::string& text = found.outcome.out;
    EXPECT_NE(text.find("structures that samples search, priced by the model"), std::string::npos) << text;
    const std::string last = text.substr(text.rfind("conclusion: "));
    EXPECT_EQ(last.find('\n'), last.size() - 1) << last;
    EXPECT_NE(last.find("take " + found.answer["choice"]["name"].get<std::string>()), std::string::npos) << last;
  }
}

// Candidates are sorted, launches have the configuration's order: brute-force is last there, and takes far longer than
// planes in every build (19 times in release).
TEST(Recommend, gives_each_candidate_the_times_of_its_own_in_several_launches) {
  std::string config = space();
  const std::string methods = R"("aabb-fast", "exact-fast", "world-grid-fast")";
  config.replace(config.find(methods), methods.size(), R"("planes", "brute-force")");
  const Recommended found =
      recommended(config, "--tiles 32 --slices 8 --scheme exponential --by frame_us --grid frustum");
  ASSERT_EQ(found.outcome.code, 0) << found.outcome.err;
  EXPECT_EQ(found.answer["choice"]["assigner"]["name"], "planes") << found.outcome.out;
  std::set<std::string> behind;
  for (const Json& record : found.answer["runners_up"]) behind.insert(record["assigner"]["name"]);
  EXPECT_TRUE(behind.contains("brute-force")) << found.outcome.out;
}

TEST(Recommend, says_which_command_sizes_the_choice) {
  const Folder folder;
  const std::string choice = (folder / "my choice.json").string();
  const Outcome done = tool("recommend " + source_file("scenes/street.glb") +
                            " --no-timing -q --viewport 320x180 --tiles 64 --slices 4 --assigner exact-fast "
                            "--set scenes.*.frames=2 --write-config '" +
                            choice + "'");
  ASSERT_EQ(done.code, 0) << done.err;
  const std::size_t next = done.out.find("next: clusterbench size ");
  ASSERT_NE(next, std::string::npos) << done.out;
  EXPECT_LT(next, done.out.find("conclusion: ")) << "the last line is the conclusion";
  const Outcome sized = tool(done.out.substr(next + 18, done.out.find("   sizes", next) - next - 18));
  EXPECT_EQ(sized.code, 0) << sized.err;
  EXPECT_NE(sized.out.find("(1 camera, 451 frames)"), std::string::npos) << sized.out;
}

TEST(Recommend, says_where_no_shader_function_reads_the_choice) {
  const Recommended listed = recommended(space(), "--no-timing --by bytes --tiles 64 --slices 4");
  ASSERT_EQ(listed.outcome.code, 0) << listed.outcome.err;
  EXPECT_TRUE(listed.answer["no_reader"].is_null()) << listed.answer["no_reader"];
  std::string config = space();
  config.replace(config.find(R"("aabb-fast", "exact-fast", "world-grid-fast")"), 44, R"("z-binning")");
  const Recommended searched = recommended(config, "--no-timing --by bytes --tiles 64 --slices 4");
  ASSERT_EQ(searched.outcome.code, 0) << searched.outcome.err;
  ASSERT_TRUE(searched.answer["no_reader"].is_string());
  EXPECT_NE(searched.outcome.out.find(". `size --format hlsl` (glsl) has no function that reads its lists: " +
                                      searched.answer["no_reader"].get<std::string>()),
            std::string::npos)
      << searched.outcome.out;
}

TEST(Recommend, says_that_depths_are_random_and_what_to_do_and_a_ground_changes_that) {
  const std::string config = space(R"(, "samples": {"opaque": {}})");
  const std::string flags = "--no-timing --tiles 64 --slices 4,8 --assigner exact-fast";
  const Folder folder;
  const std::string input = folder.write("space.json", config).string();
  const Outcome random = tool("recommend " + input + " " + flags);
  EXPECT_EQ(random.code, 0) << random.err;
  EXPECT_NE(random.err.find("has no triangles: each pixel is shaded at a random depth"), std::string::npos)
      << random.err;
  EXPECT_NE(random.out.find("Samples are at random depths"), std::string::npos) << random.out;
  const Outcome ground = tool("recommend " + input + " " + flags + " --set samples.opaque.ground=lowest");
  EXPECT_EQ(ground.code, 0) << ground.err;
  EXPECT_EQ(ground.err.find("random depth"), std::string::npos) << ground.err;
  EXPECT_EQ(ground.out.find("random depths"), std::string::npos) << ground.out;
  const Recommended on_ground = recommended(config, flags + " --set samples.opaque.ground=0.5");
  EXPECT_EQ(on_ground.answer["ground_m"], 0.5);
  EXPECT_NE(on_ground.outcome.out.find("Samples lie on a floor at y = 0.5 m, since the scene has no triangles."),
            std::string::npos);
  EXPECT_EQ(on_ground.answer["random_depths"], false);
  EXPECT_TRUE(on_ground.answer["choice"]["overshade"].is_number());
  EXPECT_EQ(on_ground.answer["samples"], Json::array({"opaque"}));
  EXPECT_NE(on_ground.outcome.out.find("read (opaque)  overshade (opaque)"), std::string::npos);
  EXPECT_NE(on_ground.outcome.out.find("opaque: samples of visible surfaces; read: bytes that one reads\n"),
            std::string::npos);
  const Recommended by_overshade = recommended(config, flags + " --by overshade --set samples.opaque.ground=0.5");
  EXPECT_EQ(by_overshade.answer["random_depths"], false) << "overshade is of the floor, too";
  const Recommended at_random = recommended(config, flags);
  EXPECT_EQ(at_random.answer["random_depths"], true);
  EXPECT_EQ(at_random.answer["samples"], Json::array({"volume"}));
}

TEST(Recommend, what_samples_search_is_held_against_the_first_of_them_where_no_lists_are_chosen) {
  const Outcome done = tool("recommend -q -o - " + test::source_file("scenes/street.glb") +
                            " --no-timing --viewport 320x180 --tiles 64 --slices 16 --grid frustum"
                            " --set scenes.*.frames=1 --bytes 2060");
  const nlohmann::json answer = nlohmann::json::parse(done.out)["answers"][0], searched = answer["searched"];
  ASSERT_TRUE(answer["choice"].is_null()) << done.out;
  ASSERT_GT(searched.size(), 1u);
  EXPECT_EQ(searched[0]["by_choice"], 1.0);
  for (const nlohmann::json& one : searched)
    EXPECT_NEAR(one["by_choice"].get<double>(), one["objective"].get<double>() / searched[0]["objective"].get<double>(),
                1e-4);
  EXPECT_GT(searched.back()["by_choice"], 1.0);
}

TEST(Recommend, an_answer_does_not_depend_on_the_other_viewports) {
  const Folder folder;
  const std::string flags =
      " --no-timing --tiles 64,128 --slices 8 --grid frustum --assigner exact-fast,aabb-fast -q -o " +
      (folder / "answer.json").string();
  const std::string input = folder.write("space.json", space()).string();
  const auto choices = [&](const std::string& viewports) {
    EXPECT_EQ(tool("recommend " + input + flags + " --viewport " + viewports).code, 0);
    std::map<std::string, Json> all;
    const Json written = Json::parse(file_text(folder / "answer.json"));
    for (const Json& answer : written["answers"]) all[answer["viewport"].dump()] = answer["choice"];
    return all;
  };
  // Names begin with the viewport where there are several.
  const auto figures = [&](const std::string& viewports, const std::string& of) {
    const auto all = choices(viewports);
    return std::pair(all.at(of)["figures"], all.at(of)["grid"]);
  };
  for (const std::string viewport : {"[320,180]", "[960,540]"}) {
    const auto alone = figures(viewport == "[320,180]" ? "320x180" : "960x540", viewport);
    EXPECT_EQ(figures("320x180,960x540", viewport), alone);
    EXPECT_EQ(figures("960x540,320x180", viewport), alone);
  }
}

TEST(Recommend, of_engines_that_assign_on_a_gpu_no_time_is_asked_for) {
  const std::string scene = source_file("scenes/street.glb") + " --set 'scenes.*.frames=2' --viewport 320x180 -q ";
  const Outcome ranked = tool("recommend " + scene + "--preset bevy-gpu,filament");
  EXPECT_EQ(ranked.code, 0) << ranked.err;
  EXPECT_TRUE(ranked.out.starts_with("least gpu_cost_us")) << ranked.out;
  const Outcome timed = tool("recommend " + scene + "--preset bevy-gpu,filament --by frame_us");
  EXPECT_NE(timed.code, 0);
  EXPECT_NE(timed.err.find("'bevy-gpu' makes its lists on a GPU"), std::string::npos) << timed.err;
}

TEST(Recommend, finds_what_a_sweep_over_all_candidates_and_frames_finds) {
  const Json cases = swept(space());
  ASSERT_EQ(cases.size(), 52u);
  for (const std::string objective : {"bytes", "index_entries", "longest", "evaluated"}) {
    double least = std::numeric_limits<double>::infinity();
    for (const Json& one : cases)
      if (is_lit(one)) least = std::min(least, figure(one, objective));
    const Recommended found = recommended(space(), "--no-timing --by " + objective);
    ASSERT_EQ(found.outcome.code, 0) << found.outcome.err;
    EXPECT_NEAR(found.answer["choice"]["objective"].get<double>(), least, 1e-8 * least) << objective;
    EXPECT_EQ(found.answer["candidates"], 52);
    EXPECT_LT(found.answer["work"]["evaluations_share"], 0.6) << objective;
    // By name: samples of surfaces, for the cost model, give the case another id.
    const std::string name = "street/walk/" + found.answer["choice"]["name"].get<std::string>();
    const auto same = std::ranges::find_if(cases, [&](const Json& one) { return one["name"] == name; });
    ASSERT_NE(same, cases.end()) << name;
    for (const std::string figure_name : {"bytes", "index_entries", "longest", "evaluated"})
      EXPECT_NEAR(found.answer["choice"]["figures"][figure_name].get<double>(), figure(*same, figure_name), 1e-6)
          << figure_name;
  }
}

TEST(Recommend, says_before_it_begins_what_it_will_measure_and_then_each_stage) {
  const Folder folder;
  const Outcome done =
      tool("recommend " + folder.write("space.json", space()).string() + " --no-timing --by evaluated");
  ASSERT_EQ(done.code, 0) << done.err;
  const std::size_t budget = done.err.find(
                        "street: 52 candidates, 8 frames of 1 camera; measures at most 52 on 1 frame, 6 and what may "
                        "still be better on all frames\n"),
                    first = done.err.find("\nstreet: 1 frame: 52 candidates\n"),
                    last = done.err.find("\nstreet: all 8 frames: ");
  EXPECT_LT(budget, first) << done.err;
  EXPECT_LT(first, last) << done.err;
  EXPECT_NE(last, std::string::npos) << done.err;
}

TEST(Recommend, tells_a_method_that_uses_no_cells_once) {
  std::string config = space();
  config.replace(config.find("\"aabb-fast\""), 11, "\"bvh\"");
  const Recommended found = recommended(config, "--no-timing --by evaluated --runners-up 100 --filter /bvh/own");
  ASSERT_EQ(found.outcome.code, 0) << found.outcome.err;
  EXPECT_EQ(found.answer["candidates"], 1) << "is the choice where there is nothing else";
  EXPECT_EQ(found.answer["runners_up"], Json::array());
}

TEST(Recommend, gives_the_same_answer_again_and_on_more_threads) {
  const std::string flags = "--no-timing --by gpu_cost_us --longest 60";
  const Json once = recommended(space(), flags).answer;
  ASSERT_FALSE(once["choice"].is_null());
  EXPECT_EQ(recommended(space(), flags).answer, once);
  EXPECT_EQ(recommended(space(), flags + " --threads 3").answer, once);
}

TEST(Recommend, names_the_grid_whose_lists_take_too_much_memory) {
  const Outcome done = tool("recommend -q --no-timing " + source_file("scenes/hall-512.glb") +
                            " --set 'scenes.*.frames=1' --set limits.memory_mib=1 --threads 2");
  EXPECT_EQ(done.code, 2);
  EXPECT_TRUE(std::regex_search(
      done.err, std::regex("clusterbench: hall-512/walk/[^/]+/.*: limits.memory_mib: .* 1 MiB are allowed")))
      << done.err;
}

TEST(Recommend, writes_a_configuration_that_runs_and_gives_the_same_figures) {
  const Folder folder;
  const std::string choice = (folder / "choice.json").string(), result = (folder / "result.json").string();
  const Recommended found =
      recommended(space(), "--no-timing --by index_entries --longest 200 --write-config " + choice);
  ASSERT_EQ(found.outcome.code, 0) << found.outcome.err;
  const Outcome run = tool("run " + choice + " -q --no-timing -o " + result);
  ASSERT_EQ(run.code, 0) << run.err;
  const Json cases = Json::parse(file_text(result))["cases"];
  ASSERT_EQ(cases.size(), 1u);
  EXPECT_EQ(cases[0]["id"], found.answer["choice"]["ids"][0]);
  EXPECT_EQ(figure(cases[0], "index_entries"), found.answer["choice"]["objective"]);
  EXPECT_EQ(Json::parse(file_text(choice))["limits"]["fail_if"], Json::array({"longest > 200.0"}));
}

TEST(Recommend, writes_runners_up_where_they_are_asked_for) {
  const Folder folder;
  const std::string choice = (folder / "choice.json").string();
  const Recommended found =
      recommended(space(), "--no-timing --by bytes --write-config " + choice + " --write-runners-up 3");
  ASSERT_EQ(found.outcome.code, 0) << found.outcome.err;
  ASSERT_GE(found.answer["runners_up"].size(), 3u);
  const Json cases = swept(file_text(choice));
  const auto is_measured = [&](const Json& candidate) {
    return std::ranges::any_of(cases, [&](const Json& one) { return one["id"] == candidate["ids"][0]; });
  };
  EXPECT_TRUE(is_measured(found.answer["choice"]));
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(is_measured(found.answer["runners_up"][i]));
}

TEST(Recommend, takes_what_draws_lights_by_what_pixels_cost_alone) {
  const std::string flags = "recommend " + source_file("scenes/mix.glb") +
                            " -q --no-timing --viewport 192x108 --grid frustum --tiles 32 --slices 8 --assigner "
                            "deferred,exact-fast --set 'scenes.*.frames=1' ";
  for (const std::string by : {"bytes", "longest", "read_bytes"}) {
    const Outcome done = tool(flags + "--by " + by);
    EXPECT_EQ(done.code, 0) << done.err;
    EXPECT_NE(done.out.find("/exact-fast/packed"), std::string::npos) << done.out;
    EXPECT_EQ(done.out.find("take frustum 32px x 8 exponential/deferred"), std::string::npos) << done.out;
  }
  const Outcome by_cost = tool(flags + "--set samples.opaque={} -o -");
  ASSERT_EQ(by_cost.code, 0) << by_cost.err;
  EXPECT_NE(by_cost.out.find("/deferred/no lists"), std::string::npos) << by_cost.out;
  const Outcome alone = tool("recommend " + source_file("scenes/mix.glb") +
                             " -q --no-timing --viewport 192x108 --grid frustum --tiles 32 --slices 8 --assigner "
                             "deferred --set 'scenes.*.frames=1' --by bytes");
  EXPECT_EQ(alone.code, 1);
  EXPECT_NE(alone.out.find("has lists (methods that draw lights are ranked by cost alone) rejects"), std::string::npos)
      << alone.out;
}

TEST(Recommend, gives_the_same_answer_for_methods_in_any_order) {
  const auto answer = [](const std::string& methods) {
    const Outcome done = tool("recommend " + source_file("scenes/street.glb") +
                              " -q --no-timing --viewport 320x180 --grid frustum --tiles 64,128 --slices 4,8 "
                              "--set 'scenes.*.frames=12' -o - --assigner " +
                              methods);
    EXPECT_EQ(done.code, 0) << done.err;
    return Json::parse(done.out)["answers"][0]["choice"];
  };
  const Json choice = answer("bounds-fast,exact-fast,aabb-fast,sphere-refinement-fast");
  EXPECT_EQ(answer("sphere-refinement-fast,aabb-fast,exact-fast,bounds-fast"), choice);
  EXPECT_EQ(answer("exact-fast,sphere-refinement-fast,bounds-fast,aabb-fast"), choice);
}

TEST(Recommend, gives_a_budget_to_the_choice_alone_where_its_method_leaves_more) {
  const Folder folder;
  const std::string choice = (folder / "choice.json").string(),
                    level = source_file("scenes/street.glb") +
                            " --no-timing -q --viewport 320x180 --grid frustum --tiles 64 --slices 4 --assigner bvh "
                            "--set storages=bitfield --set 'scenes.*.frames=3' ";
  ASSERT_EQ(tool("recommend " + level + "--by bytes --bytes 100000 --write-config " + choice).code, 0);
  const Json budgets = Json::parse(file_text(choice))["limits"]["fail_if"];
  ASSERT_EQ(budgets.size(), 1u);
  EXPECT_TRUE(budgets[0].get<std::string>().ends_with("/bvh/bitfield: bytes > 100000.0")) << budgets;
  EXPECT_EQ(tool("run " + choice + " --no-timing -q -o " + (folder / "result.json").string()).code, 0);
}

TEST(Recommend, says_what_is_not_there_to_rank_by) {
  const Folder folder;
  const std::string level = folder.write("level.gltf", level_of(row_of(1))).string();
  const Outcome done = tool("recommend " + level +
                            " --no-timing -q --viewport 64x36 --grid frustum --tiles 64 --slices 4 --assigner "
                            "exact-fast --set shading.samples=20 --by overshade");
  EXPECT_EQ(done.code, 1) << done.out;
  EXPECT_NE(done.out.find("a known overshade on these frames rejects"), std::string::npos) << done.out;
}

TEST(Recommend, tells_a_coarser_grid_that_is_about_as_good) {
  const Recommended found = recommended(space(), "--no-timing --by evaluated --within 400");
  ASSERT_EQ(found.outcome.code, 0) << found.outcome.err;
  const Json &coarsest = found.answer["coarsest"], &choice = found.answer["choice"];
  ASSERT_FALSE(coarsest.is_null());
  EXPECT_LT(coarsest["cells"], choice["cells"]);
  EXPECT_LE(coarsest["objective"].get<double>(), 5.0 * choice["objective"].get<double>());
  EXPECT_TRUE(recommended(space(), "--no-timing --by evaluated --within 0%").answer["coarsest"].is_null());
}

TEST(Recommend, measures_times_where_the_objective_is_one) {
  const Recommended found = recommended(space(), "--by frame_us --filter 64px");
  ASSERT_EQ(found.outcome.code, 0) << found.outcome.err;
  EXPECT_GT(found.answer["choice"]["objective"], 0.0);
  ASSERT_FALSE(found.answer["runners_up"].empty());
  EXPECT_TRUE(found.answer["runners_up"][0].contains("ci95"));
  for (const Json& doubt : found.answer.at("timing_doubts"))
    EXPECT_NE(found.outcome.out.find("warning: " + doubt.get<std::string>()), std::string::npos) << found.outcome.out;
}

TEST(Recommend, searches_a_space_of_its_own_for_a_scene) {
  const Folder folder;
  const std::string output = (folder / "answer.json").string();
  const Outcome done =
      tool("recommend " + source_file("scenes/street.glb") +
           " -q --no-timing --viewport 640x360 --tiles 128 --slices 8 --set scenes.0.frames=2 -o " + output);
  ASSERT_EQ(done.code, 0) << done.err;
  const Json found = Json::parse(file_text(output));
  EXPECT_EQ(found["objective"]["figure"], "gpu_cost_us");
  EXPECT_GT(found["answers"][0]["candidates"], 50);
  for (const Json& method : found["config"]["assigners"]) {
    EXPECT_NE(method["name"], "brute-force");
    EXPECT_NE(method["name"], "aabb") << "has a fast form";
    EXPECT_FALSE(method["name"].get<std::string>().starts_with("naive"));
  }
}

TEST(Recommend, refuses_what_makes_no_sense_and_says_which_flag_it_is) {
  const Folder folder;
  const std::string config = folder.write("space.json", space()).string();
  const std::pair<std::string, std::string> cases[] = {
      {"--within abc", "--within: 'abc' is no share"},
      {"--within=-1%", "--within: '-1%' is no share"},
      {"--within nan", "--within: 'nan' is no share"},
      {"--bytes=-3", "--bytes: takes a number of at least 0, not '-3'"},
      {"--bytes 10k", "--bytes: takes a number of at least 0, not '10k'"},
      {"--bytes inf", "--bytes: takes a number of at least 0, not 'inf'"},
      {"--fail-if 'byts > 1'", "names no figure of a case (did you mean 'bytes'?)"},
      {"--by byte", "--by"},
      {"--by frame_us --no-timing", "--no-timing: leaves out the times"},
      {"--by bytes --frame-us 10 --no-timing", "--no-timing: leaves out the times"},
      {"--by bytes --viewport 640x360,320x180 --write-config x.json",
       "--write-config: takes one scene in one viewport"},
      {"--by gpu_cost_us --set shading.samples=0", "a cost is that of samples"},
      {"--filter nothing-like-it", "--filter"},
      {"-o " + config, config},
  };
  for (const auto& [flags, message] : cases) {
    const Outcome done =
        tool("recommend " + config + " -q " + flags + (flags.starts_with("--by") ? "" : " --by bytes") +
             (flags.find("--no-timing") == std::string::npos ? " --no-timing" : ""));
    EXPECT_EQ(done.code, 2) << flags << "\n" << done.err;
    EXPECT_NE(done.err.find(message), std::string::npos) << flags << "\n" << done.err;
  }
  EXPECT_EQ(file_text(config), space()) << "the input is not overwritten";
}

}  // namespace
}  // namespace clusterbench::test::recommending
