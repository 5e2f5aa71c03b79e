#include "cli/processes/plugin_tests.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <sstream>

#include "acceptance/acceptance_test.h"
#include "core/error.h"
#include "core/json_document.h"
#include "core/text.h"
#include "os/call_notes.h"
#include "os/guarded_process.h"
#include "os/orphans.h"
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
  const acceptance::Subject subject{plugin.file.string(), &method_of(plugin, method), request.seed,
                                    request.seconds,      request.timeout_s,          plugin.facts.changes_on_loading};
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
  bool is_late = false, is_stopped = false, is_too_large = false;
  os::Ending ending;
  std::optional<os::GuardedEnd> noted;  // of a process that gave no answer
};

// Waits for a line of its output, and looks at its memory meanwhile.
os::Conversation::Received received_from(os::Conversation& child, const PluginCheckRequest& request, double seconds,
                                         const std::atomic<bool>& stop, Answer& answer, std::string& line) {
  using Received = os::Conversation::Received;
  constexpr double k_look_s = 0.05;
  const std::uint64_t most_bytes = static_cast<std::uint64_t>(request.memory_mib) << 20;
  const auto start = std::chrono::steady_clock::now();
  for (;;) {
    const Received received = child.receive_line(line, std::min(k_look_s, seconds), stop);
    if (received != Received::timeout) return received;
    answer.is_too_large = os::noted_growth() > most_bytes;
    const double spent_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (answer.is_too_large || spent_s > seconds) return received;
  }
}

Answer answer_of(const PluginCheckRequest& request, const std::string& asked, double seconds,
                 const std::atomic<bool>& stop) {
  const os::Orphans orphans;
  os::begin_notes();
  std::vector<std::string> command{os::this_program(),
                                   "plugin",
                                   "check",
                                   std::string(k_serve_test) + "=" + asked,
                                   "--seed=" + std::to_string(request.seed),
                                   "--seconds=" + std::to_string(request.seconds),
                                   "--timeout=" + std::to_string(request.timeout_s)};
  if (const std::string notes = os::path_of_notes(); !notes.empty())
    command.push_back(std::string(k_notes) + "=" + notes);
  command.insert(command.end(), {"--", request.file});
  os::Conversation child(command);
  Answer answer;
  std::string line;
  const os::Conversation::Received received = received_from(child, request, seconds, stop, answer, line);
  answer.is_stopped = received == os::Conversation::Received::stop;
  answer.is_late = received == os::Conversation::Received::timeout && !answer.is_too_large;
  if (received == os::Conversation::Received::line)
    if (Json json = json_or_discarded<Json>(line); json.is_object()) answer.json = std::move(json);
  answer.ending = child.end();
  orphans.end_all();
  if (!answer.json && answer.ending.wait_status >= 0) answer.noted = os::noted_end(answer.ending.wait_status);
  return answer;
}

// " in assign, with seed 17, frustum 12x12t"
std::string place_text(const std::optional<os::NotedCall>& call, bool is_running) {
  if (!call) return "";
  return std::string(is_running ? " in " : " after ") + os::name_of(call->step) +
         (call->setting.empty() ? "" : ", with " + call->setting);
}

// Each line that its process printed, after the name of the test.
void print_said(const std::string& name, const std::string& said) {
  std::istringstream lines(said);
  for (std::string line; std::getline(lines, line);) std::cerr << printable(name + ": " + line) + "\n";
  std::cerr << std::flush;
}

// How its process ended, with what was said last: by the guards of arrays, or by the plug-in.
std::string ending_text(const Answer& answer) {
  const std::string said = printable(answer.ending.error_tail), how = answer.ending.how;
  std::string text = "ended its process", call;
  const std::optional<os::GuardedEnd>& noted = answer.noted;
  if (noted && noted->lost_descriptor >= 0)
    return os::lost_file_text(noted->lost_descriptor, noted->is_file_changed) + place_text(noted->call, true);
  if (noted && noted->has_forked) return "came back twice (it forked)" + place_text(noted->call, true);
  if (noted && noted->has_ended_thread) text += " by ending its thread (pthread_exit)";
  if (noted) text += place_text(noted->call, noted->is_call_running);
  return text + ": " + (how.empty() ? "exit code 0" : how) + (said.empty() ? "" : "; " + said);
}

std::string time_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g s", seconds);
  return text;
}

constexpr const char* k_longer = "; --timeout SECONDS gives it longer";

std::string late_text(const Answer& answer, double seconds) {
  const std::optional<os::GuardedEnd>& noted = answer.noted;
  return "was not done within " + time_text(seconds) +
         (noted ? "; it was" + place_text(noted->call, noted->is_call_running) : "") + k_longer;
}

std::string memory_text(const PluginCheckRequest& request, const Answer& answer) {
  const std::optional<os::GuardedEnd>& noted = answer.noted;
  return "took more than " + std::to_string(request.memory_mib) + " MiB of memory" +
         (noted ? place_text(noted->call, noted->is_call_running) : "") + "; --memory MIB gives it more";
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
              answer.is_late ? "is not loaded within " + time_text(request.timeout_s) + k_longer
                             : "cannot be loaded: it " + ending_text(answer),
              ExitCode::gate_failed);
}

std::optional<result::PluginTest> tested(const PluginCheckRequest& request, const std::string& method,
                                         const std::string& test, const std::atomic<bool>& stop) {
  if (request.in_process) return test_here(request, method, test);
  const double seconds = time_for(request, test);
  const Answer answer = answer_of(request, method + "/" + test, seconds, stop);
  if (answer.json) {
    print_said(method + ", " + test, answer.ending.error_tail);
    return result::from_json<result::PluginTest>(*answer.json);
  }
  if (answer.is_stopped || stop) return {};
  if (answer.is_late) return result::PluginTest{method, test, "timed_out", {late_text(answer, seconds)}, ""};
  if (answer.is_too_large) return result::PluginTest{method, test, "crashed", {memory_text(request, answer)}, ""};
  return result::PluginTest{method, test, "crashed", {ending_text(answer)}, ""};
}

void serve_test(const PluginCheckRequest& request, const std::string& asked) {
  const os::OwnOutput output;
  if (!request.notes.empty()) os::join_notes(request.notes);
  const std::size_t slash = asked.rfind('/');
  const Json answer = asked == k_description
                          ? to_json(description_here(request))
                          : result::to_json(test_here(request, asked.substr(0, slash), asked.substr(slash + 1)));
  output.write_line(answer.dump());
}

}  // namespace clusterbench::cli
