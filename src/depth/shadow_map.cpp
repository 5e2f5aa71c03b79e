#include "depth/shadow_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/memory.h"
#include "depth/texel_cover.h"
#include "geom/numbers/round_to_float.h"
#include "geom/shapes/angle_between.h"

namespace clusterbench::depth {
namespace {

constexpr float k_unlimited = std::numeric_limits<float>::infinity();

struct Axes {
  Vec3d right, up, forward;
};

// The sides of a cube, as seen from its middle.
std::array<Axes, 6> cube_axes() {
  const Vec3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  return {Axes{-z, y, x}, Axes{z, y, -x}, Axes{x, -z, y}, Axes{x, z, -y}, Axes{x, y, z}, Axes{-x, y, -z}};
}

Axes axes_along(const Vec3d& forward) {
  const Vec3d aside = std::abs(forward.y) < 0.9 ? Vec3d(0, 1, 0) : Vec3d(1, 0, 0);
  const Vec3d right = glm::normalize(glm::cross(forward, aside));
  return {right, glm::cross(right, forward), forward};
}

// Wider than all roundoffs of an angle, and by no more than a thousandth of a texel.
constexpr double k_angle_slack = 1e-6;

// Whether none of the directions between these is within a spot's cone.
bool is_outside_cone(const scene::WorldLight& light, const std::array<Vec3d, 4>& corners) {
  if (light.type != scene::LightType::spot) return false;
  const Vec3d middle = corners[0] + corners[1] + corners[2] + corners[3];
  double spread = 0.0;
  for (const Vec3d& corner : corners) spread = std::max(spread, geom::angle_between(middle, corner));
  return geom::angle_between(middle, light.direction) > light.outer_cone_rad + spread + k_angle_slack;
}

// Calls `use` for the body's edges, by their two corners, whose numbers differ in one bit.
template <class Use>
void each_edge(Use&& use) {
  for (unsigned i = 0; i < 8; ++i)
    for (const unsigned bit : {1u, 2u, 4u})
      if ((i & bit) == 0) use(i, i | bit);
}

}  // namespace

const char* name_of(TexelBound bound) {
  return bound == TexelBound::proven ? "proven" : "sampled";
}

ShadowMap::ShadowMap(const RayCaster& caster, const scene::WorldLight& light, const ShadowMapRequest& request)
    : light_(light), request_(request) {
  const bool is_spot = light.type == scene::LightType::spot;
  if (is_spot && light.outer_cone_rad <= k_widest_spot_rad) {
    const Axes axes = axes_along(glm::normalize(light.direction));
    slope_ = std::tan(light.outer_cone_rad) * (1.0 + k_angle_slack) + k_angle_slack;
    faces_.push_back({axes.right, axes.up, axes.forward, {}});
  } else {
    for (const Axes& axes : cube_axes()) faces_.push_back({axes.right, axes.up, axes.forward, {}});
  }
  check_memory("bytes of shadow maps", most_bytes(request), 1, "ask for a lower resolution");
  for (Face& face : faces_) cast(caster, face);
}

void ShadowMap::cast(const RayCaster& caster, Face& face) {
  const int size = request_.resolution;
  const auto along = [&](int x, int y) {
    const auto slope = [&](int i) { return slope_ * (2.0 * i / size - 1.0); };
    return face.forward + slope(x) * face.right + slope(y) * face.up;
  };
  const CastRay first_surface = [&](const Vec3d& direction) {
    return caster.first_surface(light_.position, glm::normalize(direction), request_.near_m, light_.range_m);
  };
  const auto row = [&](int y) {
    std::vector<std::optional<SurfaceHit>> hits;
    for (int x = 0; x <= size; ++x) hits.push_back(first_surface(along(x, y)));
    return hits;
  };
  Level& finest = face.levels.emplace_back();
  finest.size = size;
  finest.farthest.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  std::vector<std::optional<SurfaceHit>> low = row(0);
  for (int y = 0; y < size; ++y) {
    std::vector<std::optional<SurfaceHit>> high = row(y + 1);
    for (int x = 0; x < size; ++x) {
      const std::array corners{along(x, y), along(x + 1, y), along(x + 1, y + 1), along(x, y + 1)};
      const auto i = static_cast<std::size_t>(x);
      const std::array hits{low[i], low[i + 1], high[i + 1], high[i]};
      if (is_outside_cone(light_, corners)) {
        finest.farthest.push_back(0.0f);
      } else if (!std::ranges::all_of(hits, [](const auto& hit) { return hit.has_value(); })) {
        finest.farthest.push_back(k_unlimited);
      } else if (request_.bound == TexelBound::sampled) {
        double farthest = 0.0;
        for (const auto& hit : hits) farthest = std::max(farthest, hit->distance_m);
        finest.farthest.push_back(geom::rounded_up(farthest));
      } else {
        const std::array found{*hits[0], *hits[1], *hits[2], *hits[3]};
        finest.farthest.push_back(geom::rounded_up(covered_distance(corners, found, first_surface, request_.near_m)));
      }
    }
    low = std::move(high);
  }
}

void ShadowMap::reduce() {
  for (Face& face : faces_) {
    while (face.levels.back().size > 1) {
      const Level& fine = face.levels.back();
      Level coarse{(fine.size + 1) / 2, {}};
      for (int y = 0; y < coarse.size; ++y)
        for (int x = 0; x < coarse.size; ++x) {
          const int x1 = std::min(2 * x + 1, fine.size - 1), y1 = std::min(2 * y + 1, fine.size - 1);
          const auto at = [&](int i, int k) { return fine.farthest[static_cast<std::size_t>(k * fine.size + i)]; };
          coarse.farthest.push_back(std::max({at(2 * x, 2 * y), at(x1, 2 * y), at(2 * x, y1), at(x1, y1)}));
        }
      face.levels.push_back(std::move(coarse));
    }
  }
}

float ShadowMap::texel(std::size_t face, int x, int y) const {
  return faces_[face].levels.front().farthest[static_cast<std::size_t>(y * request_.resolution + x)];
}

ShadowMap::TexelCounts ShadowMap::texel_counts() const {
  TexelCounts counts;
  for (const Face& face : faces_)
    for (const float farthest : face.levels.front().farthest) {
      counts.texels += farthest > 0.0f ? 1 : 0;
      counts.unlimited += farthest == k_unlimited ? 1 : 0;
    }
  return counts;
}

std::uint64_t ShadowMap::most_bytes(const ShadowMapRequest& request) {
  constexpr std::uint64_t k_most_faces = 6;
  std::uint64_t texels = 0;
  for (std::uint64_t size = static_cast<std::uint64_t>(request.resolution); size > 0;
       size = size > 1 ? (size + 1) / 2 : 0)
    texels += size * size;
  return k_most_faces * texels * sizeof(float);
}

std::size_t ShadowMap::bytes() const {
  std::size_t texels = 0;
  for (const Face& face : faces_)
    for (const Level& level : face.levels) texels += level.farthest.size();
  return texels * sizeof(float);
}

// At most this many texels of a level are tested along each axis.
constexpr int k_most_texels = 4;

float ShadowMap::farthest(const Face& face, const Rectangle& covered) const {
  // The position of a side, in texels, with a slack of a little more than roundoffs.
  const auto texel = [&](double slope, double slack) {
    const double at = (slope / slope_ + 1.0) * 0.5 * request_.resolution + slack;
    return static_cast<int>(std::clamp(std::floor(at), 0.0, request_.resolution - 1.0));
  };
  constexpr double k_slack = 1e-6;
  int x0 = texel(covered.left, -k_slack), x1 = texel(covered.right, k_slack);
  int y0 = texel(covered.bottom, -k_slack), y1 = texel(covered.top, k_slack);
  std::size_t level = 0;
  for (; std::max(x1 - x0, y1 - y0) >= k_most_texels && level + 1 < face.levels.size(); ++level) {
    x0 /= 2;
    x1 /= 2;
    y0 /= 2;
    y1 /= 2;
  }
  const Level& texels = face.levels[level];
  float farthest = 0.0f;
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x)
      farthest = std::max(farthest, texels.farthest[static_cast<std::size_t>(y * texels.size + x)]);
  return farthest;
}

bool ShadowMap::hides(const std::array<Vec3d, 8>& corners, double nearest_m, double bias_m) const {
  if (!(nearest_m > bias_m)) return false;
  const auto is_finite = [](const Vec3d& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); };
  if (!std::ranges::all_of(corners, is_finite)) return false;
  // In a face's pyramid every point of the body is at least this deep, since it is at least as far away as the body.
  const double least_depth = nearest_m / std::sqrt(1.0 + 2.0 * slope_ * slope_) * (1.0 - 1e-9);
  for (const Face& face : faces_) {
    std::array<Vec3d, 8> local;
    for (std::size_t i = 0; i < 8; ++i)
      local[i] = {glm::dot(face.right, corners[i]), glm::dot(face.up, corners[i]), glm::dot(face.forward, corners[i])};
    constexpr double k_none = std::numeric_limits<double>::infinity();
    Rectangle covered{k_none, -k_none, k_none, -k_none};
    const auto add = [&](const Vec3d& point) {
      covered.left = std::min(covered.left, point.x / point.z);
      covered.right = std::max(covered.right, point.x / point.z);
      covered.bottom = std::min(covered.bottom, point.y / point.z);
      covered.top = std::max(covered.top, point.y / point.z);
    };
    for (const Vec3d& point : local)
      if (point.z >= least_depth) add(point);
    each_edge([&](unsigned i, unsigned k) {
      const Vec3d &a = local[i], &b = local[k];
      if ((a.z >= least_depth) == (b.z >= least_depth)) return;
      const Vec3d between = a + (least_depth - a.z) / (b.z - a.z) * (b - a);
      add({between.x, between.y, least_depth});
    });
    const bool is_beside =
        !(covered.left <= slope_ && covered.right >= -slope_ && covered.bottom <= slope_ && covered.top >= -slope_);
    if (is_beside) continue;
    if (!(nearest_m > static_cast<double>(farthest(face, covered)) + bias_m)) return false;
  }
  return true;
}

}  // namespace clusterbench::depth
