#include "dump/list_keys.h"

#include <algorithm>
#include <vector>

#include "core/error.h"
#include "core/text.h"

namespace clusterbench::dump {
namespace {

// A key that stands in some lists, and the layouts that read it.
struct ListKey {
  const char* name;
  bool is_given;
  std::vector<std::string> layouts;
};

const std::vector<std::string> k_of_rows = {"packed", "fixed", "runs", "bits", "bits_and_bins", "bits_and_slice_ranges",
                                            "linked"};
const std::vector<std::string> k_of_entries = {"packed", "fixed", "runs"}, k_of_offsets = {"packed", "runs"},
                               k_of_bits = {"bits", "bits_and_bins", "bits_and_slice_ranges"},
                               k_of_ranges = {"bits_and_bins", "bits_and_slice_ranges"},
                               k_of_cells = {"packed", "fixed", "runs", "bits", "linked", "inline"};

std::vector<ListKey> keys_of(const result::DumpLists& lists) {
  const auto& entries = lists.entries;
  const auto& ranges = lists.ranges;
  return {{"per_tile", lists.per_tile.has_value(), k_of_cells},
          {"rows", lists.rows.has_value(), k_of_rows},
          {"offset", lists.offset.has_value(), k_of_offsets},
          {"offset_is", lists.offset_is.has_value(), k_of_offsets},
          {"counts", lists.counts.has_value(), k_of_entries},
          {"end", lists.end.has_value(), k_of_offsets},
          {"entries", entries.has_value(), k_of_entries},
          {"entries/end", entries && entries->end, {"fixed"}},
          {"per_cell", lists.per_cell.has_value(), {"fixed"}},
          {"word", lists.word.has_value(), k_of_bits},
          {"first_bit", lists.first_bit.has_value(), k_of_bits},
          {"ranges", ranges.has_value(), k_of_ranges},
          {"ranges/tile_stride", ranges && ranges->tile_stride, {"bits_and_slice_ranges"}},
          {"ranges/words_at", ranges && ranges->words_at, {"bits_and_bins"}},
          {"head", lists.head.has_value(), {"linked"}},
          {"nodes", lists.nodes.has_value(), {"linked"}},
          {"cells", lists.cells.has_value(), {"inline"}}};
}

}  // namespace

void check_list_keys(const result::DumpLists& lists, const std::string& pointer) {
  for (const ListKey& key : keys_of(lists))
    if (key.is_given && std::ranges::find(key.layouts, lists.layout) == key.layouts.end())
      throw Error("", pointer + "/" + key.name,
                  "has no meaning with layout '" + lists.layout + "'; it is of " + joined(key.layouts));
  if (lists.layout == "fixed" && lists.rows && lists.entries && lists.entries->buffer && !lists.counts)
    throw Error("", pointer + "/rows",
                "has no meaning where entries have a buffer of their own and there are no counts; allowed: one of "
                "rows and entries.buffer, or counts in the rows");
}

}  // namespace clusterbench::dump
