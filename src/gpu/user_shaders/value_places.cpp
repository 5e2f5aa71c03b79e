#include "gpu/user_shaders/value_places.h"

#include <algorithm>

#include "core/error.h"
#include "core/text.h"
#include "gpu/user_shaders/number_bytes.h"

namespace clusterbench::gpu {
namespace {

// One number of a value.
struct NumberPlace {
  std::uint64_t begin, end;
  std::size_t value;
};

}  // namespace

ValuePlace place_of(const result::ShaderValue& value, std::uint64_t at, std::uint64_t numbers) {
  const std::uint64_t size = bytes_of_number(value.type);
  return {at, numbers, size, value.step.value_or(size)};
}

void check_room(const ValuePlace& place, std::uint64_t room, const std::string& where) {
  if (place.at <= room && place.length() <= room - place.at) return;
  throw Error("", where + "/at",
              "is " + std::to_string(place.at) + ": its " + number_of(place.length(), "byte") + " end beyond the " +
                  std::to_string(room) + " that there are");
}

void check_overlaps(const std::vector<std::optional<ValuePlace>>& places, const std::string& pointer) {
  std::vector<NumberPlace> numbers;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i]) continue;
    for (std::uint64_t n = 0; n < places[i]->numbers; ++n) {
      const std::uint64_t begin = places[i]->at + n * places[i]->step;
      numbers.push_back({begin, begin + places[i]->size, i});
    }
  }
  std::ranges::sort(numbers, {}, &NumberPlace::begin);
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    const NumberPlace &one = numbers[i - 1], &next = numbers[i];
    if (next.begin >= one.end) continue;
    const auto [first, second] = std::minmax(one.value, next.value);
    throw Error("", pointer + "/" + std::to_string(second) + "/at",
                "is " + std::to_string(places[second]->at) + ": byte " + std::to_string(next.begin) + " is one of " +
                    pointer + "/" + std::to_string(first) + ", too; allowed: bytes of its own");
  }
}

void check_covered(const std::vector<std::optional<ValuePlace>>& places, const std::vector<bool>& read,
                   const std::string& module, const std::string& pointer) {
  std::vector<bool> given(read.size(), false);
  for (const std::optional<ValuePlace>& place : places) {
    if (!place) return;
    for (std::uint64_t n = 0; n < place->numbers; ++n)
      for (std::uint64_t byte = place->at + n * place->step, i = 0; i < place->size && byte + i < given.size(); ++i)
        given[byte + i] = true;
  }
  for (std::size_t byte = 0; byte < read.size(); ++byte)
    if (read[byte] && !given[byte])
      throw Error("", pointer,
                  "say nothing of byte " + std::to_string(byte) + ", which the push constants of " + module +
                      " have; needed are values for all " + number_of(read.size(), "byte") + ", but for gaps");
}

}  // namespace clusterbench::gpu
