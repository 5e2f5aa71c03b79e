#pragma once
// Warnings of a loader, grouped so that one warning for many locations is one line.

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace clusterbench::scene {

class Warnings {
 public:
  // Warnings whose pointers and messages differ only in numbers count as one; the first one is shown.
  void add(const std::string& pointer, const std::string& message);

  // A line each, in the order of their first locations: "pointer: message (and 69 more like it)".
  std::vector<std::string> lines() const;

  // The largest number of different warnings that are kept; further ones are only counted.
  static constexpr std::size_t k_most = 100;

 private:
  struct Kind {
    std::string first;
    std::size_t count = 1;
  };
  std::vector<Kind> kinds_;
  std::map<std::string, std::size_t> known_;  // shape -> index in kinds_
  std::size_t left_out_ = 0;
};

}  // namespace clusterbench::scene
