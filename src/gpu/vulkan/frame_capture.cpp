#include "gpu/vulkan/frame_capture.h"

#include "os/shared_library.h"

namespace clusterbench::gpu {

FrameCapture FrameCapture::find() {
  using GetApi = int (*)(int version, void** api);
  constexpr int k_version_1_0_0 = 10000;
  constexpr int k_start = 19, k_end = 21;  // of the functions of that version
  const auto get = reinterpret_cast<GetApi>(os::symbol_of_loaded("renderdoc", "RENDERDOC_GetAPI"));
  void* api = nullptr;
  if (get == nullptr || get(k_version_1_0_0, &api) != 1) return {};
  void* const* functions = static_cast<void**>(api);
  FrameCapture out;
  out.start_ = reinterpret_cast<Start>(functions[k_start]);
  out.end_ = reinterpret_cast<End>(functions[k_end]);
  return out;
}

FrameCapture::Scope::Scope(const FrameCapture& of, bool is_wanted)
    : of_(of), is_wanted_(is_wanted && of.is_possible()) {
  if (is_wanted_) of_.start_(nullptr, nullptr);
}

FrameCapture::Scope::~Scope() {
  if (is_wanted_) of_.end_(nullptr, nullptr);
}

}  // namespace clusterbench::gpu
