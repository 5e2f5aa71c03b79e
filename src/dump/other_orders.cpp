#include "dump/other_orders.h"

#include <algorithm>

#include "core/error.h"
#include "core/memory.h"
#include "dump/other_frames.h"

namespace clusterbench::dump {
namespace {

constexpr std::uint64_t k_times_fewer = 100;
constexpr std::uint64_t k_too_few = 10;     // to say so
constexpr std::uint64_t k_times_more = 10;  // true pairs, to remark on
constexpr double k_times_chance = 10.0;     // as many pairs as a reading loses are lost by chance

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

// Tiles in pixels are counted from the first row, so that the other end of the picture gives another grid.
std::optional<grid::Grid> grid_from_other_row(const DumpFile& dump, const DumpFrame& frame) {
  result::DumpGrid given = dump.record.grid;
  if (!given.tiles || !given.tiles->pixels || dump.record.viewport[1] % (*given.tiles->pixels)[1] == 0)
    return std::nullopt;
  given.first_row = given.first_row.value_or("top") == "top" ? "bottom" : "top";
  return grid_of(given, frame.frame);
}

// In words; empty: the same.
std::string order_change(const layout::CellOrder& given, const layout::CellOrder& other) {
  std::string out;
  const auto add = [&out](const std::string& change) { out += (out.empty() ? "" : ", ") + change; };
  if (other.axes != given.axes) add("grid.axes '" + other.axes + "'");
  if (other.is_from_bottom != given.is_from_bottom)
    add(other.is_from_bottom ? "grid.first_row 'bottom'" : "grid.first_row 'top'");
  if (other.is_from_far != given.is_from_far)
    add(other.is_from_far ? "grid.first_slice 'far'" : "grid.first_slice 'near'");
  return out;
}

// How many of the true pairs lists would lose that have as many cells for each light, but cells drawn by chance. Near 0
// where lists name their lights in nearly all cells: those lose nothing under any description.
double lost_by_chance(const assign::Lists& truth, const assign::Lists& listed, std::size_t lights) {
  std::vector<std::uint64_t> is_true(lights, 0), are_listed(lights, 0);
  for (const std::uint32_t light : truth.lights) ++is_true[light];
  for (const std::uint32_t light : listed.lights) ++are_listed[light];
  double lost = 0.0;
  for (std::size_t light = 0; light < lights; ++light)
    lost += static_cast<double>(is_true[light]) *
            (1.0 - static_cast<double>(are_listed[light]) / static_cast<double>(listed.cell_count()));
  return lost;
}

// Lists and truth under one description.
struct Evidence {
  const assign::Lists& truth;
  const assign::Lists& listed;
  double by_chance;
  // Of ranges: a smaller one loses less whatever the lists are, so it has to fit in both directions.
  bool is_strict = false;
};

class BestReading {
 public:
  BestReading(const DumpFrame& frame, const ListSet& set, const LostLights& found)
      : given_(frame.order),
        is_mirrored_(frame.has_mirrored_cells),
        of_tiles_(is_of_tiles(set)),
        found_(found),
        lights_(frame.frame.lights.size()) {
    if (is_lost_) most_ = found.lost_pairs / k_times_fewer;
    if (is_for_nothing_) most_ = std::max(most_, found.listed_pairs / k_times_fewer);
  }
  // Whether there is something to explain.
  bool is_wanted() const { return is_lost_ || is_for_nothing_; }
  bool is_lost() const { return is_lost_; }
  WantedRanges wanted_ranges() const { return {is_lost_, is_for_nothing_ && !is_lost_}; }

  // `rows_from_bottom`: where the grid itself depends on the first row, the one that it was made for.
  void try_orders(const grid::Grid& grid, const assign::Lists& truth, const assign::Lists& listed,
                  const std::string& camera, std::optional<bool> rows_from_bottom) {
    const Evidence evidence = evidence_of(truth, listed);
    if (truth.cell_count() != listed.cell_count() || !is_enough(evidence)) return;
    const Vec3i cells = grid.cells();
    for (const layout::CellOrder& order : layout::all_orders()) {
      if (rows_from_bottom && order.is_from_bottom != *rows_from_bottom) continue;
      const auto source = [&](std::uint32_t cell) {
        return grid::cell_index(source_cell(given_, order, grid.cell_at(cell), cells, of_tiles_), cells);
      };
      const std::uint64_t lost = count_lost(truth, listed, source, most_);
      take(lost, evidence, reading_in(order, camera, "", ""));
      if (order == given_ && !camera.empty()) note(lost, evidence, camera);
    }
  }
  // Lists that are read another way, in the dump's own order.
  void try_lists(const assign::Lists& truth, const assign::Lists& listed, const std::string& change) {
    const std::uint64_t lost = count_lost(
        truth, listed, [](std::uint32_t cell) { return cell; }, most_);
    const double are_true = static_cast<double>(true_of(lost, truth)),
                 were_true = static_cast<double>(found_.true_pairs - found_.lost_pairs);
    // Numbers without meaning that make long lists lose nothing, too.
    if (are_true * static_cast<double>(found_.listed_pairs) < were_true * static_cast<double>(listed.pair_count()))
      return;
    take(lost, evidence_of(truth, listed), reading_in(given_, "", change, ""));
  }
  // Lights with other ranges. Whether none is lost.
  bool try_ranges(const assign::Lists& truth, const assign::Lists& listed, const std::string& change) {
    const std::uint64_t lost = count_lost(
        truth, listed, [](std::uint32_t cell) { return cell; }, most_);
    Evidence evidence = evidence_of(truth, listed);
    evidence.is_strict = true;
    take(lost, evidence, reading_in(given_, "", "", change));
    note(lost, evidence, change);
    return lost == 0;
  }
  const std::optional<result::OtherReading>& best() const { return best_; }
  Readings readings() const { return {best_, best_ ? "" : remark_}; }

 private:
  static std::uint64_t true_of(std::uint64_t lost, const assign::Lists& truth) {
    return truth.pair_count() - std::min<std::uint64_t>(lost, truth.pair_count());
  }
  Evidence evidence_of(const assign::Lists& truth, const assign::Lists& listed) const {
    return {truth, listed, truth.cell_count() == listed.cell_count() ? lost_by_chance(truth, listed, lights_) : 0.0};
  }
  result::OtherReading reading_in(const layout::CellOrder& order, const std::string& camera, const std::string& lists,
                                  const std::string& lights) const {
    const layout::CellOrder named = in_dump(order);
    return {named.axes,
            named.is_from_bottom ? "bottom" : "top",
            named.is_from_far ? "far" : "near",
            order_change(in_dump(given_), named),
            camera,
            lists,
            lights,
            0};
  }

  // In the dump's words.
  layout::CellOrder in_dump(layout::CellOrder order) const {
    order.is_from_far = order.is_from_far != is_mirrored_;
    return order;
  }

  // Lists that lose nothing by chance are no evidence, and neither are a few pairs beside all that are lost.
  bool is_enough(const Evidence& evidence) const {
    return evidence.by_chance >= k_times_chance &&
           (!is_lost_ || is_for_nothing_ ||
            k_times_chance * evidence.by_chance >= static_cast<double>(found_.lost_pairs));
  }
  // Loses far fewer, though chance would lose a good part of them (squares of ranges may lose any number), and has no
  // fewer than half as many pairs that are true.
  bool explains_losses(std::uint64_t lost, const Evidence& evidence) const {
    return is_lost_ && lost <= found_.lost_pairs / k_times_fewer &&
           (evidence.is_strict || k_times_chance * evidence.by_chance >= static_cast<double>(found_.lost_pairs)) &&
           2 * true_of(lost, evidence.truth) >= found_.true_pairs - found_.lost_pairs;
  }
  // Makes most of the listed pairs true, and many more than there were.
  bool explains_excess(std::uint64_t lost, const Evidence& evidence) const {
    const std::uint64_t are_true = true_of(lost, evidence.truth), were_true = found_.true_pairs - found_.lost_pairs;
    return is_for_nothing_ && lost <= found_.listed_pairs / k_times_fewer &&
           2 * are_true > evidence.listed.pair_count() && 2 * are_true >= 3 * were_true;
  }
  // Lost and for nothing.
  static std::uint64_t wrong_of(std::uint64_t lost, const Evidence& evidence) {
    return lost + evidence.listed.pair_count() - true_of(lost, evidence.truth);
  }
  bool fits_both_ways(std::uint64_t wrong) const { return 3 * wrong <= found_.lost_pairs + found_.false_positives; }

  void take(std::uint64_t lost, const Evidence& evidence, result::OtherReading reading) {
    if (lost > most_) return;
    const std::uint64_t wrong = wrong_of(lost, evidence);
    if (best_ && (evidence.is_strict ? wrong >= best_wrong_ : lost >= best_->lost_pairs)) return;
    if (k_times_chance * static_cast<double>(lost + 1) > evidence.by_chance) return;
    const bool loses_fewer = explains_losses(lost, evidence), has_more_true = explains_excess(lost, evidence);
    if (evidence.is_strict && (!fits_both_ways(wrong) || (is_lost_ && !loses_fewer))) return;
    if (!loses_fewer && !has_more_true) return;
    reading.lost_pairs = lost;
    best_ = std::move(reading);
    best_wrong_ = wrong;
  }

  // What makes many more of the listed pairs true, and loses none; the most are remarked on.
  void note(std::uint64_t lost, const Evidence& evidence, const std::string& change) {
    const std::uint64_t are_true = evidence.truth.pair_count(), were_true = found_.true_pairs - found_.lost_pairs;
    if (lost > 0 || are_true <= most_noted_ || are_true < k_times_more * std::max<std::uint64_t>(were_true, 1) ||
        evidence.by_chance < k_times_chance)
      return;
    most_noted_ = are_true;
    remark_ = "with " + change + ", " + std::to_string(are_true) + " of the " + std::to_string(found_.listed_pairs) +
              " listed pairs would be true in place of " + std::to_string(were_true) + ", and none would be lost";
  }

  layout::CellOrder given_;
  bool is_mirrored_, of_tiles_;
  const LostLights& found_;
  std::size_t lights_;
  bool is_lost_ = found_.lost_pairs >= k_too_few;
  bool is_for_nothing_ = found_.listed_pairs >= k_too_few && are_for_nothing(found_);
  std::uint64_t most_ = 0, best_wrong_ = 0;
  std::optional<result::OtherReading> best_;
  std::uint64_t most_noted_ = 0;
  std::string remark_;
};

void try_descriptions(const DumpFile& dump, const DumpFrame& frame, const ListSet& set, const assign::Lists& truth,
                      BestReading& best) {
  const layout::Shape shape = frame.shape();
  for (const layout::OtherDescription& other : layout::other_descriptions(set.parts)) try {
      layout::Decoded decoded = layout::decode(other.parts, dump.buffers, shape);
      const assign::Lists listed = frame.in_frame(std::move(decoded.lists));
      if (decoded.faults.are_readable()) best.try_lists(truth, listed, other.change);
    } catch (const Error&) {  // NOLINT(bugprone-empty-catch): this description does not fit the buffers
    }
}

// Calls try_truth(exact lists) and returns what it returns; false where they are more than the memory holds.
template <class TryTruth>
bool try_truth_of(const DumpFrame& frame, int threads, TryTruth&& try_truth) {
  try {
    return try_truth(measure::find_truth(frame.frame, frame.grid, threads).lists);
  } catch (const Error&) {
    return false;
  }
}

void try_cameras(const DumpFile& dump, const assign::Lists& listed, std::optional<bool> rows, int threads,
                 BestReading& best) {
  each_other_camera(dump, [&](const DumpFrame& other, const std::string& change) {
    return try_truth_of(other, threads, [&](const assign::Lists& truth) {
      best.try_orders(other.grid, truth, listed, change, rows);
      return best.best().has_value();
    });
  });
}

void try_other_ranges(const DumpFile& dump, const DumpFrame& frame, const assign::Lists& listed, int threads,
                      BestReading& best) {
  bool is_none_lost = false;  // with the ranges that were tried last
  const auto try_one = [&](const DumpFrame& other, const std::string& change) {
    is_none_lost = try_truth_of(other, threads,
                                [&](const assign::Lists& truth) { return best.try_ranges(truth, listed, change); });
    return false;  // several may fit: the best is said
  };
  each_other_range(dump, frame, best.wanted_ranges(), try_one);
  if (best.best() || !is_none_lost || !best.wanted_ranges().larger) return;
  // The last were twice the ranges.
  each_larger_range(dump, frame, [&](const DumpFrame& other, const std::string& change) {
    try_one(other, change);
    return !is_none_lost;
  });
}

}  // namespace

Readings better_reading(const DumpFile& dump, const DumpFrame& frame, const ListSet& set, const assign::Lists& truth,
                        const assign::Lists& listed, const LostLights& found, int threads) {
  BestReading best(frame, set, found);
  if (!best.is_wanted() || listed.pair_count() == 0) return {};
  const auto truth_in = [threads](const view::Frame& of, const grid::Grid& grid) {
    return measure::find_truth(of, grid, threads).lists;
  };
  const std::optional<grid::Grid> turned = grid_from_other_row(dump, frame);
  const bool is_from_bottom = frame.order.is_from_bottom;
  const std::optional<bool> rows = turned ? std::optional(is_from_bottom) : std::nullopt;
  if (best.is_lost()) {  // no order and no other list makes more of the true pairs listed where none is lost
    best.try_orders(frame.grid, truth, listed, "", rows);
    if (turned && !best.best()) best.try_orders(*turned, truth_in(frame.frame, *turned), listed, "", !is_from_bottom);
    if (!best.best()) try_descriptions(dump, frame, set, truth, best);
  }
  if (!best.best()) try_cameras(dump, listed, rows, threads, best);
  if (!best.best()) try_other_ranges(dump, frame, listed, threads, best);
  return best.readings();
}

}  // namespace clusterbench::dump
