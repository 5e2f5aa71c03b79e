#include "scene/gltf_document/gltf_location.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/error.h"
#include "core/text.h"

namespace clusterbench::scene {
namespace {

// Numbers within half a step of the largest float round to it.
constexpr double k_float_max = std::numeric_limits<float>::max(), k_half_step = 0x1p103;

// The pointer to a member or an element. RFC 6901: '~' and '/' inside a name are escaped.
std::string child_of(const std::string& pointer, std::string_view name) {
  std::string out;
  out.reserve(pointer.size() + 1 + name.size());
  out.append(pointer).append(1, '/');
  if (std::ranges::none_of(name, [](char c) { return c == '~' || c == '/'; })) return out.append(name);
  for (const char c : name) {
    if (c == '~') {
      out += "~0";
    } else if (c == '/') {
      out += "~1";
    } else {
      out += c;
    }
  }
  return out;
}

// None if it is not one that rounds to a finite number in single precision.
std::optional<double> number_of(const nlohmann::json& value) {
  if (!value.is_number()) return std::nullopt;
  const auto number = value.get<double>();
  return std::abs(number) < k_float_max + k_half_step ? std::optional(number) : std::nullopt;
}

}  // namespace

std::string kind_of(const nlohmann::json& value) {
  if (value.is_null()) return "null";
  if (value.is_boolean()) return "true or false";
  if (value.is_number()) return "the number " + value.dump();
  if (value.is_string()) return "a string";
  return value.is_array() ? (value.empty() ? "an empty array" : "an array") : "an object";
}

std::string one_line(std::string text) {
  constexpr std::size_t k_longest = 300;
  if (text.size() > k_longest) {
    std::size_t end = k_longest;
    while ((static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // not inside a UTF-8 sequence
    text = text.substr(0, end) + "...";
  }
  return printable(text);
}

bool is_float_max(double number) {
  return number > k_float_max - k_half_step && number < k_float_max + k_half_step;
}

void JsonLocation::refuse(const std::string& message) const {
  throw Error(*file_, pointer_.empty() ? "/" : pointer_, one_line(message));
}

void JsonLocation::warn(const std::string& message) const {
  warnings_->add(pointer_.empty() ? "/" : pointer_, one_line(message));
}

JsonLocation JsonLocation::at(std::string_view key) const {
  expect_object();
  const auto found = value_->find(key);
  if (found == value_->end()) refuse("'" + std::string(key) + "' is missing");
  JsonLocation out(*file_, *found, *warnings_, child_of(pointer_, key), lazy_);
  out.owned_ = owned_;
  if (lazy_ != nullptr) out.array_ = lazy_->at(out.pointer_);
  return out;
}

JsonLocation JsonLocation::at(std::size_t index) const {
  std::string pointer = child_of(pointer_, std::to_string(index));
  if (array_ != nullptr) {
    const auto element = std::make_shared<const nlohmann::json>(array_->element(index));
    JsonLocation out(*file_, *element, *warnings_, std::move(pointer));
    out.owned_ = element;
    return out;
  }
  JsonLocation out(*file_, (*value_)[index], *warnings_, std::move(pointer), lazy_);
  out.owned_ = owned_;
  return out;
}

void JsonLocation::expect_object() const {
  if (!value_->is_object()) refuse("found " + kind_of(*value_) + ", an object is needed");
}

void JsonLocation::expect_array() const {
  if (!value_->is_array()) refuse("found " + kind_of(*value_) + ", an array is needed");
}

std::size_t JsonLocation::elements() const {
  expect_array();
  if (size() == 0) warn("an empty array, where glTF asks for one element or more; read as absent");
  return size();
}

const std::string& JsonLocation::text() const {
  if (!value_->is_string()) refuse("found " + kind_of(*value_) + ", a string is needed");
  return value_->get_ref<const std::string&>();
}

bool JsonLocation::boolean() const {
  if (!value_->is_boolean()) refuse("found " + kind_of(*value_) + ", true or false is needed");
  return value_->get<bool>();
}

double JsonLocation::number() const {
  if (const std::optional<double> number = number_of(*value_)) return *number;
  if (!value_->is_number()) refuse("found " + kind_of(*value_) + ", a number is needed");
  refuse("found " + kind_of(*value_) + ", a number that single precision can hold is needed");
}

std::size_t JsonLocation::whole() const {
  constexpr double k_largest = 9007199254740992.0;  // 2^53: every whole number up to it is a double
  const double found = value_->is_number() ? value_->get<double>() : -1.0;
  if (!(found >= 0.0 && found <= k_largest) || found != std::floor(found)) {
    refuse("found " + kind_of(*value_) + ", a whole number from 0 is needed");
  }
  return static_cast<std::size_t>(found);
}

std::size_t JsonLocation::index(std::size_t count, const std::string& target) const {
  const std::size_t found = whole();
  if (found >= count) {
    refuse("refers to " + target + " " + std::to_string(found) + ", but there " +
           (count == 1 ? "is 1" : "are " + std::to_string(count)));
  }
  return found;
}

std::vector<double> JsonLocation::numbers(std::size_t count) const {
  if (!value_->is_array() || value_->size() != count) {
    refuse("found " + kind_of(*value_) + (value_->is_array() ? " of " + std::to_string(value_->size()) : "") + ", " +
           std::to_string(count) + " numbers are needed");
  }
  std::vector<double> out;
  for (std::size_t i = 0; i < count; ++i) {
    const std::optional<double> number = array_ == nullptr ? number_of((*value_)[i]) : std::nullopt;
    out.push_back(number ? *number : at(i).number());
  }
  return out;
}

}  // namespace clusterbench::scene
