#pragma once
// A value of a glTF document with its location, so that every error message names its JSON pointer.

#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "scene/gltf_document/gltf_lazy.h"
#include "scene/gltf_document/gltf_warnings.h"

namespace clusterbench::scene {

class JsonLocation {
 public:
  // `file`, `value`, `warnings` and `lazy` must outlive the JsonLocation. `lazy`: arrays of the document that are read
  // element by element; such an element lives as long as a location at or below it.
  JsonLocation(const std::string& file, const nlohmann::json& value, Warnings& warnings, std::string pointer = "",
               const LazyArrays* lazy = nullptr)
      : file_(&file), value_(&value), warnings_(&warnings), pointer_(std::move(pointer)), lazy_(lazy) {}

  const nlohmann::json& value() const { return *value_; }
  const std::string& pointer() const { return pointer_; }
  bool has(std::string_view key) const { return value_->is_object() && value_->contains(key); }
  std::size_t size() const { return array_ != nullptr ? array_->size() : value_->size(); }

  // A required member, or an element of an array.
  JsonLocation at(std::string_view key) const;
  JsonLocation at(std::size_t index) const;

  // Each throws Error(file, pointer, ...) if the value is not of that kind.
  void expect_object() const;
  void expect_array() const;
  // Number of elements of an array. Warns once of an empty one, since glTF requires one or more: call it once per
  // array.
  std::size_t elements() const;
  const std::string& text() const;
  bool boolean() const;
  double number() const;      // rounds to a finite number in single precision
  std::size_t whole() const;  // 0 .. 2^53
  std::size_t index(std::size_t count, const std::string& target) const;
  std::vector<double> numbers(std::size_t count) const;

  [[noreturn]] void refuse(const std::string& message) const;
  // For an error that does not stop loading.
  void warn(const std::string& message) const;

 private:
  const std::string* file_;
  const nlohmann::json* value_;
  Warnings* warnings_;
  std::string pointer_;
  const LazyArrays* lazy_ = nullptr;
  const LazyArray* array_ = nullptr;             // this is one of them
  std::shared_ptr<const nlohmann::json> owned_;  // the lazy element that is or contains this value
};

// printable(), and cut to a length suitable for one line: strings of a file in messages.
std::string one_line(std::string text);

// The largest single-precision number, which means "no end" in files; also if its decimals are rounded slightly up.
bool is_float_max(double number);

// "a number", "an array" ... for messages.
std::string kind_of(const nlohmann::json& value);

}  // namespace clusterbench::scene
