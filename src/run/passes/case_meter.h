#pragma once
// A case over the frames of the counting pass: its structure's buffers, and its lights at samples.

#include <memory>
#include <optional>
#include <span>

#include "assign/contract/mapped_structure.h"
#include "assign/contract/storage.h"
#include "run/passes/accuracy_pass.h"
#include "run/passes/method_meter.h"
#include "run/passes/prepared_frame.h"

namespace clusterbench::run {

// One light structure.
class StructureMeter {
 public:
  explicit StructureMeter(const config::Config& config);

  void add(int frame, const assign::LightStructure& made, const MethodMeter& method);
  // `lists`: of the cells; null without cells.
  void add(int frame, const assign::LightStructure& structure, const assign::Lists* lists, std::size_t scratch_bytes);
  void add_lookup(const measure::LookupFrame& lookup) { lookup.add(*structure_, measures_.lookup); }
  // Evaluates some samples of a set with the lights that they need.
  void add_samples(std::size_t set, int frame, std::span<const grid::Sample> samples,
                   const measure::NeededLights& needed) {
    measure::add_samples(measures_.samples[set].counts, frame, samples, needed, *structure_);
  }
  void add_waves(std::size_t set, const FrameSampleSet& samples);

  StructureMeasures result() const;

 private:
  std::optional<assign::MappedStructure> mapped_;      // behind a pre-cull: of the current frame
  const assign::LightStructure* structure_ = nullptr;  // of the current frame
  measure::BufferMeter buffers_;
  StructureMeasures measures_;
};

class CaseMeter {
 public:
  CaseMeter(const config::Config& config, const CasePlan& plan);

  void add(const PreparedFrame& now, const MethodMeter& method);
  // The same with a copy of the lists, without the method.
  void add(const PreparedFrame& now, const ListsOfFrame& lists);
  // Samples of `set` in `part` (part_of()), whose needed lights are known.
  void add_samples(const PreparedFrame& now, std::size_t set, std::size_t part, const measure::NeededLights& needed);
  // Waves are made of neighbouring pixels.
  void add_waves(const PreparedFrame& now, std::size_t set);
  // Samples and waves of all sets, of a frame that has their needed lights.
  void add_known_samples(const PreparedFrame& now, const Stop& stop);

  const Method& method() const { return method_; }
  StructureMeasures result() const;

 private:
  void add(const PreparedFrame& now, const ListsOfFrame& lists, assign::Storage& storage, StructureMeter& meter) const;

  Method method_;
  bool evaluates_lookup_;                     // whose samples are anywhere in the view
  bool reads_cells_;                          // false: sizes alone
  std::unique_ptr<assign::Storage> storage_;  // none: the method's own structure
  StructureMeter meter_;
  // For comparison with a storage that can run out of room.
  std::unique_ptr<assign::Storage> roomy_storage_;
  std::optional<StructureMeter> roomy_meter_;
};

}  // namespace clusterbench::run
