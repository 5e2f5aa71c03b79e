#include "measure/truth.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "geom/meets.h"
#include "geom/predicates.h"
#include "measure/truth_rows.h"

namespace clusterbench::measure {
namespace {

using geom::Verdict;

geom::LightVolume volume_of(const scene::WorldLight& light, const view::Space& space) {
  return {{light.position, space.origin, space.rotation},
          light.range_m,
          light.type == scene::LightType::spot,
          light.direction,
          light.outer_cone_rad};
}

BallInSpace ball_in_space(const geom::LightVolume& volume) {
  constexpr double k_slack = 0x1p-44;
  const geom::LocalPoint center = geom::local_point(volume.apex);
  const double size = std::abs(center.at.x) + std::abs(center.at.y) + std::abs(center.at.z) + volume.range;
  return {center.at, volume.range, k_slack * size + 4.0 * center.rounding_error};
}

// A spot in double precision, for tests that settle most cells at once.
struct QuickCone {
  Vec3d apex, axis;
  double range, cos_angle, sin_angle, slack;

  QuickCone(const geom::LightVolume& volume, const BallInSpace& ball)
      : apex(ball.center),
        axis(glm::normalize(volume.apex.rotation * volume.direction)),
        range(volume.range),
        cos_angle(std::cos(volume.half_angle_rad)),
        sin_angle(std::sin(volume.half_angle_rad)),
        slack(0x1p-30 * (std::abs(apex.x) + std::abs(apex.y) + std::abs(apex.z))) {}

  // Is a ball outside of the cone's side, behind its apex or beyond its range?
  bool surely_misses(const geom::Ball& around) const {
    const Vec3d v = Vec3d(around.center) - apex;
    const double along = glm::dot(v, axis), reach = around.radius * (1.0 + 0x1p-30) + slack;
    if (along < -reach || glm::length(v) > range + reach) return true;
    return cos_angle * glm::length(v - along * axis) - sin_angle * along > reach;
  }
  bool surely_holds(const Vec3d& p) const {
    const Vec3d v = p - apex;
    const double along = glm::dot(v, axis), size = glm::length(v), rounding = 0x1p-30 * size + slack;
    return size < range - rounding && sin_angle * along - cos_angle * glm::length(v - along * axis) > rounding;
  }
};

// Is a point well inside a cell?
struct WellInside {
  Vec3d p;

  static bool between(double lo, double value, double hi) {
    const double rounding = 0x1p-40 * (std::abs(lo) + std::abs(hi));
    return value > lo + rounding && value < hi - rounding;
  }
  bool operator()(const geom::FrustumPiece& c) const {
    const double depth = -p.z, scale = c.orthographic ? 1.0 : depth;
    return between(c.depth0, depth, c.depth1) && between(c.x0 * scale, p.x, c.x1 * scale) &&
           between(c.y0 * scale, p.y, c.y1 * scale);
  }
  bool operator()(const geom::ShellPiece& c) const {
    const double depth = -p.z;
    return depth > 0.0 && between(c.distance0, glm::length(p), c.distance1) &&
           between(c.x0 * depth, p.x, c.x1 * depth) && between(c.y0 * depth, p.y, c.y1 * depth);
  }
  bool operator()(const geom::Box& c) const {
    return between(c.lo.x, p.x, c.hi.x) && between(c.lo.y, p.y, c.hi.y) && between(c.lo.z, p.z, c.hi.z);
  }
};

// The true cells of one light.
struct LightCells {
  std::vector<std::uint32_t> cells;
  std::uint64_t filter_decided = 0, exact_decided = 0, undecided = 0;
};

// Finds true cells light by light. Made once per frame; const, so that threads can share it.
class TruthFinder {
 public:
  TruthFinder(const view::Frame& frame, const grid::Grid& grid)
      : frame_(frame), grid_(grid), space_(grid::space_of(grid, frame)) {
    if (!is_tilted()) blocks_ = box_blocks(grid);
    if (frame.lights.size() > frame.points) make_cell_balls();
  }

  LightCells find(std::uint32_t light) const {
    LightCells found;
    const geom::LightVolume volume = volume_of(frame_.lights[light], space_);
    if (volume.range == 0.0) return found;
    if (std::isinf(volume.range)) {
      for (std::uint32_t cell = 0; cell < grid_.cell_count(); ++cell) settle_endless(volume, cell, found);
      return found;
    }
    const BallInSpace ball = ball_in_space(volume);
    const QuickCone cone(volume, ball);
    std::vector<Row> rows;
    if (grid_.kind() == grid::Kind::distance) {
      append_tile_rows(grid_.screen(), ball, rows);
      for (const Row& row : rows) settle_tiles(volume, cone, row, found);
      return found;
    }
    if (is_tilted()) append_rows(grid_.screen(), ball, rows);
    for (const BoxBlock& block : blocks_) append_rows(block, ball, rows);
    for (const Row& row : rows) settle_row(volume, cone, row, found);
    return found;
  }

 private:
  // Cells with sides through the eye.
  bool is_tilted() const {
    return grid_.kind() == grid::Kind::distance ||
           (grid_.kind() == grid::Kind::frustum && !grid_.screen().tiles.orthographic);
  }

  void make_cell_balls() {
    cell_balls_.reserve(grid_.cell_count());
    for (std::uint32_t cell = 0; cell < grid_.cell_count(); ++cell)
      cell_balls_.push_back(grid_.is_hole(cell) ? geom::Ball{} : geom::ball_around(grid_.cell(cell)));
  }

  void settle_row(const geom::LightVolume& volume, const QuickCone& cone, const Row& row, LightCells& found) const {
    for (int column = row.outer.first; column <= row.outer.last; ++column) {
      const std::uint32_t cell = row.first_cell + static_cast<std::uint32_t>(column);
      if (grid_.is_hole(cell)) continue;
      if (volume.is_cone)
        settle_spot(volume, cone, cell, found);
      else if (row.inner.holds(column))
        take(cell, found);
      else
        decide(volume, cell, found);
    }
  }

  // One row of tiles of a distance grid, through all shells.
  void settle_tiles(const geom::LightVolume& volume, const QuickCone& cone, const Row& row, LightCells& found) const {
    const grid::ScreenGrid& grid = grid_.screen();
    const auto tiles = static_cast<std::uint32_t>(grid.tiles.count.x * grid.tiles.count.y);
    for (int column = row.outer.first; column <= row.outer.last; ++column) {
      const std::uint32_t tile = row.first_cell + static_cast<std::uint32_t>(column);
      const auto piece = std::get<geom::ShellPiece>(grid_.cell(tile));
      // A spot's own distances are dear, its ball's are a cheap first bound.
      geom::LightVolume whole = volume;
      whole.is_cone = false;
      const geom::DistanceInterval reach = geom::filter_distances(whole, piece.x0, piece.x1, piece.y0, piece.y1);
      for (int shell = 0; shell < grid.slices.count(); ++shell) {
        const auto k = static_cast<std::size_t>(shell);
        const double near = grid.slices.boundaries[k], far = grid.slices.boundaries[k + 1];
        if (far < reach.outer_lo || near > reach.outer_hi) continue;
        const std::uint32_t cell = static_cast<std::uint32_t>(shell) * tiles + tile;
        if (volume.is_cone)
          settle_spot(volume, cone, cell, found);
        else if (near <= reach.inner_hi && far >= reach.inner_lo && reach.inner_lo <= reach.inner_hi)
          take(cell, found);
        else
          decide(volume, cell, found);
      }
    }
  }

  void settle_endless(const geom::LightVolume& volume, std::uint32_t cell, LightCells& found) const {
    if (grid_.is_hole(cell)) return;
    if (!volume.is_cone) return take(cell, found);
    filter(volume, cell, found);
  }

  void settle_spot(const geom::LightVolume& volume, const QuickCone& cone, std::uint32_t cell,
                   LightCells& found) const {
    const geom::Ball& around = cell_balls_[cell];
    if (cone.surely_misses(around)) {
      ++found.filter_decided;
      return;
    }
    const Vec3d middle(around.center);
    if (cone.surely_holds(middle) && std::visit(WellInside{middle}, grid_.cell(cell))) return take(cell, found);
    filter(volume, cell, found);
  }

  void filter(const geom::LightVolume& volume, std::uint32_t cell, LightCells& found) const {
    const Verdict verdict = geom::filter_meets(volume, grid_.cell(cell));
    if (verdict == Verdict::open) return decide(volume, cell, found);
    ++found.filter_decided;
    if (verdict == Verdict::yes) found.cells.push_back(cell);
  }

  void decide(const geom::LightVolume& volume, std::uint32_t cell, LightCells& found) const {
    const Verdict verdict = geom::decide_meets(volume, grid_.cell(cell));
    ++(verdict == Verdict::open ? found.undecided : found.exact_decided);
    if (verdict != Verdict::no) found.cells.push_back(cell);
  }

  static void take(std::uint32_t cell, LightCells& found) {
    ++found.filter_decided;
    found.cells.push_back(cell);
  }

  const view::Frame& frame_;
  const grid::Grid& grid_;
  view::Space space_;
  std::vector<BoxBlock> blocks_;
  std::vector<geom::Ball> cell_balls_;
};

}  // namespace

Truth find_truth(const view::Frame& frame, const grid::Grid& grid, int threads) {
  const TruthFinder finder(frame, grid);
  std::vector<LightCells> found(frame.lights.size());
  parallel_ranges(found.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t light = begin; light < end; ++light) found[light] = finder.find(static_cast<std::uint32_t>(light));
  });

  Truth truth;
  assign::PairBuffer pairs;
  pairs.start(grid.cell_count());
  for (std::uint32_t light = 0; light < found.size(); ++light) {
    for (const std::uint32_t cell : found[light].cells) pairs.add(cell, light);
    truth.filter_decided += found[light].filter_decided;
    truth.exact_decided += found[light].exact_decided;
    truth.undecided += found[light].undecided;
  }
  pairs.finish(truth.lists);
  return truth;
}

double relative_distance(const view::Frame& frame, const grid::Grid& grid, std::uint32_t cell, std::uint32_t light) {
  geom::LightVolume volume = volume_of(frame.lights[light], grid::space_of(grid, frame));
  if (std::isinf(volume.range)) return 0.0;
  const double range = volume.range;
  double misses = 0.0, meets = 1.0;
  constexpr int k_halvings = 40;
  for (int i = 0; i < k_halvings; ++i) {
    const double middle = 0.5 * (misses + meets);
    volume.range = range * middle;
    (geom::filter_meets(volume, grid.cell(cell)) == Verdict::no ? misses : meets) = middle;
  }
  return meets;
}

}  // namespace clusterbench::measure
