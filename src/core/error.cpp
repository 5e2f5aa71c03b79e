#include "core/error.h"

#include <cerrno>
#include <cstring>
#include <utility>

namespace clusterbench {
namespace {

std::string joined(const std::string& file, const std::string& where, const std::string& message) {
  std::string text = file;
  if (!where.empty()) text += (text.empty() ? "" : ": ") + where;
  return text.empty() ? message : text + ": " + message;
}

}  // namespace

Error::Error(std::string file, std::string where, std::string message, ExitCode code)
    : std::runtime_error(joined(file, where, message)),
      file_(std::move(file)),
      where_(std::move(where)),
      message_(std::move(message)),
      code_(code) {}

std::string reason_text(int error) {
  const bool is_limit = error == EMFILE || error == ENFILE;
  return std::strerror(error) + std::string(is_limit ? "; allow more of them (ulimit -n 256)" : "");
}

std::string errno_text(const std::string& action) {
  return action + ": " + reason_text(errno);
}

}  // namespace clusterbench
