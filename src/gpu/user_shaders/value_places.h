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
  bool may_go_on = false;  // as many boundaries as the grid has; `numbers` is the fewest

  std::uint64_t length() const { return (numbers - 1) * step + size; }
};
// `numbers`: at least 1.
ValuePlace place_of(const result::ShaderValue& value, std::uint64_t at, std::uint64_t numbers);

// Throws Error ("", `where`/at) for a place that ends beyond `room` bytes.
void check_room(const ValuePlace& place, std::uint64_t room, const std::string& where);
// By index in their list; nullopt: not known yet. Throws Error ("", `pointer`/N/at) for the second of two that share a
// byte.
void check_overlaps(const std::vector<std::optional<ValuePlace>>& places, const std::string& pointer);
// The fields of the lights in a buffer. `lights`: rows that are looked at.
struct LightPlaces {
  std::uint64_t at = 0, stride = 1, lights = 0;
  std::vector<std::optional<ValuePlace>> fields;  // in the row
  std::string where;
};
LightPlaces places_of_lights(const result::ShaderLightRows& rows, std::uint64_t lights, const std::string& where);
// Throws Error ("", `pointer`/N/at) for a value, and ("", `where`/fields/N/at) for a light of `second`, that share a
// byte with a light of the others.
void check_apart(const std::vector<std::optional<ValuePlace>>& values, const std::string& pointer,
                 const LightPlaces& lights);
void check_apart(const LightPlaces& first, const LightPlaces& second);

// Throws Error ("", `pointer`) where no value is at a byte that the module reads of its push constants.
void check_covered(const std::vector<std::optional<ValuePlace>>& places, const std::vector<bool>& read,
                   const std::string& module, const std::string& pointer);

}  // namespace clusterbench::gpu
