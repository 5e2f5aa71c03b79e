#include "report/sizing/searched_needs.h"

#include <algorithm>

#include "report/sizing/counts.h"

namespace clusterbench::report {
namespace {

// The findings of the searches with one camera, for a buffer.
struct CameraFind {
  std::string camera;
  std::uint64_t elements = 0, most = 0, step = 1;
  std::size_t search = 0;

  std::uint64_t steps() const { return elements / step; }
};

// If the buffer has the same room in each cell: the number of cells of the searched case; else 1.
std::uint64_t step_of(const FoundFrame& search, const std::string& buffer, const SizedStructure& structure) {
  for (const result::Case* result_case : structure.cases) {
    if (result_case->name != search.case_name) continue;
    for (const CaseBuffer& needs : buffers_of(*result_case))
      if (needs.name == buffer) return std::max<std::uint64_t>(needs.step, 1);
  }
  return 1;
}

// The largest finding of each camera, in the order of the searches.
std::vector<CameraFind> finds_of(SizedBuffer& buffer, const SizedStructure& structure) {
  std::vector<CameraFind> finds;
  for (std::size_t search = 0; search < structure.searches.size(); ++search)
    for (const FoundFrame::Need& need : structure.searches[search].needs) {
      if (need.name != buffer.name) continue;
      const std::string camera = structure.camera_of(structure.searches[search]);
      buffer.element_bytes = std::max(buffer.element_bytes, need.element_bytes);
      auto known = std::ranges::find(finds, camera, &CameraFind::camera);
      if (known == finds.end())
        known = finds.insert(known, {camera, need.elements, need.most,
                                     step_of(structure.searches[search], buffer.name, structure), search});
      if (need.elements > known->elements) known->elements = need.elements, known->search = search;
      known->most = std::max(known->most, need.most);
    }
  return finds;
}

// Cameras drawn in one frame can all be at their own worst places at the same time; one that was not searched counts as
// the worst of the others. If all cells have the same room, it is that of the longest list of all.
void add_finds(SizedBuffer& buffer, const std::vector<CameraFind>& finds, const std::vector<std::string>& cameras) {
  const auto is_of_group = [&](const CameraFind& find) {
    return std::ranges::find(cameras, find.camera) != cameras.end();
  };
  const CameraFind* worst = nullptr;
  std::uint64_t elements = 0, cells = 0, most = 0, searched = 0;
  for (const CameraFind& find : finds) {
    if (!is_of_group(find)) continue;
    if (worst == nullptr || find.steps() > worst->steps()) worst = &find;
    elements += find.elements;
    cells += find.step;
    most = std::max(most, find.most);
    ++searched;
  }
  if (worst == nullptr) return;
  const std::uint64_t others = cameras.size() - searched;
  elements = worst->step > 1 ? product_of_counts(worst->steps(), cells + product_of_counts(worst->step, others))
                             : elements + product_of_counts(worst->elements, others);
  buffer.theoretical_max = std::max(buffer.theoretical_max, product_of_counts(most, cameras.size()));
  if (buffer.found && elements <= *buffer.found) return;
  buffer.found = elements;
  buffer.found_by = worst->search;
  buffer.found_views = cameras.size();
}

}  // namespace

void add_searches(SizedStructure& structure) {
  for (SizedBuffer& buffer : structure.buffers) {
    const std::vector<CameraFind> finds = finds_of(buffer, structure);
    std::vector<std::vector<std::string>> groups = structure.views;
    for (const CameraFind& find : finds)
      if (std::ranges::none_of(structure.views, [&](const std::vector<std::string>& view) {
            return std::ranges::find(view, find.camera) != view.end();
          }))
        groups.push_back({find.camera});
    for (const std::vector<std::string>& group : groups) add_finds(buffer, finds, group);
  }
}

}  // namespace clusterbench::report
