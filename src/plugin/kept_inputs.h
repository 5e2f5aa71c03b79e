#pragma once
// What a method was given, kept beside it: other methods read the same memory, so what a plug-in wrote there is found
// and taken back.

#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

namespace clusterbench::plugin {

class KeptInputs {
 public:
  // `name`: of the array, for messages. It must outlive this object.
  template <class Number>
  void keep(const char* name, const Number* data, std::size_t count) {
    if (count == 0) return;
    const auto* bytes = reinterpret_cast<const std::byte*>(data);
    parts_.push_back({name, bytes, {bytes, bytes + count * sizeof(Number)}});
  }

  // Puts back what has changed. Returns its names: "lights.x, lights.y"; "" if nothing has.
  std::string put_back() const {
    std::string names;
    for (const Part& part : parts_) {
      if (std::memcmp(part.place, part.bytes.data(), part.bytes.size()) == 0) continue;
      std::memcpy(const_cast<std::byte*>(part.place), part.bytes.data(), part.bytes.size());
      names += (names.empty() ? "" : ", ") + std::string(part.name);
    }
    return names;
  }

 private:
  struct Part {
    const char* name;
    const std::byte* place;
    std::vector<std::byte> bytes;
  };
  std::vector<Part> parts_;
};

}  // namespace clusterbench::plugin
