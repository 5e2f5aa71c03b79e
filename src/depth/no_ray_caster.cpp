// Of a build without Embree: who asks for rays is told so. Plans ask core/libraries.h before they do.

#include "core/error.h"
#include "core/libraries.h"
#include "core/text.h"
#include "depth/ray_caster.h"

namespace clusterbench::depth {
namespace {

[[noreturn]] void refuse_rays(const scene::Scene& scene, const scene::Geometry& geometry) {
  throw Error(
      scene.path.string(), "",
      number_of(geometry.triangle_count(), "triangle") + " cannot be seen: " + missing_library(Library::embree));
}

}  // namespace

struct RayCaster::Surfaces {};

RayCaster::RayCaster(const scene::Scene& scene, const scene::Geometry& geometry) : scene_(scene), geometry_(geometry) {}
RayCaster::~RayCaster() = default;

void RayCaster::pose(const view::Frame& /*frame*/) {
  refuse_rays(scene_, geometry_);
}
void RayCaster::pose(double /*time_s*/, const Vec3d& /*origin*/) {
  refuse_rays(scene_, geometry_);
}
DepthImage RayCaster::depths(const view::Frame& /*frame*/, const PixelGrid& /*pixels*/, int /*threads*/) const {
  refuse_rays(scene_, geometry_);
}
bool RayCaster::is_hidden(const Vec3d& /*from*/, const Vec3d& /*to*/, double /*ends_before_m*/) const {
  refuse_rays(scene_, geometry_);
}
double RayCaster::clearance_m(const Vec3d& /*from*/) const {
  refuse_rays(scene_, geometry_);
}
LayerImage RayCaster::layers(const view::Frame& /*frame*/, const DepthImage& /*opaque*/, int /*most_layers*/,
                             int /*threads*/) const {
  refuse_rays(scene_, geometry_);
}
std::vector<double> RayCaster::free_ways(std::span<const WorldRay> /*rays*/, int /*threads*/) const {
  refuse_rays(scene_, geometry_);
}
std::optional<SurfaceHit> RayCaster::first_surface(const Vec3d& /*from*/, const Vec3d& /*along*/, double /*begin_m*/,
                                                   double /*end_m*/) const {
  refuse_rays(scene_, geometry_);
}
bool RayCaster::is_blocked(const Vec3d& /*from*/, const Vec3d& /*along*/, double /*begin_m*/, double /*end_m*/) const {
  refuse_rays(scene_, geometry_);
}

}  // namespace clusterbench::depth
