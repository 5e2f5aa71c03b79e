#include "report/sizing/sized_structure.h"

#include <set>

#include "core/text.h"
#include "report/sizing/counts.h"

namespace clusterbench::report {

std::vector<FrameCameras> cameras_by_frame(const SizedStructure& structure) {
  std::vector<FrameCameras> out;
  const auto cases_of = [&](const std::string& camera) {
    std::vector<const result::Case*> cases;
    for (const result::Case* result_case : structure.cases)
      if (result_case->camera == camera) cases.push_back(result_case);
    return cases;
  };
  std::set<std::string> taken(structure.guests.begin(), structure.guests.end());
  for (const std::vector<std::string>& view : structure.views) {
    out.emplace_back();
    for (const std::string& camera : view) {
      out.back().push_back(cases_of(camera));
      taken.insert(camera);
    }
  }
  for (const result::Case* result_case : structure.cases)
    if (taken.insert(result_case->camera).second) out.push_back({cases_of(result_case->camera)});
  return out;
}

std::uint64_t frames_of_group(const FrameCameras& cameras) {
  std::uint64_t most = 0;
  for (const std::vector<const result::Case*>& of_camera : cameras) most = std::max(most, of_camera.front()->frames);
  return most;
}

std::uint64_t SizedStructure::frames() const {
  std::uint64_t all = 0;
  for (const FrameCameras& cameras : cameras_by_frame(*this)) all += frames_of_group(cameras);
  return all;
}

std::uint64_t SizedStructure::frames_of(const SizedBuffer& buffer) const {
  const auto made_mark = [&](const FrameGroup& needs) { return joined(needs.cameras, "+") == buffer.worst_camera; };
  const auto found = std::ranges::find_if(buffer.groups, made_mark);
  return found == buffer.groups.end() ? frames() : found->frames;
}

const FoundFrame* SizedStructure::search_for(const std::string& measure) const {
  const FoundFrame* best = nullptr;
  for (const FoundFrame& found : searches) {
    if (found.measure != measure) continue;
    const bool is_better = best == nullptr || (found.refusal.empty() && !best->refusal.empty()) ||
                           (found.refusal.empty() && found.value > best->value);
    if (is_better) best = &found;
  }
  return best;
}

const FoundFrame* SizedStructure::main_search() const {
  const auto buffer = std::ranges::find_if(buffers, [](const SizedBuffer& one) { return one.found.has_value(); });
  if (buffer != buffers.end()) return &searches[buffer->found_by];
  return searches.empty() ? nullptr : &searches.front();
}

std::string SizedStructure::camera_of(const FoundFrame& found) const {
  for (const result::Case* result_case : cases)
    if (result_case->name == found.case_name) return result_case->camera;
  return "";
}

std::size_t SizedStructure::searched_cameras() const {
  std::set<std::string> cameras;
  for (const FoundFrame& found : searches)
    if (found.refusal.empty()) cameras.insert(camera_of(found));
  return cameras.size();
}

bool SizedStructure::is_searched() const {
  return std::ranges::any_of(searches, [](const FoundFrame& found) { return found.refusal.empty(); });
}

std::string SizedStructure::sought_measure() const {
  return measure_of_buffers(cases.front()->storage);
}

bool SizedStructure::is_sought() const {
  return std::ranges::find(searches, sought_measure(), &FoundFrame::measure) != searches.end();
}

std::string measure_of_buffers(const std::string& storage) {
  return storage.starts_with("fixed") ? "longest" : "entries";
}

std::uint64_t SizedBuffer::double_buffered_bytes() const {
  return product_of_counts(2, bytes);
}

std::uint64_t SizedStructure::bytes() const {
  std::uint64_t sum = 0;
  for (const SizedBuffer& buffer : buffers) sum = sum_of_counts(sum, buffer.bytes);
  return sum;
}

}  // namespace clusterbench::report
