#include "report/sizing/buffer_tail.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "report/cases/columns.h"

namespace clusterbench::report {
namespace {

// The probability for reported capacities: at 60 frames per second once in half an hour.
constexpr double k_rare = 1e-5;

result::ChanceOfFrame chance_of(const measure::Chance& chance) {
  return {chance.estimate, {chance.ci95.low, chance.ci95.high}};
}

// The capacity that k_rare of the frames exceed; at most the upper bound.
measure::Tail::Capacity capacity_for_rare(const measure::Tail& tail, const SizedBuffer& buffer) {
  measure::Tail::Capacity rare = tail.capacity_for(k_rare);
  rare.estimate = std::min(rare.estimate, buffer.theoretical_max);
  rare.upper = std::min(rare.upper.value_or(buffer.theoretical_max), buffer.theoretical_max);
  return rare;
}

// The upper end first: on paths whose frames change slowly the estimate itself is often far too low.
std::string chance_text(const measure::Chance& chance) {
  if (!(chance.ci95.high > 0.0)) return "no frame";
  const std::string estimate = chance.estimate > 0.0 ? one_in_text(chance.estimate) : "none";
  return "at most " + one_in_text(chance.ci95.high) + " frames (by the fit " + estimate + ")";
}

// For cameras that do not move, as seen from the buffer: a remark that other views are unknown; "" for others.
std::string still_text(const SizedBuffer& buffer) {
  if (!buffer.depends_on_view || buffer.is_all() || buffer.paths.empty()) return "";
  std::uint64_t frames = 0;
  for (const PathNeed& path : buffer.paths) {
    const bool is_merged = path.frames_per_entry > 1 && path.elements.size() > 1;
    if (path.elements.empty() || is_merged) return "";
    if (std::ranges::adjacent_find(path.elements, std::ranges::not_equal_to()) != path.elements.end()) return "";
    frames += path.frames_per_entry * path.elements.size();
  }
  const bool is_one = frames == 1, has_cameras = buffer.paths.size() > 1;
  return std::string(is_one ? "one frame says nothing of other views"
                     : has_cameras
                         ? "each camera needs the same in all its frames, as one that stands still: they say nothing "
                           "of other views"
                         : "all " + number_of(frames, "frame") +
                               " need the same, as of a camera that stands still: they say nothing of other views") +
         (buffer.found ? "; the search looked at some"
                       : "; animate the camera over what it will show, or search with --worst-case");
}

}  // namespace

std::string one_in_text(double chance) {
  if (!(chance > 0.0)) return "never";
  const double frames = 1.0 / chance;
  if (frames < 9.5) return "1 in " + text("%.1f", frames);
  double power = 1.0;
  int digits = 0;
  while (frames >= 9.5 * power) power *= 10.0, ++digits;
  const double leading = std::round(frames / power);
  if (digits >= 5 && leading == 1.0) return "1 in 10^" + std::to_string(digits);
  if (digits >= 7) return "1 in " + text("%g", leading) + "*10^" + std::to_string(digits);
  return "1 in " + text("%.0f", leading * power);
}

std::optional<measure::TailEstimate> tail_of(const SizedBuffer& buffer) {
  if (buffer.is_all() || !buffer.spread || buffer.spread->min == buffer.spread->max) return {};
  std::vector<measure::PathNeeds> paths;
  for (const PathNeed& path : buffer.paths) paths.push_back({path.elements, path.frames_per_entry});
  return measure::tail_of(paths);
}

std::string tail_text(const SizedBuffer& buffer) {
  if (const std::string still = still_text(buffer); !still.empty()) return buffer.name + ": " + still;
  const std::optional<measure::TailEstimate> found = tail_of(buffer);
  if (!found) return "";
  if (!found->tail) return buffer.name + ": no estimate: " + found->refusal;
  const measure::Tail& tail = *found->tail;
  const measure::Tail::Capacity rare = capacity_for_rare(tail, buffer);
  return buffer.name + (tail.fits ? ": above " : ": NO GOOD FIT, do not rely on it: above ") +
         std::to_string(buffer.capacity) + " in " + chance_text(tail.chance_above(buffer.capacity)) +
         "; for 1 in 10^5 allocate " + std::to_string(*rare.upper) + " (by the fit " + std::to_string(rare.estimate) +
         "); from " + number_of(tail.peaks, "peak");
}

std::optional<result::BeyondThePath> beyond_the_path(const SizedBuffer& buffer) {
  if (const std::string still = still_text(buffer); !still.empty()) return result::BeyondThePath{.refusal = still};
  const std::optional<measure::TailEstimate> found = tail_of(buffer);
  if (!found) return {};
  if (!found->tail) return result::BeyondThePath{.refusal = found->refusal};
  const measure::Tail& tail = *found->tail;
  const measure::Tail::Capacity rare = capacity_for_rare(tail, buffer);
  return result::BeyondThePath{.above_capacity = chance_of(tail.chance_above(buffer.capacity)),
                               .above_high_water = chance_of(tail.chance_above(buffer.high_water)),
                               .capacity_for_1_in_100000 = result::RareCapacity{rare.estimate, *rare.upper},
                               .fits = tail.fits,
                               .fit_p = tail.fit_p,
                               .frames = tail.frames,
                               .threshold = tail.threshold,
                               .frames_above = tail.frames_above,
                               .peaks = tail.peaks,
                               .cut_peaks = tail.cut_peaks,
                               .extremal_index = tail.extremal_index,
                               .shape = tail.shape,
                               .scale = tail.scale,
                               .end = tail.end,
                               .is_upper_bound = tail.has_merged_frames};
}

}  // namespace clusterbench::report
