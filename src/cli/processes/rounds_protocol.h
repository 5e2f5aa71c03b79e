#pragma once
// Both ends of the talk between two programs that are measured side by side (run --baseline-binary): requests are lines
// "lists ID", "frame ID NUMBER", "measure ID"; each answer, and the greeting, is a line of JSON. A program that waits
// for its next request takes no time from the other one.

#include <atomic>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "os/process.h"
#include "run/cases/sweep.h"
#include "run/timing/paired_rounds.h"

namespace clusterbench::cli {

// The greeting carries it, and --rounds-server asks for it. Raised by whatever an older program would not understand.
inline constexpr int k_rounds_protocol = 1;

// Greets, and answers on standard output what comes on standard input, to its end.
void serve_rounds(const config::Config& config, const run::Plan& plan);

// Another program that serves rounds. Throws Error where it cannot be started, is none of the kind, dies, gives no
// answer for `patience_s`, or answers nonsense; with os::stopped_exit_code() once `stop` is true.
class RemoteProgram : public run::Program {
 public:
  RemoteProgram(const std::vector<std::string>& command, double patience_s, const std::atomic<bool>& stop);

  // What it says of itself: `tool` of a result.
  const nlohmann::ordered_json& tool() const { return tool_; }

  std::vector<std::string> case_ids() override { return ids_; }
  std::vector<run::ListDigest> list_digests(const std::string& id) override;
  run::FrameLists frame_lists(const std::string& id, int frame) override;
  double assign_ns(const std::string& id) override;

 private:
  nlohmann::ordered_json ask(const std::string& request);
  nlohmann::ordered_json answer(const std::string& request);
  void greet();
  [[noreturn]] void fail(const std::string& what);

  std::string name_;
  double patience_s_;
  const std::atomic<bool>& stop_;
  os::Conversation child_;
  nlohmann::ordered_json tool_;
  std::vector<std::string> ids_;
};

}  // namespace clusterbench::cli
