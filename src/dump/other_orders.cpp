#include "dump/other_orders.h"

#include <algorithm>

#include <glm/matrix.hpp>

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

// The cell of `given` whose list a program in another order reads for a cell.
Vec3i source_cell(const layout::CellOrder& given, const layout::CellOrder& other, Vec3i at, Vec3i cells,
                  bool of_tiles) {
  if (!of_tiles) return given.cell_at(other.cell(at, cells), cells);
  const auto z = static_cast<int>(given.slice(static_cast<int>(other.slice(at.z, cells)), cells));  // its own inverse
  return given.tile_at(other.tile(at, cells), z, cells);
}

struct CameraChange {
  const char* text;
  bool is_transposed = false, is_turned = false, has_other_depth = false;
  Vec3d mirrored{1.0};  // signs of view space: lights are seen in a mirror
};
const CameraChange k_changes[] = {
    {.text = "camera.order: the matrices transposed", .is_transposed = true},
    {.text = "camera.forward: the other way", .is_turned = true},
    {.text = "camera.order and camera.forward: both the other", .is_transposed = true, .is_turned = true},
    {.text = "camera.depth: the other of 0..1 and -1..1", .has_other_depth = true},
    {.text = "camera: the other handedness (the z row of world_to_view negated, or camera.forward and projection both "
             "the other way)",
     .mirrored = {1.0, 1.0, -1.0}},
    {.text = "camera: the x row of world_to_view negated", .mirrored = {-1.0, 1.0, 1.0}},
    {.text = "camera: the x and z rows of world_to_view negated", .mirrored = {-1.0, 1.0, -1.0}}};

bool is_mirrored(const CameraChange& change) {
  return change.mirrored != Vec3d(1.0);
}

// Moves all lights to where a camera sees them whose rows of the view matrix have these signs.
void mirror_lights(view::Frame& frame, const Vec3d& signs) {
  const Mat3d to_view = frame.view_space.rotation, to_world = glm::transpose(to_view);
  for (scene::WorldLight& light : frame.lights) {
    light.position =
        frame.view_space.origin + to_world * (signs * (to_view * (light.position - frame.view_space.origin)));
    light.direction = to_world * (signs * (to_view * light.direction));
  }
}

// nullopt where the camera has no matrices, or they are none of a camera that way.
std::optional<DumpFrame> changed_frame(const DumpFile& dump, const CameraChange& change) {
  result::DumpCamera camera = dump.record.camera;
  if (!has_matrices(camera) || (is_mirrored(change) && dump.record.grid.kind.value_or("frustum") == "world"))
    return std::nullopt;
  if (change.is_transposed) camera.order = camera.order.value_or("columns") == "columns" ? "rows" : "columns";
  if (change.has_other_depth) camera.depth = camera.depth.value_or("0..1") == "0..1" ? "-1..1" : "0..1";
  if (change.is_turned) camera.forward = camera.forward.value_or("-z") == "-z" ? "+z" : "-z";
  try {
    DumpFrame frame = frame_of(dump, camera);
    if (is_mirrored(change)) mirror_lights(frame.frame, change.mirrored);
    return frame;
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
  BestReading(const result::DumpGrid& given, const ListSet& set, const LostLights& found, std::uint64_t wrong)
      : given_(order_of(given)),
        of_tiles_(is_of_tiles(set)),
        most_(wrong / k_times_fewer),
        true_before_(found.true_pairs - found.lost_pairs),
        listed_before_(found.listed_pairs),
        least_true_(found.lost_pairs < wrong ? found.listed_pairs / 2 : 0) {}

  // `rows_from_bottom`: where the grid itself depends on the first row, the one that it was made for.
  void try_orders(const grid::Grid& grid, const assign::Lists& truth, const assign::Lists& listed, const char* camera,
                  std::optional<bool> rows_from_bottom) {
    if (truth.cell_count() != listed.cell_count()) return;
    const Vec3i cells = grid.cells();
    for (const layout::CellOrder& order : layout::all_orders()) {
      if (rows_from_bottom && order.is_from_bottom != *rows_from_bottom) continue;
      const auto source = [&](std::uint32_t cell) {
        return grid::cell_index(source_cell(given_, order, grid.cell_at(cell), cells, of_tiles_), cells);
      };
      take(count_lost(truth, listed, source, most_), truth,
           {order.axes, row_name(order), slice_name(order), camera, "", 0});
    }
  }
  // Lists that are read another way, in the dump's own order.
  void try_lists(const assign::Lists& truth, const assign::Lists& listed, const std::string& change) {
    const std::uint64_t lost = count_lost(
        truth, listed, [](std::uint32_t cell) { return cell; }, most_);
    const auto are_true = static_cast<double>(truth.pair_count() - std::min<std::uint64_t>(lost, truth.pair_count()));
    // Numbers without meaning that make long lists lose nothing, too.
    if (are_true * static_cast<double>(listed_before_) <
        static_cast<double>(true_before_) * static_cast<double>(listed.pair_count()))
      return;
    take(lost, truth, {given_.axes, row_name(given_), slice_name(given_), "", change, 0});
  }
  const std::optional<result::OtherReading>& best() const { return best_; }

 private:
  static const char* row_name(const layout::CellOrder& order) { return order.is_from_bottom ? "bottom" : "top"; }
  static const char* slice_name(const layout::CellOrder& order) { return order.is_from_far ? "far" : "near"; }

  void take(std::uint64_t lost, const assign::Lists& truth, result::OtherReading reading) {
    const std::uint64_t are_true = truth.pair_count() - std::min<std::uint64_t>(lost, truth.pair_count());
    if (lost > most_ || are_true <= true_before_ || are_true < least_true_ || (best_ && lost >= best_->lost_pairs))
      return;
    reading.lost_pairs = lost;
    best_ = std::move(reading);
  }

  layout::CellOrder given_;
  bool of_tiles_;
  std::uint64_t most_, true_before_, listed_before_;
  // Lists that lose nothing are told to be another reading's only where that makes half of them true: they may be long.
  std::uint64_t least_true_;
  std::optional<result::OtherReading> best_;
};

void try_descriptions(const DumpFile& dump, const DumpFrame& frame, const ListSet& set, const assign::Lists& truth,
                      BestReading& best) {
  const layout::Shape shape = frame.shape(order_of(dump.record.grid));
  for (const layout::OtherDescription& other : layout::other_descriptions(set.parts)) try {
      layout::Decoded decoded = layout::decode(other.parts, dump.buffers, shape);
      const assign::Lists listed = frame.in_frame(std::move(decoded.lists));
      if (decoded.faults.are_readable()) best.try_lists(truth, listed, other.change);
    } catch (const Error&) {  // NOLINT(bugprone-empty-catch): this description does not fit the buffers
    }
}

}  // namespace

std::optional<result::OtherReading> better_reading(const DumpFile& dump, const DumpFrame& frame, const ListSet& set,
                                                   const assign::Lists& truth, const assign::Lists& listed,
                                                   const LostLights& found, int threads) {
  constexpr std::uint64_t k_too_few = 10;  // to say so
  const std::uint64_t wrong = std::max(found.lost_pairs, are_for_nothing(found) ? found.listed_pairs : 0);
  if (wrong < k_too_few || listed.pair_count() == 0) return std::nullopt;
  BestReading best(dump.record.grid, set, found, wrong);
  const std::optional<grid::Grid> turned = grid_from_other_row(dump, frame);
  const bool is_from_bottom = order_of(dump.record.grid).is_from_bottom;
  const std::optional<bool> rows = turned ? std::optional(is_from_bottom) : std::nullopt;
  best.try_orders(frame.grid, truth, listed, "", rows);
  if (turned && !best.best())
    best.try_orders(*turned, measure::find_truth(frame.frame, *turned, threads).lists, listed, "", !is_from_bottom);
  if (!best.best()) try_descriptions(dump, frame, set, truth, best);
  for (const CameraChange& change : k_changes) {
    if (best.best()) break;
    if (const std::optional<DumpFrame> other = changed_frame(dump, change))
      best.try_orders(other->grid, measure::find_truth(other->frame, other->grid, threads).lists, listed, change.text,
                      rows);
  }
  return best.best();
}

}  // namespace clusterbench::dump
