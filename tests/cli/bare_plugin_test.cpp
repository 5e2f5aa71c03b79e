// Plug-ins on the C header alone, from whose functions exceptions come, and which change what is not theirs.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/small_config.h"
#include "cli/tool.h"

namespace clusterbench::test {
namespace {

using BareJson = nlohmann::json;

std::string bare_plugin(const std::string& name = "bare") {
  return plugin_folder() + "/" + name + ".so";
}

bool has_part(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string small_run_of(const std::string& command, const std::string& method, const std::string& plugin = "bare") {
  return command + " " + source_file("scenes/street.glb") +
         " --viewport 640x360 --grid frustum --tiles 64 --slices 8 --set 'scenes.*.frames=2' --plugin " +
         bare_plugin(plugin) + " --assigner exact-fast,bare." + method + " ";
}

const std::pair<const char*, const char*> k_bare_faults[] = {
    {"throws", "an exception left assign(): vector::_M_range_check"},
    {"throws-bytes", "an exception left assign(): a"},
    {"throws-in-build", "an exception left build(): of the type int"},
    {"writes-struct", "build() wrote to the grid's struct, which is to be read only"},
    {"cuts-files", "wrote to a file of the program, or cut it (descriptor "},
    {"writes-to-files", "wrote to a file of the program, or cut it (descriptor "},
#ifdef __x86_64__
    {"leaves-mmx", "assign() left the x87 registers in use (MMX code without emms)"},
#endif
};

TEST(BarePlugin, whose_call_goes_wrong_loses_its_case_alone) {
  for (const auto& [method, told] : k_bare_faults) {
    const Folder folder;
    const std::string file = (folder / "r.json").string();
    const Outcome done = tool(small_run_of("run", method) + "--no-timing -q -o " + file);
    EXPECT_EQ(done.code, 1) << method << "\n" << done.err;
    const BareJson result = BareJson::parse(file_text(file), nullptr, false);
    ASSERT_TRUE(result.is_object()) << method << "\n" << done.err;
    EXPECT_EQ(result["cases"][0]["assigner"]["name"], "exact-fast") << method;
    ASSERT_EQ(result["broken"].size(), 1u) << method;
    EXPECT_TRUE(has_part(result["broken"][0]["reason"], told)) << method << ": " << result["broken"][0]["reason"];
  }
}

TEST(BarePlugin, from_which_an_exception_comes_is_named_by_every_command) {
  const Outcome sized = tool(small_run_of("size", "throws") + "-q");
  EXPECT_EQ(sized.code, 1) << sized.err;
  EXPECT_TRUE(has_part(sized.err, "FAILED ") && has_part(sized.err, "an exception left assign()")) << sized.err;
  const Outcome recommended = tool(small_run_of("recommend", "throws") + "-q");
  EXPECT_EQ(recommended.code, 1) << recommended.err;
  EXPECT_TRUE(has_part(recommended.err, "an exception left assign()")) << recommended.err;
  const Outcome stressed =
      tool("stress --random 40 --seed 1 --methods 'bare.throws,exact-fast' --plugin " + bare_plugin());
  EXPECT_EQ(stressed.code, 1) << stressed.err;
  EXPECT_TRUE(has_part(stressed.out + stressed.err, "an exception left assign()")) << stressed.out << stressed.err;
}

TEST(BarePlugin, whose_create_or_destroy_throws_loses_its_case_alone) {
  const std::pair<const char*, const char*> k_told[] = {{"create-throws", "an exception left create(): no table"},
                                                        {"destroy-throws", "an exception left destroy(): no end"}};
  for (const auto& [plugin, told] : k_told) {
    const Folder folder;
    const std::string file = (folder / "r.json").string();
    const Outcome done = tool(small_run_of("run", "leaves-mmx", plugin) + "--no-timing -q -o " + file);
    EXPECT_EQ(done.code, 1) << done.err;
    EXPECT_TRUE(has_part(done.err, told)) << done.err;
    const BareJson result = BareJson::parse(file_text(file), nullptr, false);
    ASSERT_TRUE(result.is_object()) << done.err;
    EXPECT_EQ(result["cases"].size(), 1u);
    const Outcome checked = tool("plugin check " + bare_plugin(plugin) +
                                 " --method bare.masks-files --test unknown-parameters --test grids");
    EXPECT_EQ(checked.code, 1) << checked.err;
    EXPECT_TRUE(has_part(checked.out, told)) << checked.out;
  }
}

TEST(BarePlugin, whose_entry_throws_is_no_plugin) {
  for (const std::string& command : {std::string("list assigners"), "run " + source_file("scenes/street.glb")}) {
    const Outcome done = tool(command + " --plugin " + bare_plugin("entry-throws"));
    EXPECT_EQ(done.code, 2) << command << done.err;
    EXPECT_TRUE(has_part(done.err, "entry-throws.so: an exception left clusterbench_plugin_entry(): no licence"))
        << done.err;
  }
}

const std::tuple<const char*, const char*, const char*> k_bare_checks[] = {
    {"throws", "grids", "an exception left assign(): vector::_M_range_check"},
    {"throws", "guards", "an exception left assign(): vector::_M_range_check"},
    {"throws-bytes", "grids", "an exception left assign(): a"},
    {"throws-in-build", "capacity", "an exception left build(): of the type int"},
    {"writes-struct", "grids", "wrote to the grid's struct"},
    {"sets-variable", "surroundings", "changes the environment (LC_MESSAGES)"},
    {"masks-files", "surroundings", "changes the mask of new files (umask), to 000"},
    {"limits-files", "surroundings", "changes the limit RLIMIT_NOFILE, to 64 (at most 64)"},
    {"blocks-signals", "surroundings", "changes the blocked signals, to SIGALRM"},
    {"is-nice", "surroundings", "changes the priority, to 19"},
};

TEST(BarePlugin, that_is_checked_is_told_what_left_which_call) {
  for (const auto& [method, test, told] : k_bare_checks) {
    const Folder folder;
    const std::string file = (folder / "c.json").string();
    const Outcome done = tool("plugin check " + bare_plugin() + " --seconds 0 -q --method bare." + method + " --test " +
                              test + " --json " + file);
    EXPECT_EQ(done.code, 1) << method << done.err;
    const BareJson check = BareJson::parse(file_text(file), nullptr, false);
    ASSERT_TRUE(check.is_object()) << method << ", " << test << "\n" << done.err;
    EXPECT_EQ(check["tests"][0]["verdict"], "failed") << check["tests"][0];
    EXPECT_TRUE(has_part(check["tests"][0]["reasons"].dump(), told)) << method << ": " << check["tests"][0];
  }
}

TEST(StressOfAMethod, that_no_drawn_setting_suits_says_that_nothing_was_checked) {
  const Outcome done = tool("stress --random 1 --seed 1 --methods bare.throws --plugin " + bare_plugin());
  EXPECT_TRUE(has_part(done.out + done.err, "nothing was checked")) << done.out << done.err;
}

}  // namespace
}  // namespace clusterbench::test
