#include "run/timing/timed_work.h"

#include <algorithm>

#include "core/memory.h"
#include "os/call_notes.h"

namespace clusterbench::run {

namespace {

// The first frame has no previous one: it gets the value of the second.
bool is_grid_new(const grid::GridSpec& spec, const PathFrames& path, const view::Frame& frame) {
  const std::optional<view::Frame> other = path.neighbour(frame);
  return other && !(path.inputs(spec, frame) == path.inputs(spec, *other));
}

}  // namespace

std::vector<int> mean_frames(const config::Config& config, const PathFrames& path) {
  return evenly_spaced(config.timing.frames == 0 ? path.count() : config.timing.frames, path.count());
}

std::vector<TimedFrame> timed_frames(const config::Config& config, const GroupPlan& group, const PathFrames& path,
                                     const std::vector<int>& indices) {
  std::vector<TimedFrame> frames;
  GridOfFrames grids(config.grids[group.grid]);
  std::shared_ptr<const grid::Grid> grid;
  const auto culls = std::make_shared<const GroupCulls>(config, group, path);
  frames.reserve(indices.size());
  for (const int index : indices) {
    view::Frame frame = path.frame(index);
    if (grids.update(path, frame)) grid = std::make_shared<grid::Grid>(grids.grid());
    FrameLights lights(config.precisions, view::lights_in(frame, grid::space_of(*grid, frame)));
    const bool is_new = is_grid_new(config.grids[group.grid], path, frame);
    std::shared_ptr<const depth::DepthImage> depth = depths_for(config, group, path, frame);
    if (depth) check_memory("depths of timed pixels", indices.size() * depth->pixels.count(), sizeof(float));
    frames.push_back({grid, std::move(frame), std::move(lights), std::move(depth), culls, is_new});
  }
  return frames;
}

bool is_threaded(const config::MethodRequest& assigner) {
  return assign::thread_count(*assign::find_assigner(assigner.name), assigner.params) > 1;
}

TimedWork::TimedWork(const config::Config& config, const GroupPlan& group, const Method& method,
                     std::span<const TimedFrame> frames, const TimedFrame* extra)
    : frames_(frames),
      extra_(extra),
      precision_(method.precision),
      pre_cull_(&frames.front().culls->path.of(method)),
      most_lights_(frames.front().culls->max_lights_of(method)) {
  const std::size_t all_frames = frames.size() + (extra == nullptr ? 0 : 1);
  os::note_label(label_of(method));
  const config::MethodRequest& request = config.assigners[method.assigner];
  const assign::AssignerDescriptor& descriptor = *assign::find_assigner(request.name);
  if (method.answer == assign::Answer::lists) {
    lists_assigner_ = descriptor.make(request.params);
    lists_.resize(all_frames);
  } else {
    structure_assigner_ = descriptor.make_own(request.params);
    for (std::size_t i = 0; i < all_frames; ++i) structures_.push_back(structure_assigner_->make_structure());
  }
  const std::vector<std::size_t> of_stores = frames_of_stores(all_frames);
  for (std::size_t index = 0; index < group.cases.size(); ++index) {
    const CasePlan& case_plan = group.cases[index];
    if (case_plan.method() != method) continue;
    case_indices_.push_back(index);
    if (!case_plan.storage) continue;
    const config::MethodRequest& store = config.storages[*case_plan.storage];
    stores_.emplace_back();
    for (const std::size_t frame : of_stores)
      stores_.back().push_back(storage(*assign::find_storage(store.name), store.params, frame));
  }
  if (culls()) frame_culls_.resize(all_frames);
  for (std::size_t i = 0; i < frame_culls_.size(); ++i) {
    cull_frame(i);
    cull::PreCull::give_source(at(i).lights.in_precision(precision_), frame_culls_[i]);
  }
  if (extra_ != nullptr) assign_frame(frames.size());
  assign();
  check();
  if (extra_ != nullptr) check_frame(frames.size());
}

std::vector<std::size_t> TimedWork::frames_of_stores(std::size_t all_frames) {
  std::vector<std::size_t> first_frames;
  for (std::size_t frame = 0; frame < all_frames; ++frame) {
    const auto same = std::ranges::find(first_frames, at(frame).grid->cells(),
                                        [&](std::size_t first) { return at(first).grid->cells(); });
    store_of_frame_.push_back(static_cast<std::size_t>(same - first_frames.begin()));
    if (same == first_frames.end()) first_frames.push_back(frame);
  }
  return first_frames;
}

void TimedWork::build() {
  build_for(frames_.front());
}

assign::Assigner& TimedWork::assigner() const {
  if (lists_assigner_) return *lists_assigner_;
  return *structure_assigner_;
}

void TimedWork::build_for(const TimedFrame& frame) {
  assigner().build(*frame.grid, assign::kinds_of(frame.lights.in_precision(precision_)));
  built_for_ = frame.grid.get();
}

void TimedWork::cull() {
  if (!culls()) return;
  for (std::size_t i = 0; i < frames_.size(); ++i) cull_frame(i);
}

void TimedWork::cull_frame(std::size_t frame) {
  const TimedFrame& now = at(frame);
  pre_cull_->cull(now.frame, *now.grid, now.lights.in_precision(precision_), frame_culls_[frame]);
}

// The lights of a frame that the method gets.
const view::LightArrays& TimedWork::lights(std::size_t frame) const {
  return culls() ? frame_culls_[frame].lights : at(frame).lights.in_precision(precision_);
}

void TimedWork::assign() {
  for (std::size_t i = 0; i < frames_.size(); ++i) assign_frame(i);
}

void TimedWork::prepare_frame(std::size_t frame) {
  const TimedFrame& now = at(frame);
  if (!now.is_grid_new && now.grid.get() != built_for_) build_for(now);
}

void TimedWork::assign_frame(std::size_t frame) {
  const TimedFrame& now = at(frame);
  if (now.is_grid_new || now.grid.get() != built_for_) build_for(now);
  const assign::FrameInput input{now.frame, lights(frame), now.depth.get()};
  if (lists_assigner_)
    lists_assigner_->assign(input, lists_[frame]);
  else
    structure_assigner_->assign(input, *structures_[frame]);
}

void TimedWork::check_frame(std::size_t frame) const {
  os::note_frame(path_frame(frame));
  if (lists_assigner_) lists_assigner_->check(lists_[frame], lights(frame));
}

void TimedWork::check() const {
  for (std::size_t i = 0; i < frames_.size(); ++i) check_frame(i);
}

std::size_t TimedWork::builds() const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    const TimedFrame& before = frames_[i > 0 ? i - 1 : frames_.size() - 1];
    count += frames_[i].is_grid_new || frames_[i].grid != before.grid ? 1 : 0;
  }
  return count;
}

void TimedWork::convert(std::size_t store) const {
  for (std::size_t i = 0; i < frames_.size(); ++i) convert_frame(store, i);
}

void TimedWork::convert_frame(std::size_t store, std::size_t frame) const {
  store_lists(*stores_[store][store_of_frame_[frame]], frame);
}

void TimedWork::store_lists(assign::Storage& storage, std::size_t frame) const {
  if (culls()) storage.set_types(frame_culls_[frame].lights);
  storage.store(lists_[frame]);
}

std::unique_ptr<assign::Storage> TimedWork::storage(const assign::StorageDescriptor& storage,
                                                    const assign::Params& params, std::size_t frame) const {
  auto made = storage.make(params);
  const TimedFrame& now = at(frame);
  if (culls())
    made->start(*now.grid, view::LightRanges(0, most_lights_));
  else
    made->start(*now.grid, now.lights.in_precision(precision_));
  return made;
}

}  // namespace clusterbench::run
