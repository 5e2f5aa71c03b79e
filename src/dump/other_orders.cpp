#include "dump/other_orders.h"

#include <algorithm>

#include "core/error.h"
#include "core/memory.h"
#include "dump/camera.h"

namespace clusterbench::dump {
namespace {

constexpr std::uint64_t k_times_fewer = 100;

bool is_of_tiles(const ListSet& set) {
  return std::ranges::all_of(set.parts, [](const layout::ListPart& part) {
    return part.lists.per_tile.value_or(false) || part.lists.layout.starts_with("bits_and");
  });
}

// The number of the list that a program in this order reads for a cell.
std::uint64_t list_number(const layout::CellOrder& order, Vec3i at, Vec3i cells, bool of_tiles) {
  if (!of_tiles) return order.cell(at, cells);
  const auto tiles = static_cast<std::uint64_t>(cells.x) * static_cast<std::uint64_t>(cells.y);
  return order.slice(at.z, cells) * tiles + order.tile(at, cells);
}

// For each cell of the grid, the cell whose list another order of the same buffers gives it.
std::vector<std::uint32_t> source_cells(const grid::Grid& grid, const layout::CellOrder& given,
                                        const layout::CellOrder& other, bool of_tiles) {
  const Vec3i cells = grid.cells();
  std::vector<std::uint32_t> cell_of_list(grid.cell_count()), out(grid.cell_count());
  for (std::uint32_t cell = 0; cell < out.size(); ++cell)
    cell_of_list[list_number(given, grid.cell_at(cell), cells, of_tiles)] = cell;
  for (std::uint32_t cell = 0; cell < out.size(); ++cell)
    out[cell] = cell_of_list[list_number(other, grid.cell_at(cell), cells, of_tiles)];
  return out;
}

struct CameraChange {
  const char* text;
  bool is_transposed, is_turned;
};
constexpr CameraChange k_changes[] = {{"camera.order: the matrices transposed", true, false},
                                      {"camera.forward: the other way", false, true},
                                      {"camera.order and camera.forward: both the other", true, true}};

// nullopt where the camera has no matrices, or they are none of a camera that way.
std::optional<DumpFrame> changed_frame(const DumpFile& dump, const CameraChange& change) {
  result::DumpCamera camera = dump.record.camera;
  if (!has_matrices(camera)) return std::nullopt;
  if (change.is_transposed) camera.order = camera.order.value_or("columns") == "columns" ? "rows" : "columns";
  if (change.is_turned) camera.forward = camera.forward.value_or("-z") == "-z" ? "+z" : "-z";
  try {
    return frame_of(dump, camera);
  } catch (const Error&) {
    return std::nullopt;
  }
}

// Tiles in pixels are counted from the first row, so that the other end of the picture gives another grid.
std::optional<grid::Grid> grid_from_other_row(const DumpFile& dump, const DumpFrame& frame) {
  result::DumpGrid given = dump.record.grid;
  if (!given.tiles || !given.tiles->pixels || dump.record.viewport[1] % (*given.tiles->pixels)[1] == 0)
    return std::nullopt;
  given.first_row = given.first_row.value_or("top") == "top" ? "bottom" : "top";
  return grid_of(given, frame.frame);
}

class BestReading {
 public:
  BestReading(const result::DumpGrid& given, const ListSet& set, const assign::Lists& listed, const LostLights& found,
              std::uint64_t wrong)
      : given_(order_of(given)),
        listed_(listed),
        of_tiles_(is_of_tiles(set)),
        most_(wrong / k_times_fewer),
        true_before_(found.true_pairs - found.lost_pairs) {}

  void try_orders(const grid::Grid& grid, const assign::Lists& truth, const char* camera) {
    if (truth.cell_count() != listed_.cell_count()) return;
    for (const layout::CellOrder& order : layout::all_orders()) {
      const std::uint64_t lost = count_lost(truth, listed_, source_cells(grid, given_, order, of_tiles_), most_);
      if (lost > most_ || truth.pair_count() - lost <= true_before_ || (best_ && lost >= best_->lost_pairs)) continue;
      best_ = result::OtherReading{order.axes, order.is_from_bottom ? "bottom" : "top",
                                   order.is_from_far ? "far" : "near", camera, lost};
    }
  }
  const std::optional<result::OtherReading>& best() const { return best_; }

 private:
  layout::CellOrder given_;
  const assign::Lists& listed_;
  bool of_tiles_;
  std::uint64_t most_, true_before_;
  std::optional<result::OtherReading> best_;
};

}  // namespace

std::optional<result::OtherReading> better_reading(const DumpFile& dump, const DumpFrame& frame, const ListSet& set,
                                                   const assign::Lists& truth, const assign::Lists& listed,
                                                   const LostLights& found, int threads) {
  constexpr std::uint64_t k_too_few = 10;  // to say so
  const std::uint64_t wrong = std::max(found.lost_pairs, are_for_nothing(found) ? found.listed_pairs : 0);
  if (wrong < k_too_few || listed.pair_count() == 0) return std::nullopt;
  BestReading best(dump.record.grid, set, listed, found, wrong);
  best.try_orders(frame.grid, truth, "");
  if (const std::optional<grid::Grid> grid = best.best() ? std::nullopt : grid_from_other_row(dump, frame))
    best.try_orders(*grid, measure::find_truth(frame.frame, *grid, threads).lists, "");
  for (const CameraChange& change : k_changes) {
    if (best.best()) break;
    if (const std::optional<DumpFrame> other = changed_frame(dump, change))
      best.try_orders(other->grid, measure::find_truth(other->frame, other->grid, threads).lists, change.text);
  }
  return best.best();
}

}  // namespace clusterbench::dump
