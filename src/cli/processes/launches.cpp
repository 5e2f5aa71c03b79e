#include "cli/processes/launches.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "assign/contract/method_error.h"
#include "cli/processes/handover.h"
#include "core/error.h"
#include "core/json_document.h"
#include "os/call_notes.h"
#include "os/process.h"
#include "run/passes/timing_pass.h"

namespace clusterbench::cli {
namespace {

using Json = nlohmann::ordered_json;
using run::GroupSamples;
using run::MethodSamples;
using run::StoreSamples;

constexpr const char* k_ready = "ready";
constexpr const char* k_method_error = "method_error";

Json to_json(const StoreSamples& store) {
  return {{"warm_ns", store.warm_ns},
          {"warm_each", store.warm_each},
          {"cold_each", store.cold_each},
          {"warm_passes", store.warm_passes}};
}

StoreSamples store_samples(const Json& json) {
  return {json.at("warm_ns"), json.at("warm_each"), json.at("cold_each"), json.at("warm_passes")};
}

Json to_json(const MethodSamples& method) {
  Json stores = Json::array();
  for (const StoreSamples& store : method.stores) stores.push_back(to_json(store));
  Json out{{"frames", method.frames},
           {"mean_frames", method.mean_frames},
           {"pairs", method.pairs},
           {"builds_per_frame", method.builds_per_frame},
           {"build_ns", method.build_ns},
           {"warm_ns", method.warm_ns},
           {"floor_ns", method.floor_ns},
           {"warm_each", method.warm_each},
           {"cold_each", method.cold_each},
           {"warm_passes", method.warm_passes},
           {"stores", stores}};
  if (!method.cull_warm_ns.empty())
    out["cull"] = {
        {"warm_ns", method.cull_warm_ns}, {"warm_each", method.cull_warm_each}, {"cold_each", method.cull_cold_each}};
  return out;
}

MethodSamples method_samples(const Json& json) {
  MethodSamples method{json.at("frames"),
                       json.at("mean_frames"),
                       json.at("pairs"),
                       json.at("builds_per_frame"),
                       json.at("build_ns"),
                       json.at("warm_ns"),
                       json.at("floor_ns"),
                       json.at("warm_each"),
                       json.at("cold_each"),
                       json.at("warm_passes"),
                       {}};
  for (const Json& store : json.at("stores")) method.stores.push_back(store_samples(store));
  if (json.contains("cull")) {
    method.cull_warm_ns = json["cull"].at("warm_ns").get<std::vector<double>>();
    method.cull_warm_each = json["cull"].at("warm_each").get<std::vector<run::EachFrame>>();
    method.cull_cold_each = json["cull"].at("cold_each").get<std::vector<run::EachFrame>>();
  }
  return method;
}

Json to_json(const GroupSamples& group) {
  Json methods = Json::array();
  for (const MethodSamples& method : group.methods) methods.push_back(to_json(method));
  const run::Disturbance& d = group.disturbance;
  return {{"methods", methods},
          {"follow_ns", group.follow_ns},
          {"disturbance", {d.seconds, d.others_s, d.stolen_s, d.throttled}}};
}

GroupSamples group_samples(const Json& json) {
  GroupSamples group;
  for (const Json& method : json.at("methods")) group.methods.push_back(method_samples(method));
  group.follow_ns = json.value("follow_ns", std::vector<double>{});
  const Json& d = json.at("disturbance");
  group.disturbance = {d.at(0), d.at(1), d.at(2), d.at(3)};
  return group;
}

std::string hash_of(const std::string& id) {
  return id.substr(0, id.find('-'));
}

GroupSamples measured(const config::Config& config, const run::Plan& plan, const Json& request) {
  const run::GroupPlan group = group_to_measure(plan, request.at("ids"));
  const run::PathFrames path = run::path_of(config, plan, group);
  const std::atomic<bool> stop{false};
  return run::measure_launch(
      config, group, path, {request.at("launch"), request.at("rounds"), request.at("fullest_frames")}, [](int) {},
      stop);
}

Json to_json(const assign::MethodError& error) {
  return {{"file", error.file()}, {"method", error.method()}, {"message", error.message()}};
}

assign::MethodError method_error(const Json& json) {
  return {json.at("file"), json.at("method"), json.at("message")};
}

Json answer_to(const config::Config& config, const run::Plan& plan, const std::string& request) {
  try {
    return to_json(measured(config, plan, Json::parse(request)));
  } catch (const assign::MethodError& error) {
    return {{k_method_error, to_json(error)}};
  }
}

Json request_for(const run::GroupToTime& group, int launch, int rounds) {
  Json ids = Json::array();
  for (const run::CasePlan& case_plan : group.group->cases) ids.push_back(case_plan.id);
  return {{"ids", ids}, {"launch", launch}, {"rounds", rounds}, {"fullest_frames", group.fullest_frames}};
}

// One further process.
class Launch {
 public:
  Launch(const config::Config& config, const run::Plan& plan, std::size_t scene, const std::atomic<bool>& stop)
      : stop_(stop), child_({os::this_program(), "run", k_serve_launch, "--", file_argument(config)}) {
    child_.send_line(handover_line(config, plan, scene));
    if (const std::optional<std::string> line = next_line(); line && *line != k_ready)
      fail("greets with '" + *line + "'");
  }

  // nullopt if stopped.
  std::optional<Json> answer(const Json& request) {
    child_.send_line(request.dump());
    const std::optional<std::string> line = next_line();
    if (!line) return std::nullopt;
    Json read = json_or_discarded<Json>(*line);
    if (read.is_object() && read.contains(k_method_error)) throw method_error(read[k_method_error]);
    if (!read.is_object()) fail("answered '" + line->substr(0, 100) + "'");
    return read;
  }

 private:
  std::optional<std::string> next_line() {
    constexpr double k_no_end_s = 1e9;  // no timeout: work that is slow in a child process is slow in this one, too
    std::string line;
    const os::Conversation::Received received =
        stop_ ? os::Conversation::Received::stop : child_.receive_line(line, k_no_end_s, stop_);
    if (received == os::Conversation::Received::line) return line;
    // Ctrl-C signals both processes, and the launch may end before `stop_` is set here.
    for (int i = 0; i < 20 && !stop_; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (stop_) return std::nullopt;
    const os::Ending ending = child_.end();
    os::end_with_call(ending.wait_status);
    const bool refuses = ending.exit_code == static_cast<int>(ExitCode::usage);
    fail("ended" + (ending.how.empty() ? "" : " (" + ending.how + ")"), refuses ? ExitCode::usage : ExitCode::internal);
  }

  [[noreturn]] void fail(const std::string& problem, ExitCode code = ExitCode::internal) const {
    const std::string errors = child_.error_tail();
    throw Error("", "--launches", "a process that was to measure " + problem + (errors.empty() ? "" : ": " + errors),
                code);
  }

  const std::atomic<bool>& stop_;
  os::Conversation child_;
};

}  // namespace

run::GroupPlan group_to_measure(const run::Plan& plan, const std::vector<std::string>& ids) {
  const auto place = [&](const run::CasePlan& case_plan) {
    return std::ranges::find(ids, hash_of(case_plan.id), hash_of) - ids.begin();
  };
  for (run::GroupPlan group : plan.groups) {
    std::erase_if(group.cases, [&](const run::CasePlan& one) { return place(one) == std::ssize(ids); });
    if (group.cases.empty() || group.cases.size() != ids.size()) continue;
    std::ranges::stable_sort(group.cases, {}, place);
    return group;
  }
  throw Error("", k_serve_launch, "has no group with the cases that are asked for", ExitCode::internal);
}

void serve_launch(const config::Config& config, const run::Plan& plan) {
  std::cout << k_ready << std::endl;
  for (std::string line; std::getline(std::cin, line);) std::cout << answer_to(config, plan, line).dump() << std::endl;
}

run::Launcher make_launcher(const config::Config& config, const run::Plan& plan, report::Journal* journal,
                            const std::atomic<bool>& stop) {
  return [&config, &plan, journal, &stop](std::span<const run::GroupToTime> groups, int launch, int rounds,
                                          const std::function<void(std::size_t)>& on_group) {
    std::vector<GroupSamples> all;
    std::optional<Launch> process;
    for (std::size_t i = 0; i < groups.size() && !stop; ++i) {
      on_group(i);
      const Json request = request_for(groups[i], launch, rounds);
      std::optional<Json> answer = journal == nullptr ? std::nullopt : journal->earlier_answer(request);
      if (!answer) {
        if (!process) process.emplace(config, plan, groups.front().group->scene, stop);
        answer = process->answer(request);
        if (!answer) break;
        if (journal != nullptr) journal->add_answer(request, *answer);
      }
      all.push_back(group_samples(*answer));
    }
    return all;
  };
}

}  // namespace clusterbench::cli
