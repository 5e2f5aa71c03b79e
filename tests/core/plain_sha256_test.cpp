#include "core/plain_sha256.h"

#include <gtest/gtest.h>

#include <string>

#include "core/text.h"

namespace clusterbench {
namespace {

std::string hex_of(PlainSha256& sum) {
  std::string text;
  for (const unsigned char byte : sum.digest()) {
    constexpr char k_digits[] = "0123456789abcdef";
    text += {k_digits[byte >> 4], k_digits[byte & 15]};
  }
  return text;
}

std::string plain_hex(std::string_view bytes) {
  PlainSha256 sum;
  sum.add(bytes);
  return hex_of(sum);
}

// NIST, "SHA-256 test vectors" for FIPS 180-4.
TEST(PlainSha256, gives_the_published_sums) {
  EXPECT_EQ(plain_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(plain_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(plain_hex("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(plain_hex("abcdefghbcdefghicdefghijdefghijkefghijklfghijklmghijklmnhijklmno"
                      "ijklmnopjklmnopqklmnopqrlmnopqrsmnopqrstnopqrstu"),
            "cf5b16a778af8380036ce59e7b0492370b249b11e8f07a51afac45037afee9d1");
  EXPECT_EQ(plain_hex(std::string(1'000'000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

// sha256_hex() is OpenSSL's where that is built in. Every length around the end of a block.
TEST(PlainSha256, is_what_the_library_gives_for_every_length) {
  std::string bytes;
  for (int i = 0; i < 300; ++i) {
    ASSERT_EQ(plain_hex(bytes), sha256_hex(bytes)) << i << " bytes";
    bytes += static_cast<char>(i * 37);
  }
}

TEST(PlainSha256, does_not_depend_on_the_pieces) {
  std::string bytes;
  for (int i = 0; i < 1000; ++i) bytes += static_cast<char>(i * i);
  for (const std::size_t piece : {1u, 3u, 63u, 64u, 65u, 200u}) {
    PlainSha256 sum;
    for (std::size_t from = 0; from < bytes.size(); from += piece) sum.add(std::string_view(bytes).substr(from, piece));
    EXPECT_EQ(hex_of(sum), plain_hex(bytes)) << piece;
  }
}

}  // namespace
}  // namespace clusterbench
