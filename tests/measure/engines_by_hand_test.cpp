// Methods with the mistakes of engines, held against what these engines do, written down again here: in double
// precision, by projection matrices, cell by cell, and without anything of the methods.

#include <set>

#include "assign/dense_check.h"
#include "measure/truth/truth.h"

namespace clusterbench::measure::engines_by_hand {
namespace {

using assign::find_assigner;
using assign::Lists;
using assign::Params;
using assign::testing::cell_index;
using assign::testing::frame_of;
using assign::testing::lists_by;
using assign::testing::perspective;
using assign::testing::point_light;
using assign::testing::Random;
using assign::testing::spot_light;

using CellLights = std::vector<std::set<std::uint32_t>>;  // of each cell

// Maps view space to the picture, from -1 to 1 to the right and upward.
struct Screen {
  explicit Screen(const view::Frame& frame)
      : orthographic(frame.projection.orthographic),
        middle{0.5 * (frame.projection.left + frame.projection.right),
               0.5 * (frame.projection.bottom + frame.projection.top)},
        half{0.5 * (frame.projection.right - frame.projection.left),
             0.5 * (frame.projection.top - frame.projection.bottom)} {}

  // One axis: its numerator, and what it is divided by.
  double above(int axis, double at, double depth) const {
    return (at - middle[axis] * (orthographic ? 1.0 : depth)) / half[axis];
  }
  double below(double depth) const { return orthographic ? 1.0 : depth; }
  double seen(int axis, double at, double depth) const { return above(axis, at, depth) / below(depth); }

  bool orthographic;
  double middle[2], half[2];
};

// Lights around the eye, before it and beside it; some of each type.
std::vector<scene::WorldLight> lights_around(std::uint64_t seed, int points, int spots, double reach) {
  Random random(seed);
  std::vector<scene::WorldLight> lights;
  const auto place = [&] {
    return Vec3d{random.between(-reach, reach), random.between(-0.5 * reach, 0.5 * reach),
                 random.between(-2.0 * reach, 0.3 * reach)};
  };
  for (int i = 0; i < points; ++i) lights.push_back(point_light(place(), random.log_between(0.3, 0.6 * reach)));
  for (int i = 0; i < spots; ++i) {
    const Vec3d at = place();
    lights.push_back(
        spot_light(at, random.log_between(1.0, 0.6 * reach), random.direction(), random.between(0.1, 1.2)));
  }
  return lights;
}

struct View {
  view::Frame frame;
  grid::Grid grid;
};

View view_of(Vec2i pixels, const grid::Tiling& tiles, grid::Scheme scheme, int slices, bool orthographic,
             std::vector<scene::WorldLight> lights) {
  View out;
  const double aspect = static_cast<double>(pixels.x) / pixels.y;
  view::Projection projection = perspective(M_PI / 3, aspect, 0.1, 200.0);
  if (orthographic) projection = {true, -10.0 * aspect, 10.0 * aspect, -10.0, 10.0, 0.1, 200.0};
  out.frame = frame_of(projection, pixels, std::move(lights));
  grid::GridSpec spec;
  spec.tiles = tiles;
  spec.slices.scheme = scheme;
  spec.slices.count = slices;
  spec.slices.far_at_most_m = scheme == grid::Scheme::exponential_first ? 100.0 : 0.0;
  out.grid = grid::make_grid(spec, grid::grid_inputs(spec, out.frame, 0.0, {}, {}));
  return out;
}

CellLights empty_cells(const grid::Grid& grid) {
  return CellLights(grid.cell_count());
}

std::uint64_t count(const CellLights& cells) {
  std::uint64_t pairs = 0;
  for (const auto& lights : cells) pairs += lights.size();
  return pairs;
}

// Pairs in one and not in the other.
std::uint64_t differences(const Lists& lists, const CellLights& cells) {
  std::uint64_t different = 0;
  for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
    const auto list = lists.of(cell);
    const std::set<std::uint32_t> listed(list.begin(), list.end());
    for (const std::uint32_t light : listed) different += cells[cell].contains(light) ? 0 : 1;
    for (const std::uint32_t light : cells[cell]) different += listed.contains(light) ? 0 : 1;
  }
  return different;
}

std::uint64_t lost(const View& view, const Lists& lists) {
  const Truth truth = find_truth(view.frame, view.grid, 1);
  std::uint64_t missing = 0;
  for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
    const auto list = lists.of(cell);
    for (const std::uint32_t light : truth.lists.of(cell))
      missing += std::find(list.begin(), list.end(), light) == list.end() ? 1 : 0;
  }
  return missing;
}

// What a rounding may decide otherwise.
void expect_alike(const Lists& lists, const CellLights& by_hand, const char* what) {
  EXPECT_GT(count(by_hand), 1000u) << what;
  EXPECT_LE(1000 * differences(lists, by_hand), count(by_hand)) << what;
}

// --- Filament: froxels counted from the bottom, planes through the eye without offsets, a column at a time ---

class FroxelizerByHand {
 public:
  FroxelizerByHand(const View& view)
      : screen_(view.frame),
        grid_(view.grid),
        counts_(view.grid.cells()),
        depths_(view.grid.screen().slices.boundaries) {}

  void add(const scene::WorldLight& light, std::uint32_t index, CellLights& out) const {
    const Vec3d c = light.position;
    const double r = light.range_m, znear = std::min(-depths_.front() * 1.0, c.z + r), zfar = c.z - r;
    double lo[2] = {1e30, 1e30}, hi[2] = {0, 0};
    for (int corner = 0; corner < 8; ++corner)
      for (int axis = 0; axis < 2; ++axis) {
        const double z = corner & 4 ? zfar : znear;
        const double at = screen_.seen(axis, c[axis] + (corner & (1 << axis) ? r : -r), -z);
        lo[axis] = std::min(lo[axis], at);
        hi[axis] = std::max(hi[axis], at);
      }
    for (int z = slice(-znear); z <= slice(-zfar); ++z) {
      Vec3d in_slice = c;
      double left = r * r;
      if (z != slice(-c.z))
        flatten(in_slice, left, 2, -static_cast<double>(depths_[z < slice(-c.z) ? z + 1u : z + 0u]));
      if (!(left > 0)) continue;
      const int xc = tile(0, screen_.seen(0, in_slice.x, -in_slice.z)),
                yc = tile(1, screen_.seen(1, in_slice.y, -in_slice.z));
      for (int y = tile(1, lo[1]); y <= tile(1, hi[1]); ++y) {
        Vec3d in_row = in_slice;
        double rest = left;
        if (y != yc) project(in_row, rest, 1, y < yc ? y + 1 : y);
        if (!(rest > 0)) continue;
        int begin = counts_.x, end = -1;
        for (int x = tile(0, lo[0]); x <= tile(0, hi[0]); ++x) {
          Vec3d moved = in_row;
          double last = rest;
          if (x != xc) project(moved, last, 0, x < xc ? x + 1 : x);
          if (!(last > 0)) continue;
          begin = std::min(begin, x);
          end = std::max(end, x);
        }
        for (int x = begin; x <= end; ++x)
          if (light.type == scene::LightType::point || reaches(light, x, y, z))
            out[static_cast<std::size_t>(cell_index(counts_, x, counts_.y - 1 - y, z))].insert(index);
      }
    }
  }

 private:
  int slice(double depth) const {
    if (!(depth > 0)) return 0;
    // As many slices beyond the first as logarithms say.
    const double first = depths_[1], far = depths_.back(), step = std::log2(far / first) / (counts_.z - 1);
    return std::clamp(static_cast<int>(std::log2(depth / far) / step + counts_.z), 0, counts_.z - 1);
  }
  int tile(int axis, double at) const {
    const int tiles = axis == 0 ? counts_.x : counts_.y;
    const double pixels = axis == 0 ? grid_.screen().tiles.viewport.x : grid_.screen().tiles.viewport.y;
    const double size = axis == 0 ? grid_.screen().tiles.pixels.x : grid_.screen().tiles.pixels.y;
    return std::clamp(static_cast<int>(std::clamp(0.5 * (at + 1.0) * pixels / size, -9.0, 1e6)), 0, tiles - 1);
  }
  static void flatten(Vec3d& center, double& squared, int axis, double at) {
    squared -= (center[axis] - at) * (center[axis] - at);
    center[axis] = at;
  }
  // The plane before tile i: through the eye and that line of the picture; of an orthographic view through the axis.
  Vec3d normal(int axis, int i) const {
    const double pixels = axis == 0 ? grid_.screen().tiles.viewport.x : grid_.screen().tiles.viewport.y;
    const double size = axis == 0 ? grid_.screen().tiles.pixels.x : grid_.screen().tiles.pixels.y;
    const double slope = screen_.middle[axis] + screen_.half[axis] * (2.0 * i * size / pixels - 1.0);
    Vec3d n{0, 0, screen_.orthographic ? 0.0 : slope};
    n[axis] = 1.0;
    return glm::normalize(n);
  }
  void project(Vec3d& center, double& squared, int axis, int plane) const {
    const Vec3d n = normal(axis, plane);
    const double d = glm::dot(n, center);
    center -= d * n;
    squared -= d * d;
  }
  bool reaches(const scene::WorldLight& light, int x, int y, int z) const {
    Vec3d mean(0.0), corners[8];
    for (int i = 0; i < 8; ++i) {
      const double depth = i & 4 ? depths_[z + 1u] : z == 0 ? 0.0 : depths_[z + 0u];
      // Where three planes meet.
      const Vec3d nx = normal(0, x + (i & 1)), ny = normal(1, y + (i >> 1 & 1));
      corners[i] = {depth * nx.z / nx.x, depth * ny.z / ny.y, -depth};
      mean += corners[i] / 8.0;
    }
    double radius = 0.0;
    for (const Vec3d& corner : corners) radius = std::max(radius, glm::length(corner - mean));
    // The sphere meets the endless cone where its centre lies in the cone whose apex is moved back.
    const Vec3d way = mean - (light.position - radius / std::sin(light.outer_cone_rad) * light.direction);
    return glm::dot(way, light.direction) >= glm::length(way) * std::cos(light.outer_cone_rad);
  }

  Screen screen_;
  const grid::Grid& grid_;
  Vec3i counts_;
  const std::vector<float>& depths_;
};

// As an engine culls lights before: against each plane around the view.
bool is_in_view(const view::Frame& frame, const scene::WorldLight& light, double far_m) {
  const view::Projection& p = frame.projection;
  const Vec3d c = light.position;
  const double depth = -c.z, r = light.range_m;
  if (depth + r < p.near_m || depth - r > far_m) return false;
  const auto outside = [&](double at, double side, double sign) {
    if (p.orthographic) return sign * (at - side) > r;
    return sign * (at - side * depth) / std::sqrt(1 + side * side) > r;
  };
  return !outside(c.x, p.left, -1) && !outside(c.x, p.right, 1) && !outside(c.y, p.bottom, -1) &&
         !outside(c.y, p.top, 1);
}

CellLights froxels_by_hand(const View& view) {
  CellLights out = empty_cells(view.grid);
  const FroxelizerByHand by_hand(view);
  for (std::uint32_t i = 0; i < view.frame.lights.size(); ++i)
    if (is_in_view(view.frame, view.frame.lights[i], view.grid.screen().slices.boundaries.back()))
      by_hand.add(view.frame.lights[i], i, out);
  return out;
}

View filament_view(bool orthographic, std::uint64_t seed) {
  return view_of({1920, 1080}, {{72, 72}, {0, 0}}, grid::Scheme::exponential_first, 16, orthographic,
                 lights_around(seed, 120, 60, 25.0));
}

TEST(FilamentAsShipped, lists_what_the_froxelizer_lists) {
  for (const std::uint64_t seed : {1u, 2u, 3u})
    for (const bool orthographic : {false, true}) {
      const View view = filament_view(orthographic, seed);
      expect_alike(lists_by("filament-refinement", view.frame, view.grid), froxels_by_hand(view),
                   orthographic ? "orthographic" : "perspective");
    }
}

TEST(FilamentAsShipped, loses_lights_whose_centres_are_behind_the_eye_and_most_of_an_orthographic_view) {
  View behind = filament_view(false, 1);
  behind.frame = frame_of(behind.frame.projection, behind.frame.viewport,
                          {point_light({11.017, -0.441, 1.953}, 9.262), point_light({-18.893, -2.426, 3.57}, 18.75),
                           point_light({-6.218, -3.86, 0.542}, 5.362)});
  EXPECT_GT(lost(behind, lists_by("filament-refinement", behind.frame, behind.grid)), 0u);
  const View orthographic = filament_view(true, 1);
  const std::uint64_t pairs = find_truth(orthographic.frame, orthographic.grid, 1).lists.pair_count();
  EXPECT_GT(2 * lost(orthographic, lists_by("filament-refinement", orthographic.frame, orthographic.grid)), pairs);
}

// --- three.js: a thread per cell goes through lights from far to near ---

CellLights threads_by_hand(const View& view, std::size_t most) {
  CellLights out = empty_cells(view.grid);
  const Screen screen(view.frame);
  const Vec3i n = view.grid.cells();
  const view::LightArrays lights = view::lights_in(view.frame, view.frame.view_space);
  std::vector<std::uint32_t> order(view.frame.lights.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto ball = [&](std::uint32_t i) { return lights.bounding_ball(i, 0.0f); };
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return ball(a).center.z < ball(b).center.z; });
  const double near = view.frame.projection.near_m, ratio = view.frame.projection.far_m / near;
  for (int cell = 0; cell < n.x * n.y * n.z; ++cell) {
    const int at[2] = {cell % n.x, n.y - 1 - cell / n.x % n.y}, tiles[2] = {n.x, n.y}, z = cell / (n.x * n.y);
    const double front = near * std::pow(ratio, double(z) / n.z), back = near * std::pow(ratio, double(z + 1) / n.z);
    for (const std::uint32_t i : order) {
      if (out[static_cast<std::size_t>(cell)].size() == most) break;
      const geom::Ball b = ball(i);
      double squared = 0.0;
      const auto add = [&](double p, double lo, double hi) { squared += std::pow(p - std::clamp(p, lo, hi), 2.0); };
      for (int axis = 0; axis < 2; ++axis) {
        const double from = screen.half[axis] * (2.0 * at[axis] / tiles[axis] - 1),
                     to = screen.half[axis] * (2.0 * (at[axis] + 1) / tiles[axis] - 1);
        add(b.center[axis], std::min(from * front, from * back), std::max(to * front, to * back));
      }
      add(-b.center.z, front, back);
      if (squared <= double(b.radius) * b.radius) out[static_cast<std::size_t>(cell)].insert(i);
    }
  }
  return out;
}

TEST(ThreeJsAsShipped, lists_what_its_compute_shader_lists) {
  for (const bool orthographic : {false, true}) {
    const View view = view_of({800, 450}, {{32, 32}, {0, 0}}, grid::Scheme::exponential, 24, orthographic,
                              lights_around(5, 90, 40, 25.0));
    expect_alike(lists_by("three-js-boxes", view.frame, view.grid), threads_by_hand(view, 64), "64 in a cell");
    const auto few =
        find_assigner("three-js-boxes")->make(Params(find_assigner("three-js-boxes")->params, {{"most", 5.0}}));
    few->build(view.grid);
    Lists lists;
    few->assign({view.frame, view::lights_in(view.frame, view.frame.view_space)}, lists);
    expect_alike(lists, threads_by_hand(view, 5), "5 in a cell");
  }
}

TEST(ThreeJsAsShipped, loses_small_lights_at_the_bottom_where_32_does_not_divide_the_height) {
  // 1600 x 900: 29 rows, of which the last lookup is of 4 pixels. In the 28th whole row that is looked up.
  std::vector<scene::WorldLight> lights;
  const double top = std::tan(M_PI / 6);
  for (int i = 0; i < 40; ++i) {
    const double depth = 5.0 + i, down = top * (1.0 - 2.0 * 892.0 / 900.0) * depth;
    lights.push_back(point_light({0.01 * i, down, -depth}, 0.002 * depth));
  }
  const View view = view_of({1600, 900}, {{32, 32}, {0, 0}}, grid::Scheme::exponential, 24, false, lights);
  const Lists shipped = lists_by("three-js-boxes", view.frame, view.grid);
  EXPECT_EQ(lost(view, lists_by("brute-force", view.frame, view.grid)), 0u);
  EXPECT_GT(lost(view, shipped), 0u);
}

// --- Babylon.js: a rectangle of tiles per light, and ranges of the sorted lights per slice ---

struct LightProxy {
  bool is_drawn = false;
  double from[2] = {0, 0}, to[2] = {0, 0};  // tiles' edges, upward
};

LightProxy proxy_by_hand(const Screen& screen, Vec3d center, double r, Vec3i n) {
  double at[2][2];  // axis, corner
  for (int axis = 0; axis < 2; ++axis)
    for (int corner = 0; corner < 2; ++corner) {
      const double sign = corner == 0 ? -1.0 : 1.0, depth = -center.z, across = center[axis];
      const double sine2 = r * r / (across * across + depth * depth), cosine2 = std::max(1.0 - sine2, 0.01);
      // Turned by the tangent's angle and drawn in by its cosine: the tangent point.
      const double angle = std::atan2(std::sqrt(sine2), std::sqrt(cosine2)) * sign;
      const double scale = std::sqrt(cosine2) * std::sqrt(cosine2 + sine2);
      const double x = scale * (std::cos(angle) * across + std::sin(angle) * depth);
      const double z = scale * (std::cos(angle) * depth - std::sin(angle) * across);
      const double seen = screen.above(axis, x, z) / std::max(screen.below(z), 0.01);
      at[axis][corner] = (1.0 + (cosine2 > 0.01 ? seen : sign)) * 0.5 * (axis == 0 ? n.x : n.y);
    }
  LightProxy proxy;
  double sides[2];
  for (int axis = 0; axis < 2; ++axis) {
    proxy.from[axis] = std::floor(at[axis][0]) - 0.01;
    proxy.to[axis] = std::ceil(at[axis][1]) + 0.01;
    sides[axis] = proxy.to[axis] - proxy.from[axis];
    if (sides[axis] < 0) std::swap(proxy.from[axis], proxy.to[axis]);
  }
  proxy.is_drawn = sides[0] * sides[1] > 0;  // else it shows its back
  return proxy;
}

CellLights proxies_by_hand(const View& view) {
  CellLights out = empty_cells(view.grid);
  const Vec3i n = view.grid.cells();
  const Screen screen(view.frame);
  const auto& lights = view.frame.lights;
  std::vector<std::uint32_t> order(lights.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return lights[a].position.z > lights[b].position.z; });
  std::vector<std::size_t> first(static_cast<std::size_t>(n.z), 0), last(static_cast<std::size_t>(n.z), 0);
  const double near = view.frame.projection.near_m, log = std::log(view.frame.projection.far_m / near);
  int begun = -1;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const double depth = -lights[order[rank]].position.z, r = lights[order[rank]].range_m;
    const auto slice = [&](double d) {
      return d < near ? -1 : static_cast<int>(std::floor(std::log(d / near) * n.z / log));
    };
    for (int j = slice(depth - r); j <= slice(depth + r); ++j) {
      if (j < 0 || j >= n.z) continue;
      if (j > begun) first[static_cast<std::size_t>(j)] = rank, begun = j;
      last[static_cast<std::size_t>(j)] = rank;
    }
  }
  for (int z = 0; z < n.z; ++z)
    for (std::size_t rank = first[static_cast<std::size_t>(z)]; rank <= last[static_cast<std::size_t>(z)]; ++rank) {
      const auto& light = lights[order[rank]];
      const LightProxy proxy = proxy_by_hand(screen, light.position, light.range_m, n);
      for (int y = 0; y < n.y && proxy.is_drawn; ++y)
        for (int x = 0; x < n.x; ++x)
          if (x + 0.5 > proxy.from[0] && x + 0.5 < proxy.to[0] && y + 0.5 > proxy.from[1] && y + 0.5 < proxy.to[1])
            out[static_cast<std::size_t>(cell_index(n, x, n.y - 1 - y, z))].insert(order[rank]);
    }
  return out;
}

View babylon_view(bool orthographic, std::uint64_t seed) {
  return view_of({1280, 720}, {{0, 0}, {64, 64}}, grid::Scheme::exponential, 16, orthographic,
                 lights_around(seed, 60, 30, 25.0));
}

TEST(BabylonAsShipped, lists_what_its_light_proxies_draw) {
  for (const std::uint64_t seed : {1u, 2u})
    for (const bool orthographic : {false, true}) {
      const View view = babylon_view(orthographic, seed);
      expect_alike(lists_by("babylon-as-shipped", view.frame, view.grid), proxies_by_hand(view),
                   orthographic ? "orthographic" : "perspective");
    }
}

TEST(BabylonAsShipped, loses_lights_where_its_scheme_loses_none) {
  for (const bool orthographic : {false, true}) {
    const View view = babylon_view(orthographic, 3);
    EXPECT_EQ(lost(view, lists_by("babylon-masks", view.frame, view.grid)), 0u);
    if (orthographic) {
      EXPECT_GT(lost(view, lists_by("babylon-as-shipped", view.frame, view.grid)), 0u);
    }
  }
  // A centre beside the eye and a little behind it; the far tangent lies behind the eye, beyond the straight line back.
  const View beside = view_of({1280, 720}, {{0, 0}, {64, 64}}, grid::Scheme::exponential, 16, false,
                              {point_light({-19.081, 3.67, 3.767}, 19.33)});
  EXPECT_GT(lost(beside, lists_by("babylon-as-shipped", beside.frame, beside.grid)), 0u);
  EXPECT_EQ(lost(beside, lists_by("babylon-masks", beside.frame, beside.grid)), 0u);
}

}  // namespace
}  // namespace clusterbench::measure::engines_by_hand
