#pragma once
// Captures by RenderDoc (renderdoc_app.h: RENDERDOC_GetAPI, version 1.0.0), where its library is in this process. A
// program without pictures has to say itself what a frame is.

namespace clusterbench::gpu {

class FrameCapture {
 public:
  // None can be made.
  FrameCapture() = default;
  // By the library, which comes with an instance that was made.
  static FrameCapture find();

  bool is_possible() const { return start_ != nullptr && end_ != nullptr; }

  // What is submitted while one lives is one capture, if it is wanted.
  class Scope {
   public:
    Scope(const FrameCapture& of, bool is_wanted);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    const FrameCapture& of_;
    bool is_wanted_;
  };

 private:
  using Start = void (*)(void* device, void* window);  // null: the only one
  using End = unsigned (*)(void* device, void* window);

  Start start_ = nullptr;
  End end_ = nullptr;
};

}  // namespace clusterbench::gpu
