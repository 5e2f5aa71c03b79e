#pragma once
// Numbers from a glTF document's accessors, bufferViews and buffers, read only on request. Everything is checked before
// use; an error is thrown as Error with its JSON pointer.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scene/gltf_document/gltf_container.h"
#include "scene/gltf_document/gltf_location.h"

namespace clusterbench::scene {

// componentType values of glTF.
enum class Component : int { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

struct AccessorHead {
  Component component = Component::f32;
  std::string type;  // SCALAR, VEC3, VEC4; others have no meaning here
  bool normalized = false;
  std::size_t count = 0;
};

// Animations have few numbers, which are contiguous. Vertices have many, and they may be interleaved (byteStride).
enum class AccessorUse { animations, vertices };

class AccessorReader {
 public:
  // Both must outlive the reader.
  AccessorReader(const GltfFile& file, Warnings& warnings, AccessorUse use = AccessorUse::animations);

  const JsonLocation& root() const { return root_; }
  JsonLocation location(std::size_t accessor) const { return root_.at("accessors").at(accessor); }
  AccessorHead head(std::size_t accessor) const;
  // False: it names neither bufferView nor sparse values, so that all its numbers are 0.
  bool has_data(std::size_t accessor) const;

  // All elements, `components` doubles each; normalized integers become -1..1 or 0..1, sparse substitution is done. All
  // floats are finite. One reader returns at most k_most_numbers numbers of animations in total; vertices are bounded
  // by the limit on memory (core/memory.h).
  std::vector<double> numbers(std::size_t accessor, std::size_t components);
  static constexpr std::size_t k_most_numbers = std::size_t{1} << 24;
  // So that a small document that names one large file many times does not fill the memory.
  static constexpr std::size_t k_most_external_bytes = std::size_t{1} << 31;

  // The bytes of a bufferView, for readers with a format of their own.
  std::string_view view_bytes(const JsonLocation& reference) { return view(reference).bytes; }

  // Adds the bytes of the external files read so far, in the order of their buffers.
  void add_external_bytes(Sha256& hash) const;

 private:
  std::string_view buffer(std::size_t index);
  struct View {
    std::string_view bytes;
    std::size_t stride = 0;  // 0: elements are contiguous
    std::size_t offset = 0;  // of the first byte in its buffer
  };
  View view(const JsonLocation& reference);
  bool has_fallback(const JsonLocation& view) const;
  View plain_view(const JsonLocation& view, std::size_t stride);
  View decoded_view(const JsonLocation& view, const JsonLocation& extension, std::size_t index, std::size_t stride);
  void read_dense(const JsonLocation& accessor, const AccessorHead& head, std::size_t components,
                  std::vector<double>& out);
  void read_sparse(const JsonLocation& accessor, const AccessorHead& head, std::size_t components,
                   std::vector<double>& out);

  struct Bytes {
    std::string owned;
    bool external = false;
  };
  void count_numbers(const JsonLocation& accessor, std::size_t count, std::size_t components);

  const GltfFile& file_;
  JsonLocation root_;
  AccessorUse use_;
  std::map<std::size_t, Bytes> buffers_;
  std::map<std::size_t, std::string> decoded_;  // of compressed bufferViews
  std::size_t numbers_ = 0;                     // number of values returned
  std::size_t external_bytes_left_ = k_most_external_bytes;
};

}  // namespace clusterbench::scene
