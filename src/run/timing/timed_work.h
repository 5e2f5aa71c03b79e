#pragma once
// What is timed and what is counted: a group's methods over the frames that the configuration chooses for timing.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "assign/contract/storage.h"
#include "run/cases/frame_lights.h"
#include "run/cases/path_culls.h"
#include "run/cases/path_frames.h"
#include "run/cases/sweep.h"

namespace clusterbench::run {

// A frame with all that an assigner needs; frames with the same grid share it.
struct TimedFrame {
  std::shared_ptr<const grid::Grid> grid;
  view::Frame frame;
  FrameLights lights;
  std::shared_ptr<const depth::DepthImage> depth;  // where a method of the group needs it
  std::shared_ptr<const GroupCulls> culls;
  bool is_grid_new = false;  // another one than that of the path's frame before: an assigner is built for it
};

// The frames of the path that times are means over: `timing.frames` of them, evenly spaced, so that they stand for the
// path; all where it is 0.
std::vector<int> mean_frames(const config::Config& config, const PathFrames& path);

// These frames of the path, ready for a group's methods.
std::vector<TimedFrame> timed_frames(const config::Config& config, const GroupPlan& group, const PathFrames& path,
                                     const std::vector<int>& indices);

// Does this method share its work among threads?
bool is_threaded(const config::MethodRequest& assigner);

// One method over the frames, with the storages that its cases use. The frames outlive it. Its lists, or its own light
// structures, are made once at the start, so that memory has grown; each frame has its own.
class TimedWork {
 public:
  // `extra`: a further frame, which assign_frame() and convert_frame() know as frame_count(), and no pass holds.
  TimedWork(const config::Config& config, const GroupPlan& group, const Method& method,
            std::span<const TimedFrame> frames, const TimedFrame* extra = nullptr);

  // Prepares for the first frame's grid.
  void build();
  // Whether lights are culled before; and all frames' lights, as assign() wants them before it. Nothing else.
  bool culls() const { return !pre_cull_->is_none(); }
  void cull();
  void cull_frame(std::size_t frame);
  // All frames. A grid that changes between frames (fit) is built within: that is what such a method costs.
  void assign();
  // Builds for a frame's grid if that is another one than the last and not made for this frame alone.
  void prepare_frame(std::size_t frame);
  // One of them, as assign() does it.
  void assign_frame(std::size_t frame);
  // Of all frames of the last assign(), by a device's own clock; null where nothing runs on one.
  const assign::DeviceSpans* device_spans() const { return device_ ? &*device_ : nullptr; }
  // In one assign() after another.
  std::size_t builds() const;
  // Whether its lists are converted to what its cases are named after; a structure of its own is not.
  bool converts() const { return lists_assigner_ != nullptr; }
  // Puts the lists of all frames into the storage of one case.
  void convert(std::size_t store) const;
  void convert_frame(std::size_t store, std::size_t frame) const;
  // Puts a frame's lists into any storage that storage() made.
  void store_lists(assign::Storage& storage, std::size_t frame) const;

  // The method's cases by their index in the group; a storage each, where it converts.
  const std::vector<std::size_t>& case_indices() const { return case_indices_; }
  std::size_t frame_count() const { return frames_.size(); }
  bool has_extra() const { return extra_ != nullptr; }
  int path_frame(std::size_t frame) const { return at(frame).frame.index; }
  // Of the frames, and then of the extra one.
  const std::vector<assign::Lists>& lists() const { return lists_; }
  const std::vector<std::unique_ptr<assign::LightStructure>>& structures() const { return structures_; }
  // A storage that is ready for a frame, and for others with as many cells.
  std::unique_ptr<assign::Storage> storage(const assign::StorageDescriptor& storage, const assign::Params& params,
                                           std::size_t frame) const;

 private:
  assign::Assigner& assigner() const;
  const view::LightArrays& lights(std::size_t frame) const;
  void build_for(const TimedFrame& frame);
  // The frames that stand for those with as many cells, in order of first use; fills store_of_frame_.
  std::vector<std::size_t> frames_of_stores(std::size_t all_frames);
  const TimedFrame& at(std::size_t frame) const { return frame < frames_.size() ? frames_[frame] : *extra_; }

  std::span<const TimedFrame> frames_;
  const TimedFrame* extra_;
  std::size_t precision_;
  const cull::PreCull* pre_cull_;
  std::uint32_t most_lights_ = 0;             // in a frame of the path, behind the pre-cull
  std::vector<cull::FrameCull> frame_culls_;  // empty without one
  std::unique_ptr<assign::ListAssigner> lists_assigner_;
  std::unique_ptr<assign::StructureAssigner> structure_assigner_;  // one of the two
  const grid::Grid* built_for_ = nullptr;
  std::optional<assign::DeviceSpans> device_;
  std::vector<assign::Lists> lists_;
  std::vector<std::unique_ptr<assign::LightStructure>> structures_;
  std::vector<std::size_t> case_indices_;
  // Of each storage one per number of cells, since an engine whose grid changes has memory for the largest; and which
  // of them a frame is kept in.
  std::vector<std::vector<std::unique_ptr<assign::Storage>>> stores_;
  std::vector<std::size_t> store_of_frame_;
};

}  // namespace clusterbench::run
