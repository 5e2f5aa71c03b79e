#include "gpu/user_shaders/block_types.h"

#include <algorithm>

#include "core/error.h"

namespace clusterbench::gpu {
namespace {

const BlockNumber* declared_at(const std::vector<BlockNumber>& numbers, std::uint64_t byte) {
  const auto found = std::ranges::lower_bound(numbers, byte, {}, &BlockNumber::at);
  return found != numbers.end() && found->at == byte ? &*found : nullptr;
}

bool can_be(const std::string& type, const BlockNumber& declared, const SpirvModule& module) {
  const bool is_float = type.front() == 'f', is_same_size = type.substr(1) == std::to_string(8 * declared.bytes);
  if (declared.kind != 'f') return !is_float || !is_same_size || module.casts_to_float;
  return (is_float && is_same_size) || module.casts_to_whole;
}

}  // namespace

void check_types(const std::vector<BlockView>& views, const ValuePlace& place, const std::string& type,
                 const std::string& where) {
  for (std::uint64_t n = 0; n < place.numbers; ++n) {
    const std::uint64_t byte = place.at + n * place.step;
    std::string other;
    bool fits = false;
    for (const BlockView& view : views)
      if (const BlockNumber* declared = declared_at(*view.numbers, byte)) {
        fits = fits || can_be(type, *declared, *view.module);
        other = "byte " + std::to_string(byte) + " of " + view.name + " is " + declared->kind +
                std::to_string(8 * declared->bytes);
      }
    if (!fits && !other.empty()) throw Error("", where + "/type", "is " + type + "; " + other);
  }
}

}  // namespace clusterbench::gpu
