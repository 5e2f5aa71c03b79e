#pragma once
// A method of a plug-in under test, and frames for it.

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plugin/plugins.h"
#include "stress/stress_run.h"

namespace clusterbench::acceptance {

struct Subject {
  std::string file;  // the plug-in's, for messages
  const plugin::MethodFacts* method = nullptr;
  std::uint64_t seed = 1;
  double seconds = 5.0;                           // for tests that draw until time is over
  double limit_s = 60.0;                          // after which a test is ended
  std::vector<std::string> changes_on_loading{};  // plugin::PluginFacts::changes_on_loading

  // With the default values of its parameters, as the program runs it.
  stress::StressMethod with_defaults() const;
  // And with every other choice.
  std::vector<stress::StressMethod> with_every_choice() const;
};

// The findings of one test.
struct Findings {
  std::vector<std::string> faults;  // sentences; none: passed
  std::string skipped;              // why the test does not apply
  std::string detail;               // how much was looked at: "12 frames"

  void fault(const std::string& text) {
    if (faults.size() < 5) faults.push_back(text);
  }
};

// A frame with all that a method gets.
struct SubjectFrame {
  std::string label;  // "seed 17, frustum 12x12t x 24 exponential 0.1..400": `stress --random 1 --seed 17` draws it
  view::Frame frame;
  grid::Grid grid;
  view::LightArrays lights;
  depth::DepthImage depths;

  SubjectFrame() = default;
  SubjectFrame(SubjectFrame&&) = default;  // the lights refer to the frame's own, which stay where they are
  SubjectFrame& operator=(SubjectFrame&&) = default;

  assign::FrameInput input() const { return stress::input_of(frame, lights, depths); }
  assign::LightKinds kinds() const { return assign::kinds_of(lights); }
};

// The frame of a random setting; none if the method does not support it, if its grid is impossible, or if it has more
// than a million cells x lights.
std::optional<SubjectFrame> frame_of_seed(const Subject& subject, std::uint64_t seed);
// Frames as levels have them, on each kind of grid that the method supports: with points and spots, and with points
// alone.
std::vector<SubjectFrame> ordinary_frames(const Subject& subject);
// Frames of random settings that the method supports, `per_kind` for each kind of its grids; fewer where a thousand
// seeds have no more.
std::vector<SubjectFrame> frames_for(const Subject& subject, int per_kind);
// The same frame with some of its lights: those that `keep` takes.
SubjectFrame with_lights(const SubjectFrame& from, const std::function<bool(std::size_t light)>& keep);

// The lists of a new instance for one frame. Throws MethodError.
assign::Lists lists_of(const Subject& subject, const SubjectFrame& frame);

// "12 frames"
std::string frames_text(std::size_t frames);

}  // namespace clusterbench::acceptance
