// Plug-ins through the program: the flag, the key, the path variable; results that name the build; `plugin check`.

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "cli/small_config.h"
#include "cli/tool.h"

namespace clusterbench::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

std::string plugin_file(const std::string& name) {
  return plugin_folder() + "/" + name + ".so";
}

bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

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
  fs::resize_file(folder / "cut.so", fs::file_size(folder / "cut.so") / 2);
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

// --- plugin check ---

constexpr const char* k_quick = " --seconds 0.3 --timeout 20 ";

TEST(PluginCheck, passes_the_examples) {
  for (const char* name : {"example", "in-c"}) {
    const Folder folder;
    const Outcome outcome =
        tool("plugin check " + plugin_file(name) + k_quick + "--json " + (folder / "c.json").string());
    EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
    EXPECT_TRUE(mentions(outcome.out, "All tests passed.")) << outcome.out;
    const Json check = Json::parse(file_text(folder / "c.json"));
    EXPECT_EQ(check["verdict"], "passed");
    EXPECT_EQ(check["plugin"]["sha256"], sha256_hex(file_text(plugin_file(name))));
    std::size_t passed = 0;
    for (const Json& test : check["tests"]) passed += test["verdict"] == "passed" ? 1 : 0;
    EXPECT_EQ(passed, check["tests"].size());
    EXPECT_GE(passed, 15u);
    EXPECT_EQ(tool("validate " + (folder / "c.json").string()).code, 0);
  }
}

struct Caught {
  std::string method, test, verdict, reason;
};

const Caught k_caught[] = {
    {"crashes", "grids", "crashed", "signal 11"},
    {"crashes", "capacity", "crashed", "ended its process in assign, with seed "},
    {"aborts", "grids", "crashed", "signal 6"},
    {"exits", "grids", "crashed", "ended its process in assign, with an ordinary view, "},
    {"exits", "guards", "crashed", ": exit code 0"},
    {"forks", "processes", "failed", "came back twice from assign: it forked"},
    {"leaves-child", "processes", "failed", "leaves a process running"},
    {"leaves-thread", "processes", "failed", " more threads after "},
    {"spins", "processes", "failed", " % of a processor busy after destroy()"},
    {"closes", "grids", "crashed",
     "closed a file of the program, or put another in its place (descriptor 1) in assign"},
    {"closes", "guards", "crashed",
     "closed a file of the program, or put another in its place (descriptor 1) in assign"},
    {"handles", "surroundings", "failed", "changes the handler of SIGALRM"},
    {"moves", "surroundings", "failed", "changes the working directory, to /"},
    {"translates", "surroundings", "failed", "changes the locale, to C.UTF-8"},
    {"prints", "surroundings", "failed",
     "prints to standard output, which is for results: \\\"clusterbench plugin check"},
    {"throws", "grids", "failed", "assign() failed: no such tile"},
    {"throws-other", "grids", "failed", "threw what is no std::exception"},
    {"writes-behind", "guards", "crashed", "touched memory 0 bytes behind the end of `lists.begin`"},
    {"writes-input", "guards", "crashed", "wrote to `lights.x`, which is to be read only"},
    {"reads-behind", "guards", "crashed", "touched memory 0 bytes behind the end of `lights.radius`"},
    {"reads-before", "guards", "crashed", "touched memory 4 bytes before the begin of `lights.radius`"},
    {"no-index", "grids", "failed", "a light that does not exist"},
    {"greedy", "capacity", "failed", "has asked for more room 64 times"},
    {"late", "capacity", "crashed", "`lists.lights`"},
    {"remembers", "determinism", "failed", "the same frame again gives other lists"},
    {"shares", "two-instances", "failed", "an instance gives other lists while another one is there"},
    {"leaks", "create-destroy", "failed", "bytes of each instance after destroy()"},
    {"races", "threads", "failed", "on a thread of four"},
    {"counts-builds", "builds", "failed", "the lists depend on the grids that were built before"},
    {"ghost", "no-lights", "failed", "asks for room for 1 pairs where it has room for 0"},
    {"loses", "one-light", "failed", "says that it is conservative"},
    {"loses", "odd-lights", "failed", "says that it is conservative"},
    {"loses", "grids", "failed", "says that it is conservative"},
    {"loses", "hard-cases", "failed", "loss"},
    {"loses", "fuzz", "failed", "loss"},
    {"picky", "parameters", "failed", "with size = 8.000000: "},
    {"prints", "grids", "passed", ""},
    {"good", "guards", "passed", ""},
    {"good", "fuzz", "passed", ""},
    {"good", "hard-cases", "skipped", "it does not say that it is conservative"},
};

// Sanitizers have handlers of their own for signals, and an allocator that tells less.
bool is_for_sanitizers([[maybe_unused]] const Caught& one) {
#ifdef CLUSTERBENCH_SANITIZED
  return !one.reason.starts_with("signal ") && one.test != "create-destroy";
#else
  return true;
#endif
}

TEST(PluginCheck, finds_what_no_plugin_may_do) {
  for (const Caught& one : k_caught) {
    if (!is_for_sanitizers(one)) continue;
    const Folder folder;
    const Outcome outcome = tool("plugin check " + plugin_file("hostile") + k_quick + "-q --method hostile." +
                                 one.method + " --test " + one.test + " --json " + (folder / "c.json").string());
    const Json check = Json::parse(file_text(folder / "c.json"), nullptr, false);
    ASSERT_TRUE(check.is_object()) << one.method << ": " << outcome.err;
    ASSERT_EQ(check["tests"].size(), 1u);
    EXPECT_EQ(check["tests"][0]["verdict"], one.verdict) << one.method << ": " << check["tests"][0];
    EXPECT_TRUE(mentions(check["tests"][0]["reasons"].dump(), one.reason)) << one.method << ": " << check["tests"][0];
    EXPECT_EQ(outcome.code, one.verdict == "passed" || one.verdict == "skipped" ? 0 : 1) << one.method;
  }
}

TEST(PluginCheck, every_test_has_a_plugin_that_fails_it) {
  const Outcome help = tool("plugin check --help");
  std::set<std::string> tests;
  std::istringstream lines(help.out.substr(help.out.find("Tests:")));
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("  ")) tests.insert(line.substr(2, line.find(':') - 2));
  EXPECT_GE(tests.size(), 15u);
  const Outcome takes_all = tool("plugin check " + plugin_file("takes-all") + " --test unknown-parameters");
  EXPECT_EQ(takes_all.code, 1);
  EXPECT_TRUE(mentions(takes_all.out, "create() with a parameter 'no-such-parameter' gave status 0")) << takes_all.out;
  tests.erase("unknown-parameters");
  for (const Caught& one : k_caught)
    if (one.verdict == "failed" || one.verdict == "crashed") tests.erase(one.test);
  EXPECT_TRUE(tests.empty()) << *tests.begin();
}

TEST(PluginCheck, ends_a_method_that_hangs) {
  const Outcome outcome =
      tool("plugin check " + plugin_file("hostile") + " --method hostile.hangs --test grids --timeout 0.5");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(mentions(outcome.out, "TIMED OUT grids")) << outcome.out;
  EXPECT_TRUE(mentions(outcome.out, "was not done within 0.5 s; it was in assign, with an ordinary view, "))
      << outcome.out;
  EXPECT_TRUE(mentions(outcome.out, "; --timeout SECONDS gives it longer")) << outcome.out;
  EXPECT_TRUE(mentions(outcome.out, "gdb --args clusterbench plugin check ")) << outcome.out;
}

TEST(PluginCheck, ends_a_method_that_takes_too_much_memory) {
  const Outcome outcome =
      tool("plugin check " + plugin_file("hostile") + " --method hostile.eats --test grids --memory 200");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(mentions(outcome.out, "CRASHED   grids")) << outcome.out;
  EXPECT_TRUE(mentions(outcome.out, "took more than 200 MiB of memory in assign, with an ordinary view, "))
      << outcome.out;
  EXPECT_TRUE(mentions(outcome.out, "; --memory MIB gives it more")) << outcome.out;
}

TEST(PluginCheck, passes_on_what_a_plugin_prints) {
  const Outcome outcome = tool("plugin check " + plugin_file("hostile") + " --method hostile.prints --test grids");
  EXPECT_EQ(outcome.code, 0) << outcome.out;
  EXPECT_TRUE(mentions(outcome.err, "hostile.prints, grids: {\"verdict\": \"passed\"}")) << outcome.err;
}

TEST(PluginCheck, makes_slow_instances_less_often) {
  const Outcome outcome =
      tool("plugin check " + plugin_file("hostile") + " --method hostile.slow --test create-destroy --timeout 6");
  EXPECT_EQ(outcome.code, 0) << outcome.out;
  EXPECT_TRUE(mentions(outcome.out, "passed    create-destroy: ")) << outcome.out;
}

TEST(PluginCheck, leaves_no_process_of_a_method_that_hangs_with_its_child) {
  const Outcome outcome = tool("plugin check " + plugin_file("hostile") +
                               " --method hostile.hangs-with-child --test grids --timeout 1 && exit 7; "
                               "for i in /proc/[0-9]*; do tr '\\0' ' ' 2>/dev/null < $i/cmdline; echo; done");
  EXPECT_TRUE(mentions(outcome.out, "plugin check")) << "no command lines are seen";
  EXPECT_FALSE(mentions(outcome.out, "hostile.hangs-with-child/grids")) << outcome.out;
}

TEST(PluginCheck, that_is_interrupted_writes_the_tests_so_far) {
  const Folder folder;
  const std::string file = (folder / "c.json").string(), said = (folder / "err").string();
  const int status =
      std::system(("timeout --foreground -s TERM 8 " + test::program() + " plugin check " + plugin_file("example") +
                   " --test grids --test fuzz --seconds 60 -q --json " + file + " 2>" + said)
                      .c_str());
  EXPECT_EQ(WEXITSTATUS(status), 124) << "timeout's own";
  const Json check = Json::parse(file_text(file), nullptr, false);
  ASSERT_TRUE(check.is_object()) << file_text(said);
  EXPECT_EQ(check["verdict"], "incomplete");
  EXPECT_EQ(check["tests"].size(), 1u);
  EXPECT_TRUE(
      mentions(file_text(said), "interrupted after 1 test; " + file + " has them, with the verdict 'incomplete'"));
  EXPECT_EQ(tool("validate " + file).code, 0);
}

TEST(PluginCheck, tells_a_plugin_that_cannot_be_loaded_from_one_that_fails) {
  const Outcome version = tool("plugin check " + plugin_file("version-2"));
  EXPECT_EQ(version.code, 2);
  EXPECT_TRUE(mentions(version.err, "is made for version 2.0")) << version.err;
  const Outcome crashes = tool("plugin check " + plugin_file("entry-crashes"));
  EXPECT_EQ(crashes.code, 1);
  EXPECT_TRUE(mentions(crashes.err, "cannot be loaded: it ended its process in load: signal 6")) << crashes.err;
  const Outcome hangs = tool("plugin check --timeout 0.5 " + plugin_file("entry-hangs"));
  EXPECT_EQ(hangs.code, 1);
  EXPECT_TRUE(mentions(hangs.err, "is not loaded within 0.5 s")) << hangs.err;
  const Outcome unknown = tool("plugin check " + plugin_file("example") + " --method example.cell-box");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_TRUE(mentions(unknown.err, "did you mean 'example.cell-boxes'?")) << unknown.err;
}

TEST(PluginCheck, runs_in_process_for_a_debugger) {
  const Outcome here = tool("plugin check " + plugin_file("example") + " --in-process --test guards --test capacity");
  EXPECT_EQ(here.code, 0) << here.out << here.err;
  const Outcome crash =
      tool("plugin check " + plugin_file("hostile") + " --in-process --method hostile.writes-behind --test guards");
  EXPECT_GE(crash.code, 128);
  EXPECT_TRUE(mentions(crash.err, "touched memory 0 bytes behind the end of `lists.begin`")) << crash.err;
}

}  // namespace
}  // namespace clusterbench::test
