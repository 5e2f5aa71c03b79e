#include "run/timed_work.h"

namespace clusterbench::run {

std::vector<TimedFrame> timed_frames(const config::Config& config, const GroupPlan& group, const PathFrames& path) {
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

bool is_threaded(const config::MethodRequest& assigner) {
  return assign::thread_count(*assign::find_assigner(assigner.name), assigner.params) > 1;
}

TimedWork::TimedWork(const config::Config& config, const GroupPlan& group, const Method& method,
                     const std::vector<TimedFrame>& frames)
    : frames_(frames), precision_(method.precision) {
  const config::MethodRequest& request = config.assigners[method.assigner];
  const assign::AssignerDescriptor& descriptor = *assign::find_assigner(request.name);
  if (method.answer == assign::Answer::lists) {
    lists_assigner_ = descriptor.make(request.params);
    lists_.resize(frames.size());
  } else {
    structure_assigner_ = descriptor.make_own(request.params);
    for (std::size_t i = 0; i < frames.size(); ++i) structures_.push_back(structure_assigner_->make_structure());
  }
  for (std::size_t place = 0; place < group.cases.size(); ++place) {
    const CasePlan& one = group.cases[place];
    if (one.method() != method) continue;
    places_.push_back(place);
    if (!one.storage) continue;
    const config::MethodRequest& store = config.storages[*one.storage];
    stores_.push_back(storage(*assign::find_storage(store.name), store.params));
  }
  assign();
}

void TimedWork::build() {
  build_for(frames_.front());
}

void TimedWork::build_for(const TimedFrame& frame) {
  assign::Assigner& assigner = lists_assigner_ ? static_cast<assign::Assigner&>(*lists_assigner_)
                                               : static_cast<assign::Assigner&>(*structure_assigner_);
  assigner.build(*frame.grid, assign::kinds_of(frame.lights.seen(precision_)));
  built_for_ = frame.grid.get();
}

void TimedWork::assign() {
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    const TimedFrame& frame = frames_[i];
    if (frame.grid.get() != built_for_) build_for(frame);
    const assign::FrameInput input{frame.frame, frame.lights.seen(precision_)};
    if (lists_assigner_)
      lists_assigner_->assign(input, lists_[i]);
    else
      structure_assigner_->assign(input, *structures_[i]);
  }
}

void TimedWork::convert(std::size_t store) const {
  for (const assign::Lists& lists : lists_) stores_[store]->store(lists);
}

std::unique_ptr<assign::Storage> TimedWork::storage(const assign::StorageDescriptor& storage,
                                                    const assign::Params& params) const {
  const TimedFrame& frame = frames_.front();
  auto made = storage.make(params);
  made->start(*frame.grid, frame.lights.seen(precision_).points, frame.lights.seen(precision_).spots);
  return made;
}

}  // namespace clusterbench::run
