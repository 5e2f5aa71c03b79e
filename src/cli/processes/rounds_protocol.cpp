#include "cli/processes/rounds_protocol.h"

#include <cmath>
#include <iostream>
#include <sstream>

#include "core/error.h"
#include "core/json_document.h"
#include "os/stop_signals.h"
#include "run/records/records.h"
#include "run/timing/served_cases.h"

namespace clusterbench::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* k_version_key = "clusterbench_rounds";

void put(const Json& answer) {
  std::cout << answer.dump() << std::endl;
}

Json digests(run::Program& cases, const std::string& id) {
  Json frames = Json::array();
  for (const run::ListDigest& digest : cases.list_digests(id))
    frames.push_back({{"pairs", digest.pairs}, {"sha256", digest.sha256}});
  return {{"frames", frames}};
}

Json frame_lists(run::Program& cases, const std::string& id, int frame) {
  const run::FrameLists lists = cases.frame_lists(id, frame);
  return {{"cells", {lists.cells.x, lists.cells.y, lists.cells.z}}, {"lights", lists.lights}};
}

Json answer_to(run::Program& cases, const std::string& line) {
  std::istringstream in(line);
  std::string request, id;
  int frame = 0;
  in >> request >> id >> frame;
  if (request == "lists") return digests(cases, id);
  if (request == "frame") return frame_lists(cases, id, frame);
  if (request == "measure") return {{"assign_ns", cases.assign_ns(id)}};
  throw Error("", "--rounds-server", "no request '" + line + "'");
}

}  // namespace

void serve_rounds(const config::Config& config, const run::Plan& plan) {
  run::ServedCases cases(config, plan);
  put({{k_version_key, k_rounds_protocol},
       {"tool", result::to_json(run::record_of(run::tool_facts()))},
       {"cases", cases.case_ids()}});
  for (std::string line; std::getline(std::cin, line);) put(answer_to(cases, line));
}

RemoteProgram::RemoteProgram(const std::vector<std::string>& command, double timeout_s, const std::atomic<bool>& stop)
    : name_(command.front() == os::this_program() ? "this program" : command.front()),
      timeout_s_(timeout_s),
      stop_(stop),
      child_(command) {
  greet();
}

void RemoteProgram::fail(const std::string& problem) const {
  if (stop_) throw Error(name_, "", "interrupted", os::stopped_exit_code());
  const std::string errors = child_.error_tail();
  throw Error(name_, "--baseline-binary", problem + (errors.empty() ? "" : ": " + errors));
}

// A request is "measure ID", "frame ID NUMBER" or the like.
void RemoteProgram::fail_at(const std::string& request, const std::string& problem, bool has_timed_out,
                            ExitCode code) const {
  if (stop_ || tool_.is_null()) fail(problem);
  std::istringstream words(request);
  std::string verb, id;
  words >> verb >> id;
  const std::string errors = child_.error_tail();
  throw ProgramEnded(name_, problem + (errors.empty() ? "" : ": " + errors), id, has_timed_out, code);
}

void RemoteProgram::greet() {
  const Json greeting = answer("its greeting");
  const std::string kind = "is no clusterbench that can be measured beside this one";
  if (!greeting.is_object() || !greeting.contains(k_version_key)) fail(kind + "; it greets otherwise");
  if (greeting[k_version_key] != k_rounds_protocol)
    fail(kind + "; it speaks version " + greeting[k_version_key].dump() + ", this one " +
         std::to_string(k_rounds_protocol));
  try {
    tool_ = greeting.at("tool");
    ids_ = greeting.at("cases").get<std::vector<std::string>>();
  } catch (const nlohmann::json::exception&) {
    fail(kind + "; its greeting lacks tool and cases");
  }
}

Json RemoteProgram::answer(const std::string& request) {
  std::string line;
  switch (child_.receive_line(line, timeout_s_, stop_)) {
    case os::Conversation::Received::line:
      break;
    case os::Conversation::Received::stop:
      fail("interrupted");
    case os::Conversation::Received::timeout:
      fail_at(request, "gave no answer to '" + request + "' in " + std::to_string(std::lround(timeout_s_)) + " s", true,
              ExitCode::usage);
    case os::Conversation::Received::end: {
      const os::Ending ending = child_.end();
      const std::string how = ending.how.empty() ? "" : " (" + ending.how + ")";
      const bool is_by_signal = !ending.how.empty() && ending.exit_code < 0;  // as where a launch dies
      fail_at(request,
              tool_.is_null() ? "is no clusterbench that can be measured beside this one; it ended at once" + how
                              : "ended" + how + " at '" + request + "'",
              false, is_by_signal ? ExitCode::internal : ExitCode::usage);
    }
  }
  Json read = json_or_discarded<Json>(line);
  if (read.is_discarded() && !tool_.is_null()) fail("answered '" + request + "' with '" + line.substr(0, 100) + "'");
  return read;
}

Json RemoteProgram::answer_of(const std::string& request) {
  child_.send_line(request);
  return answer(request);
}

std::vector<run::ListDigest> RemoteProgram::list_digests(const std::string& id) {
  const Json answered = answer_of("lists " + id);
  std::vector<run::ListDigest> digests;
  for (const Json& frame : answered.at("frames")) digests.push_back({frame.at("pairs"), frame.at("sha256")});
  return digests;
}

run::FrameLists RemoteProgram::frame_lists(const std::string& id, int frame) {
  const Json answered = answer_of("frame " + id + " " + std::to_string(frame));
  const Json& cells = answered.at("cells");
  return {{cells.at(0).get<int>(), cells.at(1).get<int>(), cells.at(2).get<int>()},
          answered.at("lights").get<std::vector<std::vector<std::uint32_t>>>()};
}

double RemoteProgram::assign_ns(const std::string& id) {
  const Json answered = answer_of("measure " + id);
  const double ns = answered.at("assign_ns").get<double>();
  if (!(ns > 0.0)) fail("measured " + answered.dump());
  return ns;
}

}  // namespace clusterbench::cli
