#include "scene/gltf_document/gltf_accessor.h"
#include "scene/gltf_document/gltf_files.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "core/memory.h"
#include "core/text.h"
#include "scene/geometry.h"
#include "scene/gltf_document/gltf_meshopt.h"

namespace clusterbench::scene {
namespace {

std::size_t size_of(Component component) {
  switch (component) {
    case Component::i8:
    case Component::u8:
      return 1;
    case Component::i16:
    case Component::u16:
      return 2;
    case Component::u32:
    case Component::f32:
      break;
  }
  return 4;
}

Component component_of(const JsonLocation& location) {
  for (const Component known :
       {Component::i8, Component::u8, Component::i16, Component::u16, Component::u32, Component::f32}) {
    if (location.whole() == static_cast<std::size_t>(known)) return known;
  }
  location.refuse("found " + kind_of(location.value()) + ", one of 5120, 5121, 5122, 5123, 5125, 5126 is needed");
}

std::uint32_t little_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

// The formulas of glTF 2.0, 3.11 (animations), for normalized integers.
double decoded(std::string_view bytes, const AccessorHead& head) {
  const std::uint32_t raw = little_endian(bytes);
  const bool scaled = head.normalized;
  switch (head.component) {
    case Component::i8: {
      const double value = static_cast<std::int8_t>(raw);
      return scaled ? std::max(value / 127.0, -1.0) : value;
    }
    case Component::i16: {
      const double value = static_cast<std::int16_t>(raw);
      return scaled ? std::max(value / 32767.0, -1.0) : value;
    }
    case Component::u8:
      return scaled ? raw / 255.0 : raw;
    case Component::u16:
      return scaled ? raw / 65535.0 : raw;
    case Component::u32:
      return raw;
    case Component::f32:
      break;
  }
  return std::bit_cast<float>(raw);
}

std::string decoded(std::string_view base64, const JsonLocation& location) {
  std::optional<std::string> bytes = base64_decoded(base64);
  if (!bytes) location.refuse("the data is not base64, or cut off");
  return std::move(*bytes);
}

// Scenes may come from untrusted sources: they may name no file outside of their own folder.
bool stays_in_folder(const std::string& name) {
  if (printable(name) != name) return false;  // what is no UTF-8 is no name on Windows
  const std::filesystem::path plain = std::filesystem::path(name).lexically_normal();
  const bool escapes = plain.has_root_path() || (!plain.empty() && *plain.begin() == "..");
  return !escapes;
}

std::size_t array_size(const JsonLocation& root, const std::string& key) {
  if (!root.has(key)) return 0;
  root.at(key).expect_array();
  return root.at(key).size();
}

std::size_t whole_or(const JsonLocation& object, const std::string& key, std::size_t otherwise) {
  return object.has(key) ? object.at(key).whole() : otherwise;
}

std::size_t at_least_one(const JsonLocation& location) {
  const std::size_t number = location.whole();
  if (number == 0) location.refuse("found 0, 1 or more is needed");
  return number;
}

// Elements of the same size, at a fixed distance in bytes.
struct Elements {
  std::string_view bytes;
  std::size_t size, stride;

  std::string_view at(std::size_t index) const { return bytes.substr(index * stride, size); }
};

// Exporters also write strides for keys of animations, although glTF allows none there; a plausible one is used.
std::size_t stride_of(const JsonLocation& location, AccessorUse use) {
  const std::size_t stride = location.whole();
  if (stride == 0) {
    location.warn("found 0, where glTF asks for 4 to 252; read as no stride");
    return 0;
  }
  if (stride > 252 || (stride < 4 && use == AccessorUse::vertices))
    location.refuse("found " + std::to_string(stride) + ", 4 to 252 is needed");
  if (use == AccessorUse::animations)
    location.warn("a stride on keys of an animation, where glTF has none; read as so many bytes from one to the next");
  return stride;
}

// `count` elements of `element` bytes from byteOffset of `object` on; rejects elements outside `view`, which begins at
// byte `start` of its buffer.
Elements elements_of(std::string_view view, std::size_t start, std::size_t stride, const JsonLocation& object,
                     std::size_t count, std::size_t element, std::size_t alignment) {
  const std::size_t offset = whole_or(object, "byteOffset", 0), step = stride == 0 ? element : stride;
  if (offset % alignment != 0) {
    object.at("byteOffset").refuse("must be a multiple of the component's " + std::to_string(alignment) + " bytes");
  }
  if ((start + offset) % alignment != 0) {
    object.at("bufferView")
        .refuse("begins at byte " + std::to_string(start) + " of its buffer, where components of " +
                std::to_string(alignment) + " bytes must begin at a multiple of that");
  }
  if (step < element)
    object.refuse("elements of " + std::to_string(element) + " bytes do not fit into a byteStride of " +
                  std::to_string(step));
  // The last element need not be followed by a whole stride.
  const bool fits =
      offset <= view.size() &&
      (count == 0 || (element <= view.size() - offset && count - 1 <= (view.size() - offset - element) / step));
  if (!fits) {
    object.refuse(std::to_string(count) + " elements of " + std::to_string(element) + " bytes from byte " +
                  std::to_string(offset) + " on do not fit into a bufferView of " + std::to_string(view.size()) +
                  " bytes");
  }
  return {view.substr(offset), element, step};
}

}  // namespace

AccessorReader::AccessorReader(const GltfFile& file, Warnings& warnings, AccessorUse use)
    : file_(file), root_(file.name, file.json, warnings, "", &file.lazy), use_(use) {}

AccessorHead AccessorReader::head(std::size_t accessor) const {
  const JsonLocation from = location(accessor);
  AccessorHead head;
  head.component = component_of(from.at("componentType"));
  head.type = from.at("type").text();
  head.count = from.at("count").whole();  // 0 for an animation without keys
  if (from.has("normalized")) head.normalized = from.at("normalized").boolean();
  if (head.normalized && (head.component == Component::f32 || head.component == Component::u32)) {
    from.at("normalized").refuse("only 8-bit and 16-bit integers can be normalized");
  }
  return head;
}

bool AccessorReader::has_data(std::size_t accessor) const {
  return location(accessor).has("bufferView") || location(accessor).has("sparse");
}

std::vector<double> AccessorReader::numbers(std::size_t accessor, std::size_t components) {
  const JsonLocation from = location(accessor);
  const AccessorHead about = head(accessor);
  count_numbers(from, about.count, components);
  std::vector<double> out;
  read_dense(from, about, components, out);
  read_sparse(from, about, components, out);
  for (const double number : out) {
    if (!std::isfinite(number)) from.refuse("holds a number that is infinite or none at all");
  }
  return out;
}

void AccessorReader::count_numbers(const JsonLocation& accessor, std::size_t count, std::size_t components) {
  if (use_ == AccessorUse::vertices) {
    if (count > std::numeric_limits<std::uint32_t>::max()) accessor.at("count").refuse("more than 2^32 vertices");
    numbers_ += count * components;
    return check_memory("numbers of vertices", numbers_, sizeof(double), k_fewer_triangles);
  }
  if (count > (k_most_numbers - numbers_) / components) {
    accessor.at("count").refuse("more than " + std::to_string(k_most_numbers) + " numbers of animation in one file");
  }
  numbers_ += count * components;
}

void AccessorReader::add_external_bytes(Sha256& hash) const {
  for (const auto& [index, bytes] : buffers_)
    if (bytes.external) hash.add(bytes.owned);
}

void AccessorReader::read_dense(const JsonLocation& accessor, const AccessorHead& head, std::size_t components,
                                std::vector<double>& out) {
  if (!accessor.has("bufferView")) {
    if (accessor.has("byteOffset")) accessor.at("byteOffset").refuse("means nothing without bufferView");
    out.assign(head.count * components, 0.0);
    return;
  }
  const View from = view(accessor.at("bufferView"));
  const std::size_t size = size_of(head.component);
  const Elements elements =
      elements_of(from.bytes, from.offset, from.stride, accessor, head.count, size * components, size);
  out.reserve(head.count * components);
  for (std::size_t i = 0; i < head.count; ++i) {
    const std::string_view element = elements.at(i);
    for (std::size_t at = 0; at < element.size(); at += size) out.push_back(decoded(element.substr(at, size), head));
  }
}

void AccessorReader::read_sparse(const JsonLocation& accessor, const AccessorHead& head, std::size_t components,
                                 std::vector<double>& out) {
  if (!accessor.has("sparse")) return;
  const JsonLocation sparse = accessor.at("sparse"), indices = sparse.at("indices"), values = sparse.at("values");
  const std::size_t count = at_least_one(sparse.at("count"));
  if (count > head.count) sparse.at("count").refuse("more than the accessor's " + std::to_string(head.count));
  const Component index_component = component_of(indices.at("componentType"));
  if (index_component != Component::u8 && index_component != Component::u16 && index_component != Component::u32) {
    indices.at("componentType").refuse("indices must be 5121, 5123 or 5125");
  }
  const std::size_t index_size = size_of(index_component), size = size_of(head.component);
  const View of_indices = view(indices.at("bufferView")), of_values = view(values.at("bufferView"));
  const Elements locations =
      elements_of(of_indices.bytes, of_indices.offset, 0, indices, count, index_size, index_size);
  const Elements replaced = elements_of(of_values.bytes, of_values.offset, 0, values, count, size * components, size);
  std::optional<std::size_t> last;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t index = little_endian(locations.at(i));
    if (index >= head.count || (last && index <= *last)) {
      indices.refuse("index " + std::to_string(index) + " at position " + std::to_string(i) +
                     ": indices must ascend and be less than " + std::to_string(head.count));
    }
    last = index;
    for (std::size_t k = 0; k < components; ++k) {
      out[index * components + k] = decoded(replaced.at(i).substr(k * size, size), head);
    }
  }
}

AccessorReader::View AccessorReader::view(const JsonLocation& reference) {
  const std::size_t views = array_size(root_, "bufferViews");
  const std::size_t chosen = reference.index(views, "bufferView");
  const JsonLocation view = root_.at("bufferViews").at(chosen);
  std::size_t stride = 0;
  if (view.has("byteStride")) stride = stride_of(view.at("byteStride"), use_);
  const std::optional<JsonLocation> compressed = meshopt_extension(view);
  if (compressed && (has_meshopt() || !has_fallback(view))) return decoded_view(view, *compressed, chosen, stride);
  return plain_view(view, stride);
}

// Whether a compressed view's own buffer holds the same numbers for readers without decompression.
bool AccessorReader::has_fallback(const JsonLocation& view) const {
  const std::size_t index = view.at("buffer").index(array_size(root_, "buffers"), "buffer");
  return root_.at("buffers").at(index).has("uri") || (index == 0 && file_.binary);
}

AccessorReader::View AccessorReader::decoded_view(const JsonLocation& view, const JsonLocation& extension,
                                                  std::size_t index, std::size_t stride) {
  const MeshoptView about = meshopt_view(extension);
  const auto [known, is_new] = decoded_.try_emplace(index);
  try {
    if (is_new) known->second = meshopt_decoded(about, plain_view(extension, 0).bytes, extension);
  } catch (...) {
    decoded_.erase(known);
    throw;
  }
  const std::size_t length = at_least_one(view.at("byteLength"));
  if (length > known->second.size())
    view.at("byteLength")
        .refuse(std::to_string(length) + " bytes, the compressed data holds " + std::to_string(known->second.size()));
  const bool is_strided = about.mode == MeshoptMode::attributes && stride == 0;
  return {std::string_view(known->second).substr(0, length), is_strided ? about.stride : stride};
}

// `view`: a bufferView, or the compressed bytes of one, which are given in the same way.
AccessorReader::View AccessorReader::plain_view(const JsonLocation& view, std::size_t stride) {
  const std::size_t index = view.at("buffer").index(array_size(root_, "buffers"), "buffer");
  const std::size_t length = at_least_one(view.at("byteLength")), offset = whole_or(view, "byteOffset", 0);
  const std::string_view bytes = buffer(index);
  if (offset > bytes.size() || length > bytes.size() - offset) {
    view.refuse("bytes " + std::to_string(offset) + " to " + std::to_string(offset + length) +
                " do not fit into buffer " + std::to_string(index) + " of " + std::to_string(bytes.size()) + " bytes");
  }
  return {bytes.substr(offset, length), stride, offset};
}

std::string_view AccessorReader::buffer(std::size_t index) {
  const JsonLocation location = root_.at("buffers").at(index);
  const std::size_t length = at_least_one(location.at("byteLength"));
  const auto enough = [&](std::string_view bytes) {
    if (bytes.size() < length) {
      location.refuse("byteLength is " + std::to_string(length) + ", but there are " + std::to_string(bytes.size()) +
                      " bytes");
    }
    return bytes.substr(0, length);
  };
  if (const auto known = buffers_.find(index); known != buffers_.end()) return enough(known->second.owned);
  if (!location.has("uri")) {
    if (index != 0 || !file_.binary) location.refuse("has no uri, and there is no BIN chunk for it");
    return enough(*file_.binary);
  }
  const std::string& uri = location.at("uri").text();
  Bytes bytes;
  if (uri.starts_with("data:")) {
    const std::size_t comma = uri.find(";base64,");
    if (comma == std::string::npos) location.at("uri").refuse("a data URI must be base64");
    bytes.owned = decoded(std::string_view(uri).substr(comma + 8), location.at("uri"));
  } else {
    const std::string name = percent_decoded(uri);
    if (has_scheme(uri) || !stays_in_folder(name))
      location.at("uri").refuse("found '" + uri + "'; only files beside this one or below, and data URIs, are read");
    if (length > external_bytes_left_) location.refuse("more than 2 GiB of external buffers");
    bytes.external = true;
    const std::filesystem::path beside =
        std::filesystem::path(file_.name).parent_path() / std::filesystem::path(name).lexically_normal();
    bytes.owned = read_bytes(beside, file_.name, location.at("uri").pointer(), length);
    external_bytes_left_ -= bytes.owned.size();
  }
  return enough(buffers_.emplace(index, std::move(bytes)).first->second.owned);
}

}  // namespace clusterbench::scene
