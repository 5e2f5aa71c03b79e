// `clusterbench plugin check`.

#include <gtest/gtest.h>

#include <clocale>
#include <nlohmann/json.hpp>

#include "cli/plugin_files.h"
#include "cli/tool.h"
#include "plugin/plugins.h"

namespace clusterbench::test {
namespace {

using Json = nlohmann::json;

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

TEST(PluginCheck, finds_what_a_library_changes_as_it_is_loaded_and_nobody_keeps_its_locale) {
  const std::string file = plugin_file("translating");
  const Outcome outcome = tool("plugin check " + file + k_quick + "--test surroundings");
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_TRUE(mentions(outcome.out, "changes the locale, to C.UTF-8 as it is loaded")) << outcome.out;
  const plugin::PluginFacts facts = plugin::describe_plugin(file);
  EXPECT_EQ(facts.changes_on_loading, std::vector<std::string>{"the locale, to C.UTF-8"});
  EXPECT_STREQ(std::setlocale(LC_ALL, nullptr), "C");
  EXPECT_EQ(plugin::describe_plugin(plugin_file("example")).changes_on_loading, std::vector<std::string>{});
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
