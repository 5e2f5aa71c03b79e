// A dump for `clusterbench check`: its JSON, a zero byte, and the bytes of all of its buffers.

#include "core/memory.h"
#include "dump/judge.h"
#include "fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace clusterbench;
  const std::string_view all(reinterpret_cast<const char*>(data), size);
  const std::size_t end = std::min(all.find('\0'), size);
  return fuzz::answered([&] {
    const MemoryLimitScope limit(std::uint64_t{64} << 20);
    dump::DumpFile file{"input.json", dump::parse_dump(all.substr(0, end), "input.json"), {}};
    if (file.record.camera.scene) return;  // gltf.cpp reads those
    if (file.record.buffers)
      for (const auto& [name, buffer] : *file.record.buffers) {
        file.buffers.push_back({name, name, 0, {}});
        for (std::size_t i = end + 1; i < size; ++i) file.buffers.back().bytes.push_back(std::byte{data[i]});
      }
    constexpr std::uint32_t k_most_cells = 5000;  // more take long, and are read no other way
    if (dump::frame_of(file).grid.cell_count() > k_most_cells) return;
    static_cast<void>(dump::check_text(dump::judge(file, {}), 3));
  });
}
