#pragma once
// The tests of `plugin check`, each in a process of its own: this program again, which runs one test of one method and
// prints what it found as a line of JSON.

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "result/documents/plugin_check.h"

namespace clusterbench::cli {

struct PluginCheckRequest {
  std::string file;
  std::uint64_t seed = 1;
  double seconds = 5.0;     // for tests that draw until time is over
  double timeout_s = 60.0;  // for the rest of each test
  int memory_mib = 4096;    // that the process of a test may grow by in calls
  bool in_process = false;
  std::string notes;  // of the process that asks, for that which is asked
};

// The hidden option by which the other process is asked for a test, as METHOD/TEST; or for the description of the
// plug-in. It answers with a line of JSON.
inline constexpr const char* k_serve_test = "--serve-test";
inline constexpr const char* k_description = "description";
// The hidden option with the path of the notes of the process that asks.
inline constexpr const char* k_notes = "--notes";

// The plug-in and the names of its methods.
struct PluginDescription {
  result::Plugin plugin;
  std::vector<std::string> methods;
};
// Throws Error where the plug-in cannot be loaded, or ends the process that reads what it says.
PluginDescription description_of(const PluginCheckRequest& request, const std::atomic<bool>& stop);

// Runs a test of a method; nothing if it was stopped.
std::optional<result::PluginTest> tested(const PluginCheckRequest& request, const std::string& method,
                                         const std::string& test, const std::atomic<bool>& stop);

// The other process: does what `asked` says.
void serve_test(const PluginCheckRequest& request, const std::string& asked);

}  // namespace clusterbench::cli
