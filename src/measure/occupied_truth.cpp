// Truth of the cells that depths leave of a frustum grid's.

#include <algorithm>
#include <cmath>
#include <optional>

#include "geom/ball/ball_decider.h"
#include "geom/shapes/verdict.h"
#include "geom/single_precision/bounding_volumes.h"
#include "geom/spot/spot_decider.h"
#include "measure/truth.h"
#include "measure/truth_cells.h"

namespace clusterbench::measure {
namespace {

using geom::Verdict;

// Const, so that threads can share it.
class OccupiedTruth {
 public:
  OccupiedTruth(const view::Frame& frame, const grid::Grid& grid, const grid::OccupiedCells& cells)
      : frame_(frame), screen_(grid.screen()), cells_(cells) {
    if (frame.ranges().spots.empty()) return;
    for (const geom::FrustumCell& part : cells.parts) balls_.push_back(geom::ball_around(part));
  }

  LightCells find(std::uint32_t light) const {
    Search search(view::volume_of(frame_.lights[light], frame_.view_space));
    if (search.volume.range == 0.0) return {};
    for (const Row& row : tile_rows(search))
      for (int column = row.outer.first; column <= row.outer.last; ++column)
        settle_tile(row.first_cell + static_cast<std::uint32_t>(column), search);
    return std::move(search.found);
  }

 private:
  struct Search {
    geom::LightVolume volume;
    geom::BallDecider decider;  // of points
    std::optional<geom::SpotDecider> spot;
    BallInSpace ball;
    QuickCone cone;
    LightCells found;

    explicit Search(const geom::LightVolume& light)
        : volume(light),
          decider(light.apex, std::isinf(light.range) ? 0.0 : light.range),  // endless ones ask nothing
          spot(light.is_cone ? std::optional<geom::SpotDecider>(light) : std::nullopt),
          ball(ball_in_space(light)),
          cone(light, ball) {}
  };

  // Rows of tiles that the light's ball may touch; all where that is not known.
  std::vector<Row> tile_rows(const Search& search) const {
    std::vector<Row> rows;
    const Vec2i count = screen_.tiles.count;
    if (std::isfinite(search.volume.range) && !screen_.tiles.orthographic) {
      append_tile_rows(screen_, search.ball, rows);
      return rows;
    }
    for (int row = 0; row < count.y; ++row)
      rows.push_back({static_cast<std::uint32_t>(row * count.x), {0, count.x - 1}, {}});
    return rows;
  }

  void settle_tile(std::uint32_t tile, Search& search) const {
    const auto tiles = static_cast<std::uint32_t>(screen_.tiles.count.x * screen_.tiles.count.y);
    for (std::uint32_t cell = tile; cell < cells_.cell_count(); cell += tiles) settle(cell, search);
  }

  // Undecided if one part is and no other one is met.
  void settle(std::uint32_t cell, Search& search) const {
    const std::uint64_t before = decisions(search);
    Verdict verdict = Verdict::no;
    for (std::uint32_t part = cells_.begin[cell]; part < cells_.begin[cell + 1] && verdict != Verdict::yes; ++part) {
      const Verdict now = meets(part, search);
      if (now != Verdict::no) verdict = now;
    }
    ++(verdict == Verdict::uncertain ? search.found.undecided
       : decisions(search) != before ? search.found.exact_decided
                                     : search.found.filter_decided);
    if (verdict != Verdict::no) search.found.add(cell);
  }

  static std::uint64_t decisions(const Search& search) {
    return search.decider.exact_decisions() + (search.spot ? search.spot->exact_decisions() : 0);
  }

  Verdict meets(std::uint32_t part, const Search& search) const {
    const geom::FrustumCell& shape = cells_.parts[part];
    const BallInSpace& ball = search.ball;
    const double depth = -ball.center.z, reach = ball.radius + ball.slack;
    if (depth + reach < shape.depth0 || depth - reach > shape.depth1) return Verdict::no;
    if (search.spot) return search.cone.surely_misses(balls_[part]) ? Verdict::no : search.spot->meets(shape);
    if (std::isinf(ball.radius)) return Verdict::yes;
    return search.decider.meets(shape) ? Verdict::yes : Verdict::no;
  }

  const view::Frame& frame_;
  const grid::ScreenGrid& screen_;
  const grid::OccupiedCells& cells_;
  std::vector<geom::Ball> balls_;  // around the parts, where there are spots
};

}  // namespace

Truth find_truth(const view::Frame& frame, const grid::Grid& grid, const grid::OccupiedCells& cells, int threads) {
  const OccupiedTruth truth(frame, grid, cells);
  return gathered_truth(frame.lights.size(), cells.cell_count(), threads,
                        [&](std::uint32_t light) { return truth.find(light); });
}

}  // namespace clusterbench::measure
