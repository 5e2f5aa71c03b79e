// Parameters, instances, threads.

#include <algorithm>
#include <chrono>
#include <thread>

#include "acceptance/acceptance_test.h"
#include "acceptance/bare_method.h"
#include "core/text.h"
#include "os/guarded_memory.h"

namespace clusterbench::acceptance {
namespace {

// The defaults, and each parameter alone at the ends of its range, or at each of its choices.
std::vector<std::map<std::string, assign::ParamValue>> values_to_try(std::span<const assign::ParamSpec> specs) {
  std::vector<std::map<std::string, assign::ParamValue>> all{{}};
  for (const assign::ParamSpec& spec : specs) {
    if (std::holds_alternative<bool>(spec.default_value))
      for (const bool value : {false, true}) all.push_back({{spec.name, value}});
    if (std::holds_alternative<double>(spec.default_value))
      for (const double value : {spec.min, spec.max}) all.push_back({{spec.name, value}});
    for (const std::string& choice : spec.choices) all.push_back({{spec.name, choice}});
  }
  return all;
}

std::string values_text(const std::map<std::string, assign::ParamValue>& values) {
  if (values.empty()) return "the defaults";
  const auto& [name, value] = *values.begin();
  if (const auto* text = std::get_if<std::string>(&value)) return name + " = " + *text;
  if (const auto* flag = std::get_if<bool>(&value)) return name + " = " + (*flag ? "true" : "false");
  return name + " = " + std::to_string(std::get<double>(value));
}

void take_parameters(const Subject& subject, Findings& findings) {
  const assign::AssignerDescriptor& descriptor = *assign::find_assigner(subject.method->descriptor.name);
  const std::vector<SubjectFrame> frames = frames_for(subject, 1);
  const auto all = values_to_try(descriptor.params);
  for (const auto& values : all) {
    try {
      assign::AssignerRun run(descriptor, assign::Params(descriptor.params, values), assign::Answer::lists);
      for (const SubjectFrame& frame : frames) {
        run.build(frame.grid, frame.kinds());
        run.assign(frame.input());
      }
    } catch (const std::exception& error) {
      findings.fault("with " + values_text(values) + ": " + error.what());
    }
  }
  findings.detail = number_of(all.size(), "set") + " of values";
}

void refuse_parameters(const Subject& subject, Findings& findings) {
  const std::vector<assign::ParamSpec>& specs = subject.method->descriptor.params;
  const assign::Params params(specs);
  const std::vector<clusterbench_value> known = plugin::values_of(specs, params);
  const auto expect_refused = [&](const std::vector<clusterbench_value>& values, const std::string& with) {
    BareMethod method(*subject.method);
    if (method.create(values) != CLUSTERBENCH_INVALID)
      findings.fault("create() with " + with + " gave " + method.outcome() + "; it has to give status 3, " +
                     "as clusterbench_check_values() does");
  };
  std::vector<clusterbench_value> values = known;
  values.push_back({"no-such-parameter", nullptr, 1.0});
  expect_refused(values, "a parameter 'no-such-parameter'");
  if (known.empty()) return;
  values.pop_back();
  values.pop_back();
  expect_refused(values, "a parameter too few");
  values = known;
  values.front().name = "no-such-parameter";
  expect_refused(values, "'no-such-parameter' in place of '" + specs.front().name + "'");
}

// Grows by less than this for each of 200 instances: room for what libraries keep. A slow method is made less often, so
// that the test ends in half the time that it may take.
void make_and_destroy(const Subject& subject, Findings& findings) {
  constexpr int k_most_instances = 200, k_most_warm = 8;
  constexpr std::size_t k_allowed_bytes = 256;
  const auto start = std::chrono::steady_clock::now();
  const std::vector<SubjectFrame> frames = frames_for(subject, 1);
  const auto once = [&] {
    for (const SubjectFrame& frame : frames) lists_of(subject, frame);
    BareMethod method(*subject.method);  // one that is never built
    if (method.create() != CLUSTERBENCH_OK) findings.fault("create() gave " + method.outcome());
  };
  const auto spent_s = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  int warm = 0;
  do once();
  while (++warm < k_most_warm && spent_s() < subject.limit_s / 8.0);
  const double left_s = subject.limit_s / 2.0 - spent_s();
  const int instances =
      static_cast<int>(std::clamp(left_s / std::max(1e-9, spent_s() / warm), 1.0, double{k_most_instances}));
  const std::size_t before = os::heap_in_use();
  for (int i = 0; i < instances && findings.faults.empty(); ++i) once();
  const std::size_t after = os::heap_in_use();
  if (after > before + k_most_instances * k_allowed_bytes)
    findings.fault("keeps " + std::to_string((after - before) / static_cast<std::size_t>(instances)) +
                   " bytes of each instance after destroy()");
  findings.detail = number_of(static_cast<std::uint64_t>(instances), "time");
}

void keep_apart(const Subject& subject, Findings& findings) {
  const std::vector<SubjectFrame> frames = frames_for(subject, 4);
  const stress::StressMethod method = subject.with_defaults();
  std::vector<assign::Lists> alone;
  for (const SubjectFrame& frame : frames) alone.push_back(lists_of(subject, frame));
  for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
    assign::AssignerRun first = method.start(), second = method.start();
    first.build(frames[i].grid, frames[i].kinds());
    second.build(frames[i + 1].grid, frames[i + 1].kinds());
    first.assign(frames[i].input());
    second.assign(frames[i + 1].input());
    first.assign(frames[i].input());
    if (first.cell_lists() != alone[i] || second.cell_lists() != alone[i + 1])
      findings.fault(frames[i].label + ": an instance gives other lists while another one is there");
  }
  findings.detail = frames_text(frames.size());
}

void run_on_threads(const Subject& subject, Findings& findings) {
  constexpr std::size_t k_threads = 4;
  constexpr int k_times = 10;
  const std::vector<SubjectFrame> frames = frames_for(subject, 2);
  std::vector<assign::Lists> alone;
  for (const SubjectFrame& frame : frames) alone.push_back(lists_of(subject, frame));
  std::array<std::string, k_threads> faults;
  const auto work = [&](std::size_t thread) {
    try {
      for (int i = 0; i < k_times; ++i)
        for (std::size_t frame = 0; frame < frames.size(); ++frame)
          if (lists_of(subject, frames[frame]) != alone[frame]) faults[thread] = frames[frame].label + ": other lists";
    } catch (const std::exception& error) {
      faults[thread] = error.what();
    }
  };
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < k_threads; ++i) threads.emplace_back(work, i);
  for (std::thread& thread : threads) thread.join();
  for (const std::string& fault : faults)
    if (!fault.empty()) findings.fault("on a thread of four, each with an instance of its own: " + fault);
  findings.detail = frames_text(frames.size()) + " on " + std::to_string(k_threads) + " threads";
}

}  // namespace

std::vector<AcceptanceTest> instance_tests() {
  return {
      {"parameters", "takes every value that its parameters allow", false, take_parameters},
      {"unknown-parameters", "refuses parameters that it does not have", false, refuse_parameters},
      {"create-destroy", "frees what it has made, whether it was built or not", false, make_and_destroy},
      {"two-instances", "keeps instances apart", false, keep_apart},
      {"threads", "lets instances work at the same time", false, run_on_threads},
  };
}

}  // namespace clusterbench::acceptance
