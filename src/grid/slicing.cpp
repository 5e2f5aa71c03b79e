#include "grid/slicing.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "core/error.h"
#include "geom/numbers/round_to_float.h"
#include "geom/shapes/domain.h"
#include "grid/grid_spec.h"

namespace clusterbench::grid {
namespace {

double linear_at(double near, double far, double share) {
  return near + (far - near) * share;
}
double exponential_at(double near, double far, double share) {
  return near * std::pow(far / near, share);
}

void require(bool holds, const char* key, const std::string& message) {
  if (!holds) throw Error("", key, message);
}

struct Reach {
  double near, far;
};

// If no far is given and the view has no end, the grid ends where the lights end. If all lights end before the slices
// begin, or there are none, any far will do: no cell behind it has a light.
double far_from_lights(const Slicing& slicing, double near_m, double lights_end_m) {
  const bool has_first = slicing.scheme == Scheme::exponential_first || slicing.scheme == Scheme::cubical_first;
  const double begin_m = has_first ? std::max(near_m, slicing.first_m) : near_m;
  return lights_end_m <= begin_m ? begin_m + std::abs(begin_m) + 1.0 : lights_end_m;
}

Reach reach_of(const Slicing& slicing, const SliceRange& range) {
  Reach reach{slicing.near_m != 0.0 ? slicing.near_m : range.camera_near_m, slicing.far_m};
  double seen = range.camera_far_m;
  if (std::isinf(seen) && slicing.far_default_m > 0.0) seen = slicing.far_default_m;
  if (slicing.far_at_most_m > 0.0) seen = std::min(seen, slicing.far_at_most_m);
  if (reach.far == 0.0)
    reach.far = std::isfinite(seen) ? seen : far_from_lights(slicing, reach.near, range.light_far_m);
  if (slicing.scheme == Scheme::fit) {
    const double last = std::max(reach.near, reach.far);  // no far is given and all lights end before near
    const Reach lights{std::clamp(range.light_near_m, reach.near, last),
                       std::clamp(range.light_far_m, reach.near, last)};
    if (lights.near < lights.far) return lights;
    reach.far = reach.near < last ? last : reach.near * 2.0 + 1.0;  // no light in view
  }
  return reach;
}

// A list's own ends are its near and far; otherwise an end is the camera's where none is given.
void check_reach(const Slicing& slicing, const Reach& reach) {
  const bool is_list = slicing.scheme == Scheme::list;
  const char* const near_key = is_list ? "slices.boundaries" : "slices.near";
  require(geom::is_in_domain(reach.far), is_list ? "slices.boundaries" : "slices.far",
          (is_list ? "end at " : "is ") + metres(reach.far) + "; allowed: at most 1e15 m" +
              (is_list ? "" : "; where the camera's far plane is infinite, name one"));
  require(geom::is_in_domain(reach.near), near_key,
          (is_list ? "begin at " : "is ") + metres(reach.near) + "; allowed: at most 1e15 m from the eye");
  if (reach.near < reach.far) return;
  if (!is_list && slicing.far_m != 0.0 && slicing.near_m == 0.0)
    throw Error("", "slices.far",
                "is " + metres(reach.far) + ", which is not above the camera's near, " + metres(reach.near));
  throw Error("", near_key, "is " + metres(reach.near) + ", which is not below far, " + metres(reach.far));
}

void check(const Slicing& slicing, const Reach& reach, bool orthographic) {
  require(slicing.count >= 1, "slices.count", "is " + std::to_string(slicing.count) + "; allowed: 1 or more");
  check_reach(slicing, reach);
  const bool is_list = slicing.scheme == Scheme::list;
  const bool logarithmic =
      slicing.scheme != Scheme::linear && !is_list && !(slicing.scheme == Scheme::power && slicing.lambda == 0.0);
  require(orthographic || !logarithmic || reach.near > 0.0, "slices.near",
          "is " + metres(reach.near) + "; exponential slices need a near above 0");
  require(orthographic || reach.near >= 0.0, is_list ? "slices.boundaries" : "slices.near",
          (is_list ? "begin at " : "is ") + metres(reach.near) + "; allowed with a perspective camera: 0 m or more");
  if (slicing.scheme == Scheme::exponential_first) {
    require(reach.near < slicing.first_m && slicing.first_m < reach.far, "slices.first",
            "is " + metres(slicing.first_m) + (slicing.first_m == Slicing{}.first_m ? " where none is given" : "") +
                "; it must lie between near, " + metres(reach.near) + ", and far, " + metres(reach.far) +
                ": name one (grids.*.slices.first), or another scheme (grids.*.slices.scheme)");
    require(slicing.first_m > 0.0, "slices.first",
            "is " + metres(slicing.first_m) + "; exponential slices begin there and need a number above 0");
    require(slicing.count >= 2, "slices.count",
            "is " + std::to_string(slicing.count) + "; exponential-first has at least 2");
  }
}

// The depths of an orthographic view may begin at 0, which has no logarithm. Exponential slices then begin after a
// first slice as thick as that of a linear scheme from the camera on; blends with an exponential part become linear.
// Slices that end behind the camera are linear in any case.
Slicing with_linear_start(Slicing slicing, const Reach& reach) {
  const bool is_exponential = slicing.scheme == Scheme::exponential || slicing.scheme == Scheme::fit;
  if (reach.near > 0.0 || !(is_exponential || slicing.scheme == Scheme::power)) return slicing;
  if (!is_exponential || slicing.count < 2 || !(reach.far > 0.0)) {
    slicing.scheme = Scheme::linear;
    return slicing;
  }
  slicing.scheme = Scheme::exponential_first;
  slicing.first_m = reach.far / slicing.count;
  return slicing;
}

// A first slice that begins below the domain's smallest depth begins at the eye instead; other slices must not begin
// there.
void check_nearest(const char* key, std::vector<float>& boundaries) {
  if (static_cast<double>(boundaries.front()) < geom::k_nearest_m) boundaries.front() = 0.0f;
  require(static_cast<double>(boundaries[1]) >= geom::k_nearest_m, key,
          "end the first slice at " + metres(static_cast<double>(boundaries[1])) +
              "; allowed: at least 1e-15 m from the eye");
}

void check_thickness(const char* key, const std::vector<float>& boundaries) {
  for (std::size_t i = 1; i < boundaries.size(); ++i)
    require(
        boundaries[i - 1] < boundaries[i], key,
        "are too thin: two boundaries coincide in single precision, at " + metres(static_cast<double>(boundaries[i])));
}

double boundary(const Slicing& slicing, const Reach& reach, int i) {
  const double share = static_cast<double>(i) / slicing.count;
  switch (slicing.scheme) {
    case Scheme::linear:
      return linear_at(reach.near, reach.far, share);
    case Scheme::power:
      return slicing.lambda == 0.0 ? linear_at(reach.near, reach.far, share)
                                   : slicing.lambda * exponential_at(reach.near, reach.far, share) +
                                         (1.0 - slicing.lambda) * linear_at(reach.near, reach.far, share);
    case Scheme::exponential_first:
      return i == 0 ? reach.near
                    : exponential_at(slicing.first_m, reach.far, static_cast<double>(i - 1) / (slicing.count - 1));
    case Scheme::list:
      return slicing.boundaries_m[static_cast<std::size_t>(i)];
    case Scheme::exponential:
    case Scheme::fit:
    case Scheme::cubical:
    case Scheme::cubical_first:
      break;
  }
  return exponential_at(reach.near, reach.far, share);
}

// slice = log2(depth) * scale + bias counts `slices` slices from `near` to `far`.
SliceLookup log2_lookup(double near, double far, int slices, int first_slice) {
  const double scale = slices / std::log2(far / near);
  SliceLookup lookup;
  lookup.form = SliceLookup::Form::log2;
  lookup.scale = static_cast<float>(scale);
  lookup.bias = static_cast<float>(-std::log2(near) * scale + first_slice);
  lookup.first_slice = first_slice;
  return lookup;
}

SliceLookup make_lookup(const Slicing& slicing, const Reach& reach) {
  SliceLookup lookup;
  switch (slicing.scheme) {
    case Scheme::linear: {
      const double scale = slicing.count / (reach.far - reach.near);
      lookup.form = SliceLookup::Form::linear;
      lookup.scale = static_cast<float>(scale);
      lookup.bias = static_cast<float>(-reach.near * scale);
      return lookup;
    }
    case Scheme::exponential:
    case Scheme::fit:
      return log2_lookup(reach.near, reach.far, slicing.count, 0);
    case Scheme::exponential_first:
      lookup = log2_lookup(slicing.first_m, reach.far, slicing.count - 1, 1);
      lookup.first_m = static_cast<float>(slicing.first_m);
      return lookup;
    case Scheme::power:
    case Scheme::list:
    case Scheme::cubical:  // already resolved
    case Scheme::cubical_first:
      break;
  }
  return lookup;
}

// Slices cannot be thinner than the resolution of single precision: a span without depth, such as a wall's, is widened.
Span with_least_thickness(const Span& span, const Reach& requested) {
  constexpr double k_least_share = 0.01, k_least_m = 1e-11;
  const double least = std::max(k_least_share * std::max(std::abs(span.near_m), std::abs(span.far_m)), k_least_m);
  if (span.far_m - span.near_m >= least) return span;
  const double far = std::min(span.near_m + least, requested.far);
  return {std::max(requested.near, std::min(span.near_m, far - least)), std::max(far, span.far_m)};
}

// Only the far end follows, also beyond the camera's far; near and the end of the first slice stay.
void fit_to_ranges(const Span& needed, const Slicing& slicing, Reach& reach) {
  constexpr double k_least_share = 1.01;  // slices without depth do not exist
  const double from = slicing.scheme == Scheme::exponential_first ? slicing.first_m : reach.near;
  const double least = from > 0.0 ? from * k_least_share : from + 1e-3;
  reach.far = std::max(least, needed.is_empty() ? reach.far : needed.far_m + 0x1p-20 * std::abs(needed.far_m));
}

// Moves slices to the needed span. Depths before the first boundary are in the first slice, so only the far end could
// leave something out: it is moved outward by more than the roundoffs of a sample's depth or distance.
void fit_to(const Span& needed, Slicing& slicing, Reach& reach) {
  const Span inside = needed.within({reach.near, reach.far});
  if (inside.is_empty()) return;
  const double far = std::min(inside.far_m + 0x1p-20 * std::abs(inside.far_m), reach.far);
  if (slicing.scheme != Scheme::exponential_first) {
    const Span span = with_least_thickness({inside.near_m, far}, reach);
    reach = {span.near_m, span.far_m};
    return;
  }
  if (far <= slicing.first_m) {  // all of it before the end of the first slice
    const Span span = with_least_thickness({reach.near, far}, reach);
    if (reach.near <= 0.0 && span.far_m <= 0.0) return;  // nothing in front of an orthographic camera
    slicing.first_m =
        reach.near > 0.0 ? exponential_at(reach.near, span.far_m, 1.0 / slicing.count) : span.far_m / slicing.count;
    reach.far = span.far_m;
    return;
  }
  const Span span = with_least_thickness({std::max(slicing.first_m, inside.near_m), far}, reach);
  if (span.near_m <= reach.near) return;
  slicing.first_m = span.near_m;
  reach.far = span.far_m;
}

Slicing with_list_reach(Slicing slicing) {
  const auto& list = slicing.boundaries_m;
  require(list.size() >= 2, "slices.boundaries", "needs at least two numbers");
  for (std::size_t i = 1; i < list.size(); ++i)
    require(list[i - 1] < list[i], "slices.boundaries",
            "must ascend: " + metres(list[i]) + " follows " + metres(list[i - 1]));
  slicing.count = static_cast<int>(list.size()) - 1;
  return slicing;
}

// Neighbours of positive floats are neighbours as whole numbers.
float moved_by_ulps(float value, std::int64_t ulps) {
  const std::int64_t bits = std::bit_cast<std::int32_t>(value) + ulps;
  const std::int64_t greatest = std::bit_cast<std::int32_t>(std::numeric_limits<float>::max());
  return std::bit_cast<float>(static_cast<std::int32_t>(std::clamp<std::int64_t>(bits, 0, greatest)));
}

// The greatest number for which `holds` is true, if it is true up to some number and false above; 0 if for none.
template <class Holds>
std::int64_t last_where(Holds&& holds) {
  std::int64_t beyond = 1;
  constexpr std::int64_t k_most = std::int64_t{1} << 31;
  while (beyond < k_most && holds(beyond)) beyond *= 2;
  std::int64_t last = beyond / 2;
  while (last + 1 < beyond) {
    const std::int64_t middle = (last + beyond) / 2;
    (holds(middle) ? last : beyond) = middle;
  }
  return last;
}

float fast_log2(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const auto exponent = static_cast<float>(static_cast<int>(bits >> 23) - 127);
  const float mantissa = std::bit_cast<float>((bits & 0x7fffffu) | 0x3f800000u);
  return exponent + (-0.34484843f * mantissa + 2.02466578f) * mantissa - 1.67487759f;
}

// The number of cubical slices that `found` says; throws Error where no grid has so many. `remedy`: beside larger
// tiles.
int checked_count(double found, const Slicing& slicing, const char* remedy) {
  constexpr double k_most = 4096.0, k_roundoffs = 1e-9;  // the last slice may miss far by roundoffs
  const double count = std::max(1.0, std::ceil(found - k_roundoffs));
  if (count <= k_most) return static_cast<int>(count);
  std::ostringstream digits;
  digits << std::setprecision(15) << count;
  throw Error("", "slices.scheme",
              std::string("is cubical") + (slicing.scheme == Scheme::cubical_first ? "-first" : "") +
                  " and would take " + digits.str() + " slices, of at most 4096; take larger tiles" + remedy);
}

}  // namespace

bool Slicing::ends_with_lights(double camera_far_m) const {
  return scheme != Scheme::list && far_m == 0.0 && far_at_most_m == 0.0 && far_default_m == 0.0 &&
         std::isinf(camera_far_m);
}

Span deciding_span(const Slicing& slicing, const Span& needed) {
  if (slicing.fit && slicing.fit->to == Fit::To::ranges && !needed.is_empty())
    return {0.0, std::max(0.0, needed.far_m)};
  if (slicing.scheme != Scheme::exponential_first || needed.is_empty()) return needed;
  return {std::max(needed.near_m, std::min(slicing.first_m, needed.far_m)), needed.far_m};
}

Span requested_span(const Slicing& slicing, const SliceRange& range) {
  if (slicing.scheme == Scheme::list && !slicing.boundaries_m.empty())
    return {slicing.boundaries_m.front(), slicing.boundaries_m.back()};
  const Reach reach = reach_of(slicing, range);
  return {reach.near, reach.far};
}

Slicing resolved_cubical(const Slicing& slicing, const SliceRange& range, double tile_height, bool orthographic) {
  if (slicing.scheme != Scheme::cubical && slicing.scheme != Scheme::cubical_first) return slicing;
  const bool has_first = slicing.scheme == Scheme::cubical_first;
  const Reach reach = reach_of(slicing, range);
  Slicing out = slicing;
  out.count = 1;
  require(geom::is_in_domain(reach.far) && reach.near < reach.far, "slices.far",
          "must be finite and beyond near, " + metres(reach.near));
  const double from = has_first ? slicing.first_m : reach.near;
  if (orthographic) {
    require(!has_first, "slices.scheme",
            "is cubical-first; tiles of an orthographic camera are of one size, so take cubical");
    out.scheme = Scheme::linear;
    out.count = checked_count((reach.far - reach.near) / tile_height, slicing, " or a nearer far");
    out.far_m = reach.near + out.count * tile_height;
    return out;
  }
  require(from > 0.0, "slices.near", "is 0; cubical slices need a near above 0");
  require(
      !has_first || (reach.near < from && from < reach.far), "slices.first",
      "is " + metres(from) + "; it must lie between near, " + metres(reach.near) + ", and far, " + metres(reach.far));
  const double ratio = 1.0 + tile_height;
  const int count = checked_count(std::log(reach.far / from) / std::log(ratio), slicing,
                                  has_first ? ", a nearer far, or a larger first" : ", a nearer far, or cubical-first");
  out.scheme = has_first ? Scheme::exponential_first : Scheme::exponential;
  out.count = count + (has_first ? 1 : 0);
  out.far_m = from * std::pow(ratio, count);
  return out;
}

float log2_by(Log2 way, float value) {
  if (way == Log2::fast) return fast_log2(value);
  // Computed in double and rounded once: the single-precision libm differs between machines in the last bit.
  float log = static_cast<float>(std::log2(static_cast<double>(value)));
  if (way == Log2::rounded) return log;
  const float direction = way == Log2::glsl_low ? -1.0f : 1.0f;
  if (value >= 0.5f && value <= 2.0f) return log + direction * 0x1p-21f;
  for (int i = 0; i < 3; ++i) log = std::nextafter(log, direction * std::numeric_limits<float>::infinity());
  return log;
}

std::int64_t safe_padding_ulps(const Slices& slices, Log2 way) {
  std::int64_t padding = 0;
  for (int k = 1; k < slices.count(); ++k) {
    const float boundary = slices.boundaries[static_cast<std::size_t>(k)];
    if (!(boundary > 0.0f)) continue;
    const auto below_is_above = [&](std::int64_t ulps) {
      return slices.slice_of(moved_by_ulps(boundary, -ulps), way) >= k;
    };
    const auto above_is_below = [&](std::int64_t ulps) {
      const int slice = slices.slice_of(moved_by_ulps(boundary, ulps - 1), way);
      return slice >= 0 && slice < k;
    };
    padding = std::max({padding, last_where(below_is_above), last_where(above_is_below)});
  }
  return padding;
}

int Slices::slice_of(float depth, Log2 way) const {
  if (depth > boundaries.back()) return -1;
  if (lookup.form == SliceLookup::Form::search) return ideal_slice_of(static_cast<double>(depth));
  if (lookup.first_slice > 0 && depth < lookup.first_m) return 0;
  const float value =
      (lookup.form == SliceLookup::Form::log2 ? log2_by(way, depth) : depth) * lookup.scale + lookup.bias;
  // Truncation as in a shader; below the first boundary log2 can have any value, down to -inf.
  return value >= 1.0f ? std::min(static_cast<int>(value), count() - 1) : 0;
}

int Slices::ideal_slice_of(double depth) const {
  if (depth > static_cast<double>(boundaries.back())) return -1;
  const auto above = std::upper_bound(boundaries.begin(), boundaries.end(), depth,
                                      [](double value, float bound) { return value < static_cast<double>(bound); });
  return std::clamp(static_cast<int>(above - boundaries.begin()) - 1, 0, count() - 1);
}

Slices make_slices(const Slicing& requested, const SliceRange& range, bool orthographic) {
  const bool is_list = requested.scheme == Scheme::list;
  Slicing slicing = is_list ? with_list_reach(requested) : requested;
  if (orthographic && slicing.linear_when_orthographic) slicing.scheme = Scheme::linear;
  Reach reach = is_list ? Reach{slicing.boundaries_m.front(), slicing.boundaries_m.back()} : reach_of(slicing, range);
  const bool follows_ranges = slicing.fit && slicing.fit->to == Fit::To::ranges && !is_list;
  if (follows_ranges) fit_to_ranges(range.needed, slicing, reach);
  check(slicing, reach, orthographic);
  if (slicing.fit && !follows_ranges && !is_list) fit_to(range.needed, slicing, reach);
  if (orthographic) slicing = with_linear_start(slicing, reach);

  Slices slices;
  for (int i = 0; i <= slicing.count; ++i) slices.boundaries.push_back(static_cast<float>(boundary(slicing, reach, i)));
  if (slicing.fit && !is_list)
    slices.boundaries.back() = std::max(slices.boundaries.back(), geom::rounded_up(reach.far));
  // Depths between the camera's near plane and the first boundary are looked up in slice 0, so they belong to it.
  slices.boundaries.front() = geom::rounded_down(std::min(reach.near, range.camera_near_m));
  const char* const key = is_list ? "slices.boundaries" : "slices";
  if (!orthographic) check_nearest(key, slices.boundaries);
  check_thickness(key, slices.boundaries);
  slices.lookup = make_lookup(slicing, reach);
  return slices;
}

}  // namespace clusterbench::grid
