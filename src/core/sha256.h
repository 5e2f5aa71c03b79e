#pragma once
// SHA-256 of bytes that come in pieces; for a single piece see sha256_hex() of core/text.h.

#include <memory>
#include <string>
#include <string_view>

namespace clusterbench {

class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(Sha256&&) noexcept;
  Sha256& operator=(Sha256&&) noexcept;

  void add(std::string_view bytes);
  // Lower-case hexadecimal, of all bytes that were added; call it once.
  std::string hex();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace clusterbench
