#pragma once
// Another program, run from here and listened to.

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace clusterbench::cli {

// Runs `command` (looked for in PATH, without standard input) to its end and hands on each line of its standard output;
// its standard error goes to the file `errors`. When `stop` becomes true it is terminated, as it is when `on_line`
// throws.
// "" if it ended well; else how it ended: "exit code 3", "signal 9", "cannot be started: ...".
std::string run_child(const std::vector<std::string>& command, const std::filesystem::path& errors,
                      const std::function<void(const std::string& line)>& on_line, const std::atomic<bool>& stop);

}  // namespace clusterbench::cli
