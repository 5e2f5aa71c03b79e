#pragma once
// SHA-256 of bytes that come in pieces; sha256_hex() of core/text.h is of one.

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
  // Lower-case hexadecimal, of all that was added; once.
  std::string hex();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace clusterbench
