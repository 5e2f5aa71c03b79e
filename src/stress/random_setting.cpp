#include "stress/random_setting.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "stress/contact.h"
#include "stress/hard_cases.h"
#include "stress/random_boxes.h"

namespace clusterbench::stress {
namespace {

// Limit of coordinates and ranges in a scene of this tool.
constexpr double k_largest_m = 1e15;
// Ranges beyond the domain have no end. The largest float's is more than files can hold.
constexpr double k_longest_range_m = 1e30;
constexpr double k_right_angle = 90.0 * k_degree;

double at_most_largest(double value) {
  return std::clamp(value, -k_largest_m, k_largest_m);
}

// The size of a setting: slices end at far_m, lattices have steps of step_m.
struct Extent {
  double near_m = 0.1, far_m = 100.0, step_m = 1.0;
};

Extent random_extent(Draw& draw) {
  Extent extent;
  const double usual[] = {16.0, 100.0, 400.0, 1000.0, 5000.0};
  if (draw.percent(60))
    extent.far_m = draw.one_of(usual);
  else
    extent.far_m = draw.percent(50) ? draw.log_between(1.0, 1e4) : draw.log_between(1e-5, k_largest_m);
  extent.near_m = draw.percent(40) ? extent.far_m / 1000.0 : extent.far_m / draw.log_between(1.5, 1e7);
  extent.step_m = std::exp2(std::round(std::log2(extent.far_m / 64.0)));
  return extent;
}

Vec4d turned(const Vec3d& axis, double angle_rad) {
  const Vec3d part = std::sin(angle_rad / 2.0) * axis;
  return {part.x, part.y, part.z, std::cos(angle_rad / 2.0)};
}

Vec3d random_direction(Draw& draw) {
  const double along = draw.between(-1.0, 1.0), turn = draw.between(0.0, 360.0 * k_degree);
  const double across = std::sqrt(1.0 - along * along);
  return {across * std::cos(turn), along, across * std::sin(turn)};
}

Vec3d axis_direction(Draw& draw) {
  Vec3d axis(0.0);
  axis[draw.whole(0, 2)] = draw.sign();
  return axis;
}

// Between two axes.
Vec3d diagonal_direction(Draw& draw) {
  const int left_out = draw.whole(0, 2);
  Vec3d diagonal(0.0);
  for (int axis = 0; axis < 3; ++axis)
    if (axis != left_out) diagonal[axis] = draw.sign();
  return glm::normalize(diagonal);
}

// Looks along an axis, or along a diagonal, or anywhere.
Vec4d random_rotation(Draw& draw) {
  const int way = draw.whole(0, 99);
  if (way < 35) return {0.0, 0.0, 0.0, 1.0};
  if (way < 55) {
    const Vec3d axis = axis_direction(draw);
    return turned(axis, draw.whole(1, 3) * k_right_angle);
  }
  if (way < 70) return turned({0.0, 1.0, 0.0}, 45.0 * k_degree * draw.sign());
  const Vec3d axis = random_direction(draw);
  return turned(axis, draw.between(0.0, 360.0 * k_degree));
}

Vec3d whole_position(Draw& draw, double step_m, int most) {
  Vec3d position(0.0);
  for (int axis = 0; axis < 3; ++axis) position[axis] = step_m * draw.whole(-most, most);
  return position;
}

Vec3d random_eye(Draw& draw, const Extent& extent) {
  const int way = draw.whole(0, 99);
  if (way < 45) return Vec3d(0.0);
  if (way < 65) return whole_position(draw, extent.step_m, 50);
  const double far_off = way < 93 ? extent.far_m * draw.log_between(1.0, 1e6) : draw.log_between(1e12, k_largest_m);
  const double scale = way < 85 ? extent.far_m : at_most_largest(far_off);
  return 0.5 * scale * random_direction(draw);
}

Vec2i random_picture(Draw& draw) {
  const Vec2i pictures[] = {{1920, 1080}, {1920, 1080}, {1366, 768}, {1000, 640}, {1000, 700}, {512, 512},
                            {256, 64},    {30, 900},    {65, 63},    {7, 3},      {1, 1}};
  return draw.one_of(pictures);
}

void random_sides(scene::CameraProjection& projection, Draw& draw, Vec2i picture) {
  const double top = std::tan(projection.yfov_rad / 2.0), right = top * picture.x / picture.y;
  if (draw.percent(40)) {  // moved by parts of a pixel
    const double x = draw.between(-0.5, 0.5) * 2.0 * right / picture.x;
    const double y = draw.between(-0.5, 0.5) * 2.0 * top / picture.y;
    projection.sides = scene::ProjectionSides{-right + x, right + x, -top + y, top + y};
    return;
  }
  const double x = draw.between(-1.5, 1.5) * right, y = draw.between(-1.5, 1.5) * top;
  projection.sides = scene::ProjectionSides{x - right, x + right, y - top, y + top};
}

scene::CameraProjection random_projection(Draw& draw, const Extent& extent, Vec2i picture) {
  scene::CameraProjection projection;
  projection.near_m = extent.near_m;
  projection.far_m = extent.far_m;
  projection.orthographic = draw.percent(25);
  if (projection.orthographic) {
    projection.ymag_m = draw.percent(45)   ? extent.step_m * draw.whole(1, 32)
                        : draw.percent(80) ? extent.far_m * draw.log_between(1e-3, 2.0)
                                           : draw.log_between(1e-6, 1e15);
    projection.xmag_m = projection.ymag_m * picture.x / picture.y;
    if (draw.percent(40)) projection.near_m = 0.0;
    return projection;
  }
  const double usual[] = {60.0, 90.0, 45.0, 75.0};
  projection.yfov_rad = draw.percent(70)   ? draw.one_of(usual) * k_degree
                        : draw.percent(70) ? draw.log_between(0.01, 3.0)
                                           : 2.0 * std::atan(draw.log_between(10.0, 1e4));
  if (draw.percent(30)) random_sides(projection, draw, picture);
  if (!draw.percent(80)) projection.far_m = std::numeric_limits<double>::infinity();
  return projection;
}

std::vector<double> random_boundaries(Draw& draw, const Extent& extent) {
  std::vector<double> list;
  const int count = draw.percent(90) ? draw.whole(2, 12) : draw.whole(13, 150);
  const bool whole = draw.percent(50);
  for (int i = 0; i < count; ++i)
    list.push_back(whole ? extent.step_m * draw.whole(1, 64) : draw.log_between(extent.near_m, extent.far_m));
  if (draw.percent(40)) list.push_back(0.0);
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end(),
                         [](double a, double b) { return !(static_cast<float>(a) < static_cast<float>(b)); }),
             list.end());
  if (list.size() < 2) list.push_back(2.0 * list.back() + extent.far_m);
  return list;
}

void random_slices(grid::Slicing& slices, Draw& draw, const Extent& extent, const scene::CameraProjection& projection) {
  using grid::Scheme;
  const Scheme schemes[] = {Scheme::linear, Scheme::exponential, Scheme::exponential_first, Scheme::power, Scheme::list,
                            Scheme::list,   Scheme::fit};
  slices.scheme = draw.one_of(schemes);
  if (projection.near_m == 0.0 && !draw.percent(60) && slices.scheme != Scheme::list) slices.scheme = Scheme::linear;
  slices.count = draw.percent(85) ? draw.whole(2, 16) : draw.whole(1, 60);
  slices.far_m = extent.far_m;
  if (slices.scheme == Scheme::list) slices.boundaries_m = random_boundaries(draw, extent);
  if (draw.percent(30)) slices.near_m = projection.near_m * draw.log_between(0.5, 4.0);
  const double near = slices.near_m != 0.0 ? slices.near_m : projection.near_m;
  constexpr double k_least_share = 1e-3;  // of far: orthographic views begin at 0
  slices.first_m = draw.percent(50) ? std::sqrt(std::max(near, k_least_share * extent.far_m) * extent.far_m)
                                    : draw.between(near, extent.far_m);
  slices.lambda = draw.percent(20) ? 0.0 : draw.between(0.0, 1.0);
}

void random_tiles(grid::Tiling& tiling, Draw& draw, Vec2i picture) {
  const Vec2i count{std::min(picture.x, draw.percent(80) ? draw.whole(1, 16) : draw.whole(1, 48)),
                    std::min(picture.y, draw.whole(1, 12))};
  if (draw.percent(50)) {
    tiling = {{0, 0}, count};
    return;
  }
  // A size that seldom divides the picture, so that the last tiles are clipped.
  const Vec2i pixels{std::max(1, picture.x / count.x + draw.whole(0, 2)),
                     std::max(1, picture.y / count.y + draw.whole(0, 2))};
  tiling = {pixels, {0, 0}};
}

void random_boxes(grid::GridSpec& spec, Draw& draw, const Extent& extent, const Vec3d& eye) {
  if (spec.kind == grid::Kind::cascades) {
    spec.levels = draw.whole(1, 4);
    spec.cells = {4 * draw.whole(1, 3), 4 * draw.whole(1, 2), 2 * draw.whole(1, 4)};
    spec.finest_m = draw.percent(60) ? extent.step_m : extent.far_m * draw.log_between(1e-3, 0.1);
    return;
  }
  spec.cells = {draw.whole(1, 16), draw.whole(1, 6), draw.whole(1, 12)};
  spec.has_bounds = draw.percent(80);
  if (draw.percent(50)) {
    spec.bounds_lo_m = eye - extent.step_m * Vec3d(spec.cells);
    spec.bounds_hi_m = eye + extent.step_m * Vec3d(spec.cells);
    return;
  }
  for (int axis = 0; axis < 3; ++axis) {
    spec.bounds_lo_m[axis] = eye[axis] - extent.far_m * draw.between(0.05, 1.0);
    spec.bounds_hi_m[axis] = eye[axis] + extent.far_m * draw.between(0.05, 1.0);
  }
}

grid::GridSpec random_grid(Draw& draw, const Extent& extent, const scene::CameraProjection& projection, Vec2i picture,
                           const Vec3d& eye) {
  using grid::Kind;
  const Kind kinds[] = {Kind::frustum,  Kind::frustum,  Kind::frustum,  Kind::frustum, Kind::frustum,
                        Kind::distance, Kind::distance, Kind::cascades, Kind::world};
  grid::GridSpec spec;
  spec.kind = draw.one_of(kinds);
  if (spec.kind == Kind::distance && projection.orthographic && !draw.percent(5)) spec.kind = Kind::frustum;
  if (!spec.has_tiles()) {
    random_boxes(spec, draw, extent, eye);
  } else {
    random_tiles(spec.tiles, draw, picture);
    random_slices(spec.slices, draw, extent, projection);
  }
  return spec;
}

// Adds lights to a trial whose grid is known.
class Lights {
 public:
  Lights(Trial& trial, const Extent& extent, Draw& draw)
      : trial_(trial),
        extent_(extent),
        draw_(draw),
        frame_(frame_of(trial)),
        grid_(grid_of(trial, frame_)),
        space_(grid::space_of(grid_, frame_)) {}

  void add(int count) {
    while (static_cast<int>(trial_.scene.lights.size()) < count) {
      const int way = draw_.whole(0, 99);
      if (way < 40)
        touching();
      else if (way < 70)
        on_lattice();
      else if (way < 80)
        about_the_eye();
      else
        anywhere();
    }
  }

 private:
  // Against a cell's face, edge or corner; then, sometimes, pushed in or pulled away by a little or by ulps.
  void touching() {
    const Contact contact = random_contact(grid_.cell(random_cell(grid_, draw_.random())), draw_.random());
    const double distance = std::max(glm::length(contact.point), extent_.near_m);
    double range = draw_.percent(70)   ? distance * draw_.log_between(1e-3, 10.0)
                   : draw_.percent(50) ? distance * draw_.log_between(1e-8, 1e-3)
                                       : extent_.far_m * draw_.log_between(1.0, 1e3);
    range = at_most_largest(range);
    const Vec3d position = contact.point + range * contact.outward;
    if (draw_.percent(40)) range *= draw_.about_one(1e-16, 1e-3);
    if (!draw_.percent(45)) return light(in_world(position), range);
    const Vec3d other = draw_.percent(50) ? random_direction(draw_) : axis_direction(draw_);
    const double angle = random_angle();
    const Vec3d generator = glm::normalize(glm::cross(contact.outward, other) + 1e-9 * other);
    spot(in_world(contact.point + draw_.between(0.0, 1.0) * range * generator),
         world_direction(-std::cos(angle) * generator + std::sin(angle) * contact.outward), range, angle);
  }

  // Whole coordinates and ranges, mirrored: many lights touch faces, edges and corners.
  void on_lattice() {
    const double step = extent_.step_m;
    const bool of_camera = draw_.percent(60);
    Vec3d position = whole_position(draw_, step, draw_.percent(70) ? 8 : 64);
    if (of_camera) position.z = -std::abs(position.z);
    double range = step * draw_.whole(1, 12);
    if (draw_.percent(30)) range = std::abs(position[draw_.whole(0, 2)]);
    const Vec3d corners[] = {{3, 4, 0}, {0, 3, 4}, {4, 0, 3}, {1, 2, 2}, {2, 3, 6}};
    if (draw_.percent(20)) {
      const Vec3d corner = draw_.one_of(corners);
      position += (draw_.sign() * step) * corner;
      range = step * glm::length(corner);
    }
    if (range == 0.0) range = step;
    const Vec3d axis = draw_.percent(60) ? axis_direction(draw_) : diagonal_direction(draw_);
    const double degrees[] = {15.0, 30.0, 45.0, 60.0, 90.0};
    const double angle = draw_.one_of(degrees) * k_degree;
    const bool is_spot = draw_.percent(35);
    const int mirrored = draw_.percent(60) ? draw_.whole(1, 2) : -1;
    for (int copy = 0; copy < (mirrored < 0 ? 1 : 2); ++copy) {
      Vec3d at = position, towards = axis;
      if (copy == 1) {
        at[mirrored - 1] = -at[mirrored - 1];
        towards[mirrored - 1] = -towards[mirrored - 1];
      }
      at = of_camera ? in_world(at) : at;
      if (of_camera) towards = world_direction(towards);
      is_spot ? put_spot(at, towards, range, angle) : put(at, range);
    }
  }

  // Just in front of the eye, or just behind it, with a range that ends there.
  void about_the_eye() {
    const double distance = draw_.percent(60) ? extent_.near_m * draw_.log_between(1e-4, 10.0)
                                              : at_most_largest(extent_.far_m * draw_.log_between(1e-6, 1e3));
    const Vec3d way = draw_.percent(60) ? Vec3d(0.0, 0.0, draw_.sign()) : random_direction(draw_);
    const double range = distance * draw_.about_one(1e-16, 0.5);
    const Vec3d position = frame_.view_space.origin + glm::transpose(frame_.view_space.rotation) * (distance * way);
    if (draw_.percent(70)) return light(position, range);
    const Vec3d direction = draw_.percent(50) ? random_direction(draw_) : axis_direction(draw_);
    spot(position, direction, range, random_angle());
  }

  // In and around the view, of all sizes; also far away with a range of centimetres.
  void anywhere() {
    const double depth = extent_.far_m * draw_.log_between(1e-5, 2.0);
    const view::Projection& projection = frame_.projection;
    const double scale = projection.orthographic ? 1.0 : depth;
    const double x = draw_.between(-0.2, 1.2), y = draw_.between(-0.2, 1.2);
    const Vec3d position{scale * (projection.left + x * (projection.right - projection.left)),
                         scale * (projection.bottom + y * (projection.top - projection.bottom)),
                         draw_.percent(90) ? -depth : depth};
    const double size = std::max(glm::length(position), extent_.near_m);
    // Sometimes out of all proportion, up to no end (beyond the domain).
    const double range = draw_.percent(10)   ? std::max(size, 1e-6) * draw_.log_between(1e4, 1e20)
                         : draw_.percent(50) ? at_most_largest(size * draw_.log_between(1e-2, 2.0))
                                             : at_most_largest(size * draw_.log_between(1e-8, 1e4));
    const Vec3d at = frame_.view_space.origin + glm::transpose(frame_.view_space.rotation) * position;
    if (draw_.percent(50)) return light(at, range);
    const Vec3d direction = random_direction(draw_);
    spot(at, direction, range, random_angle());
  }

  double random_angle() {
    const int way = draw_.whole(0, 99);
    if (way < 55) return draw_.between(0.02, 1.56);
    if (way < 80) return draw_.log_between(1e-6, 0.1);
    const double usual[] = {1e-60, 1e-5, 30.0 * k_degree, 45.0 * k_degree, 60.0 * k_degree, k_right_angle};
    return draw_.one_of(usual);
  }

  Vec3d in_world(const Vec3d& local) const { return glm::transpose(space_.rotation) * local + space_.origin; }
  Vec3d world_direction(const Vec3d& local) const { return glm::transpose(space_.rotation) * local; }

  void light(Vec3d position, double range) {
    nudge(position, range);
    put(position, range);
  }
  void spot(Vec3d position, const Vec3d& direction, double range, double angle) {
    nudge(position, range);
    put_spot(position, direction, range, angle);
  }
  void nudge(Vec3d& position, double& range) {
    if (!draw_.percent(50)) return;
    for (int axis = 0; axis < 3; ++axis) position[axis] = draw_.nudged(position[axis], 4);
    range = draw_.nudged(range, 4);
  }

  void put(const Vec3d& position, double range) {
    const double size = std::max({std::abs(position.x), std::abs(position.y), std::abs(position.z)});
    if (!(size <= k_largest_m) || !(range > 1e-30) || !(range <= k_longest_range_m)) return;
    scene::Light added;
    added.node = static_cast<int>(trial_.scene.nodes.size());
    added.name = "light " + std::to_string(trial_.scene.lights.size());
    added.range_m = range;
    trial_.scene.nodes.push_back({.name = added.name, .translation = position});
    trial_.scene.lights.push_back(added);
  }

  void put_spot(const Vec3d& position, const Vec3d& direction, double range, double angle) {
    const std::size_t before = trial_.scene.lights.size();
    put(position, range);
    if (trial_.scene.lights.size() == before) return;
    scene::Light& added = trial_.scene.lights.back();
    added.type = scene::LightType::spot;
    added.outer_cone_rad = std::min(angle, k_right_angle);
    trial_.scene.nodes.back().rotation = scene::rotation_towards(glm::normalize(direction));
  }

  Trial& trial_;
  const Extent& extent_;
  Draw& draw_;
  view::Frame frame_;
  grid::Grid grid_;
  view::Space space_;
};

}  // namespace

int Draw::whole(int least, int most) {
  return least + static_cast<int>(random_.below(static_cast<std::uint64_t>(most - least) + 1));
}

double Draw::log_between(double lo, double hi) {
  return lo * std::exp(random_.unit() * std::log(hi / lo));
}

double Draw::about_one(double least, double most) {
  const double side = sign();
  return 1.0 + side * log_between(least, most);
}

double Draw::nudged(double value, int most_ulps) {
  const int ulps = whole(-most_ulps, most_ulps);
  constexpr double k_no_end = std::numeric_limits<double>::infinity();
  for (int i = 0; i < std::abs(ulps); ++i) value = std::nextafter(value, ulps < 0 ? -k_no_end : k_no_end);
  return value;
}

namespace {

// Uses a random source of its own, so that the rest of a seed's setting does not change.
void follow_or_shape(grid::GridSpec& spec, const scene::CameraProjection& projection, std::uint64_t seed) {
  using grid::Scheme;
  if (!spec.has_tiles() || spec.slices.scheme == Scheme::list || spec.slices.scheme == Scheme::fit) return;
  constexpr std::uint64_t k_other_source = 0x666974;
  Draw draw(seed ^ k_other_source);
  const double steps[] = {1.0, 1.25, 2.0};
  if (draw.percent(30)) {
    spec.slices.fit = grid::Fit{grid::Fit::To::lights, 0.0, draw.one_of(steps)};
    return;
  }
  constexpr double k_narrow_rad = 0.5;  // slices of narrower views are too many
  if (projection.orthographic || projection.sides || projection.yfov_rad < k_narrow_rad || !draw.percent(10)) return;
  if (draw.percent(50))
    spec.slices.scheme = draw.percent(50) ? Scheme::cubical : Scheme::cubical_first;
  else
    spec.tiles = {{0, 0}, {0, 0}, draw.log_between(0.5, 2.0)};
}

// Boxes that follow; also from a source of their own.
void follow_with_boxes(grid::GridSpec& spec, const Extent& extent, std::uint64_t seed) {
  if (spec.kind != grid::Kind::world) return;
  constexpr std::uint64_t k_other_source = 0x776f726c64;
  Draw draw(seed ^ k_other_source);
  const int way = draw.whole(0, 99);
  if (way < 25) {
    spec.follow = grid::Follow::lights;
    spec.has_bounds = false;
  } else if (way < 50) {
    spec.follow = grid::Follow::camera;
    for (int axis = 0; axis < 3; ++axis)
      spec.cell_size_m[axis] = draw.percent(50) ? 2.0 * extent.step_m : extent.far_m * draw.log_between(1e-3, 0.5);
    if (draw.percent(50)) spec.cell_size_m.y = 0.0;
  }
}

}  // namespace

Trial random_setting(std::uint64_t seed) {
  Draw draw(seed);
  const Extent extent = random_extent(draw);
  Rig rig;
  const Vec2i picture = random_picture(draw);
  rig.show(picture);
  rig.projection() = random_projection(draw, extent, picture);
  const Vec3d eye = random_eye(draw, extent);
  const Vec4d rotation = random_rotation(draw);
  grid::GridSpec spec = random_grid(draw, extent, rig.projection(), picture, eye);
  follow_or_shape(spec, rig.projection(), seed);
  follow_with_boxes(spec, extent, seed);
  Trial trial = rig.on(spec, "seed " + std::to_string(seed));
  trial.scene.nodes[0].translation = eye;
  trial.scene.nodes[0].rotation = rotation;
  try {
    Lights lights(trial, extent, draw);
    lights.add(draw.percent(90) ? draw.whole(1, 16) : draw.whole(17, 60));
    add_random_boxes(trial, extent.far_m, extent.step_m, seed);
  } catch (const Error&) {
    // No grid for this camera: a setting without lights, which is counted as refused.
  }
  return trial;
}

}  // namespace clusterbench::stress
