#include <algorithm>

#include "core/error.h"
#include "core/text.h"
#include "layout/decode.h"

namespace clusterbench::layout {
namespace {

using result::DumpLists;

// A change of a description; false where it does not apply.
struct Change {
  std::string text;  // "entries as u16"
  bool (*make)(DumpLists& lists, const std::string& value);
  std::string value = {};
};

bool set_entry_type(DumpLists& lists, const std::string& type) {
  if (!lists.entries || lists.entries->type == type) return false;
  lists.entries->type = type;
  lists.entries->stride.reset();
  return true;
}

bool change_first_light(DumpLists& lists, const std::string&) {
  if (!lists.entries) return false;
  lists.entries->first_light = lists.entries->first_light.value_or(0) == 0 ? 1 : 0;
  return true;
}

bool change_offset_unit(DumpLists& lists, const std::string&) {
  if (!lists.offset) return false;
  lists.offset_is = lists.offset_is.value_or("entries") == "entries" ? "bytes" : "entries";
  return true;
}

bool swap_offset_and_count(DumpLists& lists, const std::string&) {
  if (!lists.offset || !lists.counts || lists.counts->size() != 1) return false;
  std::swap(*lists.offset, lists.counts->front());
  return true;
}

bool set_count_type(DumpLists& lists, const std::string& type) {
  if (!lists.counts) return false;
  for (result::DumpField& count : *lists.counts) count.type = type;
  return true;
}

bool change_last(DumpLists& lists, const std::string&) {
  if (!lists.ranges) return false;
  lists.ranges->last_is = lists.ranges->last_is.value_or("last") == "last" ? "end" : "last";
  return true;
}

bool swap_first_and_last(DumpLists& lists, const std::string&) {
  if (!lists.ranges) return false;
  std::swap(lists.ranges->first, lists.ranges->last);
  return true;
}

bool move_entries(DumpLists& lists, const std::string& value) {
  if (!lists.entries) return false;
  lists.entries->at = lists.entries->at.value_or(0) + std::stoull(value);
  return true;
}

// In the order in which they are believed.
std::vector<Change> changes() {
  std::vector<Change> all;
  for (const char* type : {"u16", "u8", "u32", "f32"})
    all.push_back({std::string("entries as ") + type, set_entry_type, type});
  all.push_back({"indices that count from 1 (entries.first_light)", change_first_light});
  all.push_back({"the other unit of offsets (offset_is)", change_offset_unit});
  all.push_back({"offset and count swapped", swap_offset_and_count});
  for (const char* type : {"u16", "u8", "u32"}) all.push_back({std::string("counts as ") + type, set_count_type, type});
  all.push_back({"the other meaning of the end of a range (ranges.last_is)", change_last});
  all.push_back({"first and last of ranges swapped", swap_first_and_last});
  for (const char* bytes : {"4", "8", "16"})
    all.push_back({std::string("entries ") + bytes + " bytes later (entries.at)", move_entries, bytes});
  return all;
}

}  // namespace

std::optional<std::string> likely_reading(std::span<const ListPart> parts, std::span<const Buffer> buffers,
                                          const Shape& shape) {
  for (const Change& change : changes()) {
    std::vector<ListPart> changed(parts.begin(), parts.end());
    bool applies = false;
    for (ListPart& part : changed) applies |= change.make(part.lists, change.value);
    if (!applies) continue;
    try {
      const Decoded decoded = decode(changed, buffers, shape);
      if (decoded.faults.count == 0 && decoded.lists.pair_count() > 0)
        return "with " + change.text + " all " + std::to_string(decoded.lists.pair_count()) + " indices are below " +
               std::to_string(shape.lights);
    } catch (const Error&) {  // NOLINT(bugprone-empty-catch): this description does not fit the buffers
    }
  }
  return std::nullopt;
}

}  // namespace clusterbench::layout
