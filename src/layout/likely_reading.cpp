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

bool count_from_one(DumpLists& lists, const std::string&) {
  if (!lists.entries || lists.entries->first_light.value_or(0) > 0) return false;
  lists.entries->first_light = 1;
  return true;
}

bool count_from_zero(DumpLists& lists, const std::string&) {
  if (!lists.entries || lists.entries->first_light.value_or(0) == 0) return false;
  lists.entries->first_light.reset();
  return true;
}

bool lower_first_light(DumpLists& lists, const std::string&) {
  if (!lists.entries || lists.entries->first_light.value_or(0) < 2) return false;
  --*lists.entries->first_light;
  return true;
}

bool raise_first_light(DumpLists& lists, const std::string&) {
  if (!lists.entries || lists.entries->first_light.value_or(0) == 0) return false;
  ++*lists.entries->first_light;
  return true;
}

bool change_offset_unit(DumpLists& lists, const std::string&) {
  if (!lists.offset) return false;
  lists.offset_is = lists.offset_is.value_or("entries") == "entries" ? "bytes" : "entries";
  return true;
}

bool swap_offset_and_count(DumpLists& lists, const std::string&) {
  if (!lists.offset || !lists.counts || lists.counts->empty()) return false;
  std::swap(*lists.offset, lists.counts->front());
  return true;
}

bool set_offset_type(DumpLists& lists, const std::string& type) {
  if (!lists.offset || lists.offset->type == type) return false;
  lists.offset->type = type;
  return true;
}

bool set_end_type(DumpLists& lists, const std::string& type) {
  if (!lists.end || lists.end->type == type) return false;
  lists.end->type = type;
  return true;
}

bool set_offset_and_end_type(DumpLists& lists, const std::string& type) {
  return lists.end && set_offset_type(lists, type) && set_end_type(lists, type);
}

bool swap_offset_and_end(DumpLists& lists, const std::string&) {
  if (!lists.offset || !lists.end) return false;
  std::swap(*lists.offset, *lists.end);
  return true;
}

// Where the description says that a row has a count, which is an end, and the other way round.
bool take_count_for_end(DumpLists& lists, const std::string&) {
  if (!lists.offset || !lists.counts || lists.counts->size() != 1) return false;
  lists.end = lists.counts->front();
  lists.counts.reset();
  return true;
}

bool take_end_for_count(DumpLists& lists, const std::string&) {
  if (!lists.end || lists.counts) return false;
  lists.counts = {*lists.end};
  lists.end.reset();
  return true;
}

bool set_count_type(DumpLists& lists, const std::string& type) {
  if (!lists.counts) return false;
  bool is_other = false;
  for (result::DumpField& count : *lists.counts) {
    is_other |= count.type != type;
    count.type = type;
  }
  return is_other;
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

// By its distance to the one before; false where there is no room.
bool move_earlier(std::optional<std::uint64_t>& at, std::uint64_t stride) {
  if (stride == 0 || at.value_or(0) < stride) return false;
  *at -= stride;
  return true;
}

bool move_entries_earlier(DumpLists& lists, const std::string&) {
  if (!lists.entries) return false;
  const std::uint64_t size = size_of(number_type(lists.entries->type)) * (lists.layout == "runs" ? 2 : 1);
  return move_earlier(lists.entries->at, lists.entries->stride.value_or(size));
}

bool move_rows_earlier(DumpLists& lists, const std::string&) {
  return lists.rows && move_earlier(lists.rows->at, lists.rows->stride);
}

bool move_words_earlier(DumpLists& lists, const std::string&) {
  return lists.rows && lists.layout.starts_with("bits") &&
         move_earlier(lists.rows->at, size_of(number_type(lists.word.value_or("u32"))));
}

// In the order in which they are believed.
std::vector<Change> changes() {
  std::vector<Change> all;
  all.push_back({"indices that count from 1 (entries.first_light)", count_from_one});
  all.push_back({"indices that count from 0 (entries.first_light)", count_from_zero});
  all.push_back({"an index of the first light that is one lower (entries.first_light)", lower_first_light});
  all.push_back({"an index of the first light that is one higher (entries.first_light)", raise_first_light});
  for (const char* type : {"u16", "u8", "u32", "f32"})
    all.push_back({std::string("entries as ") + type, set_entry_type, type});
  all.push_back({"the other unit of offsets (offset_is)", change_offset_unit});
  all.push_back({"offset and (first) count swapped", swap_offset_and_count});
  all.push_back({"offset and end swapped", swap_offset_and_end});
  all.push_back({"the count as the end of the list (end)", take_count_for_end});
  all.push_back({"the end as a count of entries (counts)", take_end_for_count});
  for (const char* type : {"u16", "u8", "u32"}) all.push_back({std::string("counts as ") + type, set_count_type, type});
  for (const char* type : {"u32", "u16", "u8"}) all.push_back({std::string("ends as ") + type, set_end_type, type});
  for (const char* type : {"u32", "u16"}) {
    all.push_back({std::string("offsets as ") + type, set_offset_type, type});
    all.push_back({std::string("offsets and ends as ") + type, set_offset_and_end_type, type});
  }
  all.push_back({"the other meaning of the end of a range (ranges.last_is)", change_last});
  all.push_back({"first and last of ranges swapped", swap_first_and_last});
  for (const char* bytes : {"4", "8", "16"})
    all.push_back({std::string("entries ") + bytes + " bytes later (entries.at)", move_entries, bytes});
  all.push_back({"entries one earlier (entries.at)", move_entries_earlier});
  all.push_back({"rows one earlier (rows.at)", move_rows_earlier});
  all.push_back({"words of bits one earlier (rows.at)", move_words_earlier});
  return all;
}

}  // namespace

std::vector<OtherDescription> other_descriptions(std::span<const ListPart> parts) {
  std::vector<OtherDescription> out;
  for (const Change& change : changes()) {
    std::vector<ListPart> changed(parts.begin(), parts.end());
    bool applies = false;
    for (ListPart& part : changed) applies |= change.make(part.lists, change.value);
    if (applies) out.push_back({change.text, std::move(changed)});
  }
  return out;
}

std::optional<std::string> likely_reading(std::span<const ListPart> parts, std::span<const Buffer> buffers,
                                          const Shape& shape) {
  // What is right in the given lists counts, too: a reading that leaves a small part of all that is no explanation.
  std::size_t most = decode(parts, buffers, shape).lists.pair_count();
  struct Fitting {
    std::string change;
    std::size_t indices;
  };
  std::vector<Fitting> fitting;
  for (const OtherDescription& other : other_descriptions(parts)) {
    try {
      const Decoded decoded = decode(other.parts, buffers, shape);
      const std::size_t indices = decoded.lists.pair_count();
      if (decoded.faults.count > 0 || decoded.faults.twice > 0 || indices == 0) continue;
      most = std::max(most, indices);
      fitting.push_back({other.change, indices});
    } catch (const Error&) {  // NOLINT(bugprone-empty-catch): this description does not fit the buffers
    }
  }
  const auto found = std::ranges::find_if(fitting, [most](const Fitting& one) { return one.indices >= most / 2; });
  if (found == fitting.end()) return std::nullopt;
  return "with " + found->change + " all " + std::to_string(found->indices) + " indices are below " +
         std::to_string(shape.lights);
}

}  // namespace clusterbench::layout
