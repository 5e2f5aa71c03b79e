#include "run/counted_group.h"

#include "run/findings/fit_meter.h"

namespace clusterbench::run {
namespace {

bool follows_needs(const grid::GridSpec& spec) {
  return spec.has_tiles() && spec.slices.fit;
}

class GroupCounting {
 public:
  GroupCounting(const config::Config& config, const SceneData& data, const GroupPlan& group, const PathFrames& path,
                const OnCounting& on_counting, const Stop& stop)
      : config_(config),
        data_(data),
        group_(group),
        spec_(config.grids[group.grid]),
        path_(path),
        on_counting_(on_counting),
        stop_(stop) {}

  std::optional<GroupCounts> counts() {
    out_.frames = path_.count();
    on_counting_(CountingStage::truth, 0.0);
    const bool is_complete = count() && count_unfitted() && count_reaction() && count_steps() && count_details();
    return is_complete ? std::optional(std::move(out_)) : std::nullopt;
  }

 private:
  // Passes over all frames: a grid that follows or reacts is counted without that, too.
  int passes() const { return 1 + (follows_needs(spec_) ? 1 : 0) + (spec_.reaction ? 1 : 0); }

  AccuracyResult accuracy(const config::Config& config) {
    const double share = 1.0 / path_.count() / passes();
    const ListsOverFrames lists = passes() > 1 ? ListsOverFrames::compared : ListsOverFrames::ignored;
    return accuracy_pass(
        config, data_, group_, path_, [&](int) { on_counting_(CountingStage::truth, share); }, stop_, lists);
  }
  AccuracyResult accuracy_beside(config::Config plain) {
    plain.lookup.reset();
    return accuracy(plain);
  }

  // Each is false if it was stopped.
  bool count() {
    out_.counted = accuracy(config_);
    return out_.counted.is_complete;
  }
  bool count_unfitted() {
    if (follows_needs(spec_)) out_.unfitted = accuracy_beside(without_fit(config_, group_.grid));
    return !out_.unfitted || out_.unfitted->is_complete;
  }
  bool count_reaction() {
    if (!spec_.reaction) return true;
    const int slices = out_.counted.last_grid.cells().z;
    if (can_count_requested_tiles(spec_, path_.viewport(), slices)) {
      out_.fixed = accuracy_beside(without_reaction(config_, group_.grid));
      if (!out_.fixed->is_complete) return false;
    }
    out_.tile_moves = tile_moves(spec_, path_);
    out_.cells = cells_of_frames(spec_, path_, slices);
    return true;
  }
  bool count_steps() {
    if (!config_.stability) return true;
    on_counting_(CountingStage::stability, 0.0);
    out_.stabilities = stability_pass(
        config_, group_, path_, [&](double share) { on_counting_(CountingStage::stability, share); }, stop_);
    return !out_.stabilities.empty();
  }
  bool count_details() {
    if (!config_.details) return true;
    on_counting_(CountingStage::details, 1.0);
    out_.details = details_pass(config_, group_, path_, data_.scene, out_.counted, stop_);
    return !out_.details.empty();
  }

  const config::Config& config_;
  const SceneData& data_;
  const GroupPlan& group_;
  const grid::GridSpec& spec_;
  const PathFrames& path_;
  const OnCounting& on_counting_;
  Stop stop_;
  GroupCounts out_;
};

}  // namespace

const char* name_of(CountingStage stage) {
  constexpr const char* k_names[] = {"truth and counts", "stability", "details"};
  return k_names[static_cast<std::size_t>(stage)];
}

std::optional<GroupCounts> count_group(const config::Config& config, const SceneData& data, const GroupPlan& group,
                                       const PathFrames& path, const OnCounting& on_counting, const Stop& stop) {
  return GroupCounting(config, data, group, path, on_counting, stop).counts();
}

}  // namespace clusterbench::run
