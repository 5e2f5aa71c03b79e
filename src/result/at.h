#pragma once
// Values behind fields of which any may be absent or null:
//
//   number<&Case::timing, &Timing::frame_ns, &Time::median>(result_case)
//
// All are functions, so that tables of figures can hold pointers to them.

#include <cmath>
#include <optional>

#include "result/fields.h"

namespace clusterbench::result {

namespace detail {

template <class Record, class T>
Record record_of(T Record::*);
template <auto Member>
using RecordOf = decltype(record_of(Member));

// The value, or the value in a std::optional or Nullable.
template <class T>
const auto* present(const T& value) {
  if constexpr (requires { value.has_value(); }) {
    using Found = decltype(present(*value));
    return value ? present(*value) : Found(nullptr);
  } else {
    return &value;
  }
}

}  // namespace detail

// Null if any of the fields has no value.
template <auto First, auto... Rest>
const auto* part(const detail::RecordOf<First>& record) {
  const auto* found = detail::present(record.*First);
  if constexpr (sizeof...(Rest) == 0) {
    return found;
  } else {
    using Found = decltype(part<Rest...>(*found));
    return found != nullptr ? part<Rest...>(*found) : Found(nullptr);
  }
}

// None if any of the fields has no value, or if the number is null.
template <auto First, auto... Rest>
std::optional<double> number(const detail::RecordOf<First>& record) {
  const auto* found = part<First, Rest...>(record);
  if (found == nullptr || !std::isfinite(static_cast<double>(*found))) return std::nullopt;
  return static_cast<double>(*found);
}

}  // namespace clusterbench::result
