#include "gpu/vulkan/frame_capture.h"

#include <cctype>
#include <mutex>
#include <utility>

#include "core/text.h"
#include "gpu/device/device.h"
#include "os/shared_library.h"

namespace clusterbench::gpu {
namespace {

struct Told {
  std::mutex mutex;
  std::vector<std::string> lines;
};

Told& told() {
  static Told only;
  return only;
}

// As a part of a file's name.
std::string file_part(std::string name) {
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_') c = '-';
  return name;
}

}  // namespace

FrameCapture FrameCapture::find() {
  using GetApi = int (*)(int version, void** api);
  constexpr int k_version_1_0_0 = 10000;
  constexpr int k_set_path = 11, k_get_path = 12, k_count = 13, k_capture = 14, k_start = 19, k_end = 21;
  const auto get = reinterpret_cast<GetApi>(os::symbol_of_loaded("renderdoc", "RENDERDOC_GetAPI"));
  void* api = nullptr;
  if (get == nullptr || get(k_version_1_0_0, &api) != 1) return {};
  void* const* functions = static_cast<void**>(api);
  FrameCapture out;
  out.path_ = reinterpret_cast<GetPath>(functions[k_get_path])();
  out.set_path_ = reinterpret_cast<SetPath>(functions[k_set_path]);
  out.count_ = reinterpret_cast<Count>(functions[k_count]);
  out.capture_ = reinterpret_cast<GetCapture>(functions[k_capture]);
  out.start_ = reinterpret_cast<Start>(functions[k_start]);
  out.end_ = reinterpret_cast<End>(functions[k_end]);
  return out;
}

std::string FrameCapture::last_file() const {
  const std::uint32_t count = count_();
  std::uint32_t length = 0;
  if (count == 0 || capture_(count - 1, nullptr, &length, nullptr) == 0) return "";
  std::string file(length, '\0');
  capture_(count - 1, file.data(), &length, nullptr);
  return file.substr(0, file.find('\0'));
}

FrameCapture::Scope::Scope(const FrameCapture& of, std::vector<std::string> shaders)
    : of_(of), shaders_(std::move(shaders)) {
  if (of_.start_ == nullptr) shaders_.clear();
  if (shaders_.empty()) return;
  std::string names;
  for (const std::string& shader : shaders_) names += "." + file_part(shader);
  constexpr std::size_t k_longest = 120;  // of a file's name, with its number
  of_.set_path_((of_.path_ + names.substr(0, k_longest)).c_str());
  of_.start_(nullptr, nullptr);
}

FrameCapture::Scope::~Scope() {
  if (shaders_.empty()) return;
  const bool is_written = of_.end_(nullptr, nullptr) == 1;
  const std::string names = joined(shaders_);
  const std::lock_guard lock(told().mutex);
  told().lines.push_back(is_written ? "RenderDoc's capture of " + names + ": " + of_.last_file()
                                    : "RenderDoc could not write its capture of " + names + ": " + of_.path_ +
                                          " (RENDERDOC_CAPFILE) is where it should begin");
}

std::vector<std::string> taken_captures() {
  const std::lock_guard lock(told().mutex);
  return std::exchange(told().lines, {});
}

}  // namespace clusterbench::gpu
