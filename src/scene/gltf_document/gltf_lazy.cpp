#include "scene/gltf_document/gltf_lazy.h"

#include <algorithm>
#include <fstream>

#include "core/json_document.h"

namespace clusterbench::scene {
namespace {

using nlohmann::json;

constexpr std::size_t k_window_bytes = std::size_t{1} << 20;
constexpr const char* k_blank = " \t\r\n";

// Members and elements of JSON text by their positions, without checking their contents.
class Walker {
 public:
  explicit Walker(std::string_view text) : text_(text) {}

  std::size_t skip_blank(std::size_t at) const { return std::min(text_.find_first_not_of(k_blank, at), text_.size()); }
  bool is(std::size_t at, char c) const { return at < text_.size() && text_[at] == c; }

  // The position after the value that begins here; npos if it has no end.
  std::size_t end_of_value(std::size_t at) const {
    if (at >= text_.size()) return std::string_view::npos;
    if (text_[at] == '"') return end_of_string(at);
    if (text_[at] != '{' && text_[at] != '[') return std::min(text_.find_first_of(",]} \t\r\n", at), text_.size());
    for (std::size_t depth = 0; at < text_.size(); ++at) {
      const char c = text_[at];
      if (c == '"') {
        at = end_of_string(at);
        if (at == std::string_view::npos) return at;
        --at;
      } else if (c == '{' || c == '[') {
        ++depth;
      } else if ((c == '}' || c == ']') && --depth == 0) {
        return at + 1;
      }
    }
    return std::string_view::npos;
  }

  // Calls `use(key, begin, end)` for each member of the object at `at`; false if it is broken. A key with an escape
  // matches no searched key.
  template <class Use>
  bool members(std::size_t at, Use&& use) const {
    if (!is(at, '{')) return false;
    at = skip_blank(at + 1);
    if (is(at, '}')) return true;
    for (;; at = skip_blank(at + 1)) {
      if (!is(at, '"')) return false;
      const std::size_t key_end = end_of_string(at);
      if (key_end == std::string_view::npos) return false;
      const std::string_view key = text_.substr(at + 1, key_end - at - 2);
      if (key.find('\\') != std::string_view::npos) return false;
      at = skip_blank(key_end);
      if (!is(at, ':')) return false;
      const std::size_t begin = skip_blank(at + 1), end = end_of_value(begin);
      if (end == std::string_view::npos || end == begin || !use(key, begin, end)) return false;
      at = skip_blank(end);
      if (is(at, '}')) return true;
      if (!is(at, ',')) return false;
    }
  }

  // Calls `use(begin, end)` for each element of the array at `at`; false if it is broken.
  template <class Use>
  bool elements(std::size_t at, Use&& use) const {
    if (!is(at, '[')) return false;
    at = skip_blank(at + 1);
    if (is(at, ']')) return true;
    for (;; at = skip_blank(at + 1)) {
      const std::size_t end = end_of_value(at);
      if (end == std::string_view::npos || end == at || !use(at, end)) return false;
      at = skip_blank(end);
      if (is(at, ']')) return true;
      if (!is(at, ',')) return false;
    }
  }

 private:
  std::size_t end_of_string(std::size_t at) const {
    for (++at; at < text_.size(); ++at) {
      if (text_[at] == '\\')
        ++at;
      else if (text_[at] == '"')
        return at + 1;
    }
    return std::string_view::npos;
  }

  std::string_view text_;
};

// Reads JSON text without keeping its values, and finds keys that stand twice in an object, in any spelling.
class KeyCheck {
 public:
  bool is_json(std::string_view text) {
    count_ = 0;
    begins_.clear();
    may_repeat_a_key_ = false;
    return json::sax_parse(text, this);
  }
  // After is_json(). Also true for an object with more keys than are compared here.
  bool may_repeat_a_key() const { return may_repeat_a_key_; }

  bool null() { return true; }
  bool boolean(bool) { return true; }
  bool number_integer(json::number_integer_t) { return true; }
  bool number_unsigned(json::number_unsigned_t) { return true; }
  bool number_float(json::number_float_t, const json::string_t&) { return true; }
  bool string(const json::string_t&) { return true; }
  bool binary(const json::binary_t&) { return true; }
  bool start_object(std::size_t) {
    begins_.push_back(count_);
    return true;
  }
  bool key(const json::string_t& key) {
    constexpr std::size_t k_most_compared = 32;
    const std::size_t begin = begins_.back();
    if (count_ - begin >= k_most_compared) {
      may_repeat_a_key_ = true;
      return true;
    }
    for (std::size_t i = begin; i < count_; ++i) may_repeat_a_key_ |= keys_[i] == key;
    if (count_ == keys_.size()) keys_.emplace_back();
    keys_[count_++] = key;
    return true;
  }
  bool end_object() {
    count_ = begins_.back();
    begins_.pop_back();
    return true;
  }
  bool start_array(std::size_t) { return true; }
  bool end_array() { return true; }
  bool parse_error(std::size_t, const std::string&, const json::exception&) { return false; }

 private:
  std::vector<std::string> keys_;    // the first `count_`: of the open objects
  std::vector<std::size_t> begins_;  // of each of them
  std::size_t count_ = 0;
  bool may_repeat_a_key_ = false;
};

// Finds the long arrays, element by element.
class LazyReader {
 public:
  LazyReader(std::string_view text, std::uint64_t offset) : text_(text), offset_(offset), walker_(text) {}

  bool find_arrays() {
    const std::size_t begin = walker_.skip_blank(0);
    return walker_.members(begin, [&](std::string_view key, std::size_t at, std::size_t end) {
      if (key == "nodes") return add_array(nodes_, at, end);
      return key != "extensions" || find_lights(at);
    });
  }

  // The text without the removed elements.
  std::string rest() {
    std::sort(cuts_.begin(), cuts_.end());
    std::string rest;
    std::size_t kept = 0;
    for (const auto& [begin, end] : cuts_) {
      rest += text_.substr(kept, begin - kept);
      kept = end;
    }
    return rest + std::string(text_.substr(kept));
  }

  LazyArrays arrays(const std::string& file, const TextSource& source) {
    nodes_.shrink_to_fit();
    lights_.shrink_to_fit();
    // One window each: a node and its light are read in turn.
    return {LazyArray(std::move(nodes_), file, std::make_shared<TextSource>(source)),
            LazyArray(std::move(lights_), file, std::make_shared<TextSource>(source)), std::move(repeated_key_)};
  }

 private:
  bool find_lights(std::size_t extensions) {
    if (!walker_.is(extensions, '{')) return true;
    return walker_.members(extensions, [&](std::string_view key, std::size_t punctual, std::size_t) {
      if (key != "KHR_lights_punctual" || !walker_.is(punctual, '{')) return true;
      return walker_.members(punctual, [&](std::string_view member, std::size_t at, std::size_t end) {
        return member != "lights" || add_array(lights_, at, end);
      });
    });
  }

  // A duplicate key is left to the parser.
  bool add_array(std::vector<LazyArray::Range>& array, std::size_t begin, std::size_t end) {
    if (!walker_.is(begin, '[')) return true;
    if (!array.empty()) return false;
    cuts_.emplace_back(begin + 1, end - 1);
    return walker_.elements(begin, [&](std::size_t at, std::size_t element_end) {
      constexpr std::size_t k_longest = std::size_t{1} << 24, k_farthest = std::size_t{1} << 40;
      const std::string_view element = text_.substr(at, element_end - at);
      if (element.size() >= k_longest || offset_ + at >= k_farthest) return false;
      if (json_excess(element, JsonComments::refused) || !check_.is_json(element)) return false;
      if (check_.may_repeat_a_key()) note_repeated_key(element, at);
      array.push_back({offset_ + at, element.size()});
      return true;
    });
  }

  // The first one of the text.
  void note_repeated_key(std::string_view element, std::size_t at) {
    json value;
    const std::optional<JsonFault> fault = parse_json(element, value);
    if (!fault || (repeated_key_ && repeated_key_->byte < at)) return;
    repeated_key_ = fault;
    repeated_key_->byte += at;
  }

  std::string_view text_;
  std::uint64_t offset_;
  Walker walker_;
  KeyCheck check_;
  std::optional<JsonFault> repeated_key_;
  std::vector<LazyArray::Range> nodes_, lights_;
  std::vector<std::pair<std::size_t, std::size_t>> cuts_;
};

}  // namespace

std::string_view TextSource::at(std::uint64_t begin, std::size_t size) {
  if (file_.empty()) return begin < memory_.size() ? memory_.substr(begin, size) : std::string_view();
  if (begin < window_begin_ || begin + size > window_begin_ + window_.size()) {
    window_.resize(std::max(size, k_window_bytes));
    std::ifstream in(file_, std::ios::binary);
    in.seekg(static_cast<std::streamoff>(begin));
    in.read(window_.data(), static_cast<std::streamsize>(window_.size()));
    window_.resize(static_cast<std::size_t>(in.gcount()));
    window_begin_ = begin;
  }
  return std::string_view(window_).substr(begin - window_begin_, size);
}

json LazyArray::element(std::size_t index) const {
  const Range range = elements_[index];
  json value = json::parse(source_->at(range.begin, range.size), nullptr, false);
  if (value.is_discarded()) throw Error(file_, "byte " + std::to_string(range.begin), "has changed while it was read");
  return value;
}

const LazyArray* LazyArrays::at(const std::string& pointer) const {
  if (nodes.size() > 0 && pointer == k_lazy_nodes) return &nodes;
  return lights.size() > 0 && pointer == k_lazy_lights ? &lights : nullptr;
}

std::optional<std::string> without_long_arrays(std::string_view text, std::uint64_t offset, const std::string& file,
                                               const TextSource& source, LazyArrays& out) {
  LazyReader reader(text, offset);
  if (!reader.find_arrays()) return std::nullopt;
  out = reader.arrays(file, source);
  return reader.rest();
}

}  // namespace clusterbench::scene
