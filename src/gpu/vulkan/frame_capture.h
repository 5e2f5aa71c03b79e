#pragma once
// Captures by RenderDoc (renderdoc_app.h: RENDERDOC_GetAPI, version 1.0.0), where its library is in this process. A
// program without pictures has to say itself what a frame is.

#include <cstdint>
#include <string>
#include <vector>

namespace clusterbench::gpu {

class FrameCapture {
 public:
  // None can be made.
  FrameCapture() = default;
  // By the library, which comes with an instance that was made.
  static FrameCapture find();

  // What is submitted while one lives is a capture, whose file is named after these shaders; none without them. It is
  // told by taken_captures() (gpu/device/device.h).
  class Scope {
   public:
    Scope(const FrameCapture& of, std::vector<std::string> shaders);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    const FrameCapture& of_;
    std::vector<std::string> shaders_;
  };

 private:
  // The functions of that version that are called here. `device`, `window`: null is the only one.
  using SetPath = void (*)(const char* beginning);
  using GetPath = const char* (*)();
  using Count = std::uint32_t (*)();
  using GetCapture = std::uint32_t (*)(std::uint32_t number, char* file, std::uint32_t* length, std::uint64_t* time);
  using Start = void (*)(void* device, void* window);
  using End = std::uint32_t (*)(void* device, void* window);

  std::string last_file() const;

  std::string path_;  // without the shaders' names
  SetPath set_path_ = nullptr;
  Count count_ = nullptr;
  GetCapture capture_ = nullptr;
  Start start_ = nullptr;
  End end_ = nullptr;
};

}  // namespace clusterbench::gpu
