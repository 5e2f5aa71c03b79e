// `clusterbench plugin check PLUGIN`: whether the methods of a plug-in keep their contract.

#include <algorithm>
#include <iostream>
#include <memory>

#include "acceptance/acceptance_test.h"
#include "cli/command_line/commands.h"
#include "cli/output/output.h"
#include "cli/processes/plugin_tests.h"
#include "core/text.h"
#include "os/stop_signals.h"

namespace clusterbench::cli {
namespace {

struct PluginFlags {
  PluginCheckRequest request;
  std::vector<std::string> tests, methods;
  std::string json, asked;
  bool quiet = false;
};

bool is_passed(const result::PluginTest& test) {
  return test.verdict == "passed" || test.verdict == "skipped";
}

// "passed    grids: 12 frames", and a line for each reason.
std::string text_of(const result::PluginTest& test) {
  std::string verdict = test.verdict;
  std::ranges::replace(verdict, '_', ' ');
  if (!is_passed(test)) std::ranges::transform(verdict, verdict.begin(), ::toupper);
  std::string text = "  " + verdict + std::string(verdict.size() < 10 ? 10 - verdict.size() : 1, ' ') + test.test +
                     (test.looked_at.empty() ? "" : ": " + test.looked_at) + "\n";
  for (const std::string& reason : test.reasons) text += "            " + reason + "\n";
  return text;
}

std::string heading_of(const result::Plugin& plugin) {
  return plugin.name + " " + plugin.version + " (" + plugin.id + "; " + plugin.file + ", interface " +
         plugin.interface_version + ")\n";
}

// What to do now.
std::string last_line(const result::PluginCheck& check, const std::string& file) {
  const auto failed = std::ranges::find_if_not(check.tests, is_passed);
  if (failed == check.tests.end())
    return "All tests passed. `clusterbench run level.glb --plugin " + file + "` measures it beside other methods.";
  const std::vector<std::string> words{"clusterbench", "plugin", "check",      file,          "--method",
                                       failed->method, "--test", failed->test, "--in-process"};
  return "To see the first failure in a debugger: gdb --args " + shell_command(words);
}

std::vector<std::string> chosen_tests(const PluginFlags& flags) {
  std::vector<std::string> names;
  for (const acceptance::AcceptanceTest& test : acceptance::acceptance_tests())
    if (flags.tests.empty() || std::ranges::find(flags.tests, test.name) != flags.tests.end())
      names.emplace_back(test.name);
  return names;
}

std::vector<std::string> chosen_methods(const PluginFlags& flags, const std::vector<std::string>& all) {
  for (const std::string& name : flags.methods)
    if (std::ranges::find(all, name) == all.end())
      throw Error("", "--method", "'" + name + "' is none of " + joined(all) + did_you_mean(name, all));
  return flags.methods.empty() ? all : flags.methods;
}

// Keeps the tests that were run.
ExitCode stopped_check(const PluginFlags& flags, LaterOutput& output, result::PluginCheck& done) {
  done.verdict = "incomplete";
  if (!flags.json.empty()) output.write(result::to_json(done));
  print_message("interrupted after " + number_of(done.tests.size(), "test") +
                (flags.json.empty() ? "" : "; " + flags.json + " has them, with the verdict 'incomplete'"));
  return os::stopped_exit_code();
}

ExitCode check(const PluginFlags& flags) {
  if (!flags.asked.empty()) {
    serve_test(flags.request, flags.asked);
    return ExitCode::ok;
  }
  refuse_overwriting({flags.json}, {flags.request.file});
  LaterOutput output(flags.json, flags.json.empty());
  std::ostream& out = flags.json == "-" ? std::cerr : std::cout;
  const std::atomic<bool>& stop = os::stop_on_signals();
  const PluginDescription description = description_of(flags.request, stop);
  result::PluginCheck done{1, description.plugin, flags.request.seed, flags.request.seconds, {}, "passed"};
  if (!flags.quiet) out << printable_lines(heading_of(description.plugin));
  for (const std::string& method : chosen_methods(flags, description.methods)) {
    if (!flags.quiet) out << method << std::endl;
    for (const std::string& test : chosen_tests(flags)) {
      const std::optional<result::PluginTest> one = stop ? std::nullopt : tested(flags.request, method, test, stop);
      if (!one) return stopped_check(flags, output, done);
      if (!is_passed(*one)) done.verdict = "failed";
      if (!flags.quiet) out << printable_lines(text_of(*one)) << std::flush;
      done.tests.push_back(*one);
    }
  }
  if (!flags.json.empty()) output.write(result::to_json(done));
  if (!flags.quiet) out << last_line(done, flags.request.file) << "\n";
  return done.verdict == "passed" ? ExitCode::ok : ExitCode::gate_failed;
}

// A line for each test.
std::string tests_text() {
  std::string text = "Tests:\n";
  for (const acceptance::AcceptanceTest& test : acceptance::acceptance_tests())
    text += std::string("  ") + test.name + ": " + test.asks + "\n";
  return text;
}

}  // namespace

void add_plugin(Command& program, Action& action) {
  Command group = program.add_command("plugin", "Plug-ins: methods of your own, in a shared library");
  group.needs_command();
  auto flags = std::make_shared<PluginFlags>();
  Command command = group.add_command("check", "Check that the methods of a plug-in keep their contract");
  command.add_option("PLUGIN", flags->request.file, "Shared library (.so), see docs/plugins.md").required().utf8();
  std::vector<std::string> names;
  for (const acceptance::AcceptanceTest& test : acceptance::acceptance_tests()) names.emplace_back(test.name);
  command.add_option("--test", flags->tests, "NAME, repeatable: only these tests").once_a_name().one_of(names);
  command.add_option("--method", flags->methods, "NAME, repeatable: only these methods").once_a_name();
  command.add_option("--seconds", flags->request.seconds, "For each of the tests that draw until time is over")
      .range(0.0, 1e6)
      .shows_standard();
  command.add_option("--seed", flags->request.seed, "Seed of all that is drawn").seed();
  command.add_option("--timeout", flags->request.timeout_s, "Longest time for a test beside that, in seconds")
      .range(0.1, 1e6)
      .shows_standard();
  command
      .add_option("--memory", flags->request.memory_mib,
                  "Most memory that a test's process may take in calls, beyond what it had at the first one, in MiB")
      .range(1, 1 << 30)
      .shows_standard();
  command.add_flag("--in-process", flags->request.in_process,
                   "All tests in this process, for a debugger; a crash then ends it");
  command.add_option("--json", flags->json, "Write the verdict as JSON to this file; -: standard output");
  command.add_option(k_serve_test, flags->asked, "").hidden();
  command.add_option(k_notes, flags->request.notes, "").hidden();
  command.add_flag("-q,--quiet", flags->quiet, "No text; the exit code is the verdict");
  command.footer(tests_text());
  command.when_named([flags, &action] { action = [flags] { return check(*flags); }; });
}

}  // namespace clusterbench::cli
