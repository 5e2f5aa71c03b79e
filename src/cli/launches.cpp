#include "cli/launches.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/child.h"
#include "cli/temporary_folder.h"
#include "core/error.h"
#include "run/passes/timing_pass.h"

namespace clusterbench::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using run::GroupSamples;
using run::MethodSamples;
using run::StoreSamples;

constexpr const char* k_ready = "ready";

Json to_json(const StoreSamples& store) {
  return {{"warm_ns", store.warm_ns}, {"warm_each", store.warm_each}, {"cold_each", store.cold_each}};
}

StoreSamples store_samples(const Json& json) {
  return {json.at("warm_ns"), json.at("warm_each"), json.at("cold_each")};
}

Json to_json(const MethodSamples& method) {
  Json stores = Json::array();
  for (const StoreSamples& store : method.stores) stores.push_back(to_json(store));
  return {{"frames", method.frames},       {"mean_frames", method.mean_frames},
          {"pairs", method.pairs},         {"builds_per_frame", method.builds_per_frame},
          {"build_ns", method.build_ns},   {"warm_ns", method.warm_ns},
          {"floor_ns", method.floor_ns},   {"warm_each", method.warm_each},
          {"cold_each", method.cold_each}, {"stores", stores}};
}

MethodSamples method_samples(const Json& json) {
  MethodSamples method{json.at("frames"),    json.at("mean_frames"),
                       json.at("pairs"),     json.at("builds_per_frame"),
                       json.at("build_ns"),  json.at("warm_ns"),
                       json.at("floor_ns"),  json.at("warm_each"),
                       json.at("cold_each"), {}};
  for (const Json& store : json.at("stores")) method.stores.push_back(store_samples(store));
  return method;
}

Json to_json(const GroupSamples& group) {
  Json methods = Json::array();
  for (const MethodSamples& method : group.methods) methods.push_back(to_json(method));
  const run::Disturbance& d = group.disturbance;
  return {{"methods", methods}, {"disturbance", {d.seconds, d.others_s, d.stolen_s, d.throttled}}};
}

GroupSamples group_samples(const Json& json) {
  GroupSamples group;
  for (const Json& method : json.at("methods")) group.methods.push_back(method_samples(method));
  const Json& d = json.at("disturbance");
  group.disturbance = {d.at(0), d.at(1), d.at(2), d.at(3)};
  return group;
}

// The group of these cases and no others. A case that several scenes have is told apart by a number behind its hash; a
// launch has one scene and no such numbers.
run::GroupPlan group_of(const run::Plan& plan, const std::vector<std::string>& ids) {
  const auto hash = [](const std::string& id) { return id.substr(0, id.find('-')); };
  const auto is_asked_for = [&](const run::CasePlan& one) {
    return std::ranges::find(ids, hash(one.id), hash) != ids.end();
  };
  for (run::GroupPlan group : plan.groups) {
    std::erase_if(group.cases, [&](const run::CasePlan& one) { return !is_asked_for(one); });
    if (!group.cases.empty() && group.cases.size() == ids.size()) return group;
  }
  throw Error("", "--launch-server", "has no group with the cases that are asked for: has the input changed?");
}

GroupSamples measured(const config::Config& config, const run::Plan& plan, const Json& request) {
  const run::GroupPlan group = group_of(plan, request.at("ids"));
  const run::SceneData& data = plan.scenes[group.scene];
  const run::PathFrames path(data.scene, data.paths[group.camera], config.viewports[group.viewport]);
  const std::atomic<bool> stop{false};
  return run::measure_launch(
      config, group, path, {request.at("launch"), request.at("rounds"), request.at("fullest_frames")}, [](int) {},
      stop);
}

// One further process.
class Launch {
 public:
  Launch(const std::vector<std::string>& arguments, std::size_t scene, const std::atomic<bool>& stop)
      : stop_(stop), child_(command(arguments, scene), errors()) {
    if (const std::optional<std::string> line = heard(); line && *line != k_ready) fail("greets with '" + *line + "'");
  }

  // nullopt once it is to stop.
  std::optional<GroupSamples> measure(const run::GroupToTime& group, int launch, int rounds) {
    std::vector<std::string> ids;
    for (const run::CasePlan& one : group.group->cases) ids.push_back(one.id);
    const Json request{{"ids", ids}, {"launch", launch}, {"rounds", rounds}, {"fullest_frames", group.fullest_frames}};
    child_.say(request.dump());  // one that has ended is heard to have done so
    const std::optional<std::string> line = heard();
    if (!line) return std::nullopt;
    try {
      return group_samples(Json::parse(*line));
    } catch (const Json::exception&) {
      fail("answered '" + line->substr(0, 100) + "'");
    }
  }

 private:
  static std::vector<std::string> command(const std::vector<std::string>& arguments, std::size_t scene) {
    std::vector<std::string> out{fs::read_symlink("/proc/self/exe").string(), "run",
                                 "--launch-server=" + std::to_string(scene)};
    out.insert(out.end(), arguments.begin(), arguments.end());
    return out;
  }
  fs::path errors() const { return folder_ / "errors"; }

  std::optional<std::string> heard() {
    constexpr double k_no_end_s = 1e9;  // what takes long in a process of its own takes as long here
    std::string line;
    const Conversation::Heard what = stop_ ? Conversation::Heard::stop : child_.hear(line, k_no_end_s, stop_);
    if (what == Conversation::Heard::line) return line;
    // A signal from the keyboard reaches both; the other one may be the first to know.
    for (int i = 0; i < 20 && !stop_; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (stop_) return std::nullopt;
    const std::string ending = child_.end();
    fail("ended" + (ending.empty() ? "" : " (" + ending + ")"));
  }

  [[noreturn]] void fail(const std::string& what) const {
    const std::string words = last_words(errors());
    throw Error("", "--launches", "a process that was to measure " + what + (words.empty() ? "" : ": " + words));
  }

  TemporaryFolder folder_;
  const std::atomic<bool>& stop_;
  Conversation child_;
};

}  // namespace

void serve_launch(const config::Config& config, const run::Plan& plan) {
  std::cout << k_ready << std::endl;
  for (std::string line; std::getline(std::cin, line);)
    std::cout << to_json(measured(config, plan, Json::parse(line))).dump() << std::endl;
}

run::Launcher make_launcher(std::vector<std::string> arguments, const std::atomic<bool>& stop) {
  return [arguments = std::move(arguments), &stop](std::span<const run::GroupToTime> groups, int launch, int rounds,
                                                   const std::function<void(std::size_t)>& on_group) {
    std::vector<GroupSamples> all;
    Launch process(arguments, groups.front().group->scene, stop);
    for (std::size_t i = 0; i < groups.size() && !stop; ++i) {
      on_group(i);
      std::optional<GroupSamples> one = process.measure(groups[i], launch, rounds);
      if (!one) break;
      all.push_back(std::move(*one));
    }
    return all;
  };
}

}  // namespace clusterbench::cli
