// The container alone: header, chunks and JSON of a .glb. Its lengths are put right in three of four inputs, or almost
// every change would end there.

#include <cstring>
#include <vector>

#include "fuzz/input.h"
#include "scene/gltf_document/gltf_container.h"

namespace {

void put_length(std::vector<std::uint8_t>& bytes, std::size_t at, std::size_t value) {
  for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace clusterbench;
  std::vector<std::uint8_t> bytes(data, data + size);
  constexpr std::size_t k_headers = 20;
  if (size > k_headers && data[size - 1] % 4 != 0) {
    bytes.resize(size / 4 * 4);
    std::memcpy(bytes.data(), "glTF", 4);
    put_length(bytes, 4, 2);
    put_length(bytes, 8, bytes.size());
    if (data[size - 1] % 4 == 1) put_length(bytes, 12, bytes.size() - k_headers);
  }
  return fuzz::answered([&] {
    scene::GltfFile file;
    scene::read_gltf_file(fuzz::written(bytes.data(), bytes.size(), ".glb"), file);
  });
}
