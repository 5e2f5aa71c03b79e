// Plug-ins through the program: the flag, the key, the path variable; results that name the build.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/plugin_files.h"
#include "cli/small_config.h"
#include "cli/tool.h"

namespace clusterbench::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* k_small_run =
    " --viewport 640x360 --grid frustum --tiles 64 --slices 8 --set 'scenes.*.frames=2' --no-timing ";

std::string plugin_run(const std::string& more) {
  return "run " + source_file("scenes/street.glb") + k_small_run + more;
}

// The result of a run that ended well.
Json plugin_result(const Folder& folder, const std::string& arguments) {
  const std::string file = (folder / "result.json").string();
  const Outcome outcome = tool(arguments + " -q -o " + file);
  EXPECT_EQ(outcome.code, 0) << arguments << "\n" << outcome.err;
  return Json::parse(file_text(file), nullptr, false);
}

const Json& case_of_method(const Json& result, const std::string& assigner) {
  for (const Json& one : result["cases"])
    if (one["assigner"]["name"] == assigner) return one;
  ADD_FAILURE() << "no case of " << assigner;
  return result["cases"][0];
}

TEST(PluginRun, has_the_figures_of_built_in_methods_and_names_the_build) {
  const Folder folder;
  const Json result = plugin_result(
      folder, plugin_run("--plugin " + plugin_file("example") + " --assigner brute-force,example.cell-boxes"));
  const Json &own = case_of_method(result, "brute-force"), &foreign = case_of_method(result, "example.cell-boxes");
  EXPECT_EQ(foreign["error"]["true_pairs"], own["error"]["true_pairs"]);
  EXPECT_EQ(foreign["error"]["false_negatives"], 0);
  EXPECT_GT(foreign["error"]["true_pairs"], 0);
  EXPECT_GE(foreign["error"]["reported_pairs"], own["error"]["true_pairs"]);
  EXPECT_EQ(foreign["assigner"]["params"]["inflation"], 1.0);
  ASSERT_EQ(result["plugins"].size(), 1u);
  const Json& plugin = result["plugins"][0];
  EXPECT_EQ(plugin["id"], "example");
  EXPECT_EQ(plugin["version"], "1.0");
  EXPECT_EQ(plugin["file"], "example.so");
  EXPECT_EQ(plugin["interface_version"], "1.0");
  EXPECT_EQ(plugin["sha256"], sha256_hex(file_text(plugin_file("example"))));
}

// The C++ example, the C example and the program's own box test: points alone, so that spots' volumes do not differ.
TEST(PluginRun, examples_in_c_and_cpp_list_alike) {
  const Folder folder;
  const Json result =
      plugin_result(folder, plugin_run("--plugin " + plugin_file("example") + " --plugin " + plugin_file("in-c") +
                                       " --assigner example.cell-boxes,in-c.cell-boxes"));
  const double in_cpp = case_of_method(result, "example.cell-boxes")["error"]["reported_pairs"],
               in_c = case_of_method(result, "in-c.cell-boxes")["error"]["reported_pairs"];
  EXPECT_NEAR(in_c / in_cpp, 1.0, 1e-3);  // paddings differ by 2 roundoffs
  EXPECT_EQ(result["plugins"].size(), 2u);
}

// The method of CONTRIBUTING.md as it stands there; a box around a cell is tighter than a sphere around a flat one, and
// looser around others.
TEST(PluginRun, the_example_of_contributing_is_a_plugin_too) {
  const Folder folder;
  const Json result = plugin_result(
      folder, plugin_run("--plugin " + plugin_file("contributing") + " --assigner contributing.cell-spheres,aabb"));
  const Json &spheres = case_of_method(result, "contributing.cell-spheres")["error"],
             &boxes = case_of_method(result, "aabb")["error"];
  EXPECT_EQ(spheres["true_pairs"], boxes["true_pairs"]);
  EXPECT_EQ(spheres["false_negatives"], 0);
  EXPECT_NE(spheres["false_positives"], boxes["false_positives"]);
  EXPECT_EQ(tool("plugin check " + plugin_file("contributing") + " -q --seconds 0.3").code, 0);
}

TEST(PluginRun, a_result_without_plugins_says_nothing_of_them) {
  const Folder folder;
  EXPECT_FALSE(plugin_result(folder, plugin_run("--assigner aabb")).contains("plugins"));
  EXPECT_FALSE(
      plugin_result(folder, plugin_run("--assigner aabb --plugin " + plugin_file("example"))).contains("plugins"));
}

TEST(PluginRun, all_kinds_of_grid_lose_nothing) {
  const Folder folder;
  const Json result = plugin_result(folder, "run " + source_file("scenes/street.glb") +
                                                " --viewport 320x180 --set 'scenes.*.frames=2' --no-timing --plugin " +
                                                plugin_file("example") + " --assigner example.cell-boxes");
  std::set<std::string> kinds;
  for (const Json& one : result["cases"]) {
    kinds.insert(one["grid"]["kind"].get<std::string>());
    EXPECT_EQ(one["error"]["false_negatives"], 0) << one["name"];
    EXPECT_GT(one["error"]["true_pairs"], 0) << one["name"];
  }
  EXPECT_EQ(kinds, (std::set<std::string>{"frustum", "distance", "cascades", "world"}));
}

TEST(PluginRun, the_key_is_relative_to_the_configuration_and_parameters_are_axes) {
  const Folder folder;
  fs::create_directory(folder / "built");
  fs::copy_file(plugin_file("example"), folder / "built/mine.so");
  const fs::path config = folder.write("c.json", R"({"scenes": [{"path": ")" + source_file("scenes/street.glb") +
                                                     R"(", "frames": 1}], "viewport": [320, 180],
        "grids": [{"kind": "frustum"}], "plugins": ["built/mine.so"],
        "assigners": [{"name": "example.cell-boxes", "inflation": [1, 4]}], "timing": {"measure": false}})");
  const Json result = plugin_result(folder, "run " + config.string());
  ASSERT_EQ(result["cases"].size(), 2u);
  EXPECT_LE(result["cases"][0]["error"]["reported_pairs"], result["cases"][1]["error"]["reported_pairs"]);
  EXPECT_NE(result["cases"][0]["id"], result["cases"][1]["id"]);
  EXPECT_EQ(result["config"]["plugins"], Json({"built/mine.so"}));
  EXPECT_EQ(tool("validate " + config.string()).code, 0);
}

TEST(PluginRun, a_method_that_is_named_is_looked_for_in_the_folders_of_the_variable) {
  const Folder folder;
  const std::string arguments = plugin_run("--assigner 'example.*'");
  fs::create_directory(folder / "plugins");
  for (const char* name : {"example", "in-c", "version-2"})
    fs::copy_file(plugin_file(name), folder / ("plugins/" + std::string(name) + ".so"));
  setenv("CLUSTERBENCH_PLUGIN_PATH", ("/no-such-folder:" + (folder / "plugins").string()).c_str(), 1);
  const Json result = plugin_result(folder, arguments);
  const Outcome listed = tool("list assigners --json");
  unsetenv("CLUSTERBENCH_PLUGIN_PATH");
  EXPECT_EQ(case_of_method(result, "example.cell-boxes")["error"]["false_negatives"], 0);
  EXPECT_EQ(result["config"]["plugins"], Json({(folder / "plugins/example.so").string()}));
  EXPECT_TRUE(mentions(listed.out, "\"in-c.cell-boxes\"")) << listed.out;
  EXPECT_TRUE(mentions(listed.err, "version-2.so: is made for version 2.0 of the interface")) << listed.err;
  EXPECT_EQ(tool(arguments).code, 2);
}

TEST(PluginRun, unknown_parameters_and_values_are_refused_with_their_place) {
  const Folder folder;
  const auto refused = [&](const std::string& method) {
    const fs::path config = folder.write("c.json", R"({"scenes": ["a.glb"], "plugins": [")" + plugin_file("example") +
                                                       R"("], "assigners": [)" + method + "]}");
    const Outcome outcome = tool("run --dry-run " + config.string());
    EXPECT_EQ(outcome.code, 2);
    return outcome.err;
  };
  EXPECT_TRUE(mentions(refused(R"({"name": "example.cell-boxes", "inflatoin": 2})"), "inflation"));
  EXPECT_TRUE(mentions(refused(R"({"name": "example.cell-boxes", "inflation": 101})"), "101"));
  EXPECT_TRUE(mentions(refused(R"("example.cell-box")"), "example.cell-boxes"));
}

struct Refused {
  std::string plugin, says;
};

TEST(PluginRun, what_is_no_plugin_is_refused_with_a_sentence) {
  const Folder folder;
  fs::copy_file(plugin_file("example"), folder / "cut.so");
  fs::resize_file(folder / "cut.so", 4096);  // half of it can be the code, and all that is loaded
  fs::copy_file(plugin_file("example"), folder / "header.so");
  fs::resize_file(folder / "header.so", 40);
  folder.write("text.so", "not code");
  folder.write("empty.so", "");
  fs::copy_file(plugin_file("example"), folder / "twin.so");
  const Refused all[] = {
      {"/no/such.so", "/no/such.so: cannot be read: No such file or directory"},
      {folder.path().string(), "is a folder, not a file"},
      {(folder / "text.so").string(), "is no shared library (ELF file); takes a plug-in, see docs/plugins.md"},
      {(folder / "empty.so").string(), "is no shared library (ELF file)"},
      {(folder / "cut.so").string(), "is a shared library that was cut off"},
      {(folder / "header.so").string(), "is a shared library that was cut off"},
      {plugin_file("no-entry"), "is no plug-in: it exports no function clusterbench_plugin_entry()"},
      {plugin_file("entry-null"), "clusterbench_plugin_entry() returned no plug-in"},
      {plugin_file("version-2"), "is made for version 2.0 of the interface; this program takes versions 1.0 and later"},
      {(folder / "twin.so").string() + " --plugin " + plugin_file("example"), "has the id 'example', and so has "},
      {"x=", "names no file of a plug-in; takes FILE or ID=FILE"},
      {"Bad=" + plugin_file("example"),
       "is no file, and what stands before '=' is no ID, which has lower-case letters"},
      {"a=" + plugin_file("example") + " --plugin b=" + plugin_file("example"), "is loaded already, with the id 'a'"},
  };
  for (const Refused& one : all) {
    const Outcome outcome = tool(plugin_run("--dry-run --plugin " + one.plugin));
    EXPECT_EQ(outcome.code, 2) << one.plugin;
    EXPECT_TRUE(mentions(outcome.err, one.says)) << one.says << "\n" << outcome.err;
    EXPECT_TRUE(mentions(outcome.err, "--plugin=")) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
}

TEST(PluginRun, an_empty_name_in_a_configuration_is_refused_at_its_place) {
  const Folder folder;
  const fs::path config = folder.write("c.json", R"({"scenes": ["a.glb"], "plugins": [""]})");
  const Outcome refused = tool("run --dry-run " + config.string());
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(mentions(refused.err, "/plugins/0: names no file of a plug-in")) << refused.err;
}

TEST(PluginRun, a_method_of_a_plugin_that_is_not_there_says_where_it_is_looked_for) {
  const Outcome refused = tool(plugin_run("--dry-run --assigner foo.bar"));
  EXPECT_EQ(refused.code, 2);
  for (const char* part : {"--assigner=foo.bar", "--plugin FILE", "foo.so", "CLUSTERBENCH_PLUGIN_PATH"})
    EXPECT_TRUE(mentions(refused.err, part)) << part << "\n" << refused.err;
  EXPECT_TRUE(mentions(tool(plugin_run("--dry-run --assigner tiled-2.5")).err, "tiled-2.5d"));
}

TEST(PluginRun, folders_that_were_searched_are_named) {
  const Folder folder;
  const std::string arguments = plugin_run("--dry-run --assigner foo.bar");
  EXPECT_TRUE(mentions(tool(arguments).err, "CLUSTERBENCH_PLUGIN_PATH, which is not set"));
  setenv("CLUSTERBENCH_PLUGIN_PATH", (folder.path().string() + ":/no/such").c_str(), 1);
  const Outcome refused = tool(arguments);
  unsetenv("CLUSTERBENCH_PLUGIN_PATH");
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(mentions(refused.err, "which has " + folder.path().string() + ", /no/such (does not exist)"))
      << refused.err;
}

TEST(PluginRun, a_method_by_the_name_of_a_file_says_the_id_of_its_plugin) {
  const Folder folder;
  fs::copy_file(plugin_file("example"), folder / "renamed.so");
  const std::string says = "'renamed.cell-boxes': renamed.so has the id 'example'; name its method example.cell-boxes",
                    arguments = plugin_run("--dry-run --assigner renamed.cell-boxes");
  const Outcome named = tool(arguments + " --plugin " + (folder / "renamed.so").string());
  EXPECT_EQ(named.code, 2);
  EXPECT_TRUE(mentions(named.err, says)) << named.err;
  setenv("CLUSTERBENCH_PLUGIN_PATH", folder.path().c_str(), 1);
  const Outcome found = tool(arguments);
  unsetenv("CLUSTERBENCH_PLUGIN_PATH");
  EXPECT_EQ(found.code, 2);
  EXPECT_TRUE(mentions(found.err, says)) << found.err;
}

TEST(PluginRun, what_a_plugin_prints_is_not_in_the_result) {
  const Outcome printed = tool(plugin_run("-q --plugin " + plugin_file("hostile") + " --assigner hostile.prints,aabb"));
  EXPECT_EQ(printed.code, 0) << printed.err;
  const Json result = Json::parse(printed.out, nullptr, false);
  ASSERT_TRUE(result.is_object()) << printed.out.substr(0, 300);
  EXPECT_EQ(result["cases"].size(), 2u);
  EXPECT_TRUE(mentions(printed.err, "clusterbench plugin check: {}"));
  const Outcome here =
      tool(plugin_run("-q --plugin-in-process --plugin " + plugin_file("hostile") + " --assigner hostile.prints,aabb"));
  EXPECT_EQ(here.code, 0) << here.err;
  EXPECT_TRUE(Json::parse(here.out, nullptr, false).is_object()) << here.out.substr(0, 300);
  EXPECT_TRUE(mentions(here.err, "clusterbench plugin check: {}"));
}

// --- Plug-ins that break down as they are loaded ---

TEST(PluginLoading, that_ends_the_process_is_told_by_every_command_that_loads) {
  const Folder folder;
  const std::pair<const char*, const char*> k_ends[] = {
      {"entry-crashes", "the plug-in entry-crashes.so crashed (SIGABRT) in load"},
      {"entry-ends-thread", "the plug-in entry-ends-thread.so ended the process by ending its thread"}};
  for (const auto& [name, told] : k_ends) {
    const std::string flag = " --plugin " + plugin_file(name);
    const std::string config =
        folder.write("c.json", R"({"scenes": ["a.glb"], "plugins": [")" + plugin_file(name) + R"("]})").string();
    const std::string wrong = folder.write("wrong.json", R"({"scenes": 7})").string();
    for (const std::string& command : {"list assigners" + flag, "list --json" + flag, "schema config" + flag,
                                       "validate " + config, plugin_run(flag), "validate " + config + " " + wrong}) {
      const Outcome outcome = tool(command);
      EXPECT_EQ(outcome.code, 2) << command << outcome.err;
      EXPECT_TRUE(mentions(outcome.err, told)) << command << "\n" << outcome.err;
      if (mentions(command, wrong)) {
        EXPECT_TRUE(mentions(outcome.err, "wrong.json")) << outcome.err;
      }
    }
  }
}

TEST(PluginLoading, of_one_bad_file_in_a_folder_hides_no_other_one) {
  const Folder folder;
  for (const char* name : {"entry-crashes", "entry-ends-thread", "entry-null", "example"})
    fs::copy_file(plugin_file(name), folder / (std::string(name) + ".so"));
  setenv("CLUSTERBENCH_PLUGIN_PATH", folder.path().c_str(), 1);
  const Outcome listed = tool("list assigners");
  unsetenv("CLUSTERBENCH_PLUGIN_PATH");
  EXPECT_EQ(listed.code, 0) << listed.err;
  EXPECT_TRUE(mentions(listed.out, "example.cell-boxes")) << listed.out;
  for (const char* name : {"entry-crashes.so: the plug-in entry-crashes.so crashed",
                           "entry-ends-thread.so: the plug-in", "entry-null.so: "})
    EXPECT_TRUE(mentions(listed.err, name)) << name << "\n" << listed.err;
}

// --- A plug-in that ends the thread that calls it, and no exit code tells it ---

TEST(PluginRun, that_ends_its_thread_loses_its_case) {
  const Folder folder;
  const std::string file = (folder / "r.json").string();
  const std::string flags = " --plugin " + plugin_file("ends-thread") + " --assigner aabb,takes-all.takes-all -q";
  const Outcome done = tool(plugin_run(flags + " -o " + file));
  EXPECT_EQ(done.code, 1) << done.err;
  const Json result = Json::parse(file_text(file), nullptr, false);
  ASSERT_TRUE(result.is_object()) << done.err;
  EXPECT_EQ(result["cases"].size(), 1u);
  ASSERT_EQ(result["broken"].size(), 1u);
  EXPECT_EQ(result["broken"][0]["step"], "assign");
  EXPECT_TRUE(
      mentions(result["broken"][0]["reason"], "ended the process by ending its thread (pthread_exit) in assign"));
  const Outcome sized =
      tool("size " + source_file("scenes/street.glb") +
           " --viewport 320x180 --grid frustum --tiles 64 --slices 4 --set 'scenes.*.frames=2'" + flags);
  EXPECT_EQ(sized.code, 1) << sized.err;
  EXPECT_TRUE(mentions(sized.err, "ending its thread (pthread_exit) in assign")) << sized.err;
}

// A build that differs in a byte behind its code.
fs::path other_build(const Folder& folder) {
  const fs::path file = folder / "newer.so";
  std::ofstream(file, std::ios::binary) << file_text(plugin_file("example")) << "another build";
  return file;
}

TEST(PluginBuilds, run_side_by_side_under_two_ids) {
  const Folder folder;
  const Json result = plugin_result(folder, plugin_run("--plugin old=" + plugin_file("example") + " --plugin new=" +
                                                       other_build(folder).string() + " --assigner 'old.*,new.*'"));
  const Json &before = case_of_method(result, "old.cell-boxes"), &now = case_of_method(result, "new.cell-boxes");
  EXPECT_EQ(before["error"], now["error"]);
  EXPECT_NE(before["id"], now["id"]);
  ASSERT_EQ(result["plugins"].size(), 2u);
  EXPECT_EQ(result["plugins"][0]["id"], "old");
  EXPECT_NE(result["plugins"][0]["sha256"], result["plugins"][1]["sha256"]);
}

TEST(PluginBuilds, compare_as_the_same_method_and_the_comparison_tells_them_apart) {
  const Folder folder;
  const std::string base = (folder / "base.json").string(), next = (folder / "next.json").string();
  const std::string method = " --assigner example.cell-boxes -q";
  ASSERT_EQ(tool(plugin_run("--plugin " + plugin_file("example") + method + " -o " + base)).code, 0);
  ASSERT_EQ(tool(plugin_run("--plugin " + other_build(folder).string() + method + " -o " + next)).code, 0);
  const Outcome other = tool("compare " + base + " " + next + " --json " + (folder / "c.json").string());
  EXPECT_TRUE(mentions(other.out + other.err, "plug-in example: base 1.0 (example.so, sha256 "))
      << other.out << other.err;
  EXPECT_TRUE(mentions(other.out + other.err, "new 1.0 (newer.so, sha256 "));
  EXPECT_TRUE(mentions(other.out + other.err, "1 case in common"));
  const Json comparison = Json::parse(file_text(folder / "c.json"));
  EXPECT_NE(comparison["base"]["plugins"][0]["sha256"], comparison["new"]["plugins"][0]["sha256"]);
  const Outcome same = tool("compare " + base + " " + base);
  EXPECT_TRUE(mentions(same.out + same.err, "plug-in example: the same file in both")) << same.out << same.err;
}

TEST(PluginBuilds, do_not_merge_into_one_result) {
  const Folder folder;
  const std::string a = (folder / "a.json").string(), b = (folder / "b.json").string(),
                    c = (folder / "c.json").string();
  const std::string method = " --assigner example.cell-boxes -q -o ";
  ASSERT_EQ(tool(plugin_run("--plugin " + plugin_file("example") + method + a)).code, 0);
  ASSERT_EQ(tool(plugin_run("--set seed=2 --plugin " + other_build(folder).string() + method + b)).code, 0);
  ASSERT_EQ(tool(plugin_run("--set seed=2 --plugin " + plugin_file("example") + method + c)).code, 0);
  const Outcome refused = tool("merge " + a + " " + b);
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(mentions(refused.err, "/plugins: has plug-in 'example'")) << refused.err;
  const Outcome merged = tool("merge " + a + " " + c);
  EXPECT_EQ(merged.code, 0) << merged.err;
  EXPECT_EQ(Json::parse(merged.out)["plugins"].size(), 1u);
}

// Kills a run as soon as its journal is there.
void start_and_kill(const std::string& arguments, const std::string& result) {
  const std::string wait = "while [ ! -s " + result + ".partial ]; do sleep 0.01; done";
  const int status = std::system((program() + " " + arguments + " -q -o " + result + " 2>/dev/null & pid=$!; " + wait +
                                  "; kill -KILL $pid; wait $pid 2>/dev/null")
                                     .c_str());
  EXPECT_EQ(WEXITSTATUS(status), 128 + 9);
}

TEST(PluginBuilds, of_an_interrupted_run_are_not_mixed) {
  const Folder folder;
  const fs::path plugin = folder / "p.so";
  fs::copy_file(plugin_file("example"), plugin);
  const std::string result = (folder / "r.json").string();
  const std::string run = "run " + source_file("scenes/street.glb") +
                          " --viewport 320x180 --grid frustum --tiles 64 --slices 4 --rounds 300 --plugin " +
                          plugin.string() + " --assigner example.cell-boxes,aabb";
  start_and_kill(run, result);
  EXPECT_EQ(tool(run + " --resume --dry-run -q -o " + result).code, 0);
  fs::remove(plugin);
  fs::copy_file(other_build(folder), plugin);
  const Outcome refused = tool(run + " --resume --dry-run -q -o " + result);
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(mentions(refused.err, "is an interrupted run of another")) << refused.err;
}

TEST(PluginBuilds, of_a_complete_result_are_not_replaced_by_resume) {
  const Folder folder;
  const fs::path plugin = folder / "p.so";
  fs::copy_file(plugin_file("example"), plugin);
  const std::string result = (folder / "r.json").string(),
                    run = plugin_run("--plugin " + plugin.string() + " --assigner example.cell-boxes -q -o " + result);
  ASSERT_EQ(tool(run).code, 0);
  const std::string before = file_text(result);
  EXPECT_EQ(tool(run + " --resume").code, 0) << "the same build";
  fs::remove(plugin);
  fs::copy_file(other_build(folder), plugin);
  const Outcome refused = tool(run + " --resume");
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(mentions(refused.err, "is a complete result, with another build of the plug-in example (sha256 "))
      << refused.err;
  EXPECT_EQ(Json::parse(file_text(result))["plugins"], Json::parse(before)["plugins"]);
  EXPECT_FALSE(fs::exists(result + ".partial"));
  EXPECT_EQ(tool(run).code, 0);
  EXPECT_NE(Json::parse(file_text(result))["plugins"], Json::parse(before)["plugins"]);
}

TEST(PluginTimes, launches_load_the_same_plugins) {
  const Folder folder;
  const Json result =
      plugin_result(folder, "run " + source_file("scenes/street.glb") +
                                " --viewport 320x180 --grid frustum --tiles 64 --slices 4 --set 'scenes.*.frames=2' "
                                "--set timing.min_time_ms=1 --rounds 4 --launches 2 --plugin " +
                                plugin_file("example") + " --assigner example.cell-boxes,brute-force");
  EXPECT_EQ(case_of_method(result, "example.cell-boxes")["timing"]["launches"], 2);
  EXPECT_GT(case_of_method(result, "example.cell-boxes")["timing"]["frame_ns"]["median"], 0.0);
}

TEST(PluginTimes, another_program_measures_the_same_plugin) {
  const Folder folder;
  const std::string file = (folder / "r.json").string();
  const Outcome outcome = tool(
      "run " + source_file("scenes/street.glb") +
      " --viewport 320x180 --grid frustum --tiles 64 --slices 4 --set 'scenes.*.frames=2' --set timing.min_time_ms=1 "
      "--rounds 4 --baseline-launches 2 --baseline-most-launches 2 -q -o " +
      file + " --plugin " + plugin_file("example") + " --assigner example.cell-boxes --baseline-binary " + program());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(mentions(outcome.err, "plug-in example: the same file in both")) << outcome.err;
}

TEST(PluginStress, checks_methods_of_plugins) {
  const Outcome right =
      tool("stress --plugin " + plugin_file("example") + " --methods '^example' --random 40 --seed 3 -q -o /dev/null");
  EXPECT_EQ(right.code, 0) << right.err;
  const Folder folder;
  const Outcome written =
      tool("stress --plugin " + plugin_file("hostile") +
           " --methods 'hostile.loses$' --random 40 -q -o /dev/null --failures " + folder.path().string());
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.path()))
    if (entry.path().extension() == ".json") {  // runs as it stands, and fails
      const Outcome again = tool("run " + entry.path().string() + " -q -o /dev/null");
      EXPECT_EQ(again.code, 1) << again.err;
      EXPECT_TRUE(mentions(again.err, "hostile.loses")) << again.err;
    }
  EXPECT_FALSE(fs::is_empty(folder.path())) << written.err;
  const Outcome wrong =
      tool("stress --plugin " + plugin_file("hostile") + " --methods 'hostile.loses$' --random 40 -q -o /dev/null");
  EXPECT_EQ(wrong.code, 1);
  EXPECT_TRUE(mentions(wrong.err, "hostile.loses")) << wrong.err;
}

TEST(PluginOtherCommands, take_methods_of_plugins) {
  const std::string scene = source_file("scenes/street.glb"), plugin = " --plugin " + plugin_file("example");
  const Outcome sized = tool("size " + scene + plugin +
                             " --viewport 320x180 --grid frustum --tiles 64 --slices 4 --assigner "
                             "example.cell-boxes --set 'scenes.*.frames=2' -q");
  EXPECT_EQ(sized.code, 0) << sized.err;
  EXPECT_TRUE(mentions(sized.out, "example.cell-boxes")) << sized.out;
  const Outcome listed = tool("list assigners" + plugin);
  EXPECT_TRUE(
      mentions(listed.out, "example.cell-boxes: all cells whose bounding box is touched by its ball [an example]"));
}

}  // namespace
}  // namespace clusterbench::test
