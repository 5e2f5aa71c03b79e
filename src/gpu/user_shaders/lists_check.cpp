#include "gpu/user_shaders/lists_check.h"

#include "core/error.h"
#include "core/text.h"
#include "layout/buffers.h"

namespace clusterbench::gpu {
namespace {

using result::Json;

// A whole number of an object; nullopt where it is missing or a formula.
std::optional<std::uint64_t> number_at(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number_unsigned()) return std::nullopt;
  return found->get<std::uint64_t>();
}
// 0 where it is missing, nullopt where it is a formula.
std::optional<std::uint64_t> number_or_zero(const Json& object, const char* key) {
  return object.contains(key) ? number_at(object, key) : 0;
}
std::uint64_t size_of_number(const Json& object) {
  return layout::size_of(layout::number_type(object["type"].get<std::string>()));
}

class ListPartCheck {
 public:
  ListPartCheck(const Json& part, const result::DumpLists& lists, const BytesOfBuffer& bytes_of,
                const std::string& where)
      : part_(part), lists_(lists), bytes_of_(bytes_of), where_(where) {}

  void check() const {
    check_needs();
    if (lists_.rows) check_rows("rows");
    if (lists_.ranges) check_rows("ranges");
    if (lists_.nodes) check_rows("nodes");
    for (const char* key : {"offset", "head"})
      if (part_.contains(key)) check_field(part_[key], stride_of("rows"), where_ + "/" + key);
    if (lists_.end) check_end(part_["end"]);
    if (lists_.counts)
      for (std::size_t i = 0; i < part_["counts"].size(); ++i)
        check_field(part_["counts"][i], stride_of("rows"), where_ + "/counts/" + std::to_string(i));
    for (const char* key : {"first", "last"})
      if (lists_.ranges) check_field(part_["ranges"][key], stride_of("ranges"), where_ + "/ranges/" + key);
    for (const char* key : {"light", "next"})
      if (lists_.nodes) check_field(part_["nodes"][key], stride_of("nodes"), where_ + "/nodes/" + key);
    if (lists_.entries) check_entries();
  }

 private:
  [[noreturn]] void refuse(const std::string& key, const std::string& problem) const {
    throw Error("", where_ + key, problem);
  }
  void need(bool is_there, const char* key) const {
    if (!is_there) refuse(std::string("/") + key, "is missing: layout '" + lists_.layout + "' needs it");
  }

  void check_needs() const {
    const std::string& layout = lists_.layout;
    if (layout == "packed" || layout == "runs") {
      need(lists_.rows.has_value(), "rows");
      need(lists_.offset.has_value(), "offset");
      if (!lists_.counts && !lists_.end)
        refuse("", "has neither counts nor end, and layout '" + layout + "' needs one of them");
      if (lists_.counts && lists_.end) refuse("/end", "does not go with counts: either says how long a list is");
      need(lists_.entries.has_value(), "entries");
      need(lists_.entries->buffer.has_value(), "entries/buffer");
    } else if (layout == "fixed") {
      need(lists_.per_cell.has_value(), "per_cell");
      need(lists_.entries.has_value(), "entries");
      if (!lists_.counts && !lists_.entries->end)
        refuse("", "layout 'fixed' needs counts or entries.end, to know where a list ends");
      need(lists_.rows || (!lists_.counts && lists_.entries->buffer), "rows");
    } else if (layout == "linked") {
      need(lists_.rows.has_value(), "rows");
      need(lists_.head.has_value(), "head");
      need(lists_.nodes.has_value(), "nodes");
    } else {
      need(lists_.rows.has_value(), "rows");
      if (layout != "bits") need(lists_.ranges.has_value(), "ranges");
      if (layout == "bits_and_slice_ranges") need(lists_.ranges->tile_stride.has_value(), "ranges/tile_stride");
    }
  }

  std::optional<std::uint64_t> stride_of(const char* rows) const {
    return part_.contains(rows) ? number_at(part_[rows], "stride") : std::nullopt;
  }
  void check_rows(const char* key) const {
    if (stride_of(key) == 0u) refuse(std::string("/") + key + "/stride", "is 0; allowed: at least 1");
    check_begin(part_[key], part_[key]["buffer"].get<std::string>(), std::string("/") + key + "/at");
  }
  // Rows that begin within their buffer.
  void check_begin(const Json& rows, const std::string& buffer, const std::string& key) const {
    const std::optional<std::uint64_t> at = number_or_zero(rows, "at"), bytes = bytes_of_(buffer);
    if (!at || !bytes || *at < *bytes) return;
    refuse(key, "is " + std::to_string(*at) + "; buffer '" + buffer + "' has " + number_of(*bytes, "byte"));
  }

  // It may lie in the next cell's row.
  void check_end(const Json& end) const {
    if (end == part_["offset"]) refuse("/end", "is the field that `offset` is: all lists would be empty");
    const std::optional<std::uint64_t> at = number_at(end, "at"), stride = stride_of("rows");
    const std::uint64_t size = size_of_number(end);
    if (at && stride && *at > *stride && (*at - *stride > *stride || size > *stride - (*at - *stride)))
      refuse("/end/at", "is " + std::to_string(*at) + ": its " + number_of(size, "byte") +
                            " end beyond the next row; rows are " + number_of(*stride, "byte") + " apart");
    if (end.contains("bits")) check_bits(end, 8 * size, where_ + "/end");
  }

  static void check_field(const Json& field, std::optional<std::uint64_t> stride, const std::string& where) {
    const std::uint64_t size = size_of_number(field);
    const std::optional<std::uint64_t> at = number_at(field, "at");
    if (at && stride && (*at > *stride || size > *stride - *at))
      throw Error("", where + "/at",
                  "is " + std::to_string(*at) + ": its " + number_of(size, "byte") + " end beyond the stride of " +
                      number_of(*stride, "byte"));
    if (field.contains("bits")) check_bits(field, 8 * size, where);
  }
  static void check_bits(const Json& field, std::uint64_t width, const std::string& where) {
    const auto type = field["type"].get<std::string>();
    const Json &first = field["bits"][0], &count = field["bits"][1];
    const bool is_known = first.is_number_unsigned() && count.is_number_unsigned();
    const bool fits = !is_known || (first.get<std::uint64_t>() < width && count.get<std::uint64_t>() >= 1 &&
                                    count.get<std::uint64_t>() <= width - first.get<std::uint64_t>());
    if (fits && type.front() != 'f') return;
    throw Error("", where + "/bits",
                "is " + field["bits"].dump() + "; " + layout::bits_allowed(layout::number_type(type)));
  }

  void check_entries() const {
    const Json& entries = part_["entries"];
    if (lists_.entries->buffer) return check_begin(entries, *lists_.entries->buffer, "/entries/at");
    if (lists_.layout != "fixed") return;
    const std::uint64_t size = size_of_number(entries);
    const std::optional<std::uint64_t> at = number_or_zero(entries, "at"), stride = stride_of("rows"),
                                       step = entries.contains("stride") ? number_at(entries, "stride") : size,
                                       count = number_at(part_, "per_cell");
    if (!at || !stride || !step || !count) return;
    if (*at <= *stride && size <= *stride - *at && (*count - 1) <= (*stride - *at - size) / *step) return;
    refuse("/entries/at", "is " + std::to_string(*at) + ": " + std::to_string(*count) +
                              " entries there end beyond the stride of " + number_of(*stride, "byte"));
  }

  const Json& part_;
  const result::DumpLists& lists_;
  const BytesOfBuffer& bytes_of_;
  const std::string& where_;
};

}  // namespace

void check_list_part(const Json& part, const result::DumpLists& lists, const BytesOfBuffer& bytes_of,
                     const std::string& where) {
  ListPartCheck(part, lists, bytes_of, where).check();
}

}  // namespace clusterbench::gpu
