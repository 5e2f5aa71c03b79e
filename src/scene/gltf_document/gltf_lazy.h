#pragma once
// The long arrays of a large glTF file, its nodes and its lights, kept as text: an element is parsed on request and not
// kept. As values of a parsed document they would use twenty times as much memory as the text.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/json_document.h"

namespace clusterbench::scene {

// Bytes of a file, with a window in memory; or of a string in memory.
class TextSource {
 public:
  explicit TextSource(std::string_view memory) : memory_(memory) {}
  explicit TextSource(const std::filesystem::path& file) : file_(file) {}

  // Valid until the next call. Shorter if the file has become shorter.
  std::string_view at(std::uint64_t begin, std::size_t size);

 private:
  std::string_view memory_;
  std::filesystem::path file_;
  std::string window_;
  std::uint64_t window_begin_ = 0;
};

class LazyArray {
 public:
  struct Range {
    std::uint64_t begin : 40, size : 24;  // elements of 16 MiB and more stay in the document
  };

  LazyArray() = default;
  // `elements`: their bytes in `source`, each a JSON value; `file`: for messages.
  LazyArray(std::vector<Range> elements, std::string file, std::shared_ptr<TextSource> source)
      : elements_(std::move(elements)), file_(std::move(file)), source_(std::move(source)) {}

  std::size_t size() const { return elements_.size(); }
  // Throws Error (file, "byte N") if the file has changed since it was scanned.
  nlohmann::json element(std::size_t index) const;

 private:
  std::vector<Range> elements_;
  std::string file_;
  std::shared_ptr<TextSource> source_;
};

// By their JSON pointers.
struct LazyArrays {
  LazyArray nodes, lights;
  std::optional<JsonFault> repeated_key;  // within an element, by its byte in the text

  const LazyArray* at(const std::string& pointer) const;
};

inline constexpr const char* k_lazy_nodes = "/nodes";
inline constexpr const char* k_lazy_lights = "/extensions/KHR_lights_punctual/lights";

// The text without the elements of its long arrays, whose positions are stored in `out`: each element is valid JSON.
// nullopt if there are none, or if the text is broken, since the parser gives better messages. `offset`: of the text in
// the file; `source`: of the file's bytes.
std::optional<std::string> without_long_arrays(std::string_view text, std::uint64_t offset, const std::string& file,
                                               const TextSource& source, LazyArrays& out);

}  // namespace clusterbench::scene
