#pragma once
// The work that is timed and counted: a group's methods over the frames that the configuration chooses for timing.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "assign/contract/storage.h"
#include "run/cases/case_plan.h"
#include "run/cases/frame_lights.h"
#include "run/cases/path_culls.h"
#include "run/cases/path_frames.h"

namespace clusterbench::run {

// A frame with all inputs of an assigner; frames with the same grid share it.
struct TimedFrame {
  std::shared_ptr<const grid::Grid> grid;
  view::Frame frame;
  FrameLights lights;
  std::shared_ptr<const depth::DepthImage> depth;  // if a method of the group needs it
  std::shared_ptr<const GroupCulls> culls;
  bool is_grid_new = false;  // differs from that of the path's previous frame: the assigner is rebuilt
};

// The frames whose times are averaged: `timing.frames` frames, evenly spaced, so that they represent the path; all if
// it is 0.
std::vector<int> mean_frames(const config::Config& config, const PathFrames& path);

// These frames of the path, prepared for a group's methods.
std::vector<TimedFrame> timed_frames(const config::Config& config, const GroupPlan& group, const PathFrames& path,
                                     const std::vector<int>& indices);

// Whether this method uses several threads.
bool is_threaded(const config::MethodRequest& assigner);

// One method over the frames, with the storages that its cases use. The frames must outlive this object. Lists, or a
// method's own light structures, are made once at the start, so that memory has grown; each frame has its own.
class TimedWork {
 public:
  // `extra`: a further frame, which is number frame_count() for assign_frame() and convert_frame(), and in no pass.
  TimedWork(const config::Config& config, const GroupPlan& group, const Method& method,
            std::span<const TimedFrame> frames, const TimedFrame* extra = nullptr);

  // Builds for the first frame's grid.
  void build();
  // Whether there is a pre-cull, which runs on all frames' lights before assign().
  bool culls() const { return !pre_cull_->is_none(); }
  void cull();
  void cull_frame(std::size_t frame);
  // All frames. A grid that changes between frames (fit) is built inside: this is part of the method's cost.
  void assign();
  // Builds for a frame's grid if it differs from the last one and is not made for this frame alone.
  void prepare_frame(std::size_t frame);
  // One frame, in the same way as assign().
  void assign_frame(std::size_t frame);
  // Throws MethodError where the lists of a plug-in's method, of a frame or of all, are none. Before they are
  // converted; never timed.
  void check_frame(std::size_t frame) const;
  void check() const;
  // Of the last frame that was assigned, by the device's own clock. Only of methods that run on a device.
  const assign::DeviceSpans& device_spans() const { return *assigner().device_spans(); }
  double device_floor_ns() const { return assigner().device_floor_ns(); }
  void repeat_on_device(const assign::DeviceRepeats& repeats) const { assigner().repeat_on_device(repeats); }
  std::optional<double> device_build_ns() const { return assigner().device_build_ns(); }
  std::vector<assign::ShaderStatistic> shader_statistics() const { return assigner().shader_statistics(); }
  // Number of builds in an assign() that follows another one.
  std::size_t builds() const;
  // Whether its lists are converted to the storages of its cases; a structure of its own is not.
  bool converts() const { return lists_assigner_ != nullptr; }
  // Puts the lists of all frames into the storage of one case.
  void convert(std::size_t store) const;
  void convert_frame(std::size_t store, std::size_t frame) const;
  // Puts a frame's lists into any storage that storage() made.
  void store_lists(assign::Storage& storage, std::size_t frame) const;

  // The method's cases by their index in the group; one storage per case, if the method converts.
  const std::vector<std::size_t>& case_indices() const { return case_indices_; }
  std::size_t frame_count() const { return frames_.size(); }
  bool has_extra() const { return extra_ != nullptr; }
  int path_frame(std::size_t frame) const { return at(frame).frame.index; }
  // Of the frames, followed by the extra one.
  const std::vector<assign::Lists>& lists() const { return lists_; }
  const std::vector<std::unique_ptr<assign::LightStructure>>& structures() const { return structures_; }
  // A storage that is ready for this frame, and for other frames with the same number of cells.
  std::unique_ptr<assign::Storage> storage(const assign::StorageDescriptor& storage, const assign::Params& params,
                                           std::size_t frame) const;

 private:
  assign::Assigner& assigner() const;
  const view::LightArrays& lights(std::size_t frame) const;
  void build_for(const TimedFrame& frame);
  // The first frame of each number of cells, in order of first use; fills store_of_frame_.
  std::vector<std::size_t> frames_of_stores(std::size_t all_frames);
  const TimedFrame& at(std::size_t frame) const { return frame < frames_.size() ? frames_[frame] : *extra_; }

  std::span<const TimedFrame> frames_;
  const TimedFrame* extra_;
  std::size_t precision_;
  const cull::PreCull* pre_cull_;
  std::uint32_t most_lights_ = 0;             // in a frame of the path, behind the pre-cull
  std::vector<cull::FrameCull> frame_culls_;  // empty without one
  std::unique_ptr<assign::ListAssigner> lists_assigner_;
  std::unique_ptr<assign::StructureAssigner> structure_assigner_;  // only one of the two is set
  const grid::Grid* built_for_ = nullptr;
  std::vector<assign::Lists> lists_;
  std::vector<std::unique_ptr<assign::LightStructure>> structures_;
  std::vector<std::size_t> case_indices_;
  // Per storage and number of cells one object, since an engine whose grid changes allocates memory for the largest
  // grid; and the index of the object that each frame uses.
  std::vector<std::vector<std::unique_ptr<assign::Storage>>> stores_;
  std::vector<std::size_t> store_of_frame_;
};

}  // namespace clusterbench::run
