#include "dump/judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/text.h"
#include "dump/lost_lights.h"
#include "dump/other_orders.h"
#include "dump/unread_rows.h"

namespace clusterbench::dump {
namespace {

constexpr double k_default_rounding = 32.0;

result::CellIndex cell_index(Vec3i at) {
  result::CellIndex out;
  for (int i = 0; i < 3; ++i) out[static_cast<std::size_t>(i)] = static_cast<std::uint64_t>(at[i]);
  return out;
}

// Ends of a slice of a world grid in the dump's own world: by the numbers that the dump gives, not as the grid rounds
// them.
result::Pair world_extent(const result::DumpGrid& given, std::int64_t z) {
  if (given.planes) {
    const auto i = static_cast<std::size_t>(z);
    return {{given.planes->origin_m[2] + given.planes->z_m[i], given.planes->origin_m[2] + given.planes->z_m[i + 1]}};
  }
  const double low = given.bounds->lo_m[2], high = given.bounds->hi_m[2];
  const auto cells = static_cast<double>((*given.cells)[2]);
  const auto plane = [&](double i) { return i == cells ? high : low + (high - low) * (i / cells); };
  return {{plane(static_cast<double>(z)), plane(static_cast<double>(z + 1))}};
}

// Ends of a cell along depth, distance, or z.
result::Pair extent_of(const DumpFrame& frame, const result::Dump& dump, std::uint32_t cell) {
  const auto z = static_cast<std::size_t>(frame.dump_cell(cell).z);
  result::Pair out;
  if (frame.grid.has_tiles()) {
    const auto& boundaries = frame.grid.screen().slices.boundaries;
    out = {{static_cast<double>(boundaries[z]), static_cast<double>(boundaries[z + 1])}};
  } else {
    out = world_extent(dump.grid, frame.dump_cell(cell).z);
  }
  for (double& end : out) end *= dump.metres_per_unit.value_or(1.0);
  return out;
}

class SetJudge {
 public:
  SetJudge(const DumpFile& dump, const DumpFrame& frame, const measure::Truth& truth, const JudgeOptions& options)
      : dump_(dump),
        frame_(frame),
        truth_(truth),
        shape_(frame.shape()),
        metres_per_unit_(dump.record.metres_per_unit.value_or(1.0)),
        threads_(options.threads),
        page_(options.page),
        page_room_(options.page_room) {}

  result::CheckedSet judge(const ListSet& set) const {
    result::CheckedSet out;
    out.name = set.name;
    layout::Decoded decoded = layout::decode(set.parts, dump_.buffers, shape_);
    out.bytes = layout::bytes_of(set.parts, dump_.buffers);
    add_reading(set, decoded, out);
    out.remarks = unread_rows(dump_, set, frame_.grid.cells());
    const assign::Lists listed = frame_.in_frame(std::move(decoded.lists));
    add_longest(listed, out);
    if (page_ != nullptr) page_->sets.push_back({set.name, {}, 0});
    if (!decoded.faults.are_readable()) {
      out.verdict = "unreadable";
      return out;
    }
    const LostLights lost = find_lost(frame_.frame, frame_.grid, truth_.lists, listed,
                                      {dump_.record.rounding.value_or(k_default_rounding), metres_per_unit_});
    add_errors(lost, out);
    if (lost.lost_pairs > 0) {
      out.error->lost_in_full_lists = count_lost_in(truth_.lists, listed, full_cells(set));
      out.error->lost_in_longest_lists = count_lost_in(truth_.lists, listed, cells_with(listed, out.longest_list));
    }
    if (page_ != nullptr) page_->sets.back() = page_set(set.name, frame_, truth_.lists, listed, lost, *page_room_);
    const bool is_beyond = lost.lost_pairs > lost.within_rounding;
    out.verdict = is_beyond                  ? "lost"
                  : decoded.faults.twice > 0 ? "twice"
                  : lost.true_pairs == 0     ? "empty"
                  : lost.within_rounding > 0 ? "rounding"
                                             : "right";
    if (!is_beyond && !are_for_nothing(lost)) return out;
    const Readings readings = better_reading(dump_, frame_, set, truth_.lists, listed, lost, threads_);
    if (!readings.remark.empty()) out.remarks.push_back(readings.remark);
    if (readings.better) {
      out.other_reading = *readings.better;
      out.verdict = "misread";
    }
    return out;
  }

 private:
  result::ReadingFault fault_record(const layout::Fault& fault) const {
    return {fault.buffer == nullptr ? "" : fault.buffer->name, fault.byte, fault.value,
            cell_index(frame_.dump_cell(fault.cell)), fault.message};
  }

  void add_reading(const ListSet& set, const layout::Decoded& decoded, result::CheckedSet& out) const {
    out.reading.fault_count = decoded.faults.count;
    out.reading.twice_count = decoded.faults.twice;
    for (const layout::Fault& fault : decoded.faults.first) out.reading.faults.push_back(fault_record(fault));
    for (const layout::Fault& fault : decoded.faults.first_twice) out.reading.twice.push_back(fault_record(fault));
    if (decoded.faults.are_readable()) return;
    if (const auto likely = layout::likely_reading(set.parts, dump_.buffers, shape_))
      out.reading.likely_reading = *likely;
  }

  // Cells whose list of some part has no room for another light.
  std::vector<bool> full_cells(const ListSet& set) const {
    std::vector<bool> out(truth_.lists.cell_count(), false);
    for (const layout::ListPart& part : set.parts) {
      if (part.lists.layout != "fixed") continue;
      const assign::Lists lists = layout::decode({&part, 1}, dump_.buffers, shape_).lists;
      for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell)
        if (lists.of(cell).size() >= part.lists.per_cell.value_or(0)) out[cell] = true;
    }
    return out;
  }

  static std::vector<bool> cells_with(const assign::Lists& listed, std::uint64_t lights) {
    std::vector<bool> out(listed.cell_count());
    for (std::uint32_t cell = 0; cell < listed.cell_count(); ++cell) out[cell] = listed.of(cell).size() == lights;
    return out;
  }

  // Of a light whose range has no end: not finite.
  double reach_mm(const LostPair& pair) const { return 1000.0 * metres_per_unit_ * pair.reach_m; }

  void add_longest(const assign::Lists& listed, result::CheckedSet& out) const {
    const std::uint32_t fullest = listed.fullest_cell();
    out.longest_list = listed.of(fullest).size();
    if (out.longest_list > 0) out.longest_cell = cell_index(frame_.dump_cell(fullest));
  }

  void add_errors(const LostLights& lost, result::CheckedSet& out) const {
    result::ListErrors& error = out.error.emplace();
    error.true_pairs = lost.true_pairs;
    error.listed_pairs = lost.listed_pairs;
    error.false_positives = lost.false_positives;
    error.lost_pairs = lost.lost_pairs;
    error.lost_within_rounding = lost.within_rounding;
    error.lost_lights = lost.lights;
    error.absent_lights = lost.absent_lights;
    error.undecided = truth_.undecided;
    error.deepest_mm = error.deepest_percent = 0.0;
    if (!lost.deepest.empty()) {
      error.deepest_mm = reach_mm(lost.deepest.front());
      error.deepest_percent = 100.0 * lost.deepest.front().reach;
    }
    for (const LostPair& pair : lost.deepest) {
      const auto [from, to] = extent_of(frame_, dump_.record, pair.cell);
      out.lost.push_back({frame_.dump_index[pair.light], cell_index(frame_.dump_cell(pair.cell)),
                          frame_.order.cell(frame_.grid.cell_at(pair.cell), frame_.grid.cells()), from, to,
                          reach_mm(pair), 100.0 * pair.reach, pair.is_within_rounding});
    }
  }

  const DumpFile& dump_;
  const DumpFrame& frame_;
  const measure::Truth& truth_;
  layout::Shape shape_;
  double metres_per_unit_;
  int threads_;
  result::CheckPageFrame* page_;
  std::size_t* page_room_;
};

constexpr std::array k_verdicts = {"right", "rounding", "empty",     "twice",
                                   "lost",  "misread",  "unreadable"};  // from good to bad

result::CheckedDump judged(const DumpFile& dump, const JudgeOptions& options) {
  const DumpFrame frame = frame_of(dump);
  result::CheckedDump out;
  out.dump = printable(dump.path.string());
  out.name = dump.name();
  out.engine = dump.record.engine.value_or("");
  out.points = frame.frame.points;
  out.spots = frame.frame.lights.size() - frame.frame.points;
  out.grid_kind = grid::kind_name(frame.grid.kind());
  out.cells = cell_index(frame.grid.cells());
  const layout::CellOrder order = order_of(dump.record.grid);
  out.first_row = order.is_from_bottom ? "bottom" : "top";
  out.first_slice = order.is_from_far ? "far" : "near";
  const measure::Truth truth = measure::find_truth(frame.frame, frame.grid, options.threads);
  if (options.page != nullptr) *options.page = page_frame(frame, dump.record.metres_per_unit.value_or(1.0));
  const SetJudge judge(dump, frame, truth, options);
  for (const ListSet& set : list_sets(dump.record)) out.sets.push_back(judge.judge(set));
  add_methods(frame, truth.lists, options.methods, out);
  if (options.page != nullptr) {
    add_lights(frame, dump.record.metres_per_unit.value_or(1.0), *options.page);
    options.page->checked = out;
    for (result::CheckedSet& set : options.page->checked.sets) set.lost.clear();  // they are in the cells
  }
  return out;
}

// Most often a frame of a path that looks away from all lights.
bool is_nothing(const result::CheckedSet& set) {
  return set.verdict == "empty" && set.error->listed_pairs == 0;
}

}  // namespace

result::CheckedDump judge(const DumpFile& dump, const JudgeOptions& options) {
  try {
    return judged(dump, options);
  } catch (const Error& error) {
    if (!error.file().empty()) throw;
    throw Error(dump.path.string(), error.where(), error.message(), error.code());
  }
}

std::string worst_verdict(const std::vector<result::CheckedDump>& frames) {
  std::optional<std::size_t> worst;
  for (const result::CheckedDump& frame : frames)
    for (const result::CheckedSet& set : frame.sets) {
      if (is_nothing(set)) continue;
      const auto found = std::ranges::find(k_verdicts, set.verdict);
      worst = std::max(worst.value_or(0), static_cast<std::size_t>(found - k_verdicts.begin()));
    }
  return worst ? k_verdicts[*worst] : "empty";
}

}  // namespace clusterbench::dump
