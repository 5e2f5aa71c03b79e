// Promises against the exact truth.

#include <chrono>

#include "acceptance/acceptance_test.h"
#include "core/text.h"
#include "stress/random_setting.h"

namespace clusterbench::acceptance {
namespace {

class Deadline {
 public:
  explicit Deadline(double seconds)
      : end_(std::chrono::steady_clock::now() +
             std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(seconds))) {}
  bool is_over() const { return std::chrono::steady_clock::now() >= end_; }

 private:
  std::chrono::steady_clock::time_point end_;
};

std::string fault_text(const std::string& where, const stress::SettingFault& fault) {
  return where + ": " + fault.method + ": " + stress::fault_kind_name(fault.kind) + ": " + fault.detail;
}

// Checks a trial; its faults of the method alone: not those of the truth.
bool check_trial(const stress::Trial& trial, const std::string& where, std::span<const stress::StressMethod> methods,
                 Findings& findings) {
  const stress::SettingReport report = stress::check_setting(trial, methods);
  for (const stress::SettingFault& fault : report.faults)
    if (!fault.method.empty()) findings.fault(fault_text(where, fault));
  return report.counts.compared_pairs > 0 || !report.faults.empty();
}

std::string not_conservative() {
  return "it does not say that it is conservative";
}

void hold_on_hard_cases(const Subject& subject, Findings& findings) {
  const std::vector<stress::StressMethod> methods = subject.with_every_choice();
  if (!subject.method->descriptor.conservative) findings.skipped = not_conservative();
  const Deadline deadline(subject.seconds);
  std::uint64_t checked = 0;
  for (const stress::HardCase& hard : stress::hard_cases()) {
    if (hard.trials == nullptr || !findings.skipped.empty()) continue;
    for (const stress::Trial& trial : hard.trials(subject.seed)) {
      if (deadline.is_over()) break;
      if (check_trial(trial, std::string(hard.id) + " " + trial.label, methods, findings)) ++checked;
    }
  }
  findings.detail = number_of(checked, "trial");
}

// Of a method that promises nothing only that its lists are lists.
bool fill_lists(const Subject& subject, std::uint64_t seed) {
  const std::optional<SubjectFrame> frame = frame_of_seed(subject, seed);
  if (frame) lists_of(subject, *frame);
  return frame.has_value();
}

void hold_on_random_settings(const Subject& subject, Findings& findings) {
  const std::vector<stress::StressMethod> methods = subject.with_every_choice();
  const bool promises = subject.method->descriptor.conservative;
  const Deadline deadline(subject.seconds);
  std::uint64_t checked = 0;
  for (std::uint64_t seed = subject.seed; !deadline.is_over(); ++seed) {
    const std::string where = "seed " + std::to_string(seed);
    const bool is_checked =
        promises ? check_trial(stress::random_setting(seed), where, methods, findings) : fill_lists(subject, seed);
    if (is_checked) ++checked;
  }
  findings.detail = number_of(checked, "setting");
}

}  // namespace

std::vector<AcceptanceTest> truth_tests() {
  return {
      {"hard-cases", "loses no light in the hard cases for numerical stability (`clusterbench stress`)", true,
       hold_on_hard_cases},
      {"fuzz", "keeps its promises in random settings (`clusterbench stress --random`)", true, hold_on_random_settings},
  };
}

}  // namespace clusterbench::acceptance
