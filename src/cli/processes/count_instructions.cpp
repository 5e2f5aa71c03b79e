#include "cli/processes/count_instructions.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <set>
#include <sstream>

#include "cli/processes/handover.h"
#include "core/error.h"
#include "core/text.h"
#include "os/call_notes.h"
#include "os/environment.h"
#include "os/file_access.h"
#include "os/process.h"
#include "os/temporary_folder.h"
#include "run/counters/callgrind_counter.h"
#include "run/counters/perf_counter.h"

namespace clusterbench::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* k_callgrind = "--count=callgrind";

// Why hardware counters cannot be used; "" if they can.
std::string perf_obstacle() {
  try {
    const run::PerfCounter counter;
    return "";
  } catch (const Error& error) {
    return error.message();
  }
}

bool is_in_path(const std::string& program) {
  for (const std::string& folder : os::folders_in_variable("PATH"))
    if (os::is_executable(fs::path(folder) / program)) return true;
  return false;
}

std::string callgrind_obstacle() {
  std::string obstacle = run::CallgrindCounter::obstacle();
  if (!obstacle.empty() || is_in_path("valgrind")) return obstacle;
  return "valgrind is not in PATH; install it (Debian: apt-get install valgrind)";
}

std::vector<std::string> callgrind_command(const std::string& dumps, const std::string& file) {
  return {"valgrind",
          "--quiet",
          "--tool=callgrind",
          "--vgdb=no",
          "--instr-atstart=no",
          "--dump-line=no",
          "--callgrind-out-file=" + dumps,
          os::this_program_for_others(),
          "run",
          "--count-dumps=" + dumps,
          "--",
          file};
}

std::string line_of(const std::string& id, const run::CountResult& count) {
  std::ostringstream line;
  line << id << ' ' << count.simd_target << ' ' << count.frames << ' ' << count.build.instructions << ' '
       << count.assign.instructions << ' ' << (count.pre_cull ? std::to_string(count.pre_cull->instructions) : "-");
  if (count.convert) line << ' ' << count.convert->instructions;
  return line.str();
}

std::pair<std::string, run::CountResult> count_in(const std::string& line) {
  std::pair<std::string, run::CountResult> read;
  auto& [id, count] = read;
  count.source = "callgrind";
  std::istringstream in(line);
  std::string pre_cull;
  in >> id >> count.simd_target >> count.frames >> count.build.instructions >> count.assign.instructions >> pre_cull;
  const bool is_read = static_cast<bool>(in);
  if (is_read && pre_cull != "-") count.pre_cull.emplace().instructions = std::stoull(pre_cull);
  run::Counted convert;
  if (in >> convert.instructions) count.convert = convert;
  if (!is_read || count.frames <= 0) throw Error("", k_callgrind, "the run under valgrind printed '" + line + "'");
  return read;
}

using OnCase = std::function<void(const std::string&)>;

run::Counts count_under_callgrind(const CountTask& task, const OnCase& on_case, const std::atomic<bool>& stop) {
  run::Counts counts;
  const os::TemporaryFolder folder;
  const os::Ending ending = os::run_child(
      callgrind_command((folder / "dump").string(), file_argument(task.config)),
      handover_line(task.config, task.plan) + "\n" + nlohmann::json(task.ids).dump() + "\n",
      [&](const std::string& line) {
        const auto& [id, count] = *counts.insert(count_in(line)).first;
        on_case(id);
      },
      stop);
  if (!stop && !ending.how.empty()) os::end_with_call(ending.wait_status);
  if (!stop && !ending.how.empty())
    throw Error("", k_callgrind, "the run under valgrind failed (" + ending.how + "): " + ending.error_tail);
  return counts;
}

void count_here(const CountTask& task, run::InstructionCounter& counter,
                const std::function<void(const std::string& id, const run::CountResult&)>& on_count,
                const std::atomic<bool>& stop) {
  const std::set<std::string> ids(task.ids.begin(), task.ids.end());
  run::count_pass(
      task.config, task.plan, [&](const run::CasePlan& case_plan) { return ids.contains(case_plan.id); }, counter,
      [&](const run::CasePlan& case_plan, const run::CountResult& count) { on_count(case_plan.id, count); }, stop);
}

}  // namespace

const char* name_of(CountWay way) {
  return way == CountWay::perf ? "perf" : "callgrind";
}

CountWay count_way(const std::string& name) {
  if (name.empty()) return CountWay::none;
  if (name != "auto" && name != "perf" && name != "callgrind")
    throw Error("", "--count", "found '" + name + "'; takes perf, callgrind or auto, as in --count=perf");
  const std::string perf = name == "callgrind" ? "was not asked for" : perf_obstacle();
  if (perf.empty()) return CountWay::perf;
  if (name == "perf") throw Error("", "--count=perf", perf);
  const std::string callgrind = callgrind_obstacle();
  if (callgrind.empty()) return CountWay::callgrind;
  if (name == "callgrind") throw Error("", k_callgrind, callgrind);
  throw Error("", "--count", "instructions cannot be counted here. perf: " + perf + ". callgrind: " + callgrind);
}

run::Counts count_cases(CountWay way, const CountTask& task, const OnCase& on_case, const std::atomic<bool>& stop) {
  run::Counts counts;
  if (way == CountWay::callgrind) {
    counts = count_under_callgrind(task, on_case, stop);
  } else {
    run::PerfCounter counter;
    count_here(
        task, counter,
        [&](const std::string& id, const run::CountResult& count) {
          counts[id] = count;
          on_case(id);
        },
        stop);
  }
  for (const std::string& id : task.ids)
    if (!stop && !counts.contains(id))
      throw Error("", std::string("--count=") + name_of(way), "case " + id + " was not counted");
  return counts;
}

void print_callgrind_counts(const config::Config& config, const run::Plan& plan, const std::string& dumps) {
  const std::atomic<bool> never{false};
  std::string ids;
  std::getline(std::cin, ids);
  run::CallgrindCounter counter(dumps);
  count_here(
      {config, plan, nlohmann::json::parse(ids)}, counter,
      [](const std::string& id, const run::CountResult& count) { std::cout << line_of(id, count) << std::endl; },
      never);
}

}  // namespace clusterbench::cli
