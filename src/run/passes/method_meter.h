#pragma once
// A method over the frames of the counting pass: its work, and the measures of its lists.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "run/cases/path_culls.h"
#include "run/findings/light_shadows.h"
#include "run/passes/accuracy_pass.h"
#include "run/passes/method_instances.h"
#include "run/passes/prepared_frame.h"

namespace clusterbench::run {

class MethodMeter {
 public:
  // `shadows`: null if no shadow cull is requested. `compares`: compare cells with the truth. If the cells are too many
  // for that, a structure of the method's own is not expanded to lists either.
  MethodMeter(const config::Config& config, const Method& method, const cull::PreCull& pre_cull,
              std::uint32_t most_lights, ListsOverFrames over_frames, LightShadows* shadows, bool compares,
              bool has_too_many_cells);

  void add(const PreparedFrame& now);
  // Whether the lists are all that cases and measures need of the method. Then they can be filled apart from the rest:
  bool is_done_with_lists() const { return run_.filled_lists() != nullptr && run_.cull() == nullptr; }
  // Several threads may call it for different frames if run().shares_frames(); else frame by frame.
  void fill(const PreparedFrame& now, ListMemory& memory, ListsOfFrame& out) { instances_->fill(now, memory, out); }
  // Frame by frame.
  void add(const PreparedFrame& now, const ListsOfFrame& lists);
  // Evaluates some samples of visible surfaces; `is_lit`: one row per way to remove lights in shadow.
  void add_lit_samples(const grid::Grid& grid, std::span<const grid::Sample> samples,
                       const measure::NeededLights& needed, const std::vector<std::vector<bool>>& is_lit);
  void add_needed(std::size_t set, const measure::NeededLights& needed);

  // Whether its lists are compared with the truth of the grid's cells; not if the method has cells of its own.
  bool needs_grid_truth() const { return compares_ && measures_.has_cells && !run_.has_occupied_cells(); }

  const CulledRun& run() const { return run_; }
  // The ranges of light numbers for which a storage of its lists has room.
  view::LightRanges light_room(const view::Frame& frame) const {
    return run_.cull() == nullptr ? frame.ranges() : view::LightRanges(0, most_lights_);
  }
  const assign::Lists* cell_lists() const { return lists_; }
  const Method& method() const { return measures_.method; }

  MethodMeasures result() const;

 private:
  void assign(const PreparedFrame& now);
  void measure(const PreparedFrame& now, const assign::Lists& lists);  // of the cells
  void compare(const PreparedFrame& now, const grid::Grid& grid);

  bool compares_;
  assign::ListOrder order_;  // in which measures need the cells' lists
  int threads_;
  std::uint32_t most_lights_;  // most lights of a frame that the method gets
  LightShadows* shadows_;
  std::shared_ptr<const grid::Grid> grid_;  // for which the method is built
  CulledRun run_;
  std::unique_ptr<MethodInstances> instances_;  // that fill()
  std::optional<PreCullMeter> cull_meter_;
  std::vector<ShadowCullMeter> shadow_culls_;  // one per way, for lists only
  const assign::Lists* lists_ = nullptr;       // of the cells, in the current frame; null behind add() of given lists
  std::optional<measure::OccupancyMeter> occupancy_;
  measure::LongestBySlice longest_by_slice_;
  std::optional<ListChangeMeter> list_changes_;
  MethodMeasures measures_;
};

}  // namespace clusterbench::run
