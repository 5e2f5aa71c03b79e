#pragma once
// Lights that a pre-cull removes over a path's frames, and needed lights among them.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assign/contract/lists.h"
#include "cull/pre_cull.h"
#include "measure/samples/packing_loss.h"
#include "measure/samples/samples.h"

namespace clusterbench::run {

// Lights that samples need and a pre-cull removes.
struct LostAtSamples {
  measure::SampleSet set = measure::SampleSet::volume;
  std::uint64_t needed = 0, lost = 0;
  bool has_samples = false;  // the scene has such samples
};

struct PreCullCounts {
  struct Step {
    std::string label;
    bool is_distance = false;
    measure::MeanMax removed;  // lights per frame
    std::optional<int> limit;  // of a MostStep: its lights
    int frames = 0;            // number of frames with removed lights
  };
  bool conservative = true;                 // in every frame
  measure::MeanMax kept, removed, distant;  // lights per frame; the distant ones are among the removed
  std::vector<Step> steps;
  std::vector<std::uint32_t> dropped;  // the rig's indices of lights that limits removed in some frame, ascending
  std::uint64_t lost_pairs = 0;        // true pairs of removed lights
  std::uint64_t lost_to_limits = 0;    // those of lights in view that limits remove
  std::vector<LostAtSamples> samples;
  std::uint64_t bytes = 0;  // of visible sets
  std::uint64_t view_cells = 0;
  double build_ns = 0.0;  // of visible sets
};

class PreCullMeter {
 public:
  PreCullMeter(const cull::PreCull& pre_cull, const std::vector<measure::SampleSet>& sets);

  void add_frame(const cull::FrameCull& cull, const view::Frame& frame, bool is_conservative);
  // For the frame that was added last.
  void add_truth(const assign::Lists& truth);
  void add_samples(std::size_t set, const assign::Lists& needed);

  PreCullCounts result() const;

 private:
  struct Sum {
    std::uint64_t sum = 0, max = 0;

    void add(std::uint64_t value);
    measure::MeanMax over(int frames) const;
  };

  // Entries of lists whose lights are not in this set.
  static std::uint64_t entries_beside(const assign::Lists& lists, const std::vector<bool>& is_in);

  PreCullCounts counts_;
  // per light of the last frame; undropped: not in view, or not removed by a limit
  std::vector<bool> is_kept_, is_undropped_;
  std::vector<bool> is_ever_dropped_;
  int frames_ = 0;
  Sum kept_, removed_, distant_;
  std::vector<Sum> steps_;
};

}  // namespace clusterbench::run
