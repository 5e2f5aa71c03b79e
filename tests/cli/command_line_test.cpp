#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "cli/tool.h"
#include "config/limit_rules.h"
#include "core/libraries.h"
#include "result/figures/figure_table.h"

namespace clusterbench::test {
namespace {

using Json = nlohmann::json;

TEST(CommandLine, a_mistyped_command_is_answered_with_the_nearest_one) {
  const Outcome done = tool("rnu x.json");
  EXPECT_EQ(done.code, 2);
  EXPECT_NE(done.err.find("did you mean 'run'?"), std::string::npos) << done.err;
}

TEST(CommandLine, what_is_unknown_or_missing_is_told_in_one_line_with_the_nearest_name) {
  const std::pair<const char*, const char*> rows[] = {
      {"run --gird frustum x.json", "run: no option '--gird' (did you mean '--grid'?); see `clusterbench run --help`"},
      {"run --filtr=x x.json", "run: no option '--filtr' (did you mean '--filter'?); see `clusterbench run --help`"},
      {"run --colour x.json", "run: no option '--colour'; see `clusterbench run --help`"},
      {"run --rounds-servr", "run: no option '--rounds-servr'; see `clusterbench run --help`"},
      {"--vresion", "no option '--vresion' (did you mean '--version'?); see `clusterbench --help`"},
      {"scene inf x.glb", "scene: no command 'inf' (did you mean 'info'?); there are: info, generate, views"},
      {"scene inf --help", "scene: no command 'inf' (did you mean 'info'?); there are: info, generate, views"},
      {"scene", "scene: names no command; there are: info, generate, views"},
      {"man all", "man: 'all' is one argument too many; see `clusterbench man --help`"},
      {"list preset",
       "list: SECTION: no 'preset' (did you mean 'presets'?); there are: assigners, storages, grids, pre_culls, "
       "scenes, presets, figures, libraries, devices; "
       "see `clusterbench list --help`"},
      {"compare a.json", "compare: NEW is required; see `clusterbench compare --help`"},
      {"run", "run: INPUT is required; see `clusterbench run --help`"},
      {"schema confg",
       "schema: WHICH: no 'confg' (did you mean 'config'?); there are: config, result, comparison, "
       "ratios, recommendation, stress, worst-case, size, light-map, dump, check, plugin-check, shader; see "
       "`clusterbench "
       "schema --help`"},
  };
  for (const auto& [line, message] : rows) {
    const Outcome done = tool(line);
    EXPECT_EQ(done.code, 2) << line;
    EXPECT_EQ(done.err, std::string("clusterbench: ") + message + "\n");
    EXPECT_EQ(done.out, "") << line;
  }
}

// Options with a number, as the help of a command has them.
std::vector<std::string> options_with(const std::string& type, const std::string& command) {
  std::vector<std::string> names;
  std::istringstream help(tool(command + " --help").out);
  for (std::string line; std::getline(help, line);)
    if (const std::size_t at = line.find(" " + type), name = line.find("--"); at < line.size() && name < at)
      names.push_back(line.substr(name, at - name));
  return names;
}

constexpr const char* k_commands[] = {"run",          "compare",     "size",           "report", "export",
                                      "history show", "history add", "scene info",     "stress", "merge",
                                      "list",         "validate",    "scene generate", "schema", "completion",
                                      "worst-case",   "recommend",   "light-map",      "check",  "plugin check"};

TEST(CommandLine, no_option_takes_what_is_not_a_finite_number) {
  int options = 0;
  for (const std::string command : k_commands)
    for (const std::string& option : options_with("FLOAT", command))
      for (const std::string word : {"nan", "inf", "-1", "1e999", "2x"}) {
        const Outcome done = tool(command + " " + option + "=" + word);
        EXPECT_EQ(done.code, 2) << command << option << word;
        EXPECT_NE(done.err.find(command + ": " + option + ": takes a number "), std::string::npos) << done.err;
        EXPECT_NE(done.err.find(", not '" + word + "'"), std::string::npos) << done.err;
        EXPECT_LT(done.err.size(), 200u);
        ++options;
      }
  EXPECT_GE(options, 8 * 5);
}

TEST(CommandLine, no_option_takes_a_whole_number_that_its_type_does_not_hold) {
  int options = 0;
  for (const std::string command : k_commands)
    for (const char* type : {"UINT", "INT"})
      for (const std::string& option : options_with(type, command))
        for (const std::string word : {"-1", "18446744073709551616", "1e3", "nan"}) {
          const Outcome done = tool(command + " " + option + "=" + word);
          EXPECT_EQ(done.code, 2) << command << option << word;
          EXPECT_NE(done.err.find(": takes a whole number "), std::string::npos) << done.err;
          EXPECT_LT(done.err.size(), 200u);
          ++options;
        }
  EXPECT_GE(options, 7 * 4);
}

TEST(CommandLine, seeds_are_those_that_a_configuration_and_json_can_hold) {
  int commands = 0;
  for (const std::string command : k_commands) {
    const std::vector<std::string> options = options_with("UINT", command);
    if (std::ranges::find(options, "--seed") == options.end()) continue;
    const Outcome refused = tool(command + " --seed=9007199254740992");
    EXPECT_EQ(refused.code, 2) << command;
    EXPECT_NE(refused.err.find("--seed: takes a whole number from 0 to 2^53 - 1, not '9007199254740992'"),
              std::string::npos)
        << refused.err;
    ++commands;
  }
  EXPECT_EQ(commands, 5);

  EXPECT_NE(tool("stress --random 2 --seed 9007199254740991").err.find("--random: goes beyond the seed 2^53 - 1"),
            std::string::npos);

  const Folder folder;
  const std::string result = (folder / "stress.json").string();
  ASSERT_EQ(tool("stress --cases '^H10$' --methods exact-fast --seed 9007199254740991 -q -o " + result).code, 0);
  EXPECT_EQ(tool("validate " + result).code, 0);
  EXPECT_EQ(Json::parse(std::ifstream(result))["seed"], 9007199254740991);
}

TEST(CommandLine, no_option_takes_another_option_as_its_value) {
  for (const char* arguments : {"stress --cases --methods exact-fast", "run x.glb --filter --quiet",
                                "size x.json --engine --filter=aabb", "run x.glb -o -q"}) {
    const Outcome refused = tool(arguments);
    EXPECT_EQ(refused.code, 2) << arguments;
    EXPECT_NE(refused.err.find(": takes no option as its value, and -"), std::string::npos)
        << arguments << ": " << refused.err;
  }
  EXPECT_NE(tool("validate -- --quiet").err.find("--quiet"), std::string::npos);  // a file
}

// The command waits for its input, which comes through a pipe that the shell opens when the program reads. `size` and
// `validate` read in a process apart, since the input may name plug-ins.
TEST(CommandLine, a_signal_before_the_work_ends_the_command_with_a_message_and_its_exit_code) {
  for (const std::string command : {"run", "size", "validate", "ratio"})
    for (const auto& [name, code] : {std::pair("INT", 130), std::pair("TERM", 75), std::pair("HUP", 75)}) {
      const Folder folder;
      const std::string pipe = (folder / "pipe.json").string(), err = (folder / "err").string();
      const std::string script = "mkfifo " + pipe + "; env --default-signal=INT,TERM,HUP " + program() + " " + command +
                                 " " + pipe + " 2>" + err + " & exec 3>" + pipe + "; kill -" + name + " $!; wait $!";
      const int status = std::system(("timeout 60 sh -c '" + script + "'").c_str());
      ASSERT_TRUE(WIFEXITED(status));
      EXPECT_EQ(WEXITSTATUS(status), code) << command << " " << name;
      EXPECT_EQ(file_text(err), "clusterbench: interrupted\n") << command << " " << name;
    }
}

// Each would take minutes, and is interrupted once it has said so.
TEST(CommandLine, an_interrupted_command_says_what_it_has_written) {
  const Folder folder;
  const std::string scene = " " + source_file("scenes/open-world.glb") + " ", out = (folder / "out.json").string(),
                    path = (folder / "path.gltf").string(), err = (folder / "err").string();
  const struct {
    std::string command, begun, said;
  } runs[] = {
      {"size" + scene + "--set scenes.*.frames=5000 --threads 1", "takes about",
       "clusterbench: interrupted; no sizes, since some frames were not counted or tried\n"},
      {"recommend" + scene + "--no-timing --set scenes.*.frames=600 -o " + out, "measures at most",
       "clusterbench: interrupted; " + out + " not written\n"},
      {"worst-case" + scene + "--tiles 64 --slices 16 --assigner aabb-fast --evaluations 10000000 -o " + out +
           " --path " + path,
       "takes about",
       "clusterbench: interrupted; all output is of the frames that were tried by then; " + out + ", " + path + ", " +
           (folder / "path.json").string() + " written\n"},
  };
  for (const auto& [command, begun, said] : runs) {
    const std::string script = program() + " " + command + " >/dev/null 2>" + err + " & until grep -q \"" + begun +
                               "\" " + err + "; do sleep 0.05; done; sleep 0.5; kill -TERM $!; wait $!";
    const int status = std::system(("timeout 100 sh -c '" + script + "'").c_str());
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 75) << command;
    EXPECT_TRUE(file_text(err).ends_with(said)) << file_text(err);
  }
}

TEST(CommandLine, no_option_takes_a_blank_text) {
  for (const char* arguments : {"run x.glb --device ' '", "ratio x.json --methods ' '", "history add x h --commit '\t'",
                                "run x.glb --filter '  '", "run x.glb -o ' '", "report ' '", "stress --cases ' '",
                                "run x.glb --fail-if ' '", "scene info ' '", "size x.json --name ' '"}) {
    const Outcome refused = tool(arguments);
    EXPECT_EQ(refused.code, 2) << arguments;
    EXPECT_NE(refused.err.find("takes a text that is not blank"), std::string::npos)
        << arguments << ": " << refused.err;
  }
}

TEST(CommandLine, files_whose_names_are_not_utf8_are_read_and_text_that_is_not_is_refused) {
  const Folder folder;
  const std::string result = (folder / "\xff.json").string(), dumps = (folder / "\xfe").string();
  const std::string run = "run " + source_file("scenes/street.glb") +
                          " --grid frustum --assigner aabb-fast --set 'scenes.*.frames=1' --no-timing -q ";
  ASSERT_EQ(tool(run + "-o " + result).code, 0);
  ASSERT_EQ(tool(run + "--write-dump " + dumps).code, 0);
  for (const std::string& arguments :
       {"report " + result, "compare " + result + " " + result + " --json -", "merge " + result, "validate " + result,
        "check " + dumps + " --methods none --json -", "export --format lnt " + result,
        "size --format json " + result}) {
    const Outcome done = tool(arguments);
    EXPECT_EQ(done.code, 0) << arguments << ": " << done.err;
  }
  for (const std::string& arguments :
       {std::string("worst-case x.glb --path \xff.gltf"), std::string("plugin check \xff.so"),
        std::string("stress --plugin \xff.so"), std::string("stress --shader \xff.json")}) {
    const Outcome refused = tool(arguments);
    EXPECT_EQ(refused.code, 2) << arguments;
    EXPECT_NE(refused.err.find("takes text in UTF-8"), std::string::npos) << arguments << ": " << refused.err;
  }
}

TEST(CommandLine, no_random_settings_are_not_all_hard_cases) {
  const Outcome done = tool("stress --random 0");
  EXPECT_EQ(done.code, 2);
  EXPECT_NE(done.err.find("--random: takes a whole number of at least 1, not '0'"), std::string::npos) << done.err;
}

TEST(CommandLine, without_arguments_the_help_is_shown) {
  const Outcome done = tool("");
  EXPECT_EQ(done.code, 0);
  EXPECT_NE(done.out.find("validate"), std::string::npos) << done.out;
}

TEST(CommandLine, the_version_is_also_json) {
  const Outcome done = tool("--version --json");
  EXPECT_EQ(done.code, 0);
  const Json version = Json::parse(done.out);
  for (const char* key : {"version", "git_sha", "compiler", "flags", "build_type", "simd_target", "libraries"})
    EXPECT_TRUE(version.contains(key)) << key;
  for (const OptionalLibrary& row : optional_libraries())
    EXPECT_EQ(version["built_in"][row.name], row.is_built_in) << row.name;
  EXPECT_NE(tool("--version").out.find(version["version"].get<std::string>()), std::string::npos);
}

TEST(CommandLine, list_tells_where_presets_come_from_and_what_of_them_is_unverified) {
  const Json presets = Json::parse(tool("list presets --json").out);
  EXPECT_EQ(presets.size(), 24u);
  const std::set<std::string> grounds{"ran", "read", "memory"};
  for (const Json& preset : presets) {
    EXPECT_NE(preset["source"], "") << preset["name"];
    EXPECT_NE(preset["version"], "") << preset["name"];
    EXPECT_TRUE(grounds.contains(preset["evidence"])) << preset["name"];
  }
  const std::string text = tool("list presets").out;
  EXPECT_TRUE(text.starts_with("presets")) << text;
  EXPECT_NE(text.find("unverified: which test it has for cones"), std::string::npos) << text;
  EXPECT_NE(text.find("playcanvas: PlayCanvas, 2.23 (ran): "), std::string::npos) << text;
  EXPECT_NE(text.find("limit: 255 lights in view, the first; 255 in a cell"), std::string::npos) << text;
  EXPECT_NE(text.find("with --as-shipped: the row of a light's centre is taken once"), std::string::npos) << text;
  EXPECT_NE(text.find("with --device: {\"name\":\"gpu-lights\",\"spot\":\"cone-sphere\"}; approximated: a group"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("not with --device: it rasterises meshes of lights"), std::string::npos) << text;
  EXPECT_EQ(text.find("brute-force:"), std::string::npos) << "nothing else";
}

TEST(CommandLine, list_figures_tells_each_figure_and_where_it_can_be_used) {
  const Json figures = Json::parse(tool("list figures --json").out);
  EXPECT_EQ(figures.size(), result::figures().size());
  const std::string text = tool("list figures").out, help = tool("recommend --help").out;
  for (const Json& figure : figures) {
    const auto name = figure["name"].get<std::string>();
    EXPECT_NE(text.find("\n  " + name + " [" + figure["unit"].get<std::string>() + "]: "), std::string::npos) << name;
    EXPECT_EQ(config::limit_rule(name + " > 1", "", "--fail-if").figure, name);
    const bool is_objective = help.find(name + ",") != std::string::npos || help.find(name + "}") != std::string::npos;
    EXPECT_TRUE(!figure["uses"]["recommend"] || is_objective) << name;
  }
  EXPECT_NE(
      text.find("  frame_us [us]: median time of a frame in microseconds: cull, assign and convert\n      better: "
                "smaller; rests on: derived times; budget; recommend; export frame_time [ns]\n"),
      std::string::npos)
      << text;
  EXPECT_NE(
      text.find("better: smaller; rests on: counts; budget, also as SET.unlit; recommend; export unlit [ratio] of "
                "random points in the view; history\n"),
      std::string::npos)
      << text;
}

TEST(CommandLine, list_names_every_assigner_with_its_parameters) {
  const Json all = Json::parse(tool("list --json").out);
  std::vector<std::string> names;
  for (const Json& row : all["assigners"]) names.push_back(row["name"]);
  EXPECT_EQ(names, (std::vector<std::string>{"brute-force",
                                             "bounds",
                                             "bounds-fast",
                                             "planes",
                                             "aabb",
                                             "aabb-fast",
                                             "sphere-refinement",
                                             "sphere-refinement-fast",
                                             "exact",
                                             "exact-fast",
                                             "distance",
                                             "distance-fast",
                                             "cascades",
                                             "cascades-fast",
                                             "world-grid",
                                             "world-grid-fast",
                                             "z-binning",
                                             "bvh",
                                             "tile-ranges",
                                             "two-level",
                                             "light-boxes",
                                             "box-bounds",
                                             "box-refined",
                                             "box-separating-axis",
                                             "tiled",
                                             "tiled-2.5d",
                                             "flagged",
                                             "explicit",
                                             "tile-slices",
                                             "deferred",
                                             "conservative-raster",
                                             "tile-spans",
                                             "babylon-masks",
                                             "naive-bounds",
                                             "naive-refinement",
                                             "naive-planes",
                                             "naive-cone",
                                             "bevy-refinement",
                                             "filament-refinement",
                                             "three-js-boxes",
                                             "babylon-as-shipped",
                                             "naive-mask",
                                             "naive-tile-size",
                                             "gpu-cells",
                                             "gpu-cells-fixed",
                                             "gpu-group",
                                             "gpu-refined",
                                             "gpu-mask",
                                             "gpu-lights",
                                             "gpu-tiled"}));
  const std::string text = tool("list").out;
  for (const std::string& name : names) EXPECT_NE(text.find(name), std::string::npos) << name;
  const std::string inflation = ": padding of the light's radius";
  EXPECT_NE(text.find("inflation = 1  (0 to 1000000)" + inflation), std::string::npos) << text;
  EXPECT_EQ(text.find(inflation), text.rfind(inflation)) << "what methods share is explained once";
  EXPECT_NE(text.find("      spot = both, inflation = 1: as for brute-force\n"), std::string::npos) << text;
}

TEST(CommandLine, all_schemas_are_draft_07) {
  for (const char* which : {"config", "result", "comparison", "stress", "worst-case", "light-map", "dump", "check"}) {
    const Json schema = Json::parse(tool(std::string("schema ") + which).out);
    EXPECT_EQ(schema["$schema"], "http://json-schema.org/draft-07/schema#");
  }
  EXPECT_EQ(tool("schema nothing").code, 2);
}

// None of them goes on with what is missing.
TEST(CommandLine, all_that_reads_results_refuses_a_broken_one_and_other_documents) {
  const Folder folder;
  Json result = Json::parse(file_text(source_file("results/intel-r-xeon-r-processor/quick.json")));
  result["cases"][1].erase("buffers");
  const std::string broken = folder.write("broken.json", result.dump()).string();
  const std::string stress = source_file("results/intel-r-xeon-r-processor/stress.json");
  const std::string page = (folder / "page.html").string(), history = (folder / "history.jsonl").string();
  const auto refuses = [&](const std::string& file, const std::string& why) {
    for (const std::string& command :
         {"compare " + file + " " + file, "size " + file, "export --format csv " + file, "merge " + file,
          "report -o " + page + " " + file, "history add " + file + " " + history}) {
      const Outcome done = tool(command);
      EXPECT_EQ(done.code, 2) << command;
      EXPECT_NE(done.err.find(file + ": " + why), std::string::npos) << command << ": " << done.err;
    }
  };
  refuses(broken, "is not a valid result: /cases/1: Missing required property 'buffers'");
  refuses(stress, "is a result of `clusterbench stress`; wanted is one of `clusterbench run`");
  const std::string huge = folder.write("huge.json", "{\"version\": 1e999}").string();
  refuses(huge, "byte 12: has a number that is larger than double precision can hold: 1e999");
}

TEST(CommandLine, validate_tells_a_good_configuration_from_a_broken_one) {
  EXPECT_EQ(tool("validate " + source_file("configs/quick.json") + " " + source_file("configs/trends.json") + " " +
                 source_file("configs/details.json"))
                .code,
            0);
  const Folder folder;
  const Outcome done = tool("validate " + folder.write("bad.json", "{\n  \"scenez\": []\n}").string());
  EXPECT_EQ(done.code, 2);
  EXPECT_NE(done.err.find("bad.json: 2:3 /scenez"), std::string::npos) << done.err;
  EXPECT_NE(done.err.find("did you mean 'scenes'?"), std::string::npos) << done.err;
}

TEST(CommandLine, validate_goes_on_behind_a_broken_configuration) {
  const Folder folder;
  const std::string bad = folder.write("bad.json", "{\n  \"scenez\": []\n}").string(),
                    absent = folder.write("absent.json", "{\n  \"scenes\": [\"no.glb\"]\n}").string();
  const Outcome done = tool("validate " + bad + " " + absent + " " + source_file("configs/quick.json"));
  EXPECT_EQ(done.code, 2);
  EXPECT_NE(done.err.find("bad.json: 2:3 /scenez"), std::string::npos) << done.err;
  EXPECT_NE(done.err.find("absent.json: 2:14 /scenes/0: names '"), std::string::npos) << done.err;
  EXPECT_NE(done.out.find("quick.json: a valid configuration"), std::string::npos) << done.out;
}

TEST(SceneCommand, what_is_refused_exits_2_with_one_line_that_names_file_and_place) {
  const Folder folder;
  const Outcome done = tool(
      "scene info " +
      folder
          .write("broken.gltf",
                 "{\"asset\": {\"version\": \"2.0\"}, \"nodes\": [{\"camera\": 3}], \"scenes\": [{\"nodes\": [0]}]}")
          .string());
  EXPECT_EQ(done.code, 2);
  EXPECT_EQ(std::count(done.err.begin(), done.err.end(), '\n'), 1) << done.err;
  EXPECT_NE(done.err.find("broken.gltf: /nodes/0/camera"), std::string::npos) << done.err;
}

TEST(SceneCommand, control_characters_of_a_file_never_reach_the_terminal) {
  const Folder folder;
  const std::string evil = "\\u001b]0;gone\\u0007\\u009b31m\\u202e";
  const auto file = folder.write(
      "evil.gltf", R"({"asset": {"version": "2.0"}, "nodes": [{"name": ")" + evil +
                       R"(", "camera": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}}], "cameras": [{"type":
      "perspective", "perspective": {"yfov": 1, "znear": 1}}], "extensionsRequired": [")" +
                       evil + R"("], "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}}})");
  const auto is_clean = [](const std::string& text) {
    return text.find_first_of("\x1b\x07\x7f\r") == std::string::npos && text.find("\xc2\x9b") == std::string::npos &&
           text.find("\xe2\x80\xae") == std::string::npos;
  };
  const Outcome info = tool("scene info " + file.string());
  EXPECT_EQ(info.code, 0) << info.err;
  EXPECT_NE(info.out.find("camera   ?]0;gone??31m?: perspective"), std::string::npos) << info.out;
  EXPECT_TRUE(is_clean(info.out)) << info.out;
  const Outcome json = tool("scene info --json " + file.string());
  EXPECT_EQ(Json::parse(json.out)["cameras"].size(), 1u);
  EXPECT_TRUE(is_clean(json.out)) << json.out;
  const Outcome run = tool("run --no-timing -q --grid world --assigner world-grid -o - " + file.string());
  EXPECT_EQ(Json::parse(run.out)["cases"].size(), 1u) << run.err;
  EXPECT_TRUE(is_clean(run.out)) << run.out;
  const Outcome list = tool("run --dry-run " + file.string());
  EXPECT_EQ(list.code, 0) << list.err;
  EXPECT_TRUE(is_clean(list.out + list.err)) << list.out << list.err;
  const Outcome refused =
      tool("run --dry-run " + folder.write("x.json", R"({"scenes": [")" + evil + R"("]})").string());
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(is_clean(refused.out + refused.err)) << refused.err;
  // A name with a line feed makes no second line.
  const Outcome forged =
      tool("run --dry-run " + folder.write("y.json", R"({"scenes": ["a\nclusterbench: fine"]})").string());
  EXPECT_EQ(forged.code, 2);
  EXPECT_EQ(std::count(forged.err.begin(), forged.err.end(), '\n'), 1) << forged.err;
}

TEST(SceneCommand, a_generated_scene_is_the_committed_one_and_can_be_looked_at) {
  const Folder folder;
  const std::string file = (folder / "street.glb").string();
  ASSERT_EQ(tool("scene generate street -o " + file).code, 0);
  EXPECT_EQ(file_text(file), file_text(source_file("scenes/street.glb")));
  const Json info = Json::parse(tool("scene info --json " + file).out);
  EXPECT_GT(info["lights"]["spot"], 0);
  EXPECT_FALSE(info["cameras"].empty());
}

TEST(SceneCommand, a_cutoff_shows_the_ranges_that_it_makes) {
  const std::string file = source_file("scenes/street.glb");
  const auto by_rule = [&](const std::string& flags) {
    return Json::parse(tool("scene info --json " + flags + " " + file).out)["ranges"]["by_rule"];
  };
  const Json usual = by_rule(""), short_ones = by_rule("--cutoff-lux 0.5"), cut_off = by_rule("--max-range 3");
  EXPECT_EQ(usual["cutoff_lux"], 0.05);
  EXPECT_NEAR(short_ones["max_m"].get<double>() * std::sqrt(10.0), usual["max_m"].get<double>(), 1e-9);
  EXPECT_EQ(cut_off["max_m"], 3.0);
  const std::string text = tool("scene info --cutoff-lux 0.5 " + file).out;
  EXPECT_NE(text.find("  by rule  12 lights without range: "), std::string::npos) << text;
  EXPECT_NE(text.find(" m, where they fall to 0.5 lux (--cutoff-lux)\n"), std::string::npos) << text;
  const std::string clamped = tool("scene info --max-range 3 " + file).out;
  EXPECT_NE(clamped.find("12 of them cut off at 3 m (--max-range)\n"), std::string::npos) << clamped;
  EXPECT_EQ(tool("scene info " + source_file("scenes/hall-512.glb")).out.find("by rule"), std::string::npos);
}

TEST(SceneCommand, an_unknown_scene_name_is_answered_with_the_nearest_one) {
  const Outcome done = tool("scene generate stret");
  EXPECT_EQ(done.code, 2);
  EXPECT_NE(done.err.find("street"), std::string::npos) << done.err;
}

}  // namespace
}  // namespace clusterbench::test
