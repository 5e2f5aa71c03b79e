#pragma once
// The range of depths (for distance grids: distances) for which a frame needs slices, so that slices can follow it.
// Persson 2015 proposes to fit near and far to the existing lights; Olsson, Billeter and Assarsson 2012 to fit to the
// samples.

#include <limits>

#include "depth/depth_image.h"
#include "view/frame.h"

namespace clusterbench::grid {

// From near to far, in metres; empty if near is beyond far.
struct Span {
  double near_m = std::numeric_limits<double>::infinity(), far_m = -std::numeric_limits<double>::infinity();

  bool is_empty() const { return !(near_m <= far_m); }
  // The intersection of both; empty if they are disjoint.
  Span within(const Span& other) const;

  friend bool operator==(const Span&, const Span&) = default;
};

// Smallest step of a fit that is not 1.
inline constexpr double k_least_step = 1.01;

// Which slices are fitted, and how they follow from frame to frame.
struct Fit {
  // both: depths that lights and visible surfaces have in common. ranges: only the far end, from the spheres of the
  // ranges of the lights in view (also for spots); not limited by the camera's far (Bevy).
  enum class To { lights, surfaces, both, ranges };
  To to = To::lights;
  // When the span could shrink: the share of the difference that is left after one frame; 0: follows at once. A span
  // always grows at once, so that nothing needed is ever left out.
  double damping = 0.0;
  // The ends move outward to powers of this factor, so that most frames have the grid of the previous frame; 1: they do
  // not. Only for ends above 0.
  double step = 1.0;

  bool needs_surfaces() const { return to == To::surfaces || to == To::both; }
  friend bool operator==(const Fit&, const Fit&) = default;
};

// "lights", "surfaces", "both", "ranges"
const char* name_of(Fit::To to);

// Contains every point in view that a light reaches. It may be larger: whole lights are used, a spot by its capped cone
// (in distances by its ball), and a light beside an edge or a corner of the view may count as in view. A light without
// end needs everything.
Span span_of_lights(const view::Frame& frame, bool by_distance);
// Of the first opaque surface of each pixel.
Span span_of_surfaces(const view::Frame& frame, const depth::DepthImage& depths, bool by_distance);
// `depths`: only for a fit that needs surfaces; without depths the span is empty.
Span needed_span(const Fit& fit, const view::Frame& frame, const depth::DepthImage* depths, bool by_distance);

// Of the balls of the lights in view, spots by theirs, without lights that have no end: input of scheme `fit`.
Span span_of_balls(const view::Frame& frame, bool by_distance);

// Limits each frame's needed span to the requested range; a span depends on those before it. Each contains the span
// that its frame needs; a frame that needs nothing keeps the previous span if there is damping, else has none.
class SpanFollower {
 public:
  explicit SpanFollower(const Fit& fit) : fit_(fit) {}

  Span next(const Span& needed);

 private:
  Fit fit_;
  Span held_;
};

}  // namespace clusterbench::grid
