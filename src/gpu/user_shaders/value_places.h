#pragma once
// The bytes that values take in a buffer or among push constants.

#include <optional>
#include <string>
#include <vector>

#include "gpu/user_shaders/spirv_module.h"
#include "result/documents/shader.h"

namespace clusterbench::gpu {

// A value's bytes: `numbers` of `size` bytes each, `step` apart.
struct ValuePlace {
  std::uint64_t at = 0, numbers = 1, size = 4, step = 4;

  std::uint64_t length() const { return (numbers - 1) * step + size; }
};
// `numbers`: at least 1.
ValuePlace place_of(const result::ShaderValue& value, std::uint64_t at, std::uint64_t numbers);

// Throws Error ("", `where`/at) for a place that ends beyond `room` bytes.
void check_room(const ValuePlace& place, std::uint64_t room, const std::string& where);
// By index in their list; nullopt: not known yet. Throws Error ("", `pointer`/N/at) for the second of two that share a
// byte.
void check_overlaps(const std::vector<std::optional<ValuePlace>>& places, const std::string& pointer);
// Throws Error ("", `pointer`) where no value is at a byte that the module reads of its push constants.
void check_covered(const std::vector<std::optional<ValuePlace>>& places, const std::vector<bool>& read,
                   const std::string& module, const std::string& pointer);

}  // namespace clusterbench::gpu
