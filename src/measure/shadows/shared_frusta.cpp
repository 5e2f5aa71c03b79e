#include "measure/shadows/shared_frusta.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <set>
#include <tuple>

#include "geom/shapes/angle_between.h"
#include "grid/lights_in_view.h"

namespace clusterbench::measure {
namespace {

constexpr double k_slack = 1e-9;  // more than roundoff of angles, and of lengths relative to nearby lengths
// More than roundoff of an apex, and of differences from it, relative to its distance from the origin.
constexpr double k_position_slack = 0x1p-49;

// The depth of a spot's sphere-capped cone from its apex along an axis at the angle `turned_rad` to its own; the cone
// must not turn away from that axis.
double depth_along(const scene::WorldLight& spot, double turned_rad) {
  return spot.range_m * std::cos(std::max(0.0, turned_rad - spot.outer_cone_rad));
}

// Whether these two may be in one group, before other members are tested.
bool may_share(const scene::WorldLight& a, const scene::WorldLight& b, const SharingLimits& limits) {
  return glm::length(a.position - b.position) <= limits.most_apart_m &&
         geom::angle_between(a.direction, b.direction) <= limits.most_turned_rad;
}

// Groups by index: first the single spots, then the joined groups.
class Grouping {
 public:
  Grouping(std::span<const scene::WorldLight> lights, std::span<const std::uint32_t> spots, const SharingLimits& limits)
      : lights_(lights), limits_(limits) {
    for (const std::uint32_t spot : spots)
      if (const auto own = frustum_around(lights, std::span(&spot, 1))) add_group(*own, own->volume_m3());
    find_neighbours();
  }

  std::vector<SharedFrustum> joined() {
    while (!queue_.empty()) {
      const auto [cost, a, b] = queue_.top();
      queue_.pop();
      if (groups_[a].is_gone || groups_[b].is_gone) continue;
      join(a, b);
    }
    std::vector<SharedFrustum> out;
    for (Group& group : groups_)
      if (!group.is_gone) out.push_back(std::move(group.frustum));
    std::ranges::sort(out, {}, [](const SharedFrustum& frustum) { return frustum.members.front(); });
    return out;
  }

 private:
  struct Group {
    SharedFrustum frustum;
    double largest_m3 = 0.0;  // of the members' own frusta
    bool is_gone = false;
    std::set<std::size_t> neighbours{};  // candidates for a join, by tests of pairs of members
  };
  struct Union {
    SharedFrustum frustum;
    double largest_m3;
  };

  void add_group(SharedFrustum frustum, double largest_m3) { groups_.push_back({std::move(frustum), largest_m3}); }

  // The groups are sorted along x, so only spots that are close along x are tested.
  void find_neighbours() {
    std::vector<std::size_t> order(groups_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto spot_of = [&](std::size_t group) -> const scene::WorldLight& {
      return lights_[groups_[group].frustum.members.front()];
    };
    std::ranges::sort(order, {}, [&](std::size_t group) { return std::pair(spot_of(group).position.x, group); });
    for (std::size_t i = 0; i < order.size(); ++i)
      for (std::size_t k = i + 1; k < order.size(); ++k) {
        const scene::WorldLight &a = spot_of(order[i]), &b = spot_of(order[k]);
        if (b.position.x - a.position.x > limits_.most_apart_m) break;
        if (may_share(a, b, limits_)) add_neighbours(std::min(order[i], order[k]), std::max(order[i], order[k]));
      }
  }

  // Adds two existing groups as neighbours if they can be joined. a < b.
  void add_neighbours(std::size_t a, std::size_t b) {
    const std::optional<Union> both = united(a, b);
    if (!both) return;
    groups_[a].neighbours.insert(b);
    groups_[b].neighbours.insert(a);
    const double apart = groups_[a].frustum.volume_m3() + groups_[b].frustum.volume_m3();
    queue_.emplace(both->frustum.volume_m3() / apart, a, b);
  }

  std::optional<Union> united(std::size_t a, std::size_t b) const {
    const std::vector<std::uint32_t>&of_a = groups_[a].frustum.members, &of_b = groups_[b].frustum.members;
    for (const std::uint32_t light : of_a)
      for (const std::uint32_t other : of_b)
        if (!may_share(lights_[light], lights_[other], limits_)) return std::nullopt;
    std::vector<std::uint32_t> members;
    std::ranges::merge(of_a, of_b, std::back_inserter(members));
    std::optional<SharedFrustum> frustum = frustum_around(lights_, members);
    const double largest = std::max(groups_[a].largest_m3, groups_[b].largest_m3);
    if (!frustum || !(frustum->volume_m3() <= limits_.most_growth * largest)) return std::nullopt;
    return Union{std::move(*frustum), largest};
  }

  // Neighbours of either group are tested again with the joined group: a frustum around more lights can be smaller.
  void join(std::size_t a, std::size_t b) {
    Union both = *united(a, b);
    std::set<std::size_t> neighbours = groups_[a].neighbours;
    neighbours.insert(groups_[b].neighbours.begin(), groups_[b].neighbours.end());
    groups_[a].is_gone = groups_[b].is_gone = true;
    const std::size_t joined = groups_.size();
    add_group(std::move(both.frustum), both.largest_m3);
    for (const std::size_t neighbour : neighbours)
      if (!groups_[neighbour].is_gone) add_neighbours(neighbour, joined);
  }

  std::span<const scene::WorldLight> lights_;
  SharingLimits limits_;
  std::vector<Group> groups_;
  using Join = std::tuple<double, std::size_t, std::size_t>;  // cost, two groups
  std::priority_queue<Join, std::vector<Join>, std::greater<>> queue_;
};

void add_growth(SharingCounts& counts, std::span<const scene::WorldLight> lights, const SharedFrustum& frustum) {
  double largest_m3 = 0.0, sum_m3 = 0.0, largest_sr = 0.0, sum_sr = 0.0;
  for (const std::uint32_t member : frustum.members) {
    const SharedFrustum own = *frustum_around(lights, std::span(&member, 1));
    largest_m3 = std::max(largest_m3, own.volume_m3());
    largest_sr = std::max(largest_sr, own.solid_angle_sr());
    sum_m3 += own.volume_m3();
    sum_sr += own.solid_angle_sr();
  }
  counts.volume_over_largest.add(frustum.volume_m3() / largest_m3);
  counts.volume_over_sum.add(frustum.volume_m3() / sum_m3);
  counts.angle_over_largest.add(frustum.solid_angle_sr() / largest_sr);
  counts.angle_over_sum.add(frustum.solid_angle_sr() / sum_sr);
}

}  // namespace

double SharedFrustum::solid_angle_sr() const {
  const double square = slope * slope;
  return 4.0 * std::asin(square / (1.0 + square));
}

double SharedFrustum::volume_m3() const {
  return 4.0 / 3.0 * slope * slope * (far_m * far_m * far_m - near_m * near_m * near_m);
}

std::optional<SharedFrustum> frustum_around(std::span<const scene::WorldLight> lights,
                                            std::span<const std::uint32_t> spots) {
  SharedFrustum out;
  out.members.assign(spots.begin(), spots.end());
  // Relative to one of them: far from the origin the positions themselves are rounded.
  const Vec3d origin = lights[spots.front()].position;
  Vec3d middle(0.0), axis(0.0);
  double away_m = 0.0;
  for (const std::uint32_t spot : spots) {
    middle += (lights[spot].position - origin) / static_cast<double>(spots.size());
    axis += lights[spot].direction;
    away_m = std::max(away_m, glm::length(lights[spot].position));
  }
  if (glm::length(axis) == 0.0) return std::nullopt;
  out.axis = glm::normalize(axis);
  double widest_rad = 0.0;
  for (const std::uint32_t spot : spots)
    widest_rad =
        std::max(widest_rad, geom::angle_between(out.axis, lights[spot].direction) + lights[spot].outer_cone_rad);
  widest_rad += k_slack;
  if (widest_rad > k_widest_frustum_rad) return std::nullopt;
  out.slope = std::tan(widest_rad);
  double back_m = 0.0, size_m = 0.0;
  for (const std::uint32_t spot : spots) {
    const Vec3d from_middle = (lights[spot].position - origin) - middle;
    const double along = glm::dot(from_middle, out.axis);
    back_m = std::max(back_m, glm::length(from_middle - along * out.axis) / out.slope - along);
    size_m = std::max(size_m, glm::length(from_middle));
  }
  // Rounding error of the apex, and of depths from it.
  const double rounding_m = spots.size() > 1 ? k_position_slack * away_m : 0.0;
  if (spots.size() > 1) back_m += k_slack * (size_m + back_m) + rounding_m * (1.0 + 1.0 / out.slope);
  out.apex = origin + (middle - back_m * out.axis);
  out.near_m = std::numeric_limits<double>::infinity();
  for (const std::uint32_t spot : spots) {
    const scene::WorldLight& light = lights[spot];
    const double depth = glm::dot(light.position - out.apex, out.axis);
    const double slack = k_slack * (depth + light.range_m) + rounding_m;
    out.near_m = std::min(out.near_m, std::max(0.0, depth - slack));
    out.far_m = std::max(out.far_m, depth + depth_along(light, geom::angle_between(out.axis, light.direction)) + slack);
  }
  if (!std::isfinite(out.far_m)) return std::nullopt;
  return out;
}

std::vector<SharedFrustum> shared_frusta(std::span<const scene::WorldLight> lights,
                                         std::span<const std::uint32_t> spots, const SharingLimits& limits) {
  return Grouping(lights, spots, limits).joined();
}

void MeanMost::add(double value) {
  sum += value;
  most = count == 0 ? value : std::max(most, value);
  ++count;
}

double MeanMost::mean() const {
  return count > 0 ? sum / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
}

double SharingCounts::saved() const {
  return spots.sum > 0.0 ? 1.0 - maps.sum / spots.sum : std::numeric_limits<double>::quiet_NaN();
}

void add_frame(SharingCounts& counts, const view::Frame& frame, const SharingLimits& limits) {
  std::vector<std::uint32_t> spots;
  std::size_t points = 0;
  const std::vector<bool> in_view = grid::lights_in_view(frame);
  for (std::uint32_t i = 0; i < frame.lights.size(); ++i) {
    const scene::LightType type = frame.lights[i].type;
    if (type == scene::LightType::box || !in_view[i]) continue;
    if (type == scene::LightType::spot)
      spots.push_back(i);
    else
      ++points;
  }
  const std::vector<SharedFrustum> frusta = shared_frusta(frame.lights, spots, limits);
  std::size_t held = 0, shared = 0;
  for (const SharedFrustum& frustum : frusta) {
    held += frustum.members.size();
    counts.most_members = std::max<std::uint64_t>(counts.most_members, frustum.members.size());
    if (frustum.members.size() == 1) continue;
    ++shared;
    add_growth(counts, frame.lights, frustum);
  }
  counts.points.add(static_cast<double>(points));
  counts.spots.add(static_cast<double>(spots.size()));
  counts.maps.add(static_cast<double>(spots.size() - held + frusta.size()));
  counts.shared.add(static_cast<double>(shared));
}

}  // namespace clusterbench::measure
