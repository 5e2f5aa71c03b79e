#include "gpu/user_shaders/value_places.h"

#include <algorithm>

#include "core/error.h"
#include "core/text.h"
#include "gpu/user_shaders/light_rows.h"
#include "gpu/user_shaders/number_bytes.h"

namespace clusterbench::gpu {
namespace {

// One number of a value.
struct NumberPlace {
  std::uint64_t begin, end;
  std::size_t value;
};

// The field of a light that has one of these bytes.
std::optional<std::size_t> field_within(const LightPlaces& lights, std::uint64_t begin, std::uint64_t end) {
  if (lights.lights == 0 || end <= lights.at) return std::nullopt;
  const std::uint64_t first = begin > lights.at ? (begin - lights.at) / lights.stride : 0,
                      last = std::min(lights.lights - 1, (end - 1 - lights.at) / lights.stride);
  for (std::uint64_t light = first; light <= last && light < lights.lights; ++light)
    for (std::size_t i = 0; i < lights.fields.size(); ++i) {
      const std::uint64_t field = lights.at + light * lights.stride + lights.fields[i]->at;
      if (begin < field + lights.fields[i]->length() && field < end) return i;
    }
  return std::nullopt;
}

[[noreturn]] void refuse_shared(const std::string& where, std::uint64_t at, std::uint64_t byte,
                                const std::string& other) {
  throw Error("", where + "/at",
              "is " + std::to_string(at) + ": byte " + std::to_string(byte) + " is one of " + other +
                  ", too; allowed: bytes of its own");
}
void check_number_apart(const LightPlaces& lights, std::uint64_t begin, const ValuePlace& place,
                        const std::string& where) {
  if (const auto field = field_within(lights, begin, begin + place.size)) {
    const std::uint64_t row = lights.at + lights.fields[*field]->at;
    const std::uint64_t other = begin > row ? row + (begin - row) / lights.stride * lights.stride : row;
    refuse_shared(where, place.at, std::max(begin, other), lights.where + "/fields/" + std::to_string(*field));
  }
}

}  // namespace

ValuePlace place_of(const result::ShaderValue& value, std::uint64_t at, std::uint64_t numbers) {
  const std::uint64_t size = bytes_of_number(value.type);
  return {at, numbers, size, value.step.value_or(size), false};
}

void check_room(const ValuePlace& place, std::uint64_t room, const std::string& where) {
  if (place.at <= room && place.length() <= room - place.at) return;
  throw Error("", where + "/at",
              "is " + std::to_string(place.at) + ": its " + (place.may_go_on ? "first " : "") +
                  number_of(place.length(), "byte") + " end beyond the " + std::to_string(room) + " that there are");
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
    refuse_shared(pointer + "/" + std::to_string(second), places[second]->at, next.begin,
                  pointer + "/" + std::to_string(first));
  }
}

LightPlaces places_of_lights(const result::ShaderLightRows& rows, std::uint64_t lights, const std::string& where) {
  LightPlaces out{rows.at.value_or(0), rows.stride, lights, {}, where};
  for (const result::ShaderLightField& field : rows.fields) {
    const std::uint64_t size = bytes_of_number(field.type);
    out.fields.emplace_back(ValuePlace{field.at, numbers_of(field), size, size, false});
  }
  return out;
}

void check_apart(const std::vector<std::optional<ValuePlace>>& values, const std::string& pointer,
                 const LightPlaces& lights) {
  for (std::size_t i = 0; i < values.size(); ++i)
    for (std::uint64_t n = 0; values[i] && n < values[i]->numbers; ++n)
      check_number_apart(lights, values[i]->at + n * values[i]->step, *values[i], pointer + "/" + std::to_string(i));
}

void check_apart(const LightPlaces& first, const LightPlaces& second) {
  for (std::uint64_t light = 0; light < second.lights; ++light)
    for (std::size_t i = 0; i < second.fields.size(); ++i) {
      const ValuePlace& place = *second.fields[i];
      for (std::uint64_t n = 0; n < place.numbers; ++n)
        check_number_apart(first, second.at + light * second.stride + place.at + n * place.step, place,
                           second.where + "/fields/" + std::to_string(i));
    }
}

void check_covered(const std::vector<std::optional<ValuePlace>>& places, const std::vector<bool>& read,
                   const std::string& module, const std::string& pointer) {
  std::vector<bool> given(read.size(), false);
  for (const std::optional<ValuePlace>& place : places) {
    if (!place) return;
    for (std::uint64_t n = 0; n < place->numbers || place->may_go_on; ++n) {
      const std::uint64_t byte = place->at + n * place->step;
      if (byte >= given.size()) break;
      for (std::uint64_t i = 0; i < place->size && byte + i < given.size(); ++i) given[byte + i] = true;
    }
  }
  for (std::size_t byte = 0; byte < read.size(); ++byte)
    if (read[byte] && !given[byte])
      throw Error("", pointer,
                  "say nothing of byte " + std::to_string(byte) + ", which the push constants of " + module +
                      " have; needed are values for all " + number_of(read.size(), "byte") + ", but for gaps");
}

}  // namespace clusterbench::gpu
