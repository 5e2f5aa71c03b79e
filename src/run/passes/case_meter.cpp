#include "run/passes/case_meter.h"

namespace clusterbench::run {

StructureMeter::StructureMeter(const config::Config& config) : buffers_(config.allocation) {
  for (const config::SampleSetRequest& request : config.sample_sets) measures_.samples.push_back({request.set, {}, {}});
}

void StructureMeter::add(int frame, const assign::LightStructure& made, const MethodMeter& method) {
  mapped_ = method.run().mapped(made);
  add(frame, mapped_ ? static_cast<const assign::LightStructure&>(*mapped_) : made, method.cell_lists(),
      method.run().scratch_bytes());
}

void StructureMeter::add(int frame, const assign::LightStructure& structure, const assign::Lists* lists,
                         std::size_t scratch_bytes) {
  buffers_.add_frame(frame, structure, lists, scratch_bytes);
  structure_ = &structure;
}

void StructureMeter::add_waves(std::size_t set, const FrameSampleSet& samples) {
  std::optional<measure::Coherence>& coherence = measures_.samples[set].coherence;
  if (!coherence) coherence.emplace();
  measure::add_frame(*coherence, *samples.picture, samples.samples, *structure_);
}

StructureMeasures StructureMeter::result() const {
  StructureMeasures out = measures_;
  out.buffers = buffers_.result();
  return out;
}

CaseMeter::CaseMeter(const config::Config& config, const CasePlan& plan)
    : method_(plan.method()),
      evaluates_lookup_(config.lookup && !assign::find_assigner(config.assigners[plan.assigner].name)->at_surfaces),
      reads_cells_(evaluates_lookup_ || !config.sample_sets.empty()),
      meter_(config) {
  if (!plan.storage) return;
  const config::MethodRequest& request = config.storages[*plan.storage];
  const assign::StorageDescriptor& descriptor = *assign::find_storage(request.name);
  storage_ = descriptor.make(request.params);
  const std::optional<assign::Params> roomy = assign::without_fallback(descriptor, request.params);
  if (!roomy) return;
  roomy_storage_ = descriptor.make(*roomy);
  roomy_meter_.emplace(config);
}

void CaseMeter::add(const PreparedFrame& now, const MethodMeter& method) {
  for (assign::Storage* storage : {storage_.get(), roomy_storage_.get()}) {
    if (storage == nullptr) continue;
    if (now.is_new_grid) storage->start(*now.grid, method.light_room(now.frame));
    if (reads_cells_)
      method.run().store(*storage);
    else
      method.run().count(*storage);
  }
  const assign::LightStructure& structure = storage_ ? *storage_ : *method.run().own_structure();
  meter_.add(now.frame.index, structure, method);
  if (roomy_storage_) roomy_meter_->add(now.frame.index, *roomy_storage_, method);
  if (now.lookup && evaluates_lookup_ && !structure.has_occupied_cells()) meter_.add_lookup(*now.lookup);
}

void CaseMeter::add(const PreparedFrame& now, const ListsOfFrame& lists) {
  add(now, lists, *storage_, meter_);
  if (roomy_storage_) add(now, lists, *roomy_storage_, *roomy_meter_);
  if (now.lookup && evaluates_lookup_) meter_.add_lookup(*now.lookup);
}

void CaseMeter::add(const PreparedFrame& now, const ListsOfFrame& lists, assign::Storage& storage,
                    StructureMeter& meter) const {
  if (now.is_new_grid) storage.start(*now.grid, now.frame.ranges());
  if (reads_cells_)
    storage.store(lists.filled);
  else
    storage.count(lists.filled);
  meter.add(now.frame.index, storage, &lists.cells(), lists.scratch_bytes);
}

void CaseMeter::add_samples(const PreparedFrame& now, std::size_t set, std::size_t part,
                            const measure::NeededLights& needed) {
  const std::span<const grid::Sample> samples = part_of(now.samples[set].samples, part);
  meter_.add_samples(set, now.frame.index, samples, needed);
  if (roomy_meter_) roomy_meter_->add_samples(set, now.frame.index, samples, needed);
}

void CaseMeter::add_waves(const PreparedFrame& now, std::size_t set) {
  const std::optional<depth::DepthImage>& picture = now.samples[set].picture;
  if (picture && picture->pixels.is_full_resolution()) meter_.add_waves(set, now.samples[set]);
}

void CaseMeter::add_known_samples(const PreparedFrame& now, const Stop& stop) {
  for (std::size_t set = 0; set < now.needed.size() && !stop; ++set) {
    for (std::size_t part = 0; part < now.needed[set].size() && !stop; ++part)
      add_samples(now, set, part, now.needed[set][part]);
    add_waves(now, set);
  }
}

StructureMeasures CaseMeter::result() const {
  StructureMeasures out = meter_.result();
  if (roomy_meter_) out.roomy = std::make_shared<StructureMeasures>(roomy_meter_->result());
  return out;
}

}  // namespace clusterbench::run
