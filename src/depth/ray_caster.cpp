#include "depth/ray_caster.h"

#if CLUSTERBENCH_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "core/text.h"
#include "geom/shapes/domain.h"

namespace clusterbench::depth {
namespace {

constexpr float k_nothing = std::numeric_limits<float>::infinity();

// One instruction set on all x86 machines, so that the triangle that a ray meets does not depend on the machine: other
// sets fuse products and sums.
#if defined(__x86_64__) || defined(_M_X64)
constexpr const char* k_device = "isa=sse4.2,set_affinity=0";
#else
constexpr const char* k_device = "set_affinity=0";
#endif

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseGeometry {
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
using SurfaceTree = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;

void check(RTCDevice device) {
  const RTCError fault = rtcGetDeviceError(device);
  if (fault == RTC_ERROR_NONE) return;
  throw Error("", "depth",
              fault == RTC_ERROR_OUT_OF_MEMORY ? "not enough memory for the scene's triangles"
                                               : "Embree fails with error " + std::to_string(fault),
              ExitCode::internal);
}

// How rays are cast. Embree 3 takes a context, Embree 4 arguments that refer to one. The context comes first: Embree
// passes its address to filters.
struct RayQuery {
#if CLUSTERBENCH_EMBREE_MAJOR >= 4
  RTCRayQueryContext context;
  RTCIntersectArguments arguments;

  RayQuery() {
    rtcInitRayQueryContext(&context);
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context;
  }
  void expect_coherent_rays() {
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  }
  void find_first(RTCScene surfaces, RTCRayHit& ray) {
    rtcIntersect1(surfaces, &ray, &arguments);
  }
#else
  RTCIntersectContext context;

  RayQuery() {
    rtcInitIntersectContext(&context);
  }
  void expect_coherent_rays() {
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  }
  void find_first(RTCScene surfaces, RTCRayHit& ray) {
    rtcIntersect1(surfaces, &context, &ray);
  }
#endif
  RayQuery(const RayQuery&) = delete;
  RayQuery& operator=(const RayQuery&) = delete;
};

bool is_occluded(RTCScene surfaces, RTCRay& ray) {
#if CLUSTERBENCH_EMBREE_MAJOR >= 4
  rtcOccluded1(surfaces, &ray);
#else
  RayQuery query;
  rtcOccluded1(surfaces, &query.context, &ray);
#endif
  return ray.tfar < 0.0f;
}

Vec3f direction_of(const RTCRay& ray) {
  return {ray.dir_x, ray.dir_y, ray.dir_z};
}

// A triangle's front is the side from which it is counter-clockwise; Embree's normals point there.
bool shows_its_back(const RTCRay& ray, const RTCHit& hit) {
  return glm::dot(direction_of(ray), Vec3f(hit.Ng_x, hit.Ng_y, hit.Ng_z)) > 0.0f;
}

// The intersection of a ray with a triangle's plane, in double precision: Embree's own value depends on a processor's
// estimate of reciprocals, and depths must not depend on the machine.
float depth_at(RTCScene surfaces, const RTCRay& ray, unsigned surface, unsigned triangle) {
  RTCGeometry mesh = rtcGetGeometry(surfaces, surface);
  const auto* vertices = static_cast<const Vec3f*>(rtcGetGeometryBufferData(mesh, RTC_BUFFER_TYPE_VERTEX, 0));
  const auto& corners =
      static_cast<const scene::Triangle*>(rtcGetGeometryBufferData(mesh, RTC_BUFFER_TYPE_INDEX, 0))[triangle];
  const Vec3d a(vertices[corners[0]]), b(vertices[corners[1]]), c(vertices[corners[2]]);
  const Vec3d normal = glm::cross(b - a, c - a);
  const double depth =
      glm::dot(normal, a - Vec3d(ray.org_x, ray.org_y, ray.org_z)) / glm::dot(normal, Vec3d(direction_of(ray)));
  // For a triangle seen edge on the intersection is not well defined.
  constexpr double k_max_difference = 1e-3;
  const auto found = static_cast<double>(ray.tfar);
  return std::abs(depth - found) <= k_max_difference * found ? static_cast<float>(depth) : ray.tfar;
}

// Filters get one ray, since rays are cast one by one.
void leave_out_backs(const RTCFilterFunctionNArguments* arguments) {
  const auto* ray = reinterpret_cast<const RTCRay*>(arguments->ray);
  const auto* hit = reinterpret_cast<const RTCHit*>(arguments->hit);
  if (arguments->valid[0] == -1 && shows_its_back(*ray, *hit)) arguments->valid[0] = 0;
}

// The hits of a ray through surfaces that blend. The query comes first: filters find this by its address.
struct Gathering {
  struct Found {
    float depth;
    std::uint32_t surface;
  };
  RayQuery query;
  RTCScene surfaces;
  std::vector<Found> found;

  explicit Gathering(RTCScene of) : surfaces(of) {}

  // The nearest ones, front to back. Embree may pass the same triangle to a filter more than once, and a ray through an
  // edge that two triangles of a surface share meets both: one layer.
  void finish(std::size_t most) {
    const auto by_surface = [](const Found& a, const Found& b) {
      return a.surface != b.surface ? a.surface < b.surface : a.depth < b.depth;
    };
    const auto by_depth = [](const Found& a, const Found& b) {
      return a.depth != b.depth ? a.depth < b.depth : a.surface < b.surface;
    };
    std::ranges::sort(found, by_surface);
    const auto is_same = [](const Found& a, const Found& b) {
      return a.surface == b.surface && b.depth - a.depth <= 1e-6f * b.depth;
    };
    found.erase(std::unique(found.begin(), found.end(), is_same), found.end());
    std::ranges::sort(found, by_depth);
    if (found.size() > most) found.resize(most);
  }
};

void gather(const RTCFilterFunctionNArguments* arguments, bool with_backs) {
  const auto* ray = reinterpret_cast<const RTCRay*>(arguments->ray);
  const auto* hit = reinterpret_cast<const RTCHit*>(arguments->hit);
  if (arguments->valid[0] != -1) return;
  arguments->valid[0] = 0;  // the ray goes on
  if (!with_backs && shows_its_back(*ray, *hit)) return;
  auto* gathering = reinterpret_cast<Gathering*>(arguments->context);
  gathering->found.push_back({depth_at(gathering->surfaces, *ray, hit->geomID, hit->primID), hit->geomID});
}
void gather_both_sides(const RTCFilterFunctionNArguments* arguments) {
  gather(arguments, true);
}
void gather_fronts(const RTCFilterFunctionNArguments* arguments) {
  gather(arguments, false);
}

RTCRayHit ray_of(const Vec3f& from, const Vec3f& along, float near, float far) {
  RTCRayHit out{};
  out.ray.org_x = from.x;
  out.ray.org_y = from.y;
  out.ray.org_z = from.z;
  out.ray.dir_x = along.x;
  out.ray.dir_y = along.y;
  out.ray.dir_z = along.z;
  out.ray.tnear = near;
  out.ray.tfar = far;
  out.ray.mask = ~0U;
  out.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  out.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return out;
}

// The picture's rays in the space of the surfaces. A ray's parameter is the depth.
class Camera {
 public:
  Camera(const view::Frame& frame, const Vec3d& origin, const PixelGrid& pixels)
      : frame_(frame),
        pixels_(pixels),
        world_from_view_(glm::transpose(frame.view_space.rotation)),
        eye_(frame.view_space.origin - origin) {}

  RTCRayHit ray(std::size_t index) const {
    const view::PictureRay view_ray = view::picture_ray(frame_, pixels_.pixel(index));
    const Vec3f from(eye_ + world_from_view_ * view_ray.from), along(world_from_view_ * view_ray.along);
    return ray_of(from, along, static_cast<float>(frame_.projection.near_m),
                  static_cast<float>(frame_.projection.far_m));
  }

 private:
  const view::Frame& frame_;
  const PixelGrid& pixels_;
  Mat3d world_from_view_;
  Vec3d eye_;
};

struct PlacedSurface {
  std::size_t surface = 0, node = 0;
  bool is_mirrored = false;
  Mat4d world{1.0};

  friend bool operator==(const PlacedSurface&, const PlacedSurface&) = default;
};

}  // namespace

// The built surfaces, around an eye: single precision cannot hold the world's own coordinates, and surfaces near the
// eye must be precise, however far others reach.
struct RayCaster::Surfaces {
  Device device;
  SurfaceTree opaque, blending;
  Vec3d origin{0.0};
  std::vector<PlacedSurface> placed;  // as they were built

  Surfaces() : device(rtcNewDevice(k_device)) { check(device.get()); }
};

RayCaster::RayCaster(const scene::Scene& scene, const scene::Geometry& geometry) : scene_(scene), geometry_(geometry) {}
RayCaster::~RayCaster() = default;

namespace {

// Poses of the visible surfaces.
std::vector<PlacedSurface> placed_surfaces(const scene::Scene& scene, const scene::Geometry& geometry, double time_s) {
  const std::vector<Mat4d> world = world_transforms(scene, time_s);
  const std::vector<bool> shown = visible_nodes(scene, time_s);
  std::vector<PlacedSurface> out;
  for (const scene::SurfaceInstance& instance : geometry.instances) {
    const auto node = static_cast<std::size_t>(instance.shown_by);
    if (!shown[node]) continue;
    // In a mirrored node fronts stay fronts, also of skinned meshes (glTF 2.0, 3.7.4).
    const bool is_mirrored = glm::determinant(Mat3d(world[node])) < 0.0;
    out.push_back({instance.surface, node, is_mirrored, instance.node < 0 ? Mat4d(1.0) : world[node]});
  }
  return out;
}

// Vertices in world space.
template <class Use>
void each_vertex(const scene::Surface& surface, const PlacedSurface& placed, Use&& use) {
  for (const Vec3f& vertex : surface.vertices) use(Vec3d(placed.world * Vec4d(surface.origin + Vec3d(vertex), 1.0)));
}

void check_domain(const scene::Scene& scene, const PlacedSurface& placed, const Vec3d& vertex) {
  if (geom::is_in_domain(vertex.x) && geom::is_in_domain(vertex.y) && geom::is_in_domain(vertex.z)) return;
  const scene::Node& node = scene.nodes[placed.node];
  throw Error(scene.path.string(), "/nodes/" + std::to_string(node.gltf_index),
              "the mesh of node '" + printable(node.name) + "' reaches farther than 1e15 m from the world's origin");
}

// Adds a surface with its pose relative to an origin.
void add_surface(RTCDevice device, RTCScene to, const scene::Scene& scene, const scene::Surface& surface,
                 const PlacedSurface& placed, const Vec3d& origin, RTCFilterFunctionN filter) {
  RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  const std::unique_ptr<std::remove_pointer_t<RTCGeometry>, ReleaseGeometry> owned(mesh);
  auto* vertices = static_cast<Vec3f*>(rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               sizeof(Vec3f), surface.vertices.size()));
  auto* triangles = static_cast<scene::Triangle*>(rtcSetNewGeometryBuffer(
      mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(scene::Triangle), surface.triangles.size()));
  if (vertices == nullptr || triangles == nullptr) return check(device);
  each_vertex(surface, placed, [&](const Vec3d& vertex) {
    check_domain(scene, placed, vertex);
    *vertices++ = Vec3f(vertex - origin);
  });
  for (const scene::Triangle& triangle : surface.triangles)
    *triangles++ = placed.is_mirrored ? scene::Triangle{triangle[0], triangle[2], triangle[1]} : triangle;
  if (filter != nullptr) rtcSetGeometryIntersectFilterFunction(mesh, filter);
  rtcCommitGeometry(mesh);
  rtcAttachGeometry(to, mesh);
}

// The origin of coordinates in single precision: a point near the eye that depends only on this frame. There they
// resolve a thousandth of the near plane's distance, or a tenth of a millimetre.
Vec3d origin_near(const view::Frame& frame) {
  const double near = frame.projection.near_m;
  const double step = near > 0.0 ? std::min(1000.0, 1e4 * near) : 1000.0;
  return glm::round(frame.view_space.origin / step) * step;
}

}  // namespace

void RayCaster::pose(const view::Frame& frame) {
  pose(frame.time_s, origin_near(frame));
}

void RayCaster::pose(double time_s, const Vec3d& origin) {
  std::vector<PlacedSurface> placed = placed_surfaces(scene_, geometry_, time_s);
  if (surfaces_ && surfaces_->placed == placed && surfaces_->origin == origin) return;
  // A triangle and Embree's data for it.
  constexpr std::uint64_t k_bytes_of_triangle = 256;
  check_memory("triangles", geometry_.triangle_count(), k_bytes_of_triangle, scene::k_fewer_triangles);
  check_memory("vertices", geometry_.vertex_count(), sizeof(Vec3f), scene::k_fewer_triangles);
  if (!surfaces_) surfaces_ = std::make_unique<Surfaces>();
  Surfaces& now = *surfaces_;
  now.placed.clear();  // until all are built
  now.origin = origin;
  for (SurfaceTree* tree : {&now.opaque, &now.blending}) {
    tree->reset(rtcNewScene(now.device.get()));
    rtcSetSceneFlags(tree->get(), RTC_SCENE_FLAG_ROBUST);
  }
  for (const PlacedSurface& instance : placed) {
    const scene::Surface& surface = geometry_.surfaces[instance.surface];
    const RTCFilterFunctionN filter = surface.blends ? (surface.double_sided ? gather_both_sides : gather_fronts)
                                                     : (surface.double_sided ? nullptr : leave_out_backs);
    add_surface(now.device.get(), (surface.blends ? now.blending : now.opaque).get(), scene_, surface, instance,
                now.origin, filter);
  }
  rtcCommitScene(now.opaque.get());
  rtcCommitScene(now.blending.get());
  check(now.device.get());
  now.placed = std::move(placed);
  ++builds_;
}

namespace {

std::array<Vec3d, 3> corners_of(RTCScene surfaces, const RTCHit& hit) {
  RTCGeometry mesh = rtcGetGeometry(surfaces, hit.geomID);
  const auto* vertices = static_cast<const Vec3f*>(rtcGetGeometryBufferData(mesh, RTC_BUFFER_TYPE_VERTEX, 0));
  const auto& corners =
      static_cast<const scene::Triangle*>(rtcGetGeometryBufferData(mesh, RTC_BUFFER_TYPE_INDEX, 0))[hit.primID];
  return {Vec3d(vertices[corners[0]]), Vec3d(vertices[corners[1]]), Vec3d(vertices[corners[2]])};
}

}  // namespace

std::optional<SurfaceHit> RayCaster::first_surface(const Vec3d& from, const Vec3d& along, double begin_m,
                                                   double end_m) const {
  const Vec3d local = from - surfaces_->origin;
  RTCRayHit ray = ray_of(Vec3f(local), Vec3f(along), static_cast<float>(begin_m), static_cast<float>(end_m));
  RayQuery query;
  query.find_first(surfaces_->opaque.get(), ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  SurfaceHit hit{static_cast<double>(depth_at(surfaces_->opaque.get(), ray.ray, ray.hit.geomID, ray.hit.primID)),
                 corners_of(surfaces_->opaque.get(), ray.hit)};
  for (Vec3d& corner : hit.corners) corner -= local;
  return hit;
}

bool RayCaster::is_blocked(const Vec3d& from, const Vec3d& along, double begin_m, double end_m) const {
  // A little farther, so that surfaces close to the end are tested in double precision.
  constexpr double k_farther = 1.001;
  const std::optional<SurfaceHit> hit = first_surface(from, along, begin_m, k_farther * end_m);
  return hit && hit->distance_m < end_m;
}

DepthImage RayCaster::depths(const view::Frame& frame, const PixelGrid& pixels, int threads) const {
  const Camera camera(frame, surfaces_->origin, pixels);
  DepthImage out{pixels, {}};
  check_memory("depths of pixels", pixels.count(), sizeof(float), "ask for a larger divisor");
  out.nearest.assign(pixels.count(), k_nothing);
  parallel_ranges(pixels.count(), threads, [&](std::size_t begin, std::size_t end) {
    RayQuery query;
    query.expect_coherent_rays();
    for (std::size_t i = begin; i < end; ++i) {
      RTCRayHit ray = camera.ray(i);
      query.find_first(surfaces_->opaque.get(), ray);
      if (ray.hit.geomID != RTC_INVALID_GEOMETRY_ID)
        out.nearest[i] = depth_at(surfaces_->opaque.get(), ray.ray, ray.hit.geomID, ray.hit.primID);
    }
  });
  return out;
}

bool RayCaster::is_hidden(const Vec3d& from, const Vec3d& to, double ends_before_m) const {
  const Vec3d way = to - from;
  const double distance = glm::length(way);
  if (!(distance > ends_before_m)) return false;
  RTCRay ray =
      ray_of(Vec3f(from - surfaces_->origin), Vec3f(way / distance), 0.0f, static_cast<float>(distance - ends_before_m))
          .ray;
  return is_occluded(surfaces_->opaque.get(), ray);
}

double RayCaster::clearance_m(const Vec3d& from) const {
  constexpr double k_least_m = 1e-4, k_share = 0x1p-19;  // 32 units of single precision's rounding
  const Vec3d local = glm::abs(from - surfaces_->origin);
  return std::max(k_least_m, k_share * std::max({local.x, local.y, local.z}));
}

std::vector<double> RayCaster::free_ways(std::span<const WorldRay> rays, int threads) const {
  std::vector<double> ways(rays.size());
  RTCScene surfaces = surfaces_->opaque.get();
  parallel_ranges(rays.size(), threads, [&](std::size_t begin, std::size_t end) {
    RayQuery query;
    for (std::size_t i = begin; i < end; ++i) {
      const WorldRay& world = rays[i];
      RTCRayHit ray =
          ray_of(Vec3f(world.from - surfaces_->origin), Vec3f(world.along), 0.0f, static_cast<float>(world.most_m));
      query.find_first(surfaces, ray);
      ways[i] = world.most_m;
      if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
      ways[i] =
          std::min(world.most_m, static_cast<double>(depth_at(surfaces, ray.ray, ray.hit.geomID, ray.hit.primID)));
    }
  });
  return ways;
}

LayerImage RayCaster::layers(const view::Frame& frame, const DepthImage& opaque, int most_layers, int threads) const {
  const Camera camera(frame, surfaces_->origin, opaque.pixels);
  const std::size_t count = opaque.pixels.count();
  const auto most = static_cast<std::size_t>(most_layers);
  check_memory("depths of layers", count * most, sizeof(float), "ask for fewer layers or a larger divisor");
  std::vector<std::vector<float>> found(static_cast<std::size_t>(opaque.pixels.size.y));
  LayerImage out{opaque.pixels, std::vector<std::uint32_t>(count + 1, 0), {}};
  const auto width = static_cast<std::size_t>(opaque.pixels.size.x);
  parallel_ranges(found.size(), threads, [&](std::size_t begin, std::size_t end) {
    Gathering gathering(surfaces_->blending.get());
    for (std::size_t row = begin; row < end; ++row) {
      for (std::size_t i = row * width; i < (row + 1) * width; ++i) {
        RTCRayHit ray = camera.ray(i);
        ray.ray.tfar = std::min(ray.ray.tfar, opaque.nearest[i]);
        gathering.found.clear();
        gathering.query.find_first(surfaces_->blending.get(), ray);
        gathering.finish(most);
        out.begin[i + 1] = static_cast<std::uint32_t>(gathering.found.size());
        for (const Gathering::Found& layer : gathering.found) found[row].push_back(layer.depth);
      }
    }
  });
  for (std::size_t i = 0; i < count; ++i) out.begin[i + 1] += out.begin[i];
  for (const std::vector<float>& row : found) out.depths.insert(out.depths.end(), row.begin(), row.end());
  return out;
}

}  // namespace clusterbench::depth
