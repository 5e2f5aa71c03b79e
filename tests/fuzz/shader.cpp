// A method of users' shaders: its JSON, a zero byte, and the bytes of all of its modules.

#include "core/memory.h"
#include "fuzz/input.h"
#include "gpu/user_shaders/shader_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace clusterbench;
  const std::string_view all(reinterpret_cast<const char*>(data), size);
  const std::size_t end = std::min(all.find('\0'), size), module = std::min(end + 1, size);
  return fuzz::answered([&] {
    const MemoryLimitScope limit(std::uint64_t{64} << 20);
    gpu::make_shader_file("input.json", all.substr(0, end),
                          [&](const std::string&, const std::string&) { return std::string(all.substr(module)); });
  });
}
