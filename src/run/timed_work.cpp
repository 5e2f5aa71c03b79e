#include "run/timed_work.h"

namespace clusterbench::run {

std::vector<TimedFrame> timed_frames(const Config& config, const GroupPlan& group, const PathFrames& path) {
  const std::vector<int> chosen =
      evenly_spaced(config.timing.frames == 0 ? path.count() : config.timing.frames, path.count());
  std::vector<TimedFrame> frames;
  GridOfFrames grids(config.grids[group.grid]);
  std::shared_ptr<const grid::Grid> grid;
  frames.reserve(chosen.size());
  for (const int index : chosen) {
    view::Frame frame = path.frame(index);
    if (grids.update(path, frame)) grid = std::make_shared<grid::Grid>(grids.grid());
    FrameLights lights(config.precisions, view::lights_in(frame, grid::space_of(*grid, frame)));
    frames.push_back({grid, std::move(frame), std::move(lights)});
  }
  return frames;
}

bool is_threaded(const MethodRequest& assigner) {
  const auto threads = assigner.params.values().find("threads");
  return threads != assigner.params.values().end() && std::get<double>(threads->second) > 1.0;
}

TimedWork::TimedWork(const Config& config, const GroupPlan& group, const Method& method,
                     const std::vector<TimedFrame>& frames)
    : frames_(frames), precision_(method.precision), lists_(frames.size()) {
  const MethodRequest& assigner = config.assigners[method.assigner];
  assigner_ = assign::find_assigner(assigner.name)->make(assigner.params);
  for (std::size_t place = 0; place < group.cases.size(); ++place) {
    if (group.cases[place].method() != method) continue;
    const MethodRequest& request = config.storages[group.cases[place].storage];
    places_.push_back(place);
    stores_.push_back(storage(*assign::find_storage(request.name), request.params));
  }
  assign();
}

void TimedWork::build() {
  build_for(frames_.front());
}

void TimedWork::build_for(const TimedFrame& frame) {
  assigner_->build(*frame.grid, assign::kinds_of(frame.lights.seen(precision_)));
  built_for_ = frame.grid.get();
}

void TimedWork::assign() {
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    if (frames_[i].grid.get() != built_for_) build_for(frames_[i]);
    assigner_->assign(frames_[i].lights.seen(precision_), lists_[i]);
  }
}

void TimedWork::convert(std::size_t store) const {
  for (const assign::Lists& lists : lists_) stores_[store]->store(lists);
}

std::unique_ptr<assign::Storage> TimedWork::storage(const assign::StorageRow& row, const assign::Params& params) const {
  const TimedFrame& frame = frames_.front();
  auto storage = row.make(params);
  storage->start(frame.grid->cell_count(), frame.lights.seen(precision_).points, frame.lights.seen(precision_).spots);
  return storage;
}

}  // namespace clusterbench::run
