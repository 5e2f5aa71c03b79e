#include "cli/processes/plugin_tests.h"

#include <cstdio>

#include "acceptance/acceptance_test.h"
#include "core/error.h"
#include "core/json_document.h"
#include "core/text.h"
#include "os/own_output.h"
#include "os/process.h"
#include "plugin/plugins.h"
#include "run/records/records.h"

namespace clusterbench::cli {
namespace {

using Json = nlohmann::ordered_json;

const plugin::LoadedPlugin& loaded(const PluginCheckRequest& request) {
  const plugin::PluginName name = plugin::plugin_name(request.file);
  return plugin::load_plugin(name.file, name.id);
}

PluginDescription description_here(const PluginCheckRequest& request) {
  const plugin::LoadedPlugin& plugin = loaded(request);
  PluginDescription out{run::record_of(plugin), {}};
  for (const plugin::MethodFacts& method : plugin.facts.methods) out.methods.push_back(method.descriptor.name);
  return out;
}

const plugin::MethodFacts& method_of(const plugin::LoadedPlugin& plugin, const std::string& name) {
  for (const plugin::MethodFacts& method : plugin.facts.methods)
    if (method.descriptor.name == name) return method;
  throw Error("", k_serve_test, "names no method of the plug-in", ExitCode::internal);
}

result::PluginTest test_here(const PluginCheckRequest& request, const std::string& method, const std::string& test) {
  const plugin::LoadedPlugin& plugin = loaded(request);
  const acceptance::Subject subject{plugin.file.string(), &method_of(plugin, method), request.seed, request.seconds};
  const acceptance::AcceptanceTest* row = acceptance::find_test(test);
  if (row == nullptr) throw Error("", k_serve_test, "names no test", ExitCode::internal);
  const acceptance::Findings findings = acceptance::run_test(*row, subject);
  const bool is_skipped = !findings.skipped.empty() && findings.faults.empty();
  return {method, test,
          is_skipped                ? "skipped"
          : findings.faults.empty() ? "passed"
                                    : "failed",
          is_skipped ? std::vector{findings.skipped} : findings.faults, findings.detail};
}

Json to_json(const PluginDescription& description) {
  return {{"plugin", result::to_json(description.plugin)}, {"methods", description.methods}};
}

// What the other process answered, or how it ended without an answer.
struct Answer {
  std::optional<Json> json;
  bool is_late = false, is_stopped = false;
  os::Ending ending;
};

Answer answer_of(const PluginCheckRequest& request, const std::string& asked, double seconds,
                 const std::atomic<bool>& stop) {
  os::Conversation child({os::this_program(), "plugin", "check", std::string(k_serve_test) + "=" + asked,
                          "--seed=" + std::to_string(request.seed), "--seconds=" + std::to_string(request.seconds),
                          "--", request.file});
  Answer answer;
  std::string line;
  const os::Conversation::Received received = child.receive_line(line, seconds, stop);
  answer.is_stopped = received == os::Conversation::Received::stop;
  answer.is_late = received == os::Conversation::Received::timeout;
  if (received == os::Conversation::Received::line)
    if (Json json = json_or_discarded<Json>(line); json.is_object()) answer.json = std::move(json);
  answer.ending = child.end();
  return answer;
}

// How its process ended, with what was said last: by the guards of arrays, or by the plug-in.
std::string ending_text(const os::Ending& ending) {
  const std::string said = printable(ending.error_tail);
  return "ended its process" + (ending.how.empty() ? "" : ": " + ending.how) + (said.empty() ? "" : "; " + said);
}

std::string time_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g s", seconds);
  return text;
}

double time_for(const PluginCheckRequest& request, const std::string& test) {
  const acceptance::AcceptanceTest* row = acceptance::find_test(test);
  return request.timeout_s + (row != nullptr && row->takes_seconds ? request.seconds : 0.0);
}

}  // namespace

PluginDescription description_of(const PluginCheckRequest& request, const std::atomic<bool>& stop) {
  if (request.in_process) return description_here(request);
  const Answer answer = answer_of(request, k_description, request.timeout_s, stop);
  if (answer.json) return {result::from_json<result::Plugin>(answer.json->at("plugin")), answer.json->at("methods")};
  if (answer.ending.exit_code == static_cast<int>(ExitCode::usage)) {
    std::string said = answer.ending.error_tail;
    constexpr std::string_view k_prefix = "clusterbench: ";
    if (said.starts_with(k_prefix)) said.erase(0, k_prefix.size());
    throw Error("", "", said);
  }
  throw Error(request.file, "",
              answer.is_late ? "is not loaded within " + time_text(request.timeout_s)
                             : "cannot be loaded: it " + ending_text(answer.ending),
              ExitCode::gate_failed);
}

std::optional<result::PluginTest> tested(const PluginCheckRequest& request, const std::string& method,
                                         const std::string& test, const std::atomic<bool>& stop) {
  if (request.in_process) return test_here(request, method, test);
  const double seconds = time_for(request, test);
  const Answer answer = answer_of(request, method + "/" + test, seconds, stop);
  if (answer.json) return result::from_json<result::PluginTest>(*answer.json);
  if (answer.is_stopped || stop) return {};
  if (answer.is_late)
    return result::PluginTest{method, test, "timed_out", {"was not done within " + time_text(seconds)}, ""};
  return result::PluginTest{method, test, "crashed", {ending_text(answer.ending)}, ""};
}

void serve_test(const PluginCheckRequest& request, const std::string& asked) {
  const os::OwnOutput output;
  const std::size_t slash = asked.rfind('/');
  const Json answer = asked == k_description
                          ? to_json(description_here(request))
                          : result::to_json(test_here(request, asked.substr(0, slash), asked.substr(slash + 1)));
  output.write_line(answer.dump());
}

}  // namespace clusterbench::cli
