#pragma once
// How depth (frustum grid) or distance (distance grid) is cut into slices.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "grid/needed_span.h"

namespace clusterbench::grid {

enum class Scheme { linear, exponential, exponential_first, power, list, fit, cubical, cubical_first };

// The configuration of slices. 0 means: not given.
struct Slicing {
  Scheme scheme = Scheme::exponential_first;
  int count = 16;
  double near_m = 0.0;               // not given: the camera's near
  double first_m = 5.0;              // exponential-first: slice 0 is near..first
  double far_m = 0.0;                // not given: the camera's far, or (infinite) the farthest reach of a light in view
  double lambda = 0.5;               // power: blend, 0 linear .. 1 exponential
  std::vector<double> boundaries_m;  // list: count + 1 ascending numbers
  // Slices follow the needs of a frame, within near and far: near and far of linear, exponential and power slices; far
  // and the end of the first slice of exponential-first ones, which is never nearer than first_m unless the whole
  // needed span is.
  std::optional<Fit> fit = {};
  // If no far is given, slices end here even if the camera sees farther (Filament's 100 m). 0: no such limit.
  double far_at_most_m = 0.0;
  // If neither a far is given nor the camera has one, slices end here, as in an engine whose own cameras have this far
  // plane by default (Godot's 4000 m). 0: at the end of the lights.
  double far_default_m = 0.0;
  // With an orthographic camera the scheme is linear from near to far, as in engines (Bevy, Unity URP).
  bool linear_when_orthographic = false;

  // Whether, with this far plane of the camera, slices end where the lights in view end, so neither engine nor
  // configuration gives an end.
  bool ends_with_lights(double camera_far_m) const;
};

// The possible range of slices in this frame. light_near/far: the reach of the lights in view (fit; far if nothing else
// gives it).
struct SliceRange {
  double camera_near_m, camera_far_m;
  double light_near_m, light_far_m;
  Span needed = {};  // for a Slicing with `fit`; empty: slices lie as without
};

// The constants of the shader's lookup: slice = int(f(depth) * scale + bias), f = identity or log2. The tool prints
// them, because users copy them.
struct SliceLookup {
  enum class Form { linear, log2, search } form = Form::search;
  float scale = 0.0f, bias = 0.0f;
  int first_slice = 0;  // exponential-first: depths below `first` are slice 0, the formula counts from 1
  float first_m = 0.0f;
};

// How a shader computes the logarithm of a depth.
enum class Log2 {
  rounded,    // correctly rounded single precision
  glsl_low,   // the least and
  glsl_high,  // the greatest that GLSL allows: 3 ulp, in [0.5, 2] an error of 2^-21
  fast        // exponent and a quadratic in the mantissa: an error of up to 0.005
};
float log2_by(Log2 way, float value);  // value > 0

struct Slices {
  std::vector<float> boundaries;  // count + 1, ascending strictly; boundaries[0] is never above the camera's near
  SliceLookup lookup;

  int count() const { return static_cast<int>(boundaries.size()) - 1; }
  // The shader's lookup in single precision, clamped to [0, count); -1 beyond the last boundary.
  int slice_of(float depth, Log2 way = Log2::rounded) const;
  // The ideal lookup: by the boundaries themselves. A depth on a boundary belongs to the slice that begins there.
  int ideal_slice_of(double depth) const;
};

// The largest distance beyond its boundary, in ulps of the boundary, of a depth that is still looked up in the slice:
// cells enlarged by this much on both sides contain every depth that is looked up in them.
std::int64_t safe_padding_ulps(const Slices& slices, Log2 way);

// The requested span, independent of a frame's needs; for a list its ends.
Span requested_span(const Slicing& slicing, const SliceRange& range);
// The part of a needed span that determines the slices: equal parts give equal slices.
Span deciding_span(const Slicing& slicing, const Span& needed);

// Cubical slices expressed as exponential ones: slice k begins at near * (1 + tile_height)^k, where tile_height is that
// of a tile at depth 1 (Olsson, Billeter and Assarsson 2012: 2 tan(theta) / S_y), so that a cell is as deep as it is
// high at its near side; there are as many slices as needed to reach far. For an orthographic camera: linear ones as
// thick as a tile is high. cubical-first: from first_m on, with one slice before it. Other schemes stay unchanged.
// Throws Error (where = "slices.scheme") for more than 4096 slices.
Slicing resolved_cubical(const Slicing& slicing, const SliceRange& range, double tile_height, bool orthographic);

// For an orthographic camera near may be 0 or less: exponential slices then begin after a first one up to far / count,
// and power ones are linear. Throws Error (file "", where = key such as "slices.near") for impossible values: near >=
// far, exponential with near <= 0 of a perspective camera, an infinite far, a list that does not ascend, boundaries
// that coincide in single precision.
Slices make_slices(const Slicing& slicing, const SliceRange& range, bool orthographic);

}  // namespace clusterbench::grid
