#pragma once
// Both ends of the protocol between two programs that are measured side by side (run --baseline-binary): requests are
// lines "lists ID", "frame ID NUMBER", "measure ID"; each answer, and the greeting, is a line of JSON. A program that
// waits for its next request uses no processor time.

#include <atomic>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/error.h"
#include "os/process.h"
#include "run/cases/plan.h"
#include "run/timing/paired_rounds.h"

namespace clusterbench::cli {

// Sent in the greeting and checked by --rounds-server. Increase it for every change that an older program would not
// understand.
inline constexpr int k_rounds_protocol = 1;

// Sends the greeting, then answers requests from standard input on standard output, until the input ends.
void serve_rounds(const config::Config& config, const run::Plan& plan);

// A program that ended, or gave no answer, when it was asked about a case.
class ProgramEnded : public Error {
 public:
  ProgramEnded(const std::string& program, const std::string& problem, std::string case_id, bool has_timed_out,
               ExitCode code)
      : Error(program, "--baseline-binary", problem, code),
        case_id_(std::move(case_id)),
        has_timed_out_(has_timed_out) {}

  const std::string& case_id() const { return case_id_; }
  bool has_timed_out() const { return has_timed_out_; }

 private:
  std::string case_id_;
  bool has_timed_out_;
};

// Another program that serves rounds. Throws Error if it cannot be started, does not know the protocol, dies, gives no
// answer for `timeout_s`, or answers nonsense; with os::stopped_exit_code() once `stop` is true.
class RemoteProgram : public run::Program {
 public:
  RemoteProgram(const std::vector<std::string>& command, double timeout_s, const std::atomic<bool>& stop);

  // Its description of itself: `tool` of a result.
  const nlohmann::ordered_json& tool() const { return tool_; }

  std::vector<std::string> case_ids() override { return ids_; }
  std::vector<run::ListDigest> list_digests(const std::string& id) override;
  run::FrameLists frame_lists(const std::string& id, int frame) override;
  double assign_ns(const std::string& id) override;

 private:
  nlohmann::ordered_json answer_of(const std::string& request);
  nlohmann::ordered_json answer(const std::string& request);
  void greet();
  [[noreturn]] void fail(const std::string& problem) const;
  [[noreturn]] void fail_at(const std::string& request, const std::string& problem, bool has_timed_out,
                            ExitCode code) const;

  std::string name_;
  double timeout_s_;
  const std::atomic<bool>& stop_;
  os::Conversation child_;
  nlohmann::ordered_json tool_;
  std::vector<std::string> ids_;
};

}  // namespace clusterbench::cli
