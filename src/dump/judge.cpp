#include "dump/judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "assign/contract/assigner_run.h"
#include "assign/contract/storage.h"
#include "core/error.h"
#include "dump/lost_lights.h"
#include "dump/other_orders.h"

namespace clusterbench::dump {
namespace {

constexpr double k_default_rounding = 32.0;

result::CellIndex cell_index(Vec3i at) {
  result::CellIndex out;
  for (int i = 0; i < 3; ++i) out[static_cast<std::size_t>(i)] = static_cast<std::uint64_t>(at[i]);
  return out;
}

// Ends of a cell along depth, distance, or z.
result::Pair extent_of(const grid::Grid& grid, std::uint32_t cell) {
  const auto z = static_cast<std::size_t>(grid.cell_at(cell).z);
  if (!grid.has_tiles()) {
    const auto& planes = grid.world().z;
    const double origin = grid.world().origin.z;
    return {{origin + static_cast<double>(planes[z]), origin + static_cast<double>(planes[z + 1])}};
  }
  const auto& boundaries = grid.screen().slices.boundaries;
  return {{static_cast<double>(boundaries[z]), static_cast<double>(boundaries[z + 1])}};
}

// Of a light whose range has no end: not finite.
double reach_mm(const view::Frame& frame, const LostPair& pair) {
  return 1000.0 * pair.reach * frame.lights[pair.light].range_m;
}

class SetJudge {
 public:
  SetJudge(const DumpFile& dump, const DumpFrame& frame, const measure::Truth& truth, int threads)
      : dump_(dump),
        frame_(frame),
        truth_(truth),
        order_(order_of(dump.record.grid)),
        shape_(frame.shape(order_)),
        threads_(threads) {}

  result::CheckedSet judge(const ListSet& set) const {
    result::CheckedSet out;
    out.name = set.name;
    layout::Decoded decoded = layout::decode(set.parts, dump_.buffers, shape_);
    out.bytes = layout::bytes_of(set.parts, dump_.buffers);
    add_reading(set, decoded, out);
    const assign::Lists listed = in_frame(std::move(decoded.lists));
    add_longest(listed, out);
    if (!decoded.faults.are_readable()) {
      out.verdict = "unreadable";
      return out;
    }
    const LostLights lost =
        find_lost(frame_.frame, frame_.grid, truth_.lists, listed, dump_.record.rounding.value_or(k_default_rounding));
    add_errors(lost, out);
    const bool is_beyond = lost.lost_pairs > lost.within_rounding;
    out.verdict = is_beyond                  ? "lost"
                  : decoded.faults.twice > 0 ? "twice"
                  : lost.true_pairs == 0     ? "empty"
                  : lost.within_rounding > 0 ? "rounding"
                                             : "right";
    if (!is_beyond && !are_for_nothing(lost)) return out;
    if (auto other = better_reading(dump_, frame_, set, truth_.lists, listed, lost, threads_)) {
      out.other_reading = *other;
      out.verdict = "misread";
    }
    return out;
  }

 private:
  // Lights of the dump to those of the frame.
  assign::Lists in_frame(assign::Lists lists) const {
    for (std::uint32_t& light : lists.lights) light = frame_.frame_index[light];
    assign::make_ascending(lists);
    return lists;
  }

  void add_reading(const ListSet& set, const layout::Decoded& decoded, result::CheckedSet& out) const {
    out.reading.fault_count = decoded.faults.count;
    for (const layout::Fault& fault : decoded.faults.first)
      out.reading.faults.push_back({fault.buffer == nullptr ? "" : fault.buffer->name, fault.byte, fault.value,
                                    cell_index(frame_.grid.cell_at(fault.cell)), fault.message});
    if (decoded.faults.are_readable()) return;
    if (const auto likely = layout::likely_reading(set.parts, dump_.buffers, shape_))
      out.reading.likely_reading = *likely;
  }

  void add_longest(const assign::Lists& listed, result::CheckedSet& out) const {
    const std::uint32_t fullest = listed.fullest_cell();
    out.longest_list = listed.of(fullest).size();
    if (out.longest_list > 0) out.longest_cell = cell_index(frame_.grid.cell_at(fullest));
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
      error.deepest_mm = reach_mm(frame_.frame, lost.deepest.front());
      error.deepest_percent = 100.0 * lost.deepest.front().reach;
    }
    for (const LostPair& pair : lost.deepest) {
      const Vec3i at = frame_.grid.cell_at(pair.cell);
      const auto [from, to] = extent_of(frame_.grid, pair.cell);
      out.lost.push_back({frame_.dump_index[pair.light], cell_index(at), order_.cell(at, frame_.grid.cells()), from, to,
                          reach_mm(frame_.frame, pair), 100.0 * pair.reach, pair.is_within_rounding});
    }
  }

  const DumpFile& dump_;
  const DumpFrame& frame_;
  const measure::Truth& truth_;
  layout::CellOrder order_;
  layout::Shape shape_;
  int threads_;
};

// Methods that fill lists of this grid on this machine's processor, without trying all pairs.
bool is_compared(const assign::AssignerDescriptor& method, const assign::Params& params, const DumpFrame& frame) {
  constexpr int k_has_a_faster_form = 2;  // with the same lists
  return method.is_default() && assign::slowness_of(method.name) != k_has_a_faster_form && !method.all_pairs &&
         !method.on_device && method.takes(frame.grid.kind()) && method.answers(assign::Answer::lists) &&
         (method.orthographic || !frame.frame.projection.orthographic) &&
         assign::unavailability(method, params).empty();
}

std::uint64_t packed_bytes(const assign::Lists& lists, const DumpFrame& frame) {
  const assign::StorageDescriptor& packed = *assign::find_storage("packed");
  const auto storage = packed.make(assign::Params(packed.params));
  storage->start(lists.cell_count(), frame.frame.ranges());
  storage->store(lists);
  const assign::StructureUse use = storage->use();
  return use.index_bytes + use.header_bytes;
}

std::vector<result::CheckedMethod> checked_methods(const DumpFrame& frame, const assign::Lists& truth) {
  std::vector<result::CheckedMethod> out;
  const view::LightArrays lights = view::lights_in(frame.frame, grid::space_of(frame.grid, frame.frame));
  for (const assign::AssignerDescriptor* method : assign::assigner_descriptors()) {
    const assign::Params params(method->params);
    if (!is_compared(*method, params, frame)) continue;
    assign::AssignerRun run(*method, params, assign::Answer::lists);
    run.build(frame.grid, assign::kinds_of(lights));
    run.assign({frame.frame, lights});
    const assign::Lists& listed = run.cell_lists();
    const LostLights lost = find_lost(frame.frame, frame.grid, truth, listed, 0.0);
    out.push_back(
        {method->name, listed.pair_count(), lost.false_positives, lost.lost_pairs, packed_bytes(listed, frame)});
  }
  return out;
}

constexpr std::array k_verdicts = {"right", "rounding", "empty",     "twice",
                                   "lost",  "misread",  "unreadable"};  // from good to bad

result::CheckedDump judged(const DumpFile& dump, const JudgeOptions& options) {
  const DumpFrame frame = frame_of(dump);
  result::CheckedDump out;
  out.dump = dump.path.string();
  out.name = dump.name();
  out.engine = dump.record.engine.value_or("");
  out.points = frame.frame.points;
  out.spots = frame.frame.lights.size() - frame.frame.points;
  out.grid_kind = grid::kind_name(frame.grid.kind());
  out.cells = cell_index(frame.grid.cells());
  const measure::Truth truth = measure::find_truth(frame.frame, frame.grid, options.threads);
  const SetJudge judge(dump, frame, truth, options.threads);
  for (const ListSet& set : list_sets(dump.record)) out.sets.push_back(judge.judge(set));
  if (options.with_methods) out.methods = checked_methods(frame, truth.lists);
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
